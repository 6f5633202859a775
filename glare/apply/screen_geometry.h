// Where directions fall on the screen. Everything comes from rows 0, 1 and 3 of the projection, so that off-axis frusta,
// both handednesses and rolled screens need no case of their own. Pure functions, double precision.
#pragma once

#include <array>

#include "glare/apply/vec3.h"
#include "glare/frame.h"

namespace seaglare::glare {

struct ScreenGeometry {
    double pitch = 0;  // direction cosine per pixel at the centre of projection: 1/f_px (the finer axis)
    int width_px = 0;
    int height_px = 0;
    // clip = row . direction; w > 0 is ahead.
    Vec3 row_x{}, row_y{}, row_w{};
    std::array<double, 9> ray_from_ndc{};  // column-major: ray = M (x, y, 1), not normalised
    Vec3 forward{};                        // unit, perpendicular to the image plane
    Vec3 right{}, up{};                    // unit, in the image plane, along which the screen's x and y grow
    double plane_area_px = 0;     // area of a pixel on the image plane at distance 1: its solid angle / cos^3
    std::array<Vec3, 4> edges{};  // unit inward normals of the frustum's sides
    Vec3 axis{};                  // of the cone around the picture, unit
    double cone_rad = 0;          // its half angle
};

// Throws std::invalid_argument naming clip_from_view when it is not an invertible perspective, viewport_px when empty.
ScreenGeometry screen_geometry(const Frame& frame);

struct Tangents {
    Vec3 u, v;
};
// The frame in which a light's pattern stands: right and up of the screen, turned with the least rotation that takes
// the forward axis to `direction` (unit). Continuous everywhere but straight behind the eye.
Tangents pattern_tangents(const ScreenGeometry& geometry, const Vec3& direction);

// Pixel position in the viewport, (0, 0) its lower left corner. False when the direction is not ahead.
bool project_px(const ScreenGeometry& geometry, const Vec3& direction, std::array<double, 2>& position_px);

// Derivative of the pixel position along a tangent vector, in px per radian. `direction` is unit and ahead.
std::array<double, 2> pixel_derivative(const ScreenGeometry& geometry, const Vec3& direction,
                                       const Vec3& tangent);

// Solid angle of a pixel in a unit direction, sr: cos^3(omega)/f^2.
double pixel_solid_angle_sr(const ScreenGeometry& geometry, const Vec3& direction);

// Unit view-space direction of a pixel position.
Vec3 ray_of_px(const ScreenGeometry& geometry, double x_px, double y_px);

// Lower bound, in radians, of the angle between a unit direction and the nearest point of the picture; 0 inside.
double angle_outside_rad(const ScreenGeometry& geometry, const Vec3& direction);

struct PixelRect {
    double left = 0, bottom = 0, right = 0, top = 0;  // px in the viewport
    bool empty() const { return !(left < right && bottom < top); }
};
// The part of the viewport that a cone of half angle `angle_rad` around a unit direction can touch: exact per axis
// while the cone lies ahead, the whole viewport when it reaches the plane of the eye. `margin_px` widens the viewport.
PixelRect cone_bounds_px(const ScreenGeometry& geometry, const Vec3& direction, double angle_rad,
                         double margin_px = 0);

}  // namespace seaglare::glare
