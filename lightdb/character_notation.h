// What a character's text says, word by word, before it means durations. Internal to lightdb/character*.cpp and
// light_reader_rhythm.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lightdb/character.h"

namespace seaglare::lightdb {

struct Notation {
    std::vector<std::string> prefixes;  // "Dir", "Aero"
    bool alternating = false;
    bool fixed_under = false;      // fixed and flashing: a steady light under the flashes
    std::vector<ClassTerm> terms;  // more than one: "Q(6)+LFl"; empty: a bare "Dir" or "Al"
    std::vector<Colour> colours;
    std::optional<double> period_s;
    std::vector<ListedPhase> phases;
    std::optional<double> height_m;
    std::optional<double> direction_deg;
    std::vector<double> ranges_nm;
    char range_separator =
        0;  // '-': largest to smallest; '/': in the order of the colours; 0: a single figure
    std::vector<std::pair<Colour, double>> colour_ranges_nm;  // "W 12 R 8 G 8"
    int lamp_count = 0;                                       // 0: not written
    std::string arrangement;
    std::vector<std::string> remarks;
    std::vector<std::string> assumptions;
    std::vector<std::string> warnings;
    // Where in the text, for messages.
    std::size_t class_at = 0;
    std::size_t class_end = 0;
    std::size_t period_at = 0;
    std::size_t ranges_at = 0;
};

// Throws CharacterError.
Notation read_notation(std::string_view text);

// The class as charts write it, with prefixes and "Al", without colours.
std::string class_text(const Notation& notation);

// Fills rhythm, assumptions and warnings. Throws CharacterError for what has no meaning as a rhythm.
void lay_out_phases(const Notation& notation, Character& character);

// Decimal, without trailing zeros.
std::string number_text(double value);
// To the millisecond, with its unit: for messages.
std::string seconds_text(double value_s);

}  // namespace seaglare::lightdb
