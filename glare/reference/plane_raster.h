// The pupil's amplitude as numbers, for the reference: exact along every line, and filtered so that what lies beyond the
// grid's band does not fold back into it. Shares the eye's geometry with glare/eye, and no way of drawing it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "glare/eye/eye_instant.h"
#include "glare/eye/eye_model.h"

namespace seaglare::reference {

struct Circle {
    double x_mm = 0;
    double y_mm = 0;
    double radius_mm = 0;
};

// A convex quadrangle that lets no light through: a part of a lash or a lid. Corners in order around it, x and y in turns.
using Blind = std::array<double, 8>;

// The aperture as geometry: P = pupil * (1 - 2 particles) * (1 - depth * gratings) * (1 - blinds), where particles and
// blinds are one union each.
struct Aperture {
    double pupil_mm = 0;  // diameter
    std::vector<Circle> particles;
    glare::LensGratings gratings;
    std::vector<Blind> blinds_mm;
};

// The eye's parts, lids and lashes at an instant, where the seed puts them. Throws std::invalid_argument for an eye out of
// focus: its aperture is not real, and this reference takes it to be.
Aperture aperture_of(const glare::EyeModel& eye, const glare::EyeInstant& instant, std::uint64_t seed);
// With open lids and a head at rest.
Aperture aperture_of(const glare::EyeModel& eye, double pupil_mm, double time_s, std::uint64_t seed);

// The interpolation kernel that stands for a sample: a Kaiser-Bessel window six samples wide of unit integral (Jackson et
// al. 1991, "Selection of a convolution function for Fourier inversion using gridding"). With beta = 13 what folds back
// into frequencies below 0.3 per sample is weaker by five orders of magnitude.
class GriddingKernel {
  public:
    static constexpr double half_width = 3;  // samples
    GriddingKernel();
    double at(double x) const;
    // Its integral from minus infinity to x.
    double integral(double x) const;
    // Its Fourier transform at a frequency in cycles per sample; 1 at 0.
    double transform(double frequency) const;

  private:
    std::vector<double> integral_;
    double scale_ = 1;
};

// n x n samples, rows `stride` doubles apart; sample j stands at (j - n/2) * spacing_mm. Lines at an eighth of the spacing
// are intersected with every edge of the aperture and integrated exactly against the kernel.
void draw_aperture(const Aperture& aperture, int n, double spacing_mm, const GriddingKernel& kernel,
                   double* samples, std::size_t stride);

// What the aperture passes of the light on an open pupil: the mean square amplitude over its area, by the same lines.
double transmitted(const Aperture& aperture, double line_spacing_mm);

}  // namespace seaglare::reference
