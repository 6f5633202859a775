// What hangs before the pupil and lets no light through: lids and lashes, as convex quadrangles that anyone can draw, and
// the light they leave. Shared by the OpenCL and the CPU source.
//
// A wave that is plane at the pupil is taken to be plane at the lashes, a centimetre before it: their own diffraction on
// that way is left out.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "glare/eye/eye_instant.h"
#include "glare/eye/eye_model.h"

namespace seaglare::glare {

// Corners in order around it, x and y in turns. In millimetres around the optical axis, y up; or in samples.
struct Quad {
    std::array<float, 8> xy{};
};

// Whether the lids can ever come before a pupil.
bool lids_move(const Lids& lids);

// Height of the lids' margins at x, millimetres above the axis, at a closure.
double upper_margin_mm(const Lids& lids, double closure, double x_mm);
double lower_margin_mm(const Lids& lids, double closure, double x_mm);

// The lids and lashes of an eye. Lashes hang from the upper margin and move with it.
class Veil {
  public:
    Veil(const EyeModel& eye, std::uint64_t seed);

    // What covers part of the pupil at this instant, in millimetres, replacing `quads`; empty when nothing does. The
    // quadrangles of one lash or lid do not overlap; lashes may cross lashes and lids.
    void place(const EyeInstant& instant, std::vector<Quad>& quads) const;
    // The most quadrangles that place() can give.
    std::size_t capacity() const;

  private:
    struct Lash {
        double root_mm = 0;  // along the margin
        double angle_rad = 0;
        double curvature_per_mm = 0;
    };
    Lids lids_;
    double width_mm_ = 0;
    double length_mm_ = 0;
    std::vector<Lash> lashes_;
};

// The fraction of the light on the open pupil that passes the eye, lids and lashes at this instant: exact along each of
// many lines. transmitted_fraction() when nothing hangs before the pupil and the lens is at rest.
double transmitted_fraction(const EyeModel& eye, const EyeInstant& instant, const std::vector<Quad>& veil);

// Millimetres about the axis to samples of an n x n plane.
void to_samples(std::vector<Quad>& quads, int n, double plane_width_mm);

}  // namespace seaglare::glare
