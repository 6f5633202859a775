// What lights of a class usually do where the notation does not say. Internal to lightdb/character*.cpp.
// - rates of quick lights: 60, 120 and 240 flashes a minute (INT 1 section P 10.6-10.8 names 50 or 60, 100 or 120, 240 to
//   300; S-57 LITCHR bounds the classes at 50, 80 and 160);
// - a long flash lasts 2 s (S-57 LITCHR: not less than two seconds);
// - flash lengths: the commonest among the 1263 lights of NGA Pub. 116 (2015) whose durations are written: 0.5 s below a
//   4 s period and in groups, 1 s above; eclipses of 1 s within a group; occulting eclipses of 1 s, 2 s from 8 s on.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lightdb/character_notation.h"

namespace seaglare::lightdb {

struct QuickRate {
    double pitch_s = 1;          // from flash to flash, the usual one
    double fastest_pitch_s = 1;  // the class ends here
    double slowest_pitch_s = 1;
    double flash_s = 0.3;
    std::string_view per_minute;
};
QuickRate quick_rate(ClassKind kind);

bool is_quick(ClassKind kind);        // Q, VQ, UQ
bool is_interrupted(ClassKind kind);  // IQ, IVQ, IUQ

// ITU-R M.1677: "A" is ".-". Precondition: A to Z or 0 to 9.
std::string_view morse_code(char letter);

// Flashes (eclipses, of an occulting light) that the groups count; 0: no group is written.
int counted(const ClassTerm& term);

// A light whose durations practice fills in.
struct OpenRhythm {
    std::vector<ClassTerm> terms;  // at least one
    double period_s = 0;           // > 0
    bool period_is_written = false;
    int repeats =
        1;  // flashes of a class without groups in one period: one for each colour of an alternating light
    std::size_t class_at = 0;  // in the text, for messages
    std::size_t period_at = 0;
};

struct AssumedPhases {
    std::vector<std::pair<double, bool>> phases;  // seconds, lit; sum to the period
    std::vector<std::string> assumptions;
    std::vector<std::string> warnings;
};

// No phases for a fixed light. Throws CharacterError where the class does not fit into the period.
AssumedPhases assume_phases(const OpenRhythm& light);

// A period for a class that is written without one, in seconds; > 0.
double usual_period_s(const std::vector<ClassTerm>& terms, std::size_t colours);

}  // namespace seaglare::lightdb
