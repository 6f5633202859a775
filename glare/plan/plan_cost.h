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
// `least_cd_m2`: what the last pass leaves as it is (apply/lit_tiles.h); 0: nothing that a light reaches.
CoveredArea covered_area(const PlanInput& input, const AccumulationPlan& accumulation,
                         const GlareBound& bound, double structure_cd_m2, double least_cd_m2 = 0);

double accumulation_ms(const PlanInput& input, const CoveredArea& area, const AccumulationPlan& accumulation,
                       const DeviceCosts& costs);
// What the eye's motion costs: patterns that are made and mixed beside the frames, and taken by frames.
struct PatternWork {
    double made_ms = 0;   // of one that is made anew
    double mixed_ms = 0;  // of one mixed from two of them
    double taken_ms = 0;  // in the frame that takes one
    double made_per_frame = 0;
    double taken_per_frame = 0;
};
// For so many lamps and layers. `step_s`: it follows the eye in such steps, 0: with every frame.
PatternWork pattern_work(const PlanInput& input, int lamps, int layers, double step_s,
                         const DeviceCosts& costs);

// Sums of lights below this change no code of a target, and their tiles are not drawn.
inline constexpr double least_composited_codes = 0.25;

// Lights that one draw call takes (apply/light_buffer.h).
inline constexpr double lights_per_draw = 8192;

}  // namespace seaglare::glare
