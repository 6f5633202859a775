// Keeps a frame under its time budget by giving up quality, and takes it back when there is time. Pure functions of the
// measured times: the same load gives the same quality at any frame rate.
#pragma once

#include "glare/plan/budget.h"

namespace seaglare::glare {

// What is given up, in this order and each gradually (plan.cpp): up to 0.5 the error budget grows from max_error_codes to
// most_error_codes; from 0.3 to 0.8 the discs of near lamps leave their skirts, and their layers the pattern; from 0.5 on
// the patterns of coloured lamps go over to the white one.
struct QualityControl {
    double loss = 0;    // 0: nothing, 1: everything
    double load = 0;    // ln(time taken / time allowed), smoothed
    double rest_s = 0;  // of the last frame, less than a step
    friend bool operator==(const QualityControl&, const QualityControl&) = default;
};

// No faster than this, per second: nothing that is given up is seen to go. At 60 frames a second a step changes no pixel by more
// than 1.5 codes of random scenes (tests/gl/plan_omissions_test.cpp), and of the shipped ones none by more than 0.5
// (tests/accuracy/host_quality_steps_test.cpp).
inline constexpr double loss_per_s = 0.25;
inline constexpr double gain_per_s = 0.1;
// Quality comes back when a frame takes less than this part of its budget; in between it stands.
inline constexpr double comfortable_part = 0.75;

// A frame took `taken_ms`; the next one comes `interval_s` after it. Without a time budget everything is given back at once.
// A time that is not finite or negative counts as none.
QualityControl advanced(const QualityControl& control, const Budget& budget, double taken_ms,
                        double interval_s);

}  // namespace seaglare::glare
