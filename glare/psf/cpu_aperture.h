// The aperture and its power spectrum in plain C++, double where it sums: for machines without OpenCL, and as the second
// implementation that the first is held against.
#pragma once

#include <vector>

#include "glare/eye/aperture.h"

namespace seaglare::glare {

// n x n samples, row-major. Particles and gratings of the eye at time 0; the pupil is left out: 1 where all is clear.
std::vector<float> draw_eye_parts(const ApertureParts& parts, int n, double plane_width_mm);

// The coverage of each sample by a pupil around the axis.
std::vector<float> draw_pupil(int n, double radius_samples);

// Takes from each sample what lids and lashes, in samples, cover of it.
void cover(std::vector<float>& amplitude, int n, const std::vector<Quad>& veil);

// Energy of the diffraction pattern over frequencies -n/2 ... n/2 on both axes as a table of sums over everything below
// and left of an edge: (n + 2)^2 entries, edge i at frequency i - n/2 - 1/2. The highest frequency is shared by both
// ends. In units of the light on the open pupil; the sample's box is taken out.
class EnergySums {
  public:
    EnergySums(const std::vector<float>& amplitude, int n, double pupil_radius_samples);
    // Of amplitude * exp(i phase_per_square r^2): an eye out of focus. Its pattern has no symmetry: box(a, b, c, d) and
    // box(-b, -a, -d, -c) differ.
    EnergySums(const std::vector<float>& amplitude, int n, double pupil_radius_samples,
               double phase_per_square);
    // Energy in a box of frequencies, in samples; zero outside the transform's field.
    double box(double x0, double x1, double y0, double y1) const;

  private:
    // power(kx, ky) for -n/2 <= kx, ky <= n/2.
    template <typename Power>
    void sum_up(double pupil_radius_samples, Power power);
    double at(double x, double y) const;
    int n_;
    std::vector<double> sums_;
};

}  // namespace seaglare::glare
