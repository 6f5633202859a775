// The glare pattern as the thesis "Rendering of navigation lights" (2012) computes it, in plain C++: the yardstick for
// speed and error. One complex transform of 512^2 samples; per pixel a sum over 30 wavelengths, each a bilinear look-up in
// the scaled power spectrum (its listings 5.2 and 5.3); per disc layer a sum over all pixels of the disc (listing 5.5).
//
// Mended, because otherwise there would be nothing to compare: its equation 4.9 is inverted and lacks the square that keeps
// each wavelength's energy; its look-up is half a texel off; its area layers are not divided by the disc's area. Kept: hard
// edged discs, spectra sampled at points, a look-up instead of a pixel's integral, 512 samples whatever the screen. Left out:
// the mipmaps of its look-ups, without which blue comes out by a fifth too strong in the middle.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "glare/eye/eye_model.h"

namespace seaglare::report {

// Of the processor, on one thread.
struct ThesisTimes {
    double aperture_ms = 0;
    double transform_ms = 0;
    double spread_ms = 0;  // power, normalisation and chromatic blur
    double discs_ms = 0;
    // What the 2012 table 6.1 covers; its aperture is drawn by OpenGL before.
    double without_aperture_ms() const { return transform_ms + spread_ms + discs_ms; }
};

struct ThesisPattern {
    static constexpr int n = 512;
    static constexpr int wavelengths = 30;
    // Linear sRGB, n x n, the light at (n/2, n/2); one pixel is one sample of the transform at 575 nm. Sums to about 1.
    std::vector<std::array<float, 3>> pixels;
    std::vector<std::vector<std::array<float, 3>>> layers;
    ThesisTimes times;
};

// `disc_radii_px`: of the layers; the thesis has three of 1, 9 and 25 pixels, that is radii 0, 1.5 and 2.5 or so.
ThesisPattern make_thesis_pattern(const glare::EyeModel& eye, double pupil_mm, double plane_width_mm,
                                  std::uint64_t seed, const std::vector<int>& disc_radii_px);

// The unit of all times: milliseconds of the processor for one complex 512^2 transform, single precision, one thread, planned with
// FFTW_MEASURE, in place; the median of many.
double fftw_512_ms();

}  // namespace seaglare::report
