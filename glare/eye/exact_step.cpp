#include "glare/eye/exact_step.h"

#include <algorithm>
#include <cmath>

namespace seaglare::glare {

namespace {

// What y and its derivative are made of: exp(-decay t) times a cosine-like and a sine-like part, in the three regimes.
struct Propagator {
    double c = 1;
    double s = 0;  // seconds
};

Propagator propagator(double step_s, double omega, double damping) {
    const double decay = damping * omega;
    const double q = (1 - damping) * (1 + damping) * omega * omega * step_s * step_s;
    if (std::abs(q) <
        1e-2) {  // the roots nearly meet: sine and cosine by their series in q; the rest is below 1e-13
        const double faded = std::exp(-decay * step_s);
        return {faded * (1 - q / 2 * (1 - q / 12 * (1 - q / 30 * (1 - q / 56)))),
                faded * step_s * (1 - q / 6 * (1 - q / 20 * (1 - q / 42 * (1 - q / 72))))};
    }
    if (q > 0) {
        const double faded = std::exp(-decay * step_s);
        const double omega_d = omega * std::sqrt((1 - damping) * (1 + damping));
        return {faded * std::cos(omega_d * step_s), faded * std::sin(omega_d * step_s) / omega_d};
    }
    // Two real roots. The slow one as omega^2 / fast: the difference decay - omega_d would cancel.
    const double omega_d = omega * std::sqrt((damping - 1) * (damping + 1));
    const double fast = decay + omega_d;
    const double slow = omega / fast * omega;
    const double slowly = std::exp(-slow * step_s);
    const double quickly = std::exp(-fast * step_s);
    return {(slowly + quickly) / 2, (slowly - quickly) / (2 * omega_d)};
}

}  // namespace

double approached(double value, double goal, double step_s, double time_constant_s) {
    if (!(step_s > 0)) return value;
    if (!(time_constant_s > 0)) return goal;
    const double share = -std::expm1(-step_s / time_constant_s);
    const double result = value + (goal - value) * share;
    return std::clamp(result, std::min(value, goal), std::max(value, goal));  // rounding does not overshoot
}

SpringState sprung(const SpringState& state, double goal, double step_s, double omega_rad_s, double damping) {
    if (!(step_s > 0)) return state;
    const double omega = omega_rad_s > 0 ? std::min(omega_rad_s, 1e9) : 0;  // what comes out stays finite
    if (omega == 0) return {state.position + state.velocity * step_s, state.velocity};
    const double zeta = damping > 0 ? std::min(damping, 1e6) : 0;
    const Propagator p = propagator(step_s, omega, zeta);
    const double offset = state.position - goal;
    const double decay = zeta * omega;
    return {goal + offset * (p.c + decay * p.s) + state.velocity * p.s,
            state.velocity * (p.c - decay * p.s) - offset * omega * omega * p.s};
}

}  // namespace seaglare::glare
