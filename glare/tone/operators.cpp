#include "glare/tone/operators.h"

#include <algorithm>
#include <cmath>

namespace seaglare::glare {

double srgb_encode(double linear) {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 1;
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double srgb_decode(double encoded) {
    if (!(encoded > 0)) return 0;
    if (encoded >= 1) return 1;
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double guarded_adaptation(double adaptation_cd_m2) {
    return adaptation_cd_m2 > 1e-6 ? std::min(adaptation_cd_m2, 1e6) : 1e-6;
}

double key_value(double adaptation_cd_m2) {
    return 1.002 - 2 / (2 + std::log10(guarded_adaptation(adaptation_cd_m2) + 1));
}

ToneCurve tone_curve(const ToneSettings& settings, double adaptation_cd_m2) {
    const double white = settings.white > 1e-3 ? settings.white : 1e-3;
    return {key_value(adaptation_cd_m2) / guarded_adaptation(adaptation_cd_m2), 1 / (white * white)};
}

double tone_map(const ToneCurve& curve, double luminance_cd_m2) {
    if (!(luminance_cd_m2 > 0)) return 0;
    const double relative = std::min(curve.scale * luminance_cd_m2, 1e15);
    return relative * (1 + relative * curve.inverse_white2) / (1 + relative);
}

double inverse_tone_map(const ToneCurve& curve, double display) {
    if (!(display > 0)) return 0;
    // x^2/white^2 + x (1 - y) - y = 0, in the form that does not cancel for small y.
    const double y = std::min(display, 1.0);
    const double rest = 1 - y;
    return 2 * y / (rest + std::sqrt(rest * rest + 4 * y * curve.inverse_white2)) / curve.scale;
}

double rod_weight(double luminance_cd_m2) {
    return half_rods_cd_m2 / (half_rods_cd_m2 + std::max(luminance_cd_m2, 0.0));
}

Rgb blue_shifted(const Rgb& glare_cd_m2, double scotopic_cd_m2, double background_luminance_cd_m2) {
    const double rods = rod_weight(background_luminance_cd_m2 + std::max(luminance(glare_cd_m2), 0.0));
    const double rod_luminance = std::max(scotopic_cd_m2, 0.0) / d65_scotopic_ratio;
    Rgb result{};
    for (std::size_t i = 0; i < 3; ++i) {
        result[i] = (1 - rods) * glare_cd_m2[i] + rods * rod_tint[i] * rod_luminance;
    }
    return result;
}

Rgb mapped_into_gamut(const Rgb& rgb) {
    const double grey = luminance(rgb);
    if (!(grey > 0)) return {0, 0, 0};
    const double lowest = std::min({rgb[0], rgb[1], rgb[2]});
    if (lowest >= 0) return rgb;
    const double keep = grey / (grey - lowest);
    Rgb result{};
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = std::max(0.0, grey + keep * (rgb[i] - grey));
    return result;
}

Rgb tone_mapped_rgb(const ToneCurve& curve, const Rgb& rgb_cd_m2) {
    Rgb rgb = mapped_into_gamut(rgb_cd_m2);
    const double y = luminance(rgb);
    if (!(y > 0)) return {0, 0, 0};
    const double ratio = tone_map(curve, y) / y;
    for (double& c : rgb)
        c *= ratio;
    return rgb;
}

Rgb fitted_to_display(const Rgb& rgb) {
    const double largest = std::max({1.0, rgb[0], rgb[1], rgb[2]});
    const double white = overload_white * (1 - 1 / largest);
    Rgb result{};
    for (std::size_t i = 0; i < 3; ++i) {
        result[i] = rgb[i] / largest;
        result[i] += white * (1 - result[i]);
    }
    return result;
}

Rgb display_delta(const ToneSettings& settings, double adaptation_cd_m2, double ldr_white_cd_m2,
                  const Rgb& background_linear, const Rgb& glare_cd_m2, double scotopic_cd_m2) {
    const ToneCurve curve = tone_curve(settings, adaptation_cd_m2);
    const double background_display = luminance(background_linear);
    double background_scale = ldr_white_cd_m2;
    if (!(ldr_white_cd_m2 > 0)) {
        background_scale =
            background_display > 0 ? inverse_tone_map(curve, background_display) / background_display : 0;
    }
    Rgb background{};
    for (std::size_t i = 0; i < 3; ++i)
        background[i] = background_linear[i] * background_scale;
    const Rgb glare =
        settings.blue_shift ? blue_shifted(glare_cd_m2, scotopic_cd_m2, luminance(background)) : glare_cd_m2;
    if (settings.mode == CompositeMode::plain) return fitted_to_display(tone_mapped_rgb(curve, glare));
    const Rgb before = tone_mapped_rgb(curve, background);
    const Rgb after = tone_mapped_rgb(
        curve, {background[0] + glare[0], background[1] + glare[1], background[2] + glare[2]});
    return fitted_to_display({std::max(0.0, after[0] - before[0]), std::max(0.0, after[1] - before[1]),
                              std::max(0.0, after[2] - before[2])});
}

double threshold_luminance_cd_m2(const ToneSettings& settings, double adaptation_cd_m2, double codes) {
    const ToneCurve curve = tone_curve(settings, adaptation_cd_m2);
    // Slopes at their largest: sRGB 12.92 at zero; the curve 1 at zero, or 1/white^2 far up when white < 1.
    const double slope = curve.scale * std::max(1.0, curve.inverse_white2) * 12.92 * 255;
    return std::max(codes, 0.0) / slope;
}

}  // namespace seaglare::glare
