// What a character's text says, word by word, before it means durations. Internal to lightdb/character*.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightdb/character.h"

namespace seaglare::lightdb {

enum class ClassKind {
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
    std::vector<int> groups;
    std::string morse;
};

struct WrittenPhase {
    double duration_s = 0;
    bool lit = false;
};

struct Notation {
    std::vector<std::string> prefixes;  // "Dir", "Aero"
    bool alternating = false;
    bool fixed_under = false;      // fixed and flashing: a steady light under the flashes
    std::vector<ClassTerm> terms;  // more than one: "Q(6)+LFl"; empty: a bare "Dir" or "Al"
    std::vector<Colour> colours;
    std::optional<double> period_s;
    std::vector<WrittenPhase> phases;
    std::optional<double> height_m;
    std::vector<double> ranges_nm;
    char range_separator =
        0;               // '-': largest to smallest; '/': in the order of the colours; 0: a single figure
    int lamp_count = 0;  // 0: not written
    std::string arrangement;
    std::vector<std::string> warnings;
};

// Throws CharacterError.
Notation read_notation(std::string_view text);

// The class as charts write it, without prefix and colours.
std::string class_text(const Notation& notation);

// Fills rhythm, assumptions and warnings. Throws CharacterError for what has no meaning as a rhythm.
void lay_out_phases(const Notation& notation, Character& character);

// Decimal, without trailing zeros.
std::string number_text(double value);

}  // namespace seaglare::lightdb
