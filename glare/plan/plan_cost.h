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
    double gather_px = 0;     // in which a gather sums a light's structure
    double composite_px = 0;  // of the picture, at least once
};
// `structure_cd_m2`: what all lights together may lose of their structure in a gather; 0: each its skirt_threshold_cd_m2.
CoveredArea covered_area(const PlanInput& input, const AccumulationPlan& accumulation,
                         const GlareBound& bound, double structure_cd_m2);

double accumulation_ms(const PlanInput& input, const CoveredArea& area, const AccumulationPlan& accumulation,
                       const DeviceCosts& costs);
// Of a pattern made anew, for so many lamps and layers: while it is made, beside the frames, and in the frame that takes it.
double pattern_upload_ms(const PlanInput& input, int lamps, int layers, const DeviceCosts& costs);
double pattern_ms(const PlanInput& input, int lamps, int layers, const DeviceCosts& costs);

// Lights that one draw call takes (apply/light_buffer.h).
inline constexpr double lights_per_draw = 8192;

}  // namespace seaglare::glare
