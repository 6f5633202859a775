// The lids: how far they are closed at an instant. A pure function of (seed, absolute time) and the adaptation, so that
// channels agree and a run may be resumed anywhere.
#pragma once

#include <cstdint>

namespace seaglare::glare {

// 0 in every field: the lids stand still, and blinking costs nothing.
struct LidMotion {
    double blink_interval_s = 0;      // mean time between blinks; 0: never. Four seconds are usual
    double blink_duration_s = 0.3;    // from the first to the last movement of the lid
    double squint = 0;                // closure, 0 ... 1, that the lids take before a dazzling luminance
    double squint_half_cd_m2 = 3000;  // adaptation luminance at which half of it is reached
    friend bool operator==(const LidMotion&, const LidMotion&) = default;
};

// What the lids do at an instant, apart: a machine that cannot make a pattern for every frame follows the squint and leaves
// the blink out.
struct LidPose {
    double squint = 0;  // closure, each 0 ... 1
    double blink = 0;
    friend bool operator==(const LidPose&, const LidPose&) = default;
};
LidPose lid_pose(const LidMotion& motion, double adaptation_luminance_cd_m2, double time_s,
                 std::uint64_t seed);

// 0: wide open, 1: shut. Each interval holds one blink, at a place of its own in it: no two overlap, and the mean rate is
// kept. A blink shuts in the first third of its time and opens in the rest, without a corner in its course. A time that is
// not finite counts as 0.
double lid_closure(const LidMotion& motion, double adaptation_luminance_cd_m2, double time_s,
                   std::uint64_t seed);

}  // namespace seaglare::glare
