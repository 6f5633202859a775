// The picture's geometry for the frame reference: rays through pixels, solid angles, the directions in which a light's
// pattern stands. Double precision, written from the definitions of a perspective projection and of a least rotation;
// shares no code with glare/apply/screen_geometry.
#pragma once

#include <array>

namespace seaglare::reference {

using Vector = std::array<double, 3>;

inline double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
// a + s b
inline Vector along(const Vector& a, const Vector& b, double s) {
    return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}
double length(const Vector& a);
Vector unit(const Vector& a);

// Pixel (0, 0) is the lower left one; its middle lies at (0.5, 0.5).
class FrameScreen {
  public:
    // clip_from_view: a perspective, column-major. Throws std::invalid_argument when it is not one, or has no pixels.
    FrameScreen(const std::array<double, 16>& clip_from_view, int width_px, int height_px);

    int width_px() const { return width_px_; }
    int height_px() const { return height_px_; }
    // Direction cosine of a pixel on the picture's axis, along the finer axis: 1/f.
    double pitch() const { return pitch_; }

    // A point of the image plane: the ray through it, not normalised; linear in x and y.
    Vector plane_point(double x_px, double y_px) const {
        return along(along(origin_, step_x_, x_px), step_y_, y_px);
    }
    const Vector& step_x() const { return step_x_; }
    Vector ray(double x_px, double y_px) const { return unit(plane_point(x_px, y_px)); }
    // Solid angle of a pixel around a place, in sr: area cos^3 / distance^2 on the image plane.
    double pixel_sr(double x_px, double y_px) const;

    // False when the direction is not ahead.
    bool place_px(const Vector& direction, std::array<double, 2>& place) const;

    // The screen's right and up, turned with the least rotation that takes the view axis to a unit direction.
    struct Tangents {
        Vector u, v;
    };
    Tangents tangents(const Vector& direction) const;

  private:
    int width_px_ = 0;
    int height_px_ = 0;
    double pitch_ = 0;
    Vector origin_{}, step_x_{}, step_y_{};  // of the image plane, per pixel
    Vector forward_{}, right_{}, up_{};
    double plane_distance_ = 1;  // from the eye
    double pixel_area_ = 0;      // on the image plane
    std::array<Vector, 3> rows_{};
};

}  // namespace seaglare::reference
