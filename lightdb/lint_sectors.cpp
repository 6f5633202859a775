// Sectors against each other and against the character's colours.
#include <algorithm>
#include <cmath>

#include "lightdb/lint_checks.h"
#include "lightdb/sector.h"

namespace seaglare::lightdb::lint_checks {
namespace {

constexpr double rounding_deg = 0.1;  // lists give bearings in minutes or in tenths of a degree
constexpr double narrow_gap_deg = 5;  // the only dark arc of a light: too narrow to be its landward side
constexpr double wide_gap_deg = 45;   // between two fields of view, as of a light at the bend of a river

std::string bearing(double degrees) {
    return rounded(wrapped_deg(degrees), 2);
}
std::string limits(const Sector& sector) {
    return std::string(sector.colour ? colour_letter(*sector.colour) : "dark") + " " +
           bearing(sector.from_deg) + "-" +
           (sector_width_deg(sector) >= 360 ? "360" : bearing(sector.to_deg));
}

// Degrees that two sectors share. Their meeting at both ends counts twice, as it should.
double shared_deg(const Sector& a, const Sector& b) {
    const double width_a = sector_width_deg(a);
    const double width_b = sector_width_deg(b);
    const double b_from = wrapped_deg(b.from_deg - a.from_deg);  // with a's first limit at 0
    double shared = std::max(0.0, std::min(width_a, b_from + width_b) - b_from);
    if (b_from + width_b > 360) shared += std::min(width_a, b_from + width_b - 360);
    return shared;
}

// A sector whose colour shows: it lies nowhere deliberately over or under another of its colour.
bool shows(const Sector& sector) {
    return sector.colour && sector.intensity_factor > 0 && sector.from_elevation_deg <= 0 &&
           sector.to_elevation_deg >= 0;
}

bool contradict(const Sector& a, const Sector& b) {
    return shows(a) && shows(b) && *a.colour != *b.colour && shared_deg(a, b) > rounding_deg;
}

double contradiction_deg(const std::vector<Sector>& sectors, std::size_t of, const Sector& as) {
    double sum = 0;
    for (std::size_t i = 0; i < sectors.size(); ++i)
        if (i != of && contradict(as, sectors[i])) sum += shared_deg(as, sectors[i]);
    return sum;
}

// Written b-a instead of a-b: as it stands it covers other colours, turned round it covers none.
bool is_swapped(const std::vector<Sector>& sectors, std::size_t i) {
    if (!shows(sectors[i]) || sector_width_deg(sectors[i]) <= 180) return false;
    Sector turned = sectors[i];
    std::swap(turned.from_deg, turned.to_deg);
    return contradiction_deg(sectors, i, sectors[i]) > 0 && contradiction_deg(sectors, i, turned) == 0;
}

struct Gap {
    double from_deg = 0;
    double width_deg = 0;
};

// Arcs that no sector covers, an obscured one neither: what is said to be dark is no gap.
std::vector<Gap> gaps_of(const std::vector<Sector>& sectors) {
    std::vector<Gap> gaps;
    for (const Sector& sector : sectors) {
        if (sector_width_deg(sector) >= 360) return {};
        double width = 360;  // from this sector's end to the next beginning
        bool covered = false;
        for (const Sector& other : sectors) {
            const double to_start = wrapped_deg(other.from_deg - sector.to_deg);
            width = std::min(width, to_start);
            const double into = wrapped_deg(sector.to_deg - other.from_deg);
            covered = covered || (into < sector_width_deg(other) && into > 0);
        }
        if (!covered && width > rounding_deg) gaps.push_back({wrapped_deg(sector.to_deg), width});
    }
    std::sort(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.from_deg < b.from_deg; });
    gaps.erase(std::unique(gaps.begin(), gaps.end(),
                           [](const Gap& a, const Gap& b) { return a.from_deg == b.from_deg; }),
               gaps.end());
    return gaps;
}

void check_gaps(const Subject& subject, Findings& findings) {
    const std::vector<Sector>& sectors = subject.light->sectors;
    if (sectors.size() < 2) return;  // one sector: the rest is dark by intent
    const std::vector<Gap> gaps = gaps_of(sectors);
    if (gaps.empty()) return;
    const auto widest = std::max_element(
        gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.width_deg < b.width_deg; });
    for (auto gap = gaps.begin(); gap != gaps.end(); ++gap) {
        if (gap == widest && gap->width_deg >= narrow_gap_deg) continue;  // its landward side
        if (gap->width_deg >= wide_gap_deg) continue;
        findings.push_back(subject.finding(LintKind::sector_gap,
                                           "it is dark from " + bearing(gap->from_deg) + " to " +
                                               bearing(gap->from_deg + gap->width_deg) + ", " +
                                               rounded(gap->width_deg, 2) + " degrees between sectors"));
    }
}

