#include "lightdb/character.h"

#include <algorithm>

#include "lightdb/character_notation.h"

namespace seaglare::lightdb {
namespace {

void assign_ranges(const Notation& notation, Character& character) {
    if (!notation.colour_ranges_nm.empty()) {
        for (const auto& [colour, range_nm] : notation.colour_ranges_nm)
            character.range_nm.emplace_back(colour, range_nm);
        return;
    }
    const std::vector<double>& ranges = notation.ranges_nm;
    const bool per_colour =
        notation.range_separator == '/' || (ranges.size() == 1 && character.colours.size() == 1);
    if (notation.range_separator == '/' && ranges.size() != character.colours.size())
        throw CharacterError(notation.ranges_at, std::to_string(ranges.size()) + " ranges for " +
                                                     std::to_string(character.colours.size()) +
                                                     " colours: expected one for each");
    for (std::size_t i = 0; i < ranges.size(); ++i)
        character.range_nm.emplace_back(per_colour ? std::optional(character.colours[i]) : std::nullopt,
                                        ranges[i]);
    if (notation.range_separator == '-')
        std::sort(character.range_nm.begin(), character.range_nm.end(),
                  [](const auto& a, const auto& b) { return a.second > b.second; });
}

Character character_of(const Notation& notation) {
    Character character;
    character.colours = notation.colours;
    character.assumptions = notation.assumptions;
    if (character.colours.empty()) {
        character.colours.push_back(Colour::white);
        character.assumptions.emplace_back("no colour is written: white");
    }
    character.warnings = notation.warnings;
    character.prefixes = notation.prefixes;
    character.alternating = notation.alternating;
    character.fixed_under = notation.fixed_under;
    character.terms = notation.terms;
    character.light_class = class_text(notation);
    character.period_s = notation.period_s;
    character.height_m = notation.height_m;
    character.direction_deg = notation.direction_deg;
    character.remarks = notation.remarks;
    character.arrangement = notation.arrangement;
    const bool one_each = !notation.arrangement.empty() && notation.lamp_count == 0;
    character.lamp_count =
        one_each ? static_cast<int>(character.colours.size()) : std::max(1, notation.lamp_count);
    assign_ranges(notation, character);
    lay_out_phases(notation, character);
    return character;
}

}  // namespace

Character parse_character(std::string_view text) {
    return character_of(read_notation(text));
}

Character parse_character(std::string_view text, const std::vector<ListedPhase>& phases) {
    Notation notation = read_notation(text);
    if (!phases.empty()) notation.phases = phases;
    return character_of(notation);
}

}  // namespace seaglare::lightdb
