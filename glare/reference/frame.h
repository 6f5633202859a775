// The frame that production's is held against: every light's glare summed at every pixel in double precision, no light left
// out, nothing cropped, discs exact, the CIE's curve up to a quarter turn. Brute force; what it draws is defined in
// glare/psf/pattern.h and glare/apply/footprint.h, and it shares no numerical code with what it checks.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "glare/frame.h"
#include "glare/reference/frame_screen.h"
#include "glare/reference/frame_shape.h"

namespace seaglare::reference {

// Luminance in cd/m2, linear sRGB (signed) and scotopic, of every pixel; rows from the lowest up.
//
// What is an approximation and how good: a pixel's footprint on the skirt is a square of one pitch wherever it is in the
// picture; the tail, with its window, comes from a table over the chord of the angle, linear to 1e-7; lamps under 0.02 px
// have the skirt of a point (1e-4 of it), those under 0.3 px that of Stroud's seven nodes (fifth order).
//
// Lights whose position or illuminance is not finite are left out, as the product does. `progress` gets the fraction done.
// With a `row_step` only the rows that is_drawn() names are drawn, the others are black: ten thousand lights over a whole
// picture are 10^10 sums.
std::vector<Rgbv> draw_frame(const FrameScreen& screen, const GlareShape& shape,
                             std::span<const glare::PointSource> lights,
                             const std::function<void(double)>& progress = {}, int row_step = 1);
inline bool is_drawn(std::size_t row, int row_step) {
    const auto step = static_cast<std::size_t>(row_step);
    return row % step == step / 2;
}

}  // namespace seaglare::reference
