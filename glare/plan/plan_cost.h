// What a way of adding lights up would cost, from the summary alone. Pure; the plan compares these.
#pragma once

#include "glare/apply/glare_bound.h"
#include "glare/plan/plan.h"

namespace seaglare::glare {

// What all billboards of a frame cover; overlapping ones count each.
struct CoveredArea {
    double core_px = 0;
    double skirt_px = 0;
    double tail_cells = 0;
    double composite_px = 0;  // of the picture, at least once
};
CoveredArea covered_area(const PlanInput& input, const AccumulationPlan& accumulation,
                         const GlareBound& bound);

double accumulation_ms(const PlanInput& input, const CoveredArea& area, const AccumulationPlan& accumulation,
                       const DeviceCosts& costs);
// Of a pattern made anew, for so many lamps and layers.
double pattern_ms(const PlanInput& input, int lamps, int layers, const DeviceCosts& costs);

// Lights that one draw call takes (apply/light_buffer.h).
inline constexpr double lights_per_draw = 8192;

}  // namespace seaglare::glare
