// How glare luminance becomes display values; read from config/display and config/quality. Pure data.
#pragma once

namespace seaglare::glare {

enum class CompositeMode {
    // Adds f(L_background + L_glare) - f(L_background): the host's pixel is taken back to luminance first.
    difference,
    // Adds f(L_glare), as the 2012 thesis does; washes out dusk and day.
    plain,
};

struct ToneSettings {
    double white = 2.0;  // relative luminance that maps to 1.0 (photographic operator)
    CompositeMode mode = CompositeMode::difference;
    bool blue_shift = true;         // rod hue by local luminance
    bool dither = true;             // breaks the contours of a smooth halo on an 8-bit target
    double threshold_codes = 0.25;  // a contribution below this many 8-bit codes is left out
};

}  // namespace seaglare::glare
