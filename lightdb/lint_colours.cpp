// What a lamp's colour is drawn as, against the regions that COLREG 1972 Annex I section 7 allows.
#include <array>
#include <cmath>
#include <span>

#include "glare/colour/chromaticity.h"
#include "glare/colour/navigation_colours.h"
#include "lightdb/lint_checks.h"

namespace seaglare::lightdb::lint_checks {
namespace {

using glare::Chromaticity;

// Corners in CIE 1931 x and y, in the rule's order.
constexpr Chromaticity white_region[] = {{.525, .382}, {.525, .440}, {.452, .440},
                                         {.310, .348}, {.310, .283}, {.443, .382}};
constexpr Chromaticity green_region[] = {{.028, .385}, {.009, .723}, {.300, .511}, {.203, .356}};
constexpr Chromaticity red_region[] = {{.680, .320}, {.660, .320}, {.735, .265}, {.721, .259}};
constexpr Chromaticity yellow_region[] = {{.612, .382}, {.618, .382}, {.575, .425}, {.575, .406}};

std::span<const Chromaticity> region_of(Colour colour) {
    switch (colour) {
        case Colour::white:
            return white_region;
        case Colour::green:
            return green_region;
        case Colour::red:
            return red_region;
        case Colour::yellow:
            return yellow_region;
        default:
            return {};  // the rules know no blue, orange or violet
    }
}

// By the crossings of a ray: the white region is not convex.
bool inside(std::span<const Chromaticity> region, Chromaticity xy) {
    bool in = false;
    for (std::size_t i = 0, j = region.size() - 1; i < region.size(); j = i++) {
        const Chromaticity a = region[i];
        const Chromaticity b = region[j];
        if ((a.y > xy.y) != (b.y > xy.y) && xy.x < (b.x - a.x) * (xy.y - a.y) / (b.y - a.y) + a.x) in = !in;
    }
    return in;
}

constexpr std::array<std::string_view, colour_count> names = {"white", "red",    "green", "yellow",
                                                              "blue",  "orange", "violet"};

}  // namespace

void check_colours(std::span<const Subject> subjects, Findings& findings) {
    std::array<bool, colour_count> told{};
    for (const Subject& subject : subjects) {
        const auto shown = shown_colours(*subject.light);
        for (std::size_t c = 0; c < colour_count; ++c) {
            if (!shown[c] || told[c]) continue;
            told[c] = true;
            const auto region = region_of(static_cast<Colour>(c));
            if (region.empty()) continue;
            const auto rgb = glare::navigation_colour(static_cast<int>(c)).rgb;
            const Chromaticity xy = glare::chromaticity_of(glare::xyz_from_srgb({rgb[0], rgb[1], rgb[2]}));
            if (inside(region, xy)) continue;
            findings.push_back(
                subject.finding(LintKind::chromaticity, std::string(names[c]) + " is drawn at x " +
                                                            rounded(xy.x, 3) + ", y " + rounded(xy.y, 3) +
                                                            ", outside its region of COLREG Annex I: an sRGB "
                                                            "display has nothing nearer (this light is "
                                                            "the first of the file to show it)"));
        }
    }
}

}  // namespace seaglare::lightdb::lint_checks
