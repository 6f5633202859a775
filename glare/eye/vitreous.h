// The cloud of particles in the vitreous body: it lags behind the turning head and comes to rest in it. Host-driven, so it
// accumulates: a small state that can be read and set.
#pragma once

#include <array>

namespace seaglare::glare {

struct VitreousState {
    std::array<double, 4> orientation{0, 0, 0, 1};  // quaternion x y z w: head from cloud
    std::array<double, 3> spin_rad_s{};             // of the cloud relative to the head, in the head's axes
    std::array<double, 3> head_rad_s{};             // the head's rate that the last step was given
    friend bool operator==(const VitreousState&, const VitreousState&) = default;
};

// One step with a head that turns at `head_rad_s` (axes: x right, y up, z towards the back of the head). A change of the
// head's rate leaves the cloud behind: its spin takes the opposite jump, and then dies away as w' = -drag w. The axis of
// that spin stands still in the head, so the turn is one exponential map by |w| (1 - exp(-drag t)) / drag: exact, and two
// half steps equal one. The quaternion is renormalised. Rates that are not finite count as 0; drag_per_s <= 0 is free spin.
VitreousState turned(const VitreousState& state, const std::array<double, 3>& head_rad_s, double drag_per_s,
                     double step_s);

// The angle by which the cloud stands turned about the line of sight, the one that moves the pattern: radians.
double roll_about_sight_rad(const VitreousState& state);

}  // namespace seaglare::glare
