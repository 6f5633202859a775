// The tone curve: from luminance in cd/m2 to display values, in double precision. shaders/tone.glsl says the same in
// GLSL and a test holds the two together. Colours are linear sRGB.
//
// Sources: photographic operator after Reinhard et al. 2002, its key after Krawczyk et al. 2005 with the +1 inside the
// logarithm; rod hue and local saturation after Ritschel et al. 2009 and the physics notes; IEC 61966-2-1 for sRGB.
#pragma once

#include <array>

#include "glare/colour/chromaticity.h"
#include "glare/tone/tone_settings.h"

namespace seaglare::glare {

using Rgb = std::array<double, 3>;

double srgb_encode(double linear);   // piecewise, not a power; clamps to 0 ... 1
double srgb_decode(double encoded);  // the inverse

// alpha(L) = 1.002 - 2/(2 + log10(L + 1)): 0.002 in the dark, no pole. Adaptation is clamped to 1e-6 ... 1e6 cd/m2, NaN
// counts as 1e-6.
double guarded_adaptation(double adaptation_cd_m2);
double key_value(double adaptation_cd_m2);

struct ToneCurve {
    double scale = 1;           // relative luminance per cd/m2: alpha/adaptation
    double inverse_white2 = 0;  // 1/white^2
};
ToneCurve tone_curve(const ToneSettings& settings, double adaptation_cd_m2);

// L_d = L_r (1 + L_r/white^2)/(1 + L_r), L_r = scale L; 1 at L_r = white, not clamped. 0 for L <= 0 and NaN.
double tone_map(const ToneCurve& curve, double luminance_cd_m2);
// Its inverse for 0 ... 1.
double inverse_tone_map(const ToneCurve& curve, double display);

// Where half of vision is by rods.
inline constexpr double half_rods_cd_m2 = 0.04;
// Part of rod vision at a luminance: 0.04/(0.04 + L).
double rod_weight(double luminance_cd_m2);

// The hue that rods alone give, unit luminance at chromaticity (0.300, 0.300).
inline constexpr Rgb rod_tint = {1.05 / 1.0087, 0.97 / 1.0087, 1.27 / 1.0087};
// Scotopic over photopic luminance of D65: brightness to rods is counted so that white stays as bright.
// 1700 V'/683 V of the CIE D65 table.
inline constexpr double d65_scotopic_ratio = 2.464;

// Glare as it appears before a background: towards the rod hue as far as glare and background together are dark.
Rgb blue_shifted(const Rgb& glare_cd_m2, double scotopic_cd_m2, double background_luminance_cd_m2);

// Moves a colour with negative components along the line to the grey of the same luminance until it is inside sRGB.
Rgb mapped_into_gamut(const Rgb& rgb);

// What a colour that no display can show so bright regains of its luminance as white. Without it the middle of a red
// light, pure red, would look darker than its rim, where the background's green and blue still show. 0.03 moves the red
// primary from x = 0.640 to 0.60.
inline constexpr double overload_white = 0.03;

// Display values of a colour in cd/m2: gamut, then the curve on its luminance. A channel may exceed 1.
Rgb tone_mapped_rgb(const ToneCurve& curve, const Rgb& rgb_cd_m2);
// What is added, 0 ... 1: hue kept where a channel exceeds 1 (but for overload_white). Not done on background and glare
// together: over a bright sky the glare of a yellow light would lose all its green, and look red.
Rgb fitted_to_display(const Rgb& rgb);

// What is added to the linear value of a host pixel: never negative. ldr_white_cd_m2 = 0: the background's luminance is
// the inverse of our own curve.
Rgb display_delta(const ToneSettings& settings, double adaptation_cd_m2, double ldr_white_cd_m2,
                  const Rgb& background_linear, const Rgb& glare_cd_m2, double scotopic_cd_m2);

// The largest luminance that cannot move a display value by `codes` 8-bit steps, before any background: the curve is
// steepest in the dark.
double threshold_luminance_cd_m2(const ToneSettings& settings, double adaptation_cd_m2, double codes);

}  // namespace seaglare::glare
