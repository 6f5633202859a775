#include "glare/plan/sensitivity.h"

#include <algorithm>
#include <cmath>

#include "glare/tone/operators.h"

namespace seaglare::glare {

namespace {

constexpr double codes = 255;
constexpr double largest_ratio = 1 / 0.0722;  // pure sRGB blue

// Steepest slope of the sRGB curve from a linear value on.
double encode_slope(double linear) {
    if (linear <= 0.0031308) return 12.92;
    return linear >= 1 ? 0 : 1.055 / 2.4 * std::pow(linear, 1 / 2.4 - 1);
}

// Luminances at which the pixel's own brightness is tried: from where the curve is straight to where it has ended.
constexpr int steps = 48;
constexpr int channel_steps = 8;
// What lies between two of them is no larger, and backgrounds of strong colours, whose mixture with the glare has another
// strongest channel, add less than a fifth: tests/unit/plan_sensitivity_test.cpp tries both.
constexpr double between_steps = 1.06 * 1.2;
double tried_luminance(const ToneCurve& curve, int step) {
    return std::pow(10.0, -6 + 9.0 * step / (steps - 1)) / curve.scale;
}

}  // namespace

// A pixel of luminance L has its strongest channel at no less than L, and code = s(f(L) c/L) with c between L and k L. Of a
// change d of every channel, f'(L) d is left in the luminance and, with hue kept, up to k times that in the strongest channel
// of a colour outside the gamut; the rod hue moves by no more than d 0.04 L/(0.04 + L)^2 times the difference of the hues,
// which is less than k. Where the glare is dark all that is left is the slope at zero.
Sensitivity sensitivity(const ToneSettings& tone, double adaptation_cd_m2, double largest_channel_ratio) {
    const ToneCurve curve = tone_curve(tone, adaptation_cd_m2);
    const double ratio = std::clamp(largest_channel_ratio, 1.0, largest_ratio);
    Sensitivity result;
    result.codes_per_cd_m2 = curve.scale * std::max(1.0, curve.inverse_white2) * 12.92 * codes;
    for (int i = 0; i < steps; ++i) {
        const double luminance = tried_luminance(curve, i);
        const double shown = std::min(tone_map(curve, luminance), 1.0);
        const double slope = encode_slope(shown);
        const double relative = curve.scale * luminance;
        const double below = 1 + relative;
        const double tone_slope =
            curve.scale * (1 + relative * curve.inverse_white2 * (2 + relative)) / (below * below);
        double hue = 0;
        if (tone.blue_shift) {
            const double rest = 0.04 + luminance;
            hue = 0.04 * luminance / (rest * rest) * ratio;
        }
        result.codes_per_cd_m2 =
            std::max(result.codes_per_cd_m2, std::max(tone_slope, tone_map(curve, luminance) / luminance) *
                                                 slope * codes * (1 + hue));
        // d(code)/d(ln L); the strongest channel is somewhere between L and k L.
        for (int step = 0; step <= channel_steps; ++step) {
            const double channel = std::pow(ratio, static_cast<double>(step) / channel_steps);
            const double value = std::min(shown * channel, 1.0);
            result.codes_per_unit_ratio =
                std::max(result.codes_per_unit_ratio, between_steps * codes * encode_slope(value) *
                                                          tone_slope * luminance * channel * (1 + hue));
        }
    }
    return result;
}

double rod_hue_codes(const ToneSettings& tone, double adaptation_cd_m2, double largest_channel_ratio,
                     double largest_scotopic_ratio) {
    if (!tone.blue_shift) return 0;
    const ToneCurve curve = tone_curve(tone, adaptation_cd_m2);
    const double as_rods = rod_tint[2] * std::max(largest_scotopic_ratio, 0.0) / d65_scotopic_ratio;
    // rods L |difference of the hues| with rods L = 0.04 L/(0.04 + L) < 0.04.
    const double change_cd_m2 = 0.04 * (std::max(largest_channel_ratio, 1.0) + as_rods);
    return change_cd_m2 * curve.scale * std::max(1.0, curve.inverse_white2) * 12.92 * codes;
}

}  // namespace seaglare::glare
