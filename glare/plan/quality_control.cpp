#include "glare/plan/quality_control.h"

#include <algorithm>
#include <cmath>

namespace seaglare::glare {

namespace {

constexpr double step_s = 1.0 / 240;
constexpr double longest_interval_s = 0.25;  // a hitch says little about the frames after it
constexpr double smoothing_s = 0.2;
constexpr double largest_load = 2;  // e^2 times the budget
// Within the band in which quality stands; outside it changes the faster the farther, up to the limits.
constexpr double speed_per_load = 1;

double change_per_s(double load) {
    const double comfortable = std::log(comfortable_part);
    if (load > 0) return std::min(load * speed_per_load, loss_per_s);
    if (load < comfortable) return -std::min((comfortable - load) * speed_per_load, gain_per_s);
    return 0;
}

}  // namespace

QualityControl advanced(const QualityControl& control, const Budget& budget, double taken_ms,
                        double interval_s) {
    if (!(budget.time_ms > 0)) return {};
    QualityControl next = control;
    if (!std::isfinite(interval_s) || interval_s < 0) return next;
    double load = -largest_load;
    if (std::isfinite(taken_ms) && taken_ms > 0)
        load = std::clamp(std::log(taken_ms / budget.time_ms), -largest_load, largest_load);
    const double part = -std::expm1(-step_s / smoothing_s);
    next.rest_s += std::min(interval_s, longest_interval_s);
    // Steps of a fixed length make frame rates agree.
    while (next.rest_s >= step_s) {
        next.rest_s -= step_s;
        next.load += (load - next.load) * part;
        next.loss = std::clamp(next.loss + change_per_s(next.load) * step_s, 0.0, 1.0);
    }
    return next;
}

}  // namespace seaglare::glare
