// The checks behind lint(), by what they look at. Internal to lightdb/lint*.cpp.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lightdb/character.h"
#include "lightdb/lint.h"

namespace seaglare::lightdb::lint_checks {

// A light with its character read; nothing where it has none, or none that can be read.
struct Subject {
    const Light* light = nullptr;
    std::size_t index = 0;
    std::optional<Character> character;

    LintFinding finding(LintKind kind, std::string text) const { return {kind, index, {}, std::move(text)}; }
};

using Findings = std::vector<LintFinding>;

void check_rhythm(const Subject& subject, Findings& findings);
void check_sectors(const Subject& subject, Findings& findings);
void check_photometry(const Subject& subject, Findings& findings);
void check_colours(std::span<const Subject> subjects, Findings& findings);
void check_duplicates(std::span<const Subject> subjects, Findings& findings);
void check_leading_lights(std::span<const Subject> subjects, Findings& findings);

// The colours that show in some phase and some sector at an intensity above 0.
std::array<bool, colour_count> shown_colours(const Light& light);

// "12.3": at most one decimal, or as many as `decimals` says.
std::string rounded(double value, int decimals = 1);

// East and north of `to` in metres, seen from `from`; nothing when they do not share a frame (another body, or only one
// of them geographic).
struct Offset {
    double east_m = 0;
    double north_m = 0;
    double distance_m() const;
    double bearing_deg() const;  // true, 0 ... 360
};
std::optional<Offset> offset(const Light& from, const Light& to);

// What the position may be off because it was written in whole seconds, tenths of minutes and so on: half the coarsest
// unit that its latitude and longitude are both multiples of, as metres along the diagonal. 0 for local positions.
double position_uncertainty_m(const Light& light);

}  // namespace seaglare::lightdb::lint_checks
