// The faintest light that is worth evaluating for a picture.
#pragma once

#include "glare/frame.h"
#include "glare/tone/tone_settings.h"

namespace seaglare::glare {

// Photopic illuminance at the eye in lux, all colours of a source together, below which ViewRenderer::cull leaves out any
// source of navigation colours, wherever it stands, in the picture or outside. So whoever makes the sources may leave them
// out already. 0: every light counts. Throws as screen_geometry().
double least_illuminance_lx(const Frame& frame, const ToneSettings& tone, double angular_scale = 1);

}  // namespace seaglare::glare
