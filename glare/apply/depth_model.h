// What a stored depth value means as a distance from the eye. Pure.
//
// Along a unit ray r, clip z = t (row_z . r) + z_constant and clip w = t (row_w . r) + w_constant, so a normalised depth z
// lies at t = (z_constant - z w_constant)/(z row_w . r - row_z . r): standard, reversed, finite and infinite
// projections, of either handedness, are one formula. Near the far plane its denominator cancels in floats; anchored
// there, z = far_z + step, it is step (row_w . r) + (far_z row_w - row_z) . r, whose parts are exact.
#pragma once

#include <array>

#include "glare/apply/vec3.h"
#include "glare/frame.h"

namespace seaglare::glare {

struct DepthModel {
    bool logarithmic = false;
    double log_c = 0;
    double log_range = 0;  // ln(c far + 1)
    double scale = 2;      // step = scale (stored - anchor)
    double anchor = 1;
    double far_z = 1;
    Vec3 offset{};  // far_z row_w - row_z
    Vec3 row_w{};
    double z_constant = 0;
    double w_constant = 0;
};

// Throws std::invalid_argument naming the field when the frame's depth convention cannot be used.
DepthModel depth_model(const Frame& frame);

// Distance in metres along a unit ray; infinity where nothing was drawn.
double eye_distance_m(const DepthModel& model, double stored, const Vec3& ray);

}  // namespace seaglare::glare
