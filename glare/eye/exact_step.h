// Steps in time that are exact whatever their length: a frame may last 1/240 s or a hitch of 10 s. All are closed-form
// solutions, so two half steps equal one, nothing overshoots that should not, and nothing blows up. A step that is
// negative or NaN changes nothing.
#pragma once

namespace seaglare::glare {

// y' = (goal - y) / time_constant. Monotonic, no overshoot. A time constant that is not positive arrives at once.
double approached(double value, double goal, double step_s, double time_constant_s);

// x'' + 2 damping omega x' + omega^2 (x - goal) = 0: a damped spring.
struct SpringState {
    double position = 0;
    double velocity = 0;  // per second
    friend bool operator==(const SpringState&, const SpringState&) = default;
};

// By the exact 2x2 propagator: underdamped (damping < 1), critical, overdamped, with a series where the roots meet.
// omega_rad_s and damping count as 0 when they are negative or NaN; omega = 0 leaves free motion, which is x + v t.
SpringState sprung(const SpringState& state, double goal, double step_s, double omega_rad_s, double damping);

}  // namespace seaglare::glare
