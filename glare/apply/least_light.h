// The faintest light that is worth evaluating for a picture.
#pragma once

#include "glare/frame.h"
#include "glare/tone/tone_settings.h"

namespace seaglare::glare {

// At least so many lights of the illuminance below it, all in one pixel, come to the threshold together.
inline constexpr double least_lights_to_threshold = 64;

// Photopic illuminance at the eye in lux, all colours of a source together, below which ViewRenderer::cull leaves out any
// source, wherever it stands, in the picture or outside. So whoever makes the sources may leave them out already: of
// navigation colours, and of lamps whose largest channel has at most `strongest_channel_per_lux` of a lux. 0: every light counts. Throws as screen_geometry().
double least_illuminance_lx(const Frame& frame, const ToneSettings& tone, double angular_scale = 1,
                            double strongest_channel_per_lux = 0);

}  // namespace seaglare::glare
