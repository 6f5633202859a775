#include "lightdb/phase_list.h"

#include "lightdb/character.h"
#include "lightdb/character_scanner.h"
#include "lightdb/character_spelling.h"
#include "lightdb/json/reader.h"

namespace seaglare::lightdb {
namespace {

double checked_duration_s(const Scanner& scanner, std::size_t where, double duration_s) {
    if (!(duration_s > 0)) scanner.fail(where, "a phase lasts longer than 0 s");
    if (duration_s > longest_listed_phase_s) scanner.fail(where, "a phase lasts no longer than an hour");
    return duration_s;
}

Colour colour_from_json(const json::Value& value) {
    const std::string name = json::checked_string(value, "colour");
    if (const auto colour = spelled_colour(name)) return *colour;
    throw value.error("'" + name + "' is no colour: use W, R, G, Y, Bu, Or, Vi or white, red, green, …");
}

}  // namespace

std::optional<ListedPhase> take_listed_phase(Scanner& scanner) {
    const std::size_t start = scanner.at();
    const bool light = scanner.take_exact("fl") || scanner.take_exact("lt");
    if (!light && !scanner.take_exact("ec")) return std::nullopt;
    scanner.skip_separators();
    if (!scanner.at_digit()) {
        scanner.go_back(start);
        return std::nullopt;
    }
    const double duration_s = scanner.read_number();
    scanner.skip_blanks();
    if (!scanner.take_exact("s")) scanner.fail(scanner.at(), "expected the duration's unit, s");
    return ListedPhase{checked_duration_s(scanner, start, duration_s), light, std::nullopt, 1};
}

std::vector<ListedPhase> parse_phase_list(std::string_view text) {
    Scanner scanner(text);
    scanner.skip_blanks();
    if (scanner.peek() == '[') {
        const json::Document document = json::parse(text, "phases");
        return phases_from_json(document.root());
    }
    std::vector<ListedPhase> phases;
    for (scanner.skip_separators(); !scanner.at_end(); scanner.skip_separators()) {
        const auto phase = take_listed_phase(scanner);
        if (!phase) scanner.fail(scanner.at(), "expected a phase, such as 'fl. 0.8s' or 'ec. 2.2s'");
        phases.push_back(*phase);
    }
    if (phases.empty()) scanner.fail(0, "expected phases, such as 'fl. 0.8s, ec. 2.2s'");
    return phases;
}

std::vector<ListedPhase> parse_sigseq(std::string_view text) {
    Scanner scanner(text);
    std::vector<ListedPhase> phases;
    do {
        scanner.skip_blanks();
        const std::size_t start = scanner.at();
        const bool dark = scanner.take_exact("(");
        if (!scanner.at_digit()) {
            scanner.fail(scanner.at(), "expected a duration in seconds, as in '00.8+(02.2)'");
        }
        const double duration_s = checked_duration_s(scanner, start, scanner.read_number());
        if (dark && !scanner.take_exact(")")) scanner.fail(scanner.at(), "expected ')' after an eclipse");
        phases.push_back({duration_s, !dark, std::nullopt, 1});
        scanner.skip_blanks();
    } while (scanner.take_exact("+"));
    if (!scanner.at_end()) scanner.fail(scanner.at(), "expected '+' and the next duration");
    return phases;
}

std::vector<ListedPhase> phases_from_json(const json::Value& value) {
    if (value.kind() != json::Kind::array || value.array().empty()) {
        throw value.error(R"(expected an array of phases, such as [{"lit": 0.8}, {"eclipse": 2.2}])");
    }
    constexpr double shortest_phase_s = 1e-3;  // as in light files
    std::vector<ListedPhase> phases;
    for (const json::Value& element : value.array()) {
        json::ObjectReader reader(element, "phase");
        ListedPhase phase;
        phase.lit = reader.has("lit");
        if (phase.lit == reader.has("eclipse")) {
            throw reader.error("give either 'lit' or 'eclipse', in seconds");
        }
        phase.duration_s =
            reader.number(phase.lit ? "lit" : "eclipse", shortest_phase_s, longest_listed_phase_s);
        if (phase.lit) {
            if (const json::Value* colour = reader.find("colour")) phase.colour = colour_from_json(*colour);
            phase.level = reader.number("level", 0, 1, 1);
        }
        reader.finish();
        phases.push_back(phase);
    }
    return phases;
}

}  // namespace seaglare::lightdb
