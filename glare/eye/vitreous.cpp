#include "glare/eye/vitreous.h"

#include <cmath>

namespace seaglare::glare {

namespace {

using Quaternion = std::array<double, 4>;

Quaternion product(const Quaternion& a, const Quaternion& b) {
    return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
            a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
            a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
            a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

Quaternion renormalised(const Quaternion& q) {
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 0) || !std::isfinite(length)) return {0, 0, 0, 1};
    return {q[0] / length, q[1] / length, q[2] / length, q[3] / length};
}

double finite_or_zero(double value) {
    return std::isfinite(value) ? value : 0;
}

}  // namespace

VitreousState turned(const VitreousState& state, const std::array<double, 3>& head_rad_s, double drag_per_s,
                     double step_s) {
    VitreousState result = state;
    if (!(step_s >= 0) || !std::isfinite(step_s)) return result;
    double rate = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double head = finite_or_zero(head_rad_s[i]);
        result.spin_rad_s[i] =
            finite_or_zero(state.spin_rad_s[i]) - (head - finite_or_zero(state.head_rad_s[i]));
        result.head_rad_s[i] = head;
        rate = std::hypot(rate, result.spin_rad_s[i]);
    }
    const bool drags = drag_per_s > 0;
    const double seconds = drags ? -std::expm1(-drag_per_s * step_s) / drag_per_s : step_s;
    const double angle = rate * seconds;
    if (angle > 0 && std::isfinite(angle)) {
        const double per_rate = std::sin(angle / 2) / rate;
        const Quaternion turn = {result.spin_rad_s[0] * per_rate, result.spin_rad_s[1] * per_rate,
                                 result.spin_rad_s[2] * per_rate, std::cos(angle / 2)};
        result.orientation = renormalised(product(turn, state.orientation));
    } else {
        result.orientation = renormalised(state.orientation);
    }
    const double left = drags ? std::exp(-drag_per_s * step_s) : 1;
    for (double& spin : result.spin_rad_s)
        spin *= left;
    return result;
}

double roll_about_sight_rad(const VitreousState& state) {
    // Twist of the swing-twist decomposition about z.
    return 2 * std::atan2(state.orientation[2], state.orientation[3]);
}

}  // namespace seaglare::glare