void check_overlaps(const Subject& subject, Findings& findings) {
    const std::vector<Sector>& sectors = subject.light->sectors;
    std::vector<bool> swapped(sectors.size());
    for (std::size_t i = 0; i < sectors.size(); ++i) {
        swapped[i] = is_swapped(sectors, i);
        if (!swapped[i]) continue;
        findings.push_back(
            subject.finding(LintKind::sector_swapped,
                            "its sector " + limits(sectors[i]) + " covers " +
                                rounded(contradiction_deg(sectors, i, sectors[i])) +
                                " degrees of other colours; with its limits exchanged it would cover none"));
    }
    for (std::size_t i = 0; i < sectors.size(); ++i)
        for (std::size_t j = i + 1; j < sectors.size(); ++j) {
            if (swapped[i] || swapped[j] || !contradict(sectors[i], sectors[j])) continue;
            findings.push_back(subject.finding(
                LintKind::sector_overlap, "its sectors " + limits(sectors[i]) + " and " + limits(sectors[j]) +
                                              " share " + rounded(shared_deg(sectors[i], sectors[j]), 2) +
                                              " degrees: the later one holds"));
        }
}

void check_colours_of_character(const Subject& subject, Findings& findings) {
    if (!subject.character) return;
    const Light& light = *subject.light;
    const std::vector<Colour>& named = subject.character->colours;
    if (light.sectors.empty()) {
        bool alternates = false;
        for (const Phase& phase : light.rhythm.phases)
            alternates = alternates || (phase.lit && phase.colour != light.rhythm.phases.front().colour);
        if (named.size() > 1 && !alternates)
            findings.push_back(
                subject.finding(LintKind::colours_without_sectors,
                                "its character names several colours, but it has no sectors: " +
                                    std::string(colour_letter(named.front())) + " all round"));
        return;
    }
    std::array<bool, colour_count> in_sectors{};
    for (const Sector& sector : light.sectors)
        if (sector.colour) in_sectors[static_cast<std::size_t>(*sector.colour)] = true;
    for (const Colour colour : named)
        if (named.size() > 1 && !in_sectors[static_cast<std::size_t>(colour)])
            findings.push_back(subject.finding(
                LintKind::colour_without_sector,
                "its character names " + std::string(colour_letter(colour)) + ", which no sector shows"));
    for (int c = 0; c < colour_count; ++c) {
        const auto colour = static_cast<Colour>(c);
        if (in_sectors[static_cast<std::size_t>(c)] &&
            std::find(named.begin(), named.end(), colour) == named.end())
            findings.push_back(subject.finding(LintKind::colour_unnamed,
                                               "a sector shows " + std::string(colour_letter(colour)) +
                                                   ", which its character does not name"));
    }
}

}  // namespace

void check_sectors(const Subject& subject, Findings& findings) {
    check_overlaps(subject, findings);
    check_gaps(subject, findings);
    check_colours_of_character(subject, findings);
}

}  // namespace seaglare::lightdb::lint_checks
