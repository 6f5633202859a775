#include "glare/apply/screen_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace seaglare::glare {

namespace {

Vec3 without(const Vec3& a, const Vec3& unit) {
    return added(a, unit, -dot(a, unit));
}

bool finite(const Vec3& a) {
    return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}

struct Interval {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
};

// The planes through the eye on which one screen coordinate is constant, x = s, have the normals row - s row_w. The
// cone touches two of them: |(row - s row_w) . d| = sin(angle) |row - s row_w|, a quadratic in s.
Interval cone_interval(const Vec3& row, const Vec3& row_w, const Vec3& d, double sine) {
    const double s2 = sine * sine;
    const double p = dot(row, d);
    const double w = dot(row_w, d);
    const double a = w * w - s2 * dot(row_w, row_w);
    const double half_b = p * w - s2 * dot(row, row_w);
    const double c = p * p - s2 * dot(row, row);
    if (w <= 0 || a <= 1e-9 * dot(row_w, row_w)) return {};
    const double root = std::sqrt(std::max(0.0, half_b * half_b - a * c));
    return {(half_b - root) / a, (half_b + root) / a};
}

}  // namespace

ScreenGeometry screen_geometry(const Frame& frame) {
    const auto& m = frame.clip_from_view;
    const auto row = [&m](int r) { return Vec3{m[r], m[4 + r], m[8 + r]}; };
    ScreenGeometry g;
    g.width_px = frame.viewport_px[2];
    g.height_px = frame.viewport_px[3];
    if (g.width_px <= 0 || g.height_px <= 0) throw std::invalid_argument("viewport_px has no pixels");
    g.row_x = row(0);
    g.row_y = row(1);
    g.row_w = row(3);
    const double w_length = length(g.row_w);
    if (!finite(g.row_x) || !finite(g.row_y) || !finite(g.row_w) || !(w_length > 0)) {
        throw std::invalid_argument("clip_from_view is not a perspective projection");
    }
    g.forward = scaled(g.row_w, 1 / w_length);
    const Vec3 x_in_plane = without(g.row_x, g.forward);
    const Vec3 y_in_plane = without(g.row_y, g.forward);
    const double x_length = length(x_in_plane);
    const double y_length = length(y_in_plane);
    const double area = length(cross(x_in_plane, y_in_plane));
    if (!(x_length > 0) || !(y_length > 0) || !(area > 1e-9 * x_length * y_length)) {
        throw std::invalid_argument("clip_from_view cannot be inverted");
    }
    const double fx_px = x_length / w_length * g.width_px / 2;
    const double fy_px = y_length / w_length * g.height_px / 2;
    g.pitch = 1 / std::max(fx_px, fy_px);
    g.plane_area_px = 4.0 / g.width_px / g.height_px * w_length * w_length / area;
    g.right = scaled(x_in_plane, 1 / x_length);
    // Perpendicular to right even on a sheared screen: the pattern is never sheared.
    g.up = normalised(without(y_in_plane, g.right));

    const double determinant = dot(g.row_x, cross(g.row_y, g.row_w));
    const Vec3 column_x = scaled(cross(g.row_y, g.row_w), 1 / determinant);
    const Vec3 column_y = scaled(cross(g.row_w, g.row_x), 1 / determinant);
    const Vec3 column_1 = scaled(cross(g.row_x, g.row_y), 1 / determinant);
    g.ray_from_ndc = {column_x[0], column_x[1], column_x[2], column_y[0], column_y[1],
                      column_y[2], column_1[0], column_1[1], column_1[2]};
    if (!std::isfinite(g.pitch) || !finite(column_x) || !finite(column_y) || !finite(column_1)) {
        throw std::invalid_argument("clip_from_view cannot be inverted");
    }
    g.edges = {normalised(added(g.row_w, g.row_x)), normalised(added(g.row_w, g.row_x, -1)),
               normalised(added(g.row_w, g.row_y)), normalised(added(g.row_w, g.row_y, -1))};
    g.axis = ray_of_px(g, g.width_px / 2.0, g.height_px / 2.0);
    for (const double x : {0.0, static_cast<double>(g.width_px)}) {
        for (const double y : {0.0, static_cast<double>(g.height_px)}) {
            const double cosine = std::clamp(dot(g.axis, ray_of_px(g, x, y)), -1.0, 1.0);
            g.cone_rad = std::max(g.cone_rad, std::acos(cosine));
        }
    }
    return g;
}

