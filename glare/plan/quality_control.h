// Keeps a frame under its time budget by giving up quality, and takes it back when there is time. Pure functions of the
// measured times and of what each step is predicted to save: the same load gives the same quality at any frame rate.
#pragma once

#include "glare/plan/budget.h"
#include "glare/plan/quality.h"
#include "glare/plan/quality_savings.h"

namespace seaglare::glare {

// One kind goes after the other, first what saves most time for a code of error; what saves less than needed_part() of the
// frame does not go at all, and comes back, however short time is, once it saves less than half of that.
struct QualityControl {
    QualityLoss loss;
    double load = 0;    // ln(time taken / time allowed), smoothed
    double rest_s = 0;  // of the last frame, less than a step
    friend bool operator==(const QualityControl&, const QualityControl&) = default;
};

// No faster than this, of a kind per second: nothing that is given up is seen to go. At 60 frames a second a step changes no
// pixel by more than 1.5 codes of random scenes (tests/gl/plan_omissions_test.cpp), and of the shipped ones none by more than
// 0.5 (tests/accuracy/host_quality_steps_test.cpp).
inline constexpr double loss_per_s = 0.5;
inline constexpr double gain_per_s = 0.2;
// Quality comes back when a frame takes less than this part of its budget; in between it stands.
inline constexpr double comfortable_part = 0.75;

// A frame took `taken_ms`; the next one comes `interval_s` after it. Without a time budget everything is given back at once.
// A time that is not finite or negative counts as none.
QualityControl advanced(const QualityControl& control, const Budget& budget, double taken_ms,
                        double interval_s, const QualitySavings& savings);

// Predicted, ms of a frame: what is saved by what is given up, and what could still be saved by all that is worth giving up.
// 0 of the latter while frames take longer than their budget: it cannot be kept.
double saved_ms(const QualityLoss& loss, const QualitySavings& savings);
double could_save_ms(const QualityLoss& loss, const QualitySavings& savings);

}  // namespace seaglare::glare
