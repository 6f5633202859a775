// The eye at an instant: every number that moves, worked out before anything is drawn. A pure function of its arguments,
// and equal for two instants at which the aperture is the same, so that a table made for one serves the other.
#pragma once

#include <cstdint>

#include "glare/eye/eye_model.h"

namespace seaglare::glare {

struct EyeInstant {
    double pupil_mm = 0;
    double time_s = 0;       // of drifting particles; 0 when none drifts
    double lid_closure = 0;  // 0 open ... 1 shut
    double lens_scale = 1;   // of what the lens carries, about the axis
    double vitreous_roll_rad = 0;
    double defocus_dioptre = 0;
    friend bool operator==(const EyeInstant&, const EyeInstant&) = default;
};

// What the eye cannot move stays at rest, whatever it is given. A time that is not finite counts as 0.
EyeInstant eye_instant(const EyeModel& eye, double pupil_mm, double time_s, const LidPose& lids,
                       double vitreous_roll_rad, std::uint64_t seed);

// The phase of an eye out of focus, radians per squared sample from the axis of an n x n plane: pi D / lambda at 575 nm,
// for which the energy table is made. Spread over the spectrum, the blur grows in proportion to the wavelength, which
// diffraction does and defocus does not. Half a dioptre before 7 mm, on pixels of 30 degrees over 2160 lines, errs by 14 % of
// the skirt's luminance (relative L1) against a phase for each wavelength.
double defocus_phase(double dioptre, int n, double plane_width_mm);

}  // namespace seaglare::glare
