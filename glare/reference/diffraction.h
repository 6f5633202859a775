// Diffraction at an aperture, one wavelength at a time, without the scaling that production uses: the power spectrum
// |F(s/lambda)|^2 is evaluated at each wavelength's own frequencies, and integrated exactly over square pixels.
//
// How: by the Wiener-Khinchin theorem |F|^2 is the transform of the aperture's autocorrelation C, which ends at one pupil
// diameter. So a transform over two diameters loses nothing, and
//     energy of the pixel at s = (1/A) (p/lambda)^2 sum over r of C(r) sinc(p x/lambda) sinc(p y/lambda) cos(2 pi r s/lambda) h^2
// with p the pixel's width in direction cosines, A the open pupil's area, h the spacing of the samples, is the pixel's
// exact integral for any wavelength, without interpolation.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "glare/reference/plane_raster.h"

namespace seaglare::reference {

// (2R+1)^2 values, rows from -v to +v; energy per pixel as a fraction of the light on the open pupil.
using Plane = std::vector<double>;

class Diffraction {
  public:
    // `widest_frequency_per_mm`: the highest sin(theta)/lambda that will be asked for; decides the spacing. Uses FFTW in
    // double precision; not to be constructed in two threads at once (FFTW's planner).
    Diffraction(const Aperture& aperture, double widest_frequency_per_mm);

    // The pattern of one wavelength on (2 radius + 1)^2 pixels, `pitch` apart and as wide. Throws std::invalid_argument
    // when it reaches beyond the widest frequency.
    Plane pattern(double wavelength_nm, double pitch, int radius) const;

    int samples() const { return n_; }
    double spacing_mm() const { return spacing_mm_; }

  private:
    int n_ = 0;
    double spacing_mm_ = 0;
    double widest_per_mm_ = 0;
    int side_ = 0;              // of the quadrant: lags 0 ... side_ - 1
    std::vector<double> even_;  // C(x, y) + C(-x, y), weighted for the sum over all lags
    std::vector<double> odd_;   // C(x, y) - C(-x, y)
    double scale_ = 0;
};

}  // namespace seaglare::reference
