// What lids and lashes make of a pattern besides the picture of the aperture. Shared by the sources.
#pragma once

#include "glare/eye/eye_model.h"
#include "glare/psf/pattern.h"

namespace seaglare::glare {

// `transmitted` is the fraction of the light on the open pupil that this instant's aperture passes, lids and lashes
// included. Scales the tail and tells the picture of lashes. Returns what core + skirt are to be multiplied by.
inline double describe_veil(const EyeModel& eye, double pupil_mm, double transmitted, Pattern& pattern) {
    constexpr double rad_per_deg = 0.017453292519943295;
    const double unveiled = transmitted_fraction(eye, pupil_mm);
    const double share = unveiled > 0 ? transmitted / unveiled : 0;
    pattern.tail_scale *= share;
    const bool lashes = eye.eyelashes.count > 0;
    pattern.lash_turn_rad = lashes ? eye.eyelashes.streak_turn_deg * rad_per_deg : 0;
    pattern.lash_bend_per_rad = lashes ? eye.eyelashes.streak_bend_per_rad : 0;
    return share;
}

}  // namespace seaglare::glare
