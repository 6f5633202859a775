// Whether the eye's motion can be seen at all: what a display code may change by when the pattern of the eye at rest is shown
// instead of that of the moment. Where no light is bright enough, no pattern is made. Pure functions.
#pragma once

#include "glare/eye/eye_model.h"
#include "glare/plan/light_summary.h"
#include "glare/plan/sensitivity.h"
#include "glare/psf/pattern.h"

namespace seaglare::glare {

// How far the patterns of one eye at one adaptation are from that of the eye at rest (psf/motion_keys.h, at_rest), as parts
// of the pattern's own radial mean: the most that any channel of any node is off by. Larger than 1 where speckles are
// deeper than the mean is high.
struct MotionSpread {
    double core = 0;   // of the core's energy
    double skirt = 0;  // of the skirt
};

// An upper bound of it, from what moves: the pupil by hippus, particles, lens and lids. Fitted with headroom to the patterns
// of the shipped eyes (glare/psf/README.md has the table; tests/cl/pattern_motion_test.cpp holds it): the skirt's speckles
// stand out the more the smaller the pupil and the finer the pixel, because fewer of them fall on one. 0 for an eye of which
// nothing moves.
MotionSpread motion_spread(const EyeModel& eye, const PatternSettings& settings, double resting_pupil_mm,
                           double pitch);

// What the motion changes at most, in 8-bit codes, of any channel of any pixel. `lights` are all that are drawn,
// `smallest_pixel_sr` the solid angle of the picture's smallest pixel.
double motion_bound_codes(const MotionSpread& spread, const Sensitivity& sensitivity,
                          const LightSummary& lights, double pitch, double smallest_pixel_sr,
                          double angular_scale);

}  // namespace seaglare::glare
