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
constexpr double speed_per_load = 2;

double change_per_s(double load) {
    const double comfortable = std::log(comfortable_part);
    if (load > 0) return std::min(load * speed_per_load, loss_per_s);
    if (load < comfortable) return -std::min((comfortable - load) * speed_per_load, gain_per_s);
    return 0;
}

bool is_worth_it(const Saving& saving) {
    return saving.part >= needed_part(saving);
}

// Bounds are pessimistic, all of them; what has none goes first.
double ms_per_code(const Saving& saving) {
    return saving.ms / std::max(saving.codes, 1e-3);
}

void move(double& level, double by) {
    level = std::clamp(level + by, 0.0, 1.0);
}

void step(QualityLoss& loss, double change, const QualitySavings& savings) {
    std::size_t goes = quality_kinds, comes = quality_kinds;
    for (std::size_t k = 0; k < quality_kinds; ++k) {
        if (savings[k].part < needed_part(savings[k]) / 2) {
            move(loss.level[k], -gain_per_s * step_s);
            continue;
        }
        const double value = ms_per_code(savings[k]);
        const bool can_go = loss.level[k] < 1 && is_worth_it(savings[k]);
        if (can_go && (goes == quality_kinds || value > ms_per_code(savings[goes]))) goes = k;
        const bool can_come = loss.level[k] > 0;
        if (can_come && (comes == quality_kinds || value < ms_per_code(savings[comes]))) comes = k;
    }
    const std::size_t moved = change > 0 ? goes : comes;
    if (moved < quality_kinds) move(loss.level[moved], change * step_s);
}

}  // namespace

QualityControl advanced(const QualityControl& control, const Budget& budget, double taken_ms,
                        double interval_s, const QualitySavings& savings) {
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
        step(next.loss, change_per_s(next.load), savings);
    }
    return next;
}

double saved_ms(const QualityLoss& loss, const QualitySavings& savings) {
    double ms = 0;
    for (std::size_t k = 0; k < quality_kinds; ++k)
        ms += loss.level[k] * savings[k].ms;
    return ms;
}

double could_save_ms(const QualityLoss& loss, const QualitySavings& savings) {
    double ms = 0;
    for (std::size_t k = 0; k < quality_kinds; ++k)
        if (is_worth_it(savings[k])) ms += (1 - loss.level[k]) * savings[k].ms;
    return ms;
}

}  // namespace seaglare::glare
