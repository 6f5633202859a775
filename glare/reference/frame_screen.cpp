#include "glare/reference/frame_screen.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace seaglare::reference {

double length(const Vector& a) {
    return std::sqrt(dot(a, a));
}

Vector unit(const Vector& a) {
    const double l = length(a);
    return {a[0] / l, a[1] / l, a[2] / l};
}

FrameScreen::FrameScreen(const std::array<double, 16>& clip_from_view, int width_px, int height_px)
    : width_px_(width_px), height_px_(height_px) {
    if (width_px < 1 || height_px < 1) throw std::invalid_argument("frame reference: no pixels");
    const auto row = [&](std::size_t r) {
        return Vector{clip_from_view[r], clip_from_view[4 + r], clip_from_view[8 + r]};
    };
    rows_ = {row(0), row(1), row(3)};
    // Columns of the inverse: p = A^-1 (x, y, 1) has clip coordinates x, y and w = 1.
    const double determinant = dot(rows_[0], cross(rows_[1], rows_[2]));
    if (!std::isfinite(determinant) || determinant == 0)
        throw std::invalid_argument("frame reference: the projection cannot be inverted");
    const auto column = [&](const Vector& a, const Vector& b) {
        const Vector c = cross(a, b);
        return Vector{c[0] / determinant, c[1] / determinant, c[2] / determinant};
    };
    const Vector of_x = column(rows_[1], rows_[2]);
    const Vector of_y = column(rows_[2], rows_[0]);
    const Vector of_w = column(rows_[0], rows_[1]);
    step_x_ = along({}, of_x, 2.0 / width_px);
    step_y_ = along({}, of_y, 2.0 / height_px);
    origin_ = along(along(of_w, of_x, -1), of_y, -1);

    const Vector normal = cross(step_x_, step_y_);
    pixel_area_ = length(normal);
    forward_ = unit(normal);
    if (dot(forward_, of_w) < 0) forward_ = along({}, forward_, -1);
    plane_distance_ = dot(forward_, of_w);
    if (!(pixel_area_ > 0) || !(plane_distance_ > 0))
        throw std::invalid_argument("frame reference: not a perspective projection");
    pitch_ = std::min(length(step_x_), length(step_y_)) / plane_distance_;
    right_ = unit(step_x_);
    up_ = unit(along(step_y_, right_, -dot(step_y_, right_)));
}

double FrameScreen::pixel_sr(double x_px, double y_px) const {
    const Vector p = plane_point(x_px, y_px);
    return pixel_area_ * plane_distance_ / std::pow(dot(p, p), 1.5);
}

bool FrameScreen::place_px(const Vector& direction, std::array<double, 2>& place) const {
    const double w = dot(rows_[2], direction);
    if (!(w > 1e-9 * length(rows_[2]))) return false;
    place = {(dot(rows_[0], direction) / w + 1) * width_px_ / 2,
             (dot(rows_[1], direction) / w + 1) * height_px_ / 2};
    return true;
}

FrameScreen::Tangents FrameScreen::tangents(const Vector& direction) const {
    // Rodrigues' formula about forward x direction, whose length is the sine.
    const Vector axis = cross(forward_, direction);
    const double cosine = dot(forward_, direction);
    const double share = 1 / std::max(1 + cosine, 1e-6);
    const auto turned = [&](const Vector& a) {
        const Vector scaled = along({}, a, cosine);
        return along(along(scaled, cross(axis, a), 1), axis, dot(axis, a) * share);
    };
    return {turned(right_), turned(up_)};
}

}  // namespace seaglare::reference
