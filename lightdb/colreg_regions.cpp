#include "lightdb/colreg_regions.h"

#include <algorithm>
#include <cmath>

namespace seaglare::lightdb {

namespace {

using glare::Chromaticity;

constexpr Chromaticity white_region[] = {{.525, .382}, {.525, .440}, {.452, .440},
                                         {.310, .348}, {.310, .283}, {.443, .382}};
constexpr Chromaticity green_region[] = {{.028, .385}, {.009, .723}, {.300, .511}, {.203, .356}};
// In an order around it: the rule lists the first two the other way, and its outline would cross itself.
constexpr Chromaticity red_region[] = {{.660, .320}, {.680, .320}, {.735, .265}, {.721, .259}};
constexpr Chromaticity yellow_region[] = {{.612, .382}, {.618, .382}, {.575, .425}, {.575, .406}};

}  // namespace

std::span<const Chromaticity> colreg_region(Colour colour) {
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
            return {};
    }
}

bool inside_region(std::span<const Chromaticity> corners, Chromaticity xy) {
    constexpr double rounding =
        0.0005;  // corners have three digits, and two edges of red lie on the spectral locus
    bool in = false;
    for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
        const Chromaticity a = corners[i];
        const Chromaticity b = corners[j];
        // By the crossings of a ray: the white region is not convex.
        if ((a.y > xy.y) != (b.y > xy.y) && xy.x < (b.x - a.x) * (xy.y - a.y) / (b.y - a.y) + a.x) in = !in;
        const double along = ((xy.x - a.x) * (b.x - a.x) + (xy.y - a.y) * (b.y - a.y)) /
                             ((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
        const double t = std::clamp(along, 0.0, 1.0);
        if (std::hypot(xy.x - std::lerp(a.x, b.x, t), xy.y - std::lerp(a.y, b.y, t)) <= rounding) return true;
    }
    return in;
}

}  // namespace seaglare::lightdb
