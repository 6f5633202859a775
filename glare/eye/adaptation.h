// How the eye follows the luminance around it: quickly by its neural gain, slowly by the bleaching of its pigments. What
// accumulates is a small state that can be read and set.
#pragma once

namespace seaglare::glare {

// The share of rods in vision at a luminance in cd/m2: 0.04 / (0.04 + L) (Pattanaik et al. 2000, as physics notes have it).
// 1 for a luminance that is not positive.
double rod_share(double luminance_cd_m2);

// The luminance the eye is adapted to after `step_s` before a goal that stands still: exponential, with the time constant
// of the goal's own mixture of rods (0.4 s) and cones (0.1 s), so that two half steps equal one. cd/m2; a goal that is not
// finite changes nothing, a negative one counts as 0.
double light_adapted_cd_m2(double adapted_cd_m2, double goal_cd_m2, double step_s);

// Unbleached share of the pigments, 0 ... 1.
struct Pigments {
    double rod = 1;
    double cone = 1;
    friend bool operator==(const Pigments&, const Pigments&) = default;
};

// Bleaching and regeneration before a luminance that stands still over the step: B' = (1 - B)/T - G B / P, exact. The
// rods' time constant runs from 400 s in the dark to 16 us at 1e6 cd/m2. Constants as Pattanaik et al. 2000 are used
// elsewhere: T 400 s and 110 s, P 16 and 2.2e8 cd s/m2. With them 5 ms at 1e4 cd/m2 leave a twentieth of the rods' pigment:
// a trial for integrators more than a model of a mariner, so nothing on screen hangs on it yet.
Pigments bleached(const Pigments& pigments, double luminance_cd_m2, double step_s);

// Where the pigments come to rest: 0.04/(0.04 + G) and 2e6/(2e6 + G).
Pigments pigments_at_rest(double luminance_cd_m2);

}  // namespace seaglare::glare
