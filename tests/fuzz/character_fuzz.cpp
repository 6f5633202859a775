// libFuzzer target: no text crashes the reading of a character, what it gives is a rhythm, and the notation written from it
// means the same light.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "lightdb/character.h"
#include "tests/fuzz/allocation_bound.h"

namespace {

using namespace seaglare;
using lightdb::Character;

// A phase is written in six bytes ("fl.1s,") and kept in four lists of up to 24 bytes, each of which may live twice while
// it grows. A class without durations stands for up to 240 flashes: the constant.
constexpr std::size_t bytes_per_input_byte = 64;
constexpr std::size_t constant_bytes = std::size_t{64} << 10;

Character parse_within_bound(std::string_view text) {
    const fuzz::AllocationBound bound(text.size(), bytes_per_input_byte, constant_bytes);
    return lightdb::parse_character(text);
}

[[noreturn]] void stop(const char* broken, const std::string& notation) {
    std::fprintf(stderr, "error: %s: '%s'\n", broken, notation.c_str());
    std::abort();
}

void check_rhythm(const lightdb::Rhythm& rhythm, const std::string& notation) {
    double sum_s = 0;
    for (const lightdb::Phase& phase : rhythm.phases) {
        if (!(phase.duration_s > 0 && phase.duration_s <= 3600)) stop("a phase that is none", notation);
        if (!(phase.level >= 0 && phase.level <= 1)) stop("a level out of range", notation);
        sum_s += phase.duration_s;
    }
    if (!(std::abs(sum_s - rhythm.period_s) <= 1e-9 * std::max(1.0, sum_s)))
        stop("the phases do not sum to the period", notation);
}

void check_same(const Character& a, const Character& b, const std::string& notation) {
    if (a.light_class != b.light_class) stop("another class", notation);
    if (a.colours != b.colours) stop("other colours", notation);
    if (a.period_s != b.period_s) stop("another period", notation);
    if (a.height_m != b.height_m) stop("another height", notation);
    if (a.range_nm != b.range_nm) stop("other ranges", notation);
    if (a.lamp_count != b.lamp_count) stop("another count of lamps", notation);
    if (a.arrangement != b.arrangement) stop("another arrangement", notation);
    if (a.rhythm != b.rhythm) stop("another rhythm", notation);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    Character first;
    try {
        first = parse_within_bound(text);
    } catch (const lightdb::CharacterError& error) {
        if (error.offset > size) stop("an error beyond the end", std::string(text));
        return 0;
    }
    const std::string notation = lightdb::format_character(first);
    check_rhythm(first.rhythm, notation);
    try {
        check_same(first, lightdb::parse_character(notation), notation);
    } catch (const lightdb::CharacterError& error) {
        stop(error.what(), notation);
    }
    return 0;
}
