#include "glare/apply/code_slopes.h"

#include <bit>
#include <cmath>
#include <cstdint>

namespace seaglare::glare {

namespace {

constexpr double display_codes = 255;
constexpr double rod_luminance_cd_m2 = 0.04;  // tone/operators.h, rod_weight
constexpr std::array<double, 3> luminance_weight = {0.2126, 0.7152, 0.0722};
// Rods give way to the background's luminance while the background lifts a channel to where the display is flatter: what
// cones see shows most in between. cd/m2.
constexpr std::array<double, 6> backgrounds_cd_m2 = {0, 0.01, 0.03, 0.08, 0.2, 0.6};

// Steepest slope of the sRGB curve from a linear value on, IEC 61966-2-1, at most 2.6 % too steep. A channel beyond 1 is
// brought back to 1 with the others in proportion, so that the curve does not end there.
float encode_slope(float linear) {
    constexpr std::uint32_t first_bits = 0x3b000000U;  // 2^-9
    constexpr int shift = 19;                          // sixteen entries in an octave
    constexpr std::size_t entries = 9 * 16 + 1;
    static const std::array<float, entries> table = [] {
        std::array<float, entries> values{};
        for (std::size_t i = 0; i < entries; ++i) {
            const auto value = static_cast<double>(
                std::bit_cast<float>(first_bits + (static_cast<std::uint32_t>(i) << shift)));
            values[i] =
                static_cast<float>(value <= 0.0031308 ? 12.92 : 1.055 / 2.4 * std::pow(value, 1 / 2.4 - 1));
        }
        return values;
    }();
    if (!(linear > 0.0031308F)) return 12.92F;
    return table[(std::bit_cast<std::uint32_t>(std::min(linear, 1.0F)) - first_bits) >> shift];
}

}  // namespace

// A channel c of glare g of luminance L is shown as s(p(L) c), s the sRGB curve, p(L) = f(L)/L, f the tone curve; with x the
// part of the rods, which see V, c = (1 - x) g + x t V. A loss moves it as that says, and by what it does to the luminance: by
// the curve, which bends, p' c, at most c/L times r/(1 + r) of p, r = scale L; and by the rods' part, x (1 - x) (g - t V)/L
// of p. All of it falls as the glare grows, but for the bend, which is taken where it is largest.
CodeSlopes code_slopes(const CodeBudget& budget, double otherwise_cd_m2, const std::array<double, 4>& least) {
    CodeSlopes slopes;
    if (!(budget.codes > 0)) {
        const double part = std::min(otherwise_cd_m2 > 0 ? 1 / otherwise_cd_m2 : 1e30, 1e30);
        for (std::size_t c = 0; c < 3; ++c) {
            slopes.part_per_cd_m2[c][c] = static_cast<float>(part);
            if (budget.blue_shift)
                slopes.part_per_cd_m2[3][c] = static_cast<float>(part * rod_tint[c] / d65_scotopic_ratio);
        }
        return slopes;
    }
    double luminance = 0;
    for (std::size_t c = 0; c < 3; ++c)
        luminance += luminance_weight[c] * least[c];
    luminance = std::max(luminance, 0.0);
    const double rods = std::max(least[3], 0.0) / d65_scotopic_ratio;
    const double strongest = std::max({luminance, least[0], least[1], least[2]});
    const double relative = budget.curve.scale * luminance;
    const double white2 = budget.curve.inverse_white2;
    const double shown = budget.curve.scale * std::max((1 + relative * white2) / (1 + relative), white2);
    const double ratio = luminance > 0 ? strongest / luminance : 1;
    // From a luminance r0 on, the slope falls at least as (r0/r)^0.58 (1 + r0)/(1 + r), and r/(1 + r) times that has its peak
    // at r = 0.42.
    const double bend =
        ratio * std::max(relative / (1 + relative), 0.42 * std::sqrt(std::min(relative, 0.42)));
    // A channel at 1 brings the others back with it.
    const double beside = shown * strongest > 0.8 ? 1 : 0;
    for (const double background : backgrounds_cd_m2) {
        const double part =
            budget.blue_shift ? rod_luminance_cd_m2 / (rod_luminance_cd_m2 + background + luminance) : 0;
        const double relative_background = budget.curve.scale * background;
        const double lifted =
            least_background_channel * (budget.background_per_cd_m2 > 0
                                            ? std::min(background * budget.background_per_cd_m2, 1.0)
                                            : relative_background / (1 + relative_background));
        for (std::size_t c = 0; c < 3; ++c) {
            const double tinted = rods * rod_tint[c];
            const double value = std::max((1 - part) * least[c] + part * tinted, 0.0);
            const double slope =
                display_codes / budget.codes * shown *
                static_cast<double>(encode_slope(static_cast<float>(shown * value + lifted)));
            const double hue =
                luminance > 0 ? part * (1 - part) * std::abs(least[c] - tinted) / luminance : 0.0;
            for (std::size_t k = 0; k < 4; ++k) {
                double moved = 0;
                if (k == 3)
                    moved = part * rod_tint[c] / d65_scotopic_ratio;
                else
                    moved = (k == c ? std::max(1 - part, bend * luminance_weight[k])
                                    : beside + bend * luminance_weight[k]) +
                            hue * luminance_weight[k];
                // A channel that may be below zero is mapped into the gamut, and moves the others with it.
                if (k < 3 && k != c && least[k] <= 0) moved += (1 - part) * ratio;
                float& most = slopes.part_per_cd_m2[k][c];
                most = std::max(most, static_cast<float>(std::min(slope * moved, 1e30)));
            }
        }
        if (!budget.blue_shift) break;
    }
    return slopes;
}

}  // namespace seaglare::glare
