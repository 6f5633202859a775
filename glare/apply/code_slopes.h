// What the display makes of a loss: how much of the codes that a picture can afford each channel of it costs. Pure.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "glare/tone/operators.h"

namespace seaglare::glare {

// What may be lost, in display codes, and the curve that makes codes of luminance.
struct CodeBudget {
    double codes = 0;
    ToneCurve curve;
    bool blue_shift = true;
    // Linear display value of a host pixel of 1 cd/m2; 0: by the inverse of the curve.
    double background_per_cd_m2 = 0;
};

// A background has in each channel at least so much of its luminance: a sky or sea, however blue, and whatever sodium light
// falls on. Before a purer one rods see less while no channel is lifted where the display is steepest: a channel may then be
// off by up to three times as much.
inline constexpr double least_background_channel = 0.1;

// Of each display channel's budget, what a loss of 1 cd/m2 in each channel of the glare takes at most.
struct CodeSlopes {
    // By channel of the glare, linear sRGB and scotopic, then of the display; the fourth of those is zero.
    std::array<std::array<float, 4>, 4> part_per_cd_m2{};

    // Of the display channel that loses most; losses without their sign.
    float part_of(const std::array<float, 4>& loss) const {
        std::array<float, 4> sum{};
        for (std::size_t k = 0; k < 4; ++k)
            for (std::size_t c = 0; c < 4; ++c)
                sum[c] += loss[k] * part_per_cd_m2[k][c];
        return std::max({sum[0], sum[1], sum[2]});
    }
};

// Where the glare is at least `least` (linear sRGB and scotopic luminance, cd/m2) and of about its colour. Without codes to
// lose, `otherwise_cd_m2` in each channel is the whole budget.
CodeSlopes code_slopes(const CodeBudget& budget, double otherwise_cd_m2, const std::array<double, 4>& least);

}  // namespace seaglare::glare
