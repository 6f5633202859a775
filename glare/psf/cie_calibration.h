// Calibration of a pattern to the CIE 135/1-1999 curve: the structure keeps its shape and its colours, while the mean of its
// luminance over each ring of nodes follows the curve for the eye's age and pigmentation, into which the tail carries on.
//
// How it is normalised: the curve as printed integrates to 1.0102 over the hemisphere. Skirt and tail follow it as printed;
// the core takes what is left of the light that the pupil passes, so that no light is made: a pattern of an eye that absorbs
// nothing integrates to 1, the curve's hundredth too much is missing in the core.
#pragma once

#include <span>
#include <vector>

#include "glare/eye/eye_model.h"
#include "glare/psf/pattern.h"
#include "glare/psf/pattern_grid.h"

namespace seaglare::glare {

// Rings are those nodes (a, b) whose distance from the middle rounds to the same number. Nodes between the middles of two
// rings have a gain between theirs.
int calibration_rings(const PatternGrid& grid);

// Mean of the curve over the nodes of each ring, in energy per node (times pitch^2).
std::vector<float> calibration_targets(const PatternGrid& grid, double age_years, double pigmentation);

// Gain of each ring from the mean luminance of its nodes, `scale` times the target; 1 where there is no light. The middle
// one has the gain of the first: its light is the core's.
std::vector<float> calibration_gains(const std::vector<float>& targets, const std::vector<double>& means,
                                     double scale);
double calibration_gain(std::span<const float> gains, double distance_nodes);

// Only angles that are physical, with a tail to carry on, can follow the curve.
inline bool is_calibrated(const EyeModel& eye, const Pattern& pattern) {
    return eye.cie_calibrated && pattern.tail_scale > 0;
}

}  // namespace seaglare::glare
