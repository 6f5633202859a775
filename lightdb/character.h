// The character of a light: what charts ("Fl(2+1)WRG.10s15m12-9M") and lists of lights ("Fl.(2)W.R.G.\nperiod
// 10s\n fl. 0.5s, ec. 1.5s\nfl. 0.5s, ec. 7.5s") write, as phases in seconds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lightdb/light.h"
#include "lightdb/phase_list.h"

namespace seaglare::lightdb {

// The classes of IHO INT 1 section P 10. Alternating, "fixed and …" and sums are made of them.
enum class ClassKind : std::uint8_t {
    fixed,
    occulting,
    isophase,
    flashing,
    long_flashing,
    quick,
    very_quick,
    ultra_quick,
    interrupted_quick,
    interrupted_very_quick,
    interrupted_ultra_quick,
    morse
};

// One class with its groups: "Fl(2+1)" is {flashing, {2, 1}}, "Mo(A)" is {morse, {}, "A"}.
struct ClassTerm {
    ClassKind kind = ClassKind::fixed;
    std::vector<int> groups;  // empty: none written
    std::string morse;
    friend bool operator==(const ClassTerm&, const ClassTerm&) = default;
};

struct Character {
    Rhythm rhythm;  // every lit phase has a colour; lights with sectors show the sector's instead
    std::vector<Colour> colours;  // in the order written; {white} where none is written
    std::string
        light_class;  // as charts write it: "F", "Fl(2+1)", "Q(6)+LFl", "Mo(A)", "Al Fl", "FFl", "Dir Iso"
    std::vector<std::string> prefixes;  // "Dir", "Aero"
    bool alternating = false;           // "Al"
    bool fixed_under = false;           // "FFl", "FLFl": a steady light under the flashes
    std::vector<ClassTerm> terms;       // several: "Q(6)+LFl"; empty: a bare "Dir" or "Al"
    std::optional<double> height_m;     // above high water
    // Nominal range in nautical miles; no colour: it holds for all of them, or for the colours in order from
    // the largest to the smallest, which a chart ("12-9M") does not tell apart.
    std::vector<std::pair<std::optional<Colour>, double>> range_nm;
    std::vector<std::string>
        assumptions;  // what the notation left open and this parser chose, in plain words
    std::vector<std::string>
        warnings;  // what the notation says twice and differently (a list that misses its period), or in an old form
    std::optional<double> period_s;       // as written; the rhythm has one in any case
    std::vector<Phase> written_phases;    // the durations in the notation, untouched; empty: from practice
    int lamp_count = 1;                   // "2 F.R. (vert)": two lamps that show the same
    std::string arrangement;              // "vert", "hor" or empty
    std::optional<double> direction_deg;  // "Dir … 269°": of a direction light, true, from seaward
    std::vector<std::string> remarks;  // in brackets, as INT 1 abbreviates them: "occas", "fog", "priv" …
};

// The text cannot be a light's character. what() says what was expected, `offset` where in the text (bytes).
struct CharacterError : std::runtime_error {
    CharacterError(std::size_t where, const std::string& text) : std::runtime_error(text), offset(where) {}
    std::size_t offset;
};

// Throws CharacterError. Spaces, dots, line breaks and case carry no meaning except in "M" (miles) and "m"
// (metres).
Character parse_character(std::string_view text);

// The same with the durations of `phases` (see phase_list.h) in the place of those that the text gives or practice would.
// An empty list changes nothing.
Character parse_character(std::string_view text, const std::vector<ListedPhase>& phases);

// As a chart writes it: class, colours, period in seconds, written durations, height in metres, ranges in nautical
// miles. Parsing the result gives the same light, and formatting that the same text.
std::string format_character(const Character& character);

// One letter of the chart: W R G Y Bu Or Vi.
std::string_view colour_letter(Colour colour);

// As charts abbreviate it: "Fl", "IVQ".
std::string_view class_abbreviation(ClassKind kind);

// The groups as S-57's SIGGRP writes them, a bracket for each part: "(2+1)", "(6)(1)", "(A)"; empty: none.
std::string group_text(const Character& character);

}  // namespace seaglare::lightdb
