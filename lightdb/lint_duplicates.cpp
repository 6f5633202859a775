// The same light twice at one place: two lists merged into one file, or a record that was entered again.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>

#include "lightdb/lint_checks.h"
#include "lightdb/sector.h"

namespace seaglare::lightdb::lint_checks {
namespace {

constexpr double same_place_m = 10;    // two sources' idea of one lantern
constexpr double same_height_m = 0.5;  // lamps above each other stand further apart
constexpr double same_limit_deg = 1;

bool same_sectors(const Light& a, const Light& b) {
    if (a.sectors.size() != b.sectors.size()) return false;
    for (std::size_t i = 0; i < a.sectors.size(); ++i) {
        const Sector& s = a.sectors[i];
        const Sector& t = b.sectors[i];
        if (s.colour != t.colour ||
            std::abs(std::remainder(s.from_deg - t.from_deg, 360.0)) > same_limit_deg ||
            std::abs(std::remainder(s.to_deg - t.to_deg, 360.0)) > same_limit_deg)
            return false;
    }
    return true;
}

bool same_rhythm(const Light& a, const Light& b) {
    const auto& p = a.rhythm.phases;
    const auto& q = b.rhythm.phases;
    return p.size() == q.size() &&
           std::equal(p.begin(), p.end(), q.begin(), [](const Phase& x, const Phase& y) {
               return x.lit == y.lit && (!x.lit || x.colour == y.colour) &&
                      std::abs(x.duration_s - y.duration_s) < 0.05;
           });
}

bool same_colours(const Light& a, const Light& b) {
    for (std::size_t c = 0; c < colour_count; ++c)
        if ((a.intensity_cd[c] > 0) != (b.intensity_cd[c] > 0)) return false;
    return true;
}

// Squares of a size that holds the search radius, so that neighbours lie in the same or a touching one.
using Cell = std::tuple<std::uint32_t, bool, std::int64_t, std::int64_t>;
Cell cell_of(const Light& light, int east, int north) {
    if (!light.geographic)
        return {light.body_id, false, std::llround(std::floor(light.position_m[0] / same_place_m)) + east,
                std::llround(std::floor(light.position_m[1] / same_place_m)) + north};
    constexpr double rows_per_degree = 6000;  // of 18.5 m
    const double row = std::floor(light.latitude_deg * rows_per_degree) + north;
    const double scale = std::max(0.01, std::cos(row / rows_per_degree * 3.14159265358979 / 180));
    return {light.body_id, true,
            std::llround(std::floor(light.longitude_deg * scale * rows_per_degree)) + east,
            std::llround(row)};
}

}  // namespace

void check_duplicates(std::span<const Subject> subjects, Findings& findings) {
    std::map<Cell, std::vector<std::size_t>> cells;
    for (const Subject& subject : subjects) {
        const Light& light = *subject.light;
        bool found = false;
        for (int north = -1; north <= 1 && !found; ++north)
            for (int east = -1; east <= 1 && !found; ++east) {
                const auto cell = cells.find(cell_of(light, east, north));
                if (cell == cells.end()) continue;
                for (const std::size_t i : cell->second) {
                    const Light& other = *subjects[i].light;
                    const auto apart = offset(other, light);
                    if (!apart || apart->distance_m() > same_place_m ||
                        std::abs(other.height_m - light.height_m) > same_height_m ||
                        !same_colours(other, light) || !same_rhythm(other, light) ||
                        !same_sectors(other, light))
                        continue;
                    LintFinding finding = subject.finding(
                        LintKind::duplicate, "it shows the same as '" + other.name + "', " +
                                                 rounded(apart->distance_m()) + " m away at the same height");
                    finding.other = i;
                    findings.push_back(std::move(finding));
                    found = true;
                    break;
                }
            }
        cells[cell_of(light, 0, 0)].push_back(subject.index);
    }
}

}  // namespace seaglare::lightdb::lint_checks
