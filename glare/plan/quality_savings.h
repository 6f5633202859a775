// What giving something up buys: the planner is asked what the frame costs with it and without. Pure functions.
#pragma once

#include <array>

#include "glare/plan/plan.h"
#include "glare/plan/quality.h"

namespace seaglare::glare {

// Giving up all of one kind, the others being as they are, against giving up none of it.
struct Saving {
    double ms = 0;     // predicted, of a frame
    double part = 0;   // of what the frame takes without giving it up
    double codes = 0;  // by which the error bound grows
    friend bool operator==(const Saving&, const Saving&) = default;
};
using QualitySavings = std::array<Saving, quality_kinds>;

// What saves less than this part of a frame's time is not given up: nobody sees the time, somebody may see the loss. Costs are
// not known better, either.
inline constexpr double least_saving_part = 0.03;
// And so much more for each code that the bound grows by: what may show must buy more.
inline constexpr double least_part_per_code = 0.001;
// Of the pattern's making, beside the frames on the same two cores or the same GPU, so much is time that frames lack.
inline constexpr double pattern_beside_part = 0.5;

constexpr double needed_part(const Saving& saving) {
    return least_saving_part + least_part_per_code * saving.codes;
}

// What counts of a frame's predicted time where savings are compared.
double counted_ms(const Plan& plan);

Saving saving_of(Quality kind, const PlanInput& input, const Budget& budget, const DeviceCosts& costs);

}  // namespace seaglare::glare
