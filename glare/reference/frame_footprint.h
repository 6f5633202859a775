// The core of a light on pixels, from its definition (glare/apply/footprint.h): the lamp's disc, its light spread evenly
// over its solid angle, convolved with a kernel that is a box two pixels wide convolved with a Hann window of 1.5 pixels,
// in x and in y; each pixel is divided by its own solid angle. A disc smaller than 1.8 px is, by that definition, a point
// and a disc of 1.8 px in the proportion that keeps energy and second moment; one of up to 0.09 px is a point alone, and its
// disc comes in by 0.11 px. Double precision; discs are exact cones of any size.
#pragma once

#include <functional>

#include "glare/reference/frame_screen.h"

namespace seaglare::reference {

inline constexpr double footprint_reach_px = 1.75;
inline constexpr double smallest_disc_px = 1.8;
inline constexpr double point_alone_px = 0.09;
inline constexpr double disc_in_px = 0.11;

// The kernel along one axis, and its integral from minus infinity.
double footprint(double x_px);
double footprint_integral(double x_px);

// Calls visit(x, y, share): the share of the light's energy per steradian of pixel (x, y). Summed over all pixels times
// their solid angles the shares are 1, as far as the light is inside the picture. `direction` is unit, `radius_rad` its
// apparent radius. A pixel may be visited more than once.
void spread_core(const FrameScreen& screen, const Vector& direction, double radius_rad,
                 const std::function<void(int x, int y, double per_sr)>& visit);

}  // namespace seaglare::reference
