// What a change of luminance is worth in display codes: the currency of every error bound. Pure functions.
#pragma once

#include "glare/tone/tone_settings.h"

namespace seaglare::glare {

struct Sensitivity {
    // The most 8-bit codes that any channel of a pixel changes by when its glare changes by 1 cd/m2 in the channel that
    // changes most, whatever the pixel has beside it, the rod hue included.
    double codes_per_cd_m2 = 0;
    // The most codes by which a pixel changes when its glare is multiplied by 1 + e, per e: sources that are all wrong by
    // the same part never need to be summed. For glare whose strongest channel is its luminance times
    // largest_channel_ratio.
    double codes_per_unit_ratio = 0;

    double luminance_cd_m2(double codes) const { return codes_per_cd_m2 > 0 ? codes / codes_per_cd_m2 : 0; }
};

// largest_channel_ratio: of the glare's strongest channel to its luminance, 1 for white, 4.7 for a red lamp; at most 13.85,
// pure blue, counts (glare is mapped into the gamut).
Sensitivity sensitivity(const ToneSettings& tone, double adaptation_cd_m2, double largest_channel_ratio = 1);

// An upper bound of what leaving out the rod hue changes, in codes, for glare of the same ratio and whatever background:
// rods take part with at most 0.04 cd/m2 (tone/operators.h, rod_weight).
double rod_hue_codes(const ToneSettings& tone, double adaptation_cd_m2, double largest_channel_ratio,
                     double largest_scotopic_ratio);

}  // namespace seaglare::glare
