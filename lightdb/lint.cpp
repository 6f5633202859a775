#include "lightdb/lint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "lightdb/geodesy.h"
#include "lightdb/lint_checks.h"
#include "lightdb/sector.h"

namespace seaglare::lightdb {
namespace {

struct KindText {
    LintKind kind;
    std::string_view name;
    std::string_view meaning;
};
constexpr std::array kinds = {
    KindText{LintKind::phases_miss_period, "phases_miss_period", "durations that do not sum to the period"},
    KindText{LintKind::phase_too_short, "phase_too_short", "a flash or an eclipse below a millisecond"},
    KindText{LintKind::phase_too_long, "phase_too_long", "a flash or an eclipse longer than the period"},
    KindText{LintKind::class_against_rhythm, "class_against_rhythm", "a class that the durations contradict"},
    KindText{LintKind::sector_swapped, "sector_swapped", "a sector with its limits the wrong way round"},
    KindText{LintKind::sector_overlap, "sector_overlap", "two colours on the same bearings"},
    KindText{LintKind::sector_gap, "sector_gap", "a dark gap between sectors that nothing explains"},
    KindText{LintKind::colour_without_sector, "colour_without_sector",
             "a colour of the character that no sector shows"},
    KindText{LintKind::colour_unnamed, "colour_unnamed", "a sector's colour that the character lacks"},
    KindText{LintKind::colours_without_sectors, "colours_without_sectors",
             "several colours, but no sectors to show them"},
    KindText{LintKind::range_against_intensity, "range_against_intensity",
             "a range and an intensity that differ by more than rounding"},
    KindText{LintKind::range_implausible, "range_implausible", "a nominal range above 30 M"},
    KindText{LintKind::height_against_character, "height_against_character",
             "a height that the character contradicts"},
    KindText{LintKind::height_not_positive, "height_not_positive", "a light at or below the water"},
    KindText{LintKind::no_visible_light, "no_visible_light", "a light that never shows"},
    KindText{LintKind::duplicate, "duplicate", "the same light twice at one place"},
    KindText{LintKind::leading_bearing, "leading_bearing", "front and rear lights off their leading line"},
    KindText{LintKind::leading_heights, "leading_heights", "a rear light lower than its front light"},
    KindText{LintKind::leading_invisible, "leading_invisible", "a leading light dark on its own line"},
    KindText{LintKind::chromaticity, "chromaticity", "a colour drawn outside its COLREG region"},
};

constexpr auto kind_list = [] {
    std::array<LintKind, kinds.size()> list{};
    for (std::size_t i = 0; i < kinds.size(); ++i)
        list[i] = kinds[i].kind;
    return list;
}();

const KindText& text_of(LintKind kind) {
    return *std::find_if(kinds.begin(), kinds.end(), [&](const KindText& text) { return text.kind == kind; });
}

}  // namespace

std::string_view lint_name(LintKind kind) {
    return text_of(kind).name;
}
std::string_view lint_meaning(LintKind kind) {
    return text_of(kind).meaning;
}
std::span<const LintKind> lint_kinds() {
    return kind_list;
}

std::vector<LintFinding> lint(std::span<const Light> lights) {
    using namespace lint_checks;
    std::vector<Subject> subjects;
    subjects.reserve(lights.size());
    Findings findings;
    for (const Light& light : lights) {
        Subject subject{&light, subjects.size(), {}};
        if (!light.character.empty()) {
            try {
                subject.character = parse_character(light.character);
            } catch (const CharacterError&) {
                // Then the light has explicit phases, or came through the C interface: nothing to compare with.
            }
        }
        subjects.push_back(std::move(subject));
    }
    for (const Subject& subject : subjects) {
        check_rhythm(subject, findings);
        check_sectors(subject, findings);
        check_photometry(subject, findings);
    }
    check_colours(subjects, findings);
    check_duplicates(subjects, findings);
    check_leading_lights(subjects, findings);
    std::stable_sort(findings.begin(), findings.end(), [](const LintFinding& a, const LintFinding& b) {
        return a.light != b.light ? a.light < b.light : a.kind < b.kind;
    });
    return findings;
}

namespace lint_checks {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double metres_per_degree = earth_radius_m * degree;

}  // namespace

std::string rounded(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    std::string result = text;
    if (result.find('.') != std::string::npos) {
        while (result.back() == '0')
            result.pop_back();
        if (result.back() == '.') result.pop_back();
    }
    return result == "-0" ? "0" : result;
}

double Offset::distance_m() const {
    return std::hypot(east_m, north_m);
}
double Offset::bearing_deg() const {
    return wrapped_deg(std::atan2(east_m, north_m) / degree);
}

std::optional<Offset> offset(const Light& from, const Light& to) {
    if (from.body_id != to.body_id || from.geographic != to.geographic) return std::nullopt;
    if (!from.geographic) {
        const double east_m = to.position_m[0] - from.position_m[0];
        const double north_m = to.position_m[1] - from.position_m[1];
        const double turn = from.true_north_deg * degree;  // bearings are true
        return Offset{east_m * std::cos(turn) - north_m * std::sin(turn),
                      east_m * std::sin(turn) + north_m * std::cos(turn)};
    }
    // Leading lights are some kilometres apart: the plane at their middle latitude is good to 1e-4 of the distance.
    const double middle = (from.latitude_deg + to.latitude_deg) / 2 * degree;
    const double east_deg = std::remainder(to.longitude_deg - from.longitude_deg, 360.0);
    return Offset{east_deg * std::cos(middle) * metres_per_degree,
                  (to.latitude_deg - from.latitude_deg) * metres_per_degree};
}

double position_uncertainty_m(const Light& light) {
    if (!light.geographic) return 0;
    const auto multiple = [&](double unit_deg) {
        const auto is = [&](double value) {
            const double units = value / unit_deg;
            return std::abs(units - std::round(units)) * unit_deg < 1.5e-7;
        };
        return is(light.latitude_deg) && is(light.longitude_deg);
    };
    for (const double unit_deg : {1.0 / 60, 0.1 / 60, 1.0 / 3600, 0.01 / 60, 0.1 / 3600, 0.001 / 60})
        if (multiple(unit_deg)) return unit_deg / 2 * metres_per_degree * std::numbers::sqrt2;
    return 0;
}

std::array<bool, colour_count> shown_colours(const Light& light) {
    std::array<bool, colour_count> shown{};
    const bool lit = light.rhythm.phases.empty() ||
                     std::any_of(light.rhythm.phases.begin(), light.rhythm.phases.end(),
                                 [](const Phase& phase) { return phase.lit && phase.level > 0; });
    if (!lit) return shown;
    if (!light.sectors.empty()) {
        for (const Sector& sector : light.sectors)
            if (sector.colour && sector.intensity_factor > 0)
                shown[static_cast<std::size_t>(*sector.colour)] = true;
    } else if (!light.rhythm.phases.empty()) {
        for (const Phase& phase : light.rhythm.phases)
            if (phase.lit) shown[static_cast<std::size_t>(phase.colour)] = true;
    } else {
        // A fixed light shows the colours that it has candela for.
        shown.fill(true);
    }
    for (std::size_t c = 0; c < shown.size(); ++c)
        shown[c] = shown[c] && (light.intensity_cd[c] > 0 || light.day_intensity_cd[c] > 0);
    return shown;
}

}  // namespace lint_checks
}  // namespace seaglare::lightdb
