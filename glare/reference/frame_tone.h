// What a display shows of the glare, for comparing frames in 8-bit codes: the product's tone mapping in double precision,
// written again from its sources. Photographic operator: Reinhard et al. 2002, key after Krawczyk et al. 2005; rod weight
// 0.04/(0.04 + L); transfer function of IEC 61966-2-1.
#pragma once

#include <array>

#include "glare/reference/reference_pattern.h"
#include "glare/tone/tone_settings.h"

namespace seaglare::reference {

struct DisplayState {
    glare::ToneSettings tone;  // its dither and threshold are not used: nothing is dithered or left out here
    double adaptation_cd_m2 = 0.001;
    double ldr_white_cd_m2 = 0;  // luminance of the host's 1.0; 0: the inverse of the tone curve
};

// 8-bit code values, not rounded, of a pixel whose sRGB code values are `before` when this glare is added.
std::array<double, 3> shown_codes(const DisplayState& display, const std::array<double, 3>& before,
                                  const Rgbv& glare_cd_m2);

}  // namespace seaglare::reference
