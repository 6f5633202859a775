// What is odd about lights that are valid: contradictions between two things that the data say, and values that no
// light has. Lint reports; it repairs and drops nothing.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lightdb/light.h"

namespace seaglare::lightdb {

enum class LintKind {
    phases_miss_period,        // written durations do not sum to the written period
    phase_too_short,           // shorter than a millisecond
    phase_too_long,            // longer than the period
    class_against_rhythm,      // "Oc" that is dark for longer than it is lit, "Iso" with unequal halves, …
    sector_swapped,            // limits the wrong way round
    sector_overlap,            // two colours on one bearing
    sector_gap,                // dark between two sectors where nothing says so
    colour_without_sector,     // named by the character, shown by no sector
    colour_unnamed,            // shown by a sector, not named by the character
    colours_without_sectors,   // several colours, no sectors: one colour shows all round
    range_against_intensity,   // the character's range and the intensity differ by more than rounding
    range_implausible,         // no light is seen that far
    height_against_character,  // the character's height and the light's differ
    height_not_positive,
    no_visible_light,   // no colour, no sector or no phase that shows
    duplicate,          // the same light at the same place
    leading_bearing,    // front and rear do not stand on the bearing that the data give
    leading_heights,    // the rear light is lower than the front light
    leading_invisible,  // dark on its own leading line
    chromaticity,       // cannot be drawn inside the region that COLREG Annex I allows
};

// "phases_miss_period": for machines and for counting. And one line on what it means.
std::string_view lint_name(LintKind kind);
std::string_view lint_meaning(LintKind kind);
std::span<const LintKind> lint_kinds();

struct LintFinding {
    LintKind kind = LintKind::duplicate;
    std::size_t light = 0;             // index into the lights
    std::optional<std::size_t> other;  // the second light of a contradiction between two
    std::string text;                  // without the light's name
    friend bool operator==(const LintFinding&, const LintFinding&) = default;
};

// All findings, ordered by light and kind. Colours that cannot be drawn are reported once each, at the first light that
// shows them. Lights with a geographic position are compared by it, the others by their position in the scene; those on
// bodies only with others of the same body. Time grows with the lights times those nearby.
std::vector<LintFinding> lint(std::span<const Light> lights);

}  // namespace seaglare::lightdb
