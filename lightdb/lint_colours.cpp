// What a lamp's colour is drawn as, against the regions that COLREG 1972 Annex I section 7 allows.
#include <array>
#include <cmath>
#include <span>

#include "glare/colour/chromaticity.h"
#include "glare/colour/navigation_colours.h"
#include "lightdb/colreg_regions.h"
#include "lightdb/lint_checks.h"

namespace seaglare::lightdb::lint_checks {
namespace {

using glare::Chromaticity;

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
            const auto region = colreg_region(static_cast<Colour>(c));
            if (region.empty()) continue;
            const auto rgb = glare::navigation_colour(static_cast<int>(c)).rgb;
            const Chromaticity xy = glare::chromaticity_of(glare::xyz_from_srgb({rgb[0], rgb[1], rgb[2]}));
            if (inside_region(region, xy)) continue;
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
