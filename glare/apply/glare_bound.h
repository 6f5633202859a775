// How far a light's glare matters: the CIE curve, an upper bound of any pattern made from it, and the bound's inverse.
#pragma once

#include <array>

namespace seaglare::glare {

// A pattern's needles, rings and corona stand above the curve. Four times covers what the simulated eyes show (the
// halo ring 2.9 times the curve, single needles less).
inline constexpr double structure_headroom = 4;

class GlareBound {
  public:
    // angular_scale magnifies the pattern: psf(angle/s)/s^2.
    GlareBound(double age_years, double pigmentation, double angular_scale = 1);
    // Upper bound of the point spread function at an angle, sr^-1. Never rises with the angle.
    double psf_sr(double angle_rad) const;
    // The smallest angle beyond which the bound stays below psf_sr; at most 90 degrees. Rounded outwards.
    double reach_rad(double psf_sr) const;

  private:
    static constexpr int samples = 192;
    static double angle_of(double sample);  // 1e-5 rad ... pi/2, evenly in the logarithm
    std::array<double, samples> log_psf_{};
};

}  // namespace seaglare::glare
