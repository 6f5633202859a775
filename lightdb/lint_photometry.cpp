// Ranges, intensities, heights, and whether anything shows at all.
#include <algorithm>
#include <cmath>

#include "lightdb/lint_checks.h"
#include "lightdb/photometry.h"

namespace seaglare::lightdb::lint_checks {
namespace {

constexpr double farthest_plausible_nm = 30;
constexpr double height_rounding_m = 0.51;  // charts give whole metres

// Half of the last digit that was written: "12" is 11.5 ... 12.5, "5.5" is 5.45 ... 5.55.
double half_digit(double value) {
    if (value == std::round(value)) return 0.5;
    return std::abs(value * 10 - std::round(value * 10)) < 1e-9 ? 0.05 : 0.005;
}

// Range in nautical miles that the character gives for a colour.
std::optional<double> written_range_nm(const Character& character, Colour colour) {
    const auto& ranges = character.range_nm;
    for (const auto& [of, range_nm] : ranges)
        if (of && *of == colour) return range_nm;
    const auto at = std::find(character.colours.begin(), character.colours.end(), colour);
    if (ranges.empty() || ranges.front().first || at == character.colours.end()) return std::nullopt;
    // "12-9M" gives the largest and the smallest only: no more is known of the colours between.
    const auto index = static_cast<std::size_t>(at - character.colours.begin());
    if (ranges.size() == 1) return ranges.front().second;
    if (ranges.size() == character.colours.size()) return ranges[index].second;
    return std::nullopt;
}

double longest_flash_s(const Rhythm& rhythm) {
    double longest = 0;
    for (const Phase& phase : rhythm.phases)
        if (phase.lit) longest = std::max(longest, phase.duration_s);
    return longest;
}

// A range may be meant for the lamp's own intensity or for what a flash is worth to the eye (Blondel-Rey): a
// contradiction fits neither.
void check_range(const Subject& subject, Colour colour, Findings& findings) {
    const Light& light = *subject.light;
    const double intensity_cd = light.intensity_cd[static_cast<std::size_t>(colour)];
    const std::optional<double> range_nm = written_range_nm(*subject.character, colour);
    if (!range_nm || !(intensity_cd > 0)) return;
    const double half_nm = half_digit(*range_nm);
    const double low_cd = intensity_for_range_cd(*range_nm - half_nm);
    const double high_cd = intensity_for_range_cd(*range_nm + half_nm);
    const double flash_s = longest_flash_s(light.rhythm);
    const double effective_cd = flash_s > 0 ? effective_intensity_cd(intensity_cd, flash_s) : intensity_cd;
    constexpr double slack = 1e-6;  // an intensity that was made from the range itself
    if (intensity_cd >= low_cd * (1 - slack) && effective_cd <= high_cd * (1 + slack)) return;
    findings.push_back(subject.finding(
        LintKind::range_against_intensity,
        "its character says " + rounded(*range_nm, 2) + " M for " + std::string(colour_letter(colour)) +
            ", which is " + rounded(low_cd) + " to " + rounded(high_cd) + " cd; its intensity is " +
            rounded(intensity_cd) + " cd, " + rounded(range_for_intensity_nm(intensity_cd), 2) + " M"));
}

}  // namespace

void check_photometry(const Subject& subject, Findings& findings) {
    const Light& light = *subject.light;
    const auto shown = shown_colours(light);
    if (std::none_of(shown.begin(), shown.end(), [](bool is) { return is; }))
        findings.push_back(subject.finding(
            LintKind::no_visible_light,
            light.sectors.empty() ? "it never shows: no phase or no intensity is above 0"
                                  : "it never shows: no sector and phase have an intensity above 0"));
    for (int c = 0; c < colour_count; ++c) {
        const auto colour = static_cast<Colour>(c);
        const double range_nm = range_for_intensity_nm(light.intensity_cd[static_cast<std::size_t>(c)]);
        if (shown[static_cast<std::size_t>(c)] && range_nm > farthest_plausible_nm + 1e-6)
            findings.push_back(subject.finding(LintKind::range_implausible,
                                               "its nominal range for " + std::string(colour_letter(colour)) +
                                                   " is " + rounded(range_nm) + " M"));
        if (subject.character) check_range(subject, colour, findings);
    }
    if (light.body_id == 0 && !(light.height_m > 0))  // a ship's own light is measured from the ship
        findings.push_back(subject.finding(LintKind::height_not_positive,
                                           "its height is " + rounded(light.height_m) + " m"));
    if (subject.character && subject.character->height_m &&
        std::abs(*subject.character->height_m - light.height_m) > height_rounding_m)
        findings.push_back(subject.finding(LintKind::height_against_character,
                                           "its character says " + rounded(*subject.character->height_m) +
                                               " m, its height is " + rounded(light.height_m) + " m"));
}

}  // namespace seaglare::lightdb::lint_checks
