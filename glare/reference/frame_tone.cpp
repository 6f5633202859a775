#include "glare/reference/frame_tone.h"

#include <algorithm>
#include <cmath>

namespace seaglare::reference {

namespace {

using Colour = std::array<double, 3>;
constexpr double rod_half_cd_m2 = 0.04;
constexpr double scotopic_of_white = 2.464;  // scotopic over photopic luminance of D65
constexpr Colour rod_hue = {1.05 / 1.0087, 0.97 / 1.0087, 1.27 / 1.0087};
constexpr double white_of_overload = 0.03;  // of what a channel lacks (glare/tone/operators.h says why)

// The second row of the matrix that the primaries and the white of IEC 61966-2-1 give.
double luminance_of(const Colour& c) {
    return 0.2126390059 * c[0] + 0.7151686788 * c[1] + 0.0721923154 * c[2];
}

double encoded(double linear) {
    const double v = std::clamp(linear, 0.0, 1.0);
    return v > 0.0031308 ? 1.055 * std::pow(v, 1 / 2.4) - 0.055 : 12.92 * v;
}

double decoded(double code) {
    const double v = std::clamp(code, 0.0, 1.0);
    return v > 0.04045 ? std::pow((v + 0.055) / 1.055, 2.4) : v / 12.92;
}

struct Curve {
    double scale, white;
    double map(double luminance) const {
        const double r = std::clamp(scale * luminance, 0.0, 1e15);
        return r * (1 + r / (white * white)) / (1 + r);
    }
    // The positive root of r^2/white^2 + (1 - d) r - d = 0.
    double unmap(double display) const {
        const double d = std::clamp(display, 0.0, 1.0);
        if (d == 0) return 0;
        const double b = 1 - d;
        return 2 * d / (b + std::sqrt(b * b + 4 * d / (white * white))) / scale;
    }
};

Curve curve_of(const DisplayState& display) {
    const double adapted = std::clamp(display.adaptation_cd_m2, 1e-6, 1e6);
    const double key = 1.002 - 2 / (2 + std::log10(adapted + 1));
    return {key / adapted, std::max(display.tone.white, 1e-3)};
}

// Towards grey until no channel is negative, then the curve on the luminance.
Colour mapped(const Curve& curve, Colour c) {
    const double grey = luminance_of(c);
    if (!(grey > 0)) return {};
    const double lowest = *std::min_element(c.begin(), c.end());
    const double saturation = lowest < 0 ? grey / (grey - lowest) : 1;
    const double gain = curve.map(grey) / grey;
    for (double& v : c)
        v = std::max(grey + saturation * (v - grey), 0.0) * gain;
    return c;
}

Colour fitted(Colour c) {
    const double largest = std::max(1.0, *std::max_element(c.begin(), c.end()));
    const double white = white_of_overload * (1 - 1 / largest);
    for (double& v : c)
        v = v / largest * (1 - white) + white;
    return c;
}

}  // namespace

std::array<double, 3> shown_codes(const DisplayState& display, const std::array<double, 3>& before,
                                  const Rgbv& glare_cd_m2) {
    const Curve curve = curve_of(display);
    Colour picture{};
    for (std::size_t c = 0; c < 3; ++c)
        picture[c] = decoded(before[c] / 255);
    const double shown = luminance_of(picture);
    double white_cd_m2 = display.ldr_white_cd_m2;
    if (!(white_cd_m2 > 0)) white_cd_m2 = shown > 0 ? curve.unmap(shown) / shown : 0;
    Colour background{};
    for (std::size_t c = 0; c < 3; ++c)
        background[c] = picture[c] * white_cd_m2;

    Colour glare = {glare_cd_m2[0], glare_cd_m2[1], glare_cd_m2[2]};
    if (display.tone.blue_shift) {
        const double level = luminance_of(background) + std::max(luminance_of(glare), 0.0);
        const double rods = rod_half_cd_m2 / (rod_half_cd_m2 + level);
        const double to_rods = std::max(glare_cd_m2[3], 0.0) / scotopic_of_white;
        for (std::size_t c = 0; c < 3; ++c)
            glare[c] = (1 - rods) * glare[c] + rods * rod_hue[c] * to_rods;
    }
    Colour added{};
    if (display.tone.mode == glare::CompositeMode::plain) {
        added = fitted(mapped(curve, glare));
    } else {
        const Colour alone = mapped(curve, background);
        const Colour together =
            mapped(curve, {background[0] + glare[0], background[1] + glare[1], background[2] + glare[2]});
        for (std::size_t c = 0; c < 3; ++c)
            added[c] = std::max(together[c] - alone[c], 0.0);
        added = fitted(added);
    }
    std::array<double, 3> codes{};
    for (std::size_t c = 0; c < 3; ++c)
        codes[c] = std::max(255 * encoded(picture[c] + added[c]), before[c]);
    return codes;
}

}  // namespace seaglare::reference
