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
#include <span>

namespace seaglare::glare {

inline constexpr double kernel_hann_px = 1.5;
inline constexpr double kernel_flat_px = 1 - kernel_hann_px / 2;
inline constexpr double kernel_reach_px = 1 + kernel_hann_px / 2;
// Variance of k in px^2: box 1/3, Hann window of width w w^2 (1/12 - 1/(2 pi^2)).
inline constexpr double kernel_variance_px2 =
    1.0 / 3 + kernel_hann_px * kernel_hann_px * (1.0 / 12 - 0.050660591821168885);

double kernel(double x_px);           // integral 1, maximum 1/2
double kernel_integral(double x_px);  // from minus infinity: 0 ... 1

// A lamp with an apparent disc: nodes in the unit disc whose weights sum to one. Each node carries one kernel, so a disc
// of any size keeps the kernel's sum.
struct DiscNode {
    double x = 0, y = 0, weight = 0;
};
// Seven nodes, exact to fifth order (Stroud 1971, S2 5-1): for discs smaller than the kernel.
std::array<DiscNode, 7> small_disc_nodes();

// Below this apparent radius a lamp is a point, between them nodes, beyond a disc with a soft rim (blended from
// nodes_until_px on).
inline constexpr double point_until_px = 0.03;
inline constexpr double small_nodes_until_px = 0.7;
inline constexpr double nodes_until_px = 2.0;
inline constexpr double disc_from_px = 3.0;

}  // namespace seaglare::glare
