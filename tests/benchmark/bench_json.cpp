// Our JSON parser beside RapidJSON and simdjson, each building its whole tree from the same light file in memory. Before
// anything is timed, all of them must have read the same: the error stands beside the speed.
//
// "NAME/warm" finds the memory of the document before it in malloc's hands, "NAME/cold" has to get all of it from the kernel,
// as a program that reads one file does. Left to itself malloc gives memory back or not as sizes happen to fall, and one
// parser's blocks decide over another's speed.
#include <benchmark/benchmark.h>
#include <malloc.h>

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/benchmark/json_yardsticks.h"
#include "tests/benchmark/light_file_text.h"

namespace {

using namespace seaglare::benchmark;

constexpr std::size_t text_bytes = 30'000'000;
constexpr int repetitions = 9;

const JsonParser* const parsers[] = {&our_parser, &rapidjson_parser, &rapidjson_sse2_parser, &simdjson_parser,
                                     &simdjson_reused_parser};

// How many of the numbers are not, to the bit, what strtod makes of their tokens.
std::size_t wrong_numbers(const std::vector<double>& numbers, const std::vector<double>& right) {
    if (numbers.size() != right.size()) return std::max(numbers.size(), right.size());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < right.size(); ++i)
        wrong += std::bit_cast<std::uint64_t>(numbers[i]) != std::bit_cast<std::uint64_t>(right[i]) ? 1 : 0;
    return wrong;
}

struct Difference {
    std::size_t wrong_numbers = 0;
    bool strings_differ = false;
};

Difference compared(const JsonParser& parser, const std::string& text, const std::vector<double>& right) {
    static const Contents ours = our_parser.contents(text);
    const Contents theirs = parser.contents(text);
    return {wrong_numbers(theirs.numbers, right), theirs.strings != ours.strings ||
                                                      theirs.string_bytes != ours.string_bytes ||
                                                      theirs.string_hash != ours.string_hash};
}

enum class Memory { warm, cold };

void measure(benchmark::State& state, const JsonParser& parser, const std::string& text,
             Difference difference, Memory memory) {
    for (auto _ : state) {
        if (!parser.parse(text)) state.SkipWithError("refused");
        if (memory == Memory::warm) continue;
        state.PauseTiming();
        malloc_trim(0);
        state.ResumeTiming();
    }
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * text.size()));
    state.counters["wrong_numbers"] = static_cast<double>(difference.wrong_numbers);
    state.counters["strings_differ"] = difference.strings_differ ? 1 : 0;
}

// Everything from the heap, and nothing given back unless asked.
bool keep_memory() {
    return mallopt(M_MMAP_MAX, 0) == 1 && mallopt(M_TRIM_THRESHOLD, 1 << 30) == 1;
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    if (!keep_memory())
        std::fputs("warning: malloc keeps its own rules; warm and cold may be mixed\n", stderr);
    const std::string text = light_file_text_of_bytes(text_bytes);
    const std::vector<double> right = c_library.contents(text).numbers;
    std::fprintf(stderr, "%.1f MB, %zu numbers\n", static_cast<double>(text.size()) / 1e6, right.size());

    bool different = false;
    for (const JsonParser* parser : parsers) {
        const Difference difference = compared(*parser, text, right);
        different = different || difference.wrong_numbers != 0 || difference.strings_differ;
        for (const Memory memory : {Memory::warm, Memory::cold}) {
            const std::string name = parser->name + std::string(memory == Memory::warm ? "/warm" : "/cold");
            const auto run = [&text, parser, difference, memory](benchmark::State& state) {
                measure(state, *parser, text, difference, memory);
            };
            benchmark::RegisterBenchmark(name.c_str(), run)
                ->Unit(benchmark::kMillisecond)
                ->Repetitions(repetitions);
        }
    }
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    if (different)
        std::fputs("error: the parsers do not agree; see wrong_numbers and strings_differ\n", stderr);
    return different ? 1 : 0;
}