Tangents pattern_tangents(const ScreenGeometry& g, const Vec3& direction) {
    const Vec3 sum = added(g.forward, direction);
    const double scale = 1 / std::max(1 + dot(g.forward, direction), 1e-6);
    return {added(g.right, sum, -dot(g.right, direction) * scale),
            added(g.up, sum, -dot(g.up, direction) * scale)};
}

bool project_px(const ScreenGeometry& g, const Vec3& direction, std::array<double, 2>& position_px) {
    const double w = dot(g.row_w, direction);
    if (!(w > 1e-9 * length(g.row_w))) return false;
    position_px = {(dot(g.row_x, direction) / w + 1) / 2 * g.width_px,
                   (dot(g.row_y, direction) / w + 1) / 2 * g.height_px};
    return true;
}

std::array<double, 2> pixel_derivative(const ScreenGeometry& g, const Vec3& direction, const Vec3& tangent) {
    const double w = dot(g.row_w, direction);
    const double w_tangent = dot(g.row_w, tangent);
    const auto derivative = [&](const Vec3& row, int size_px) {
        return (dot(row, tangent) - dot(row, direction) / w * w_tangent) / w * size_px / 2;
    };
    return {derivative(g.row_x, g.width_px), derivative(g.row_y, g.height_px)};
}

double pixel_solid_angle_sr(const ScreenGeometry& g, const Vec3& direction) {
    const double cosine = std::max(dot(g.forward, direction), 0.0);
    return g.plane_area_px * cosine * cosine * cosine;
}

Vec3 ray_of_px(const ScreenGeometry& g, double x_px, double y_px) {
    const double x = x_px / g.width_px * 2 - 1;
    const double y = y_px / g.height_px * 2 - 1;
    const auto& m = g.ray_from_ndc;
    return normalised({m[0] * x + m[3] * y + m[6], m[1] * x + m[4] * y + m[7], m[2] * x + m[5] * y + m[8]});
}

double angle_outside_rad(const ScreenGeometry& g, const Vec3& direction) {
    double angle = std::acos(std::clamp(dot(g.axis, direction), -1.0, 1.0)) - g.cone_rad;
    for (const Vec3& edge : g.edges)
        angle = std::max(angle, std::asin(std::clamp(-dot(edge, direction), -1.0, 1.0)));
    return std::max(angle, 0.0);
}

PixelRect cone_bounds_px(const ScreenGeometry& g, const Vec3& direction, double angle_rad, double margin_px) {
    const double sine = angle_rad < std::numbers::pi / 2 ? std::sin(angle_rad) : 1.0;
    const Interval x = cone_interval(g.row_x, g.row_w, direction, sine);
    const Interval y = cone_interval(g.row_y, g.row_w, direction, sine);
    // A cone wholly behind the plane of the eye touches nothing.
    if (dot(g.forward, direction) <= -sine) return {};
    const double most_x = 1 + 2 * margin_px / g.width_px;
    const double most_y = 1 + 2 * margin_px / g.height_px;
    return {(std::max(x.low, -most_x) + 1) / 2 * g.width_px, (std::max(y.low, -most_y) + 1) / 2 * g.height_px,
            (std::min(x.high, most_x) + 1) / 2 * g.width_px,
            (std::min(y.high, most_y) + 1) / 2 * g.height_px};
}

}  // namespace seaglare::glare
