// How the core of a light is spread over pixels, so that it does not flicker as it moves under the grid.
//
// The kernel is separable, k(x) k(y) in pixels: a box two pixels wide convolved with a Hann window 1.5 pixels wide. Its
// integer translates sum to one, so that the sum is the same at every sub-pixel position; it is flat for |x| <= 1/4 and
// has lost 2.9 % at 1/2, so that the brightest pixel varies by 5.7 % at most; it is zero beyond 1.75. A window of one
// pixel has a peak that never varies, but after a tone curve that clips, the light shown varies more: by up to 125 %
// against 75 % here, worst case over all brightnesses, of a core without skirt.
// It lives in pixels and not in angles because only then do both hold away from the centre of the picture; each pixel
// is divided by its own solid angle, which makes energy exact everywhere.
#pragma once

#include <array>

namespace seaglare::glare {

inline constexpr double kernel_hann_px = 1.5;
inline constexpr double kernel_flat_px = 1 - kernel_hann_px / 2;
inline constexpr double kernel_reach_px = 1 + kernel_hann_px / 2;
// Variance of k in px^2: box 1/3, Hann window of width w w^2 (1/12 - 1/(2 pi^2)).
inline constexpr double kernel_variance_px2 =
    1.0 / 3 + kernel_hann_px * kernel_hann_px * (1.0 / 12 - 0.050660591821168885);

double kernel(double x_px);           // integral 1, maximum 1/2
double kernel_integral(double x_px);  // from minus infinity: 0 ... 1

// A lamp with an apparent disc has the disc convolved with k. Between a point and a disc of 1.8 px that alone would have a
// round top, whose brightest pixel varies by up to 40 % (at 1 px): so a smaller disc is drawn as a point and a disc of
// 1.8 px, in the proportion that keeps the energy and the second moment, that is the apparent size. Both parts are flat
// enough (5.9 and 6.8 %), so every mixture is; its peak is at most 15 % above the true disc's.
// A disc of less than a tenth of a pixel is a point: it would send 0.3 % of its light as far as 3.5 px, which the true disc
// does not, and which beside the skirt there would show by 2.5 codes. Its disc comes in between the next two: a light
// that draws near must not jump by so much.
inline constexpr double point_until_px = 0.09;
inline constexpr double mixed_from_px = 0.11;
inline constexpr double smallest_disc_px = 1.8;
// From here on it is a disc with a soft rim instead, blended in between: the same but for 0.1 %, and cheap at any size.
inline constexpr double rows_until_px = 3.0;
inline constexpr double disc_from_px = 4.0;

// Of the light of a disc of this apparent radius, what is drawn as a disc; the rest is a point.
double disc_share(double radius_px);

// The unit disc as chords of equal height: row i lies at +-height and is 2 half_width wide, and carries the light
// evenly. Chebyshev quadrature of the second kind: energy and second moments are exact, and as each chord is convolved
// with k exactly along itself, its integer translates sum to one, too.
struct DiscRow {
    double height = 0, half_width = 0, weight = 0;
};
std::array<DiscRow, 12> disc_rows();

// Share of a light's core that falls into the pixel whose centre lies (x, y) px from the light's. `px_from_disc`: columns,
// pixels per disc radius along two perpendicular tangents; radius_px: the apparent radius, sqrt(|det px_from_disc|). Up to
// disc_from_px; sums to one over pixels at every sub-pixel position.
double core_weight(double x_px, double y_px, const std::array<double, 4>& px_from_disc, double radius_px);

}  // namespace seaglare::glare
