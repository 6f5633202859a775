#include "lightdb/character.h"

#include <algorithm>

#include "lightdb/character_notation.h"

namespace seaglare::lightdb {
namespace {

void assign_ranges(const Notation& notation, Character& character) {
    const std::vector<double>& ranges = notation.ranges_nm;
    const bool per_colour =
        notation.range_separator == '/' || (ranges.size() == 1 && character.colours.size() == 1);
    if (notation.range_separator == '/' && ranges.size() != character.colours.size())
        throw CharacterError(0, std::to_string(ranges.size()) + " ranges for " +
                                    std::to_string(character.colours.size()) + " colours");
    for (std::size_t i = 0; i < ranges.size(); ++i)
        character.range_nm.emplace_back(per_colour ? std::optional(character.colours[i]) : std::nullopt,
                                        ranges[i]);
    if (notation.range_separator == '-')
        std::sort(character.range_nm.begin(), character.range_nm.end(),
                  [](const auto& a, const auto& b) { return a.second > b.second; });
}

}  // namespace

Character parse_character(std::string_view text) {
    const Notation notation = read_notation(text);
    Character character;
    character.colours = notation.colours;
    if (character.colours.empty()) {
        character.colours.push_back(Colour::white);
        character.assumptions.emplace_back("no colour is written: white");
    }
    character.warnings = notation.warnings;
    for (const std::string& prefix : notation.prefixes)
        character.light_class += prefix + " ";
    character.light_class += class_text(notation);
    if (character.light_class.back() == ' ') character.light_class.pop_back();
    character.period_s = notation.period_s;
    character.height_m = notation.height_m;
    character.arrangement = notation.arrangement;
    const bool one_each = !notation.arrangement.empty() && notation.lamp_count == 0;
    character.lamp_count =
        one_each ? static_cast<int>(character.colours.size()) : std::max(1, notation.lamp_count);
    assign_ranges(notation, character);
    lay_out_phases(notation, character);
    return character;
}

std::string format_character(const Character& character) {
    std::string text;
    // Without a count, "(hor)" and "(vert)" stand for one lamp of each colour.
    const bool one_each = !character.arrangement.empty() &&
                          static_cast<std::size_t>(character.lamp_count) == character.colours.size();
    if (character.lamp_count > 1 || (!character.arrangement.empty() && !one_each))
        text += std::to_string(character.lamp_count) + " ";
    text += character.light_class + " ";
    for (const Colour colour : character.colours)
        text += colour_letter(colour);
    if (!character.arrangement.empty()) text += " (" + character.arrangement + ")";
    if (character.period_s) text += " " + number_text(*character.period_s) + "s";
    for (std::size_t i = 0; i < character.written_phases.size(); ++i) {
        const Phase& phase = character.written_phases[i];
        text += (i == 0 ? " " : ", ") + std::string(phase.lit ? "fl. " : "ec. ") +
                number_text(phase.duration_s) + "s";
    }
    if (character.height_m) text += " " + number_text(*character.height_m) + "m";
    const bool per_colour = !character.range_nm.empty() && character.range_nm.front().first.has_value();
    for (std::size_t i = 0; i < character.range_nm.size(); ++i)
        text += (i == 0 ? " " : per_colour ? "/" : "-") + number_text(character.range_nm[i].second);
    if (!character.range_nm.empty()) text += "M";
    return text;
}

std::string_view colour_letter(Colour colour) {
    switch (colour) {
        case Colour::white:
            return "W";
        case Colour::red:
            return "R";
        case Colour::green:
            return "G";
        case Colour::yellow:
            return "Y";
        case Colour::blue:
            return "Bu";
        case Colour::orange:
            return "Or";
        case Colour::violet:
            return "Vi";
    }
    return "";
}

}  // namespace seaglare::lightdb
