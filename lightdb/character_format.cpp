// Characters back to the notation of charts.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "lightdb/character_notation.h"

namespace seaglare::lightdb {
namespace {

// One range for each colour, in the colours' order: "12/10/8M" says it.
bool is_complete(const Character& character) {
    if (character.range_nm.size() != character.colours.size()) return false;
    for (std::size_t i = 0; i < character.colours.size(); ++i)
        if (character.range_nm[i].first != character.colours[i]) return false;
    return true;
}

std::string ranges_text(const Character& character) {
    std::string text;
    if (character.range_nm.empty()) return text;
    const bool per_colour = character.range_nm.front().first.has_value();
    if (per_colour && !is_complete(character)) {
        for (const auto& [colour, range_nm] : character.range_nm)
            text += " " + std::string(colour_letter(*colour)) + " " + number_text(range_nm) + "M";
        return text;
    }
    for (std::size_t i = 0; i < character.range_nm.size(); ++i)
        text += (i == 0 ? " " : per_colour ? "/" : "-") + number_text(character.range_nm[i].second);
    return text + "M";
}

std::string term_text(const ClassTerm& term) {
    std::string text(class_abbreviation(term.kind));
    for (std::size_t g = 0; g < term.groups.size(); ++g)
        text += (g == 0 ? "(" : "+") + std::to_string(term.groups[g]);
    if (!term.groups.empty()) text += ")";
    if (!term.morse.empty()) text += "(" + term.morse + ")";
    return text;
}

}  // namespace

std::string class_text(const Notation& notation) {
    std::string text;
    for (const std::string& prefix : notation.prefixes)
        text += prefix + " ";
    if (notation.alternating) text += "Al ";
    if (notation.fixed_under) text += "F";
    for (std::size_t i = 0; i < notation.terms.size(); ++i)
        text += (i > 0 ? "+" : "") + term_text(notation.terms[i]);
    if (text.back() == ' ') text.pop_back();
    return text;
}

std::string group_text(const Character& character) {
    const bool sum = character.terms.size() > 1;
    std::string text;
    for (const ClassTerm& term : character.terms) {
        if (!term.morse.empty()) text += "(" + term.morse + ")";
        for (std::size_t g = 0; g < term.groups.size(); ++g)
            text += (g == 0 ? "(" : "+") + std::to_string(term.groups[g]);
        if (!term.groups.empty()) text += ")";
        if (sum && term.groups.empty()) text += "(1)";
    }
    return text;
}

std::string format_character(const Character& character) {
    std::string text;
    // Lamps in a row without a count are one for each colour: a single one that alternates has to be written.
    const bool alone_in_its_row = !character.arrangement.empty() && character.colours.size() > 1;
    if (character.lamp_count > 1 || alone_in_its_row) text += std::to_string(character.lamp_count) + " ";
    text += character.light_class + " ";
    for (const Colour colour : character.colours)
        text += colour_letter(colour);
    if (!character.arrangement.empty()) text += " (" + character.arrangement + ")";
    for (const std::string& remark : character.remarks)
        text += " (" + remark + ")";
    if (character.direction_deg) text += " " + number_text(*character.direction_deg) + "\xC2\xB0";
    if (character.period_s) text += " " + number_text(*character.period_s) + "s";
    for (std::size_t i = 0; i < character.written_phases.size(); ++i) {
        const Phase& phase = character.written_phases[i];
        text += (i == 0 ? " " : ", ") + std::string(phase.lit ? "fl. " : "ec. ") +
                number_text(phase.duration_s) + "s";
    }
    if (character.height_m) text += " " + number_text(*character.height_m) + "m";
    return text + ranges_text(character);
}

std::string number_text(double value) {
    std::array<char, 400> buffer{};  // the largest double has 309 digits, the smallest 324 decimals
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed).ptr;
    return {buffer.data(), end};
}

std::string seconds_text(double value_s) {
    return number_text(std::round(value_s * 1000) / 1000) + " s";
}

}  // namespace seaglare::lightdb
