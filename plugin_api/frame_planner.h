// Plans the frames of one view: sums its lights up, makes the plan, compares what frames took with what was predicted, and
// keeps to a time budget. The decisions themselves are glare/plan's, pure functions.
#pragma once

#include <cstdint>
#include <span>

#include "glare/plan/plan.h"
#include "glare/plan/quality_control.h"
#include "plugin_api/settings.h"

namespace seaglare::plugin {

// What frames took, in ms; GPU times are of an earlier frame, 0 while there are none.
struct FrameTimes {
    double evaluate_ms = 0;
    double upload_ms = 0;
    double occlusion_ms = 0;
    double accumulate_ms = 0;
    double composite_ms = 0;
    double render_ms = 0;  // the whole call, on the CPU
    double gpu_occlusion_ms = 0;
    double gpu_accumulate_ms = 0;
    double gpu_composite_ms = 0;
    double gpu_ms = 0;
    bool has_gpu = false;
};

class FramePlanner {
  public:
    // Costs that a new view was measured to have (calibrate.h).
    void begin_with(const glare::DeviceCosts& measured) { costs_ = measured; }

    // What a time budget gives up in the next frame.
    double quality_loss() const { return control_.loss; }

    // Fills in what is known here: lights, the pattern's grid and motion, the tail, quality. The plan stays until the next
    // call.
    const glare::Plan& make(const PlanSettings& settings, double resting_pupil_mm, glare::PlanInput& input,
                            std::span<const glare::PointSource> sources);
    const glare::Plan& plan() const { return plan_; }

    // The frame just planned has taken this; the next follows after interval_s.
    void took(const PlanSettings& settings, const FrameTimes& times, double interval_s);
    // What a frame was counted as having taken: with pinned costs what was predicted, so that channels agree; else the
    // longer of the CPU's and the GPU's time.
    double taken_ms() const { return taken_ms_; }
    const glare::DeviceCosts& costs() const { return costs_; }

  private:
    void learn_from(const FrameTimes& times);

    glare::DeviceCosts costs_;
    glare::LightSummary summary_;
    glare::Plan plan_;
    glare::QualityControl control_;
    glare::Accumulation last_method_ = glare::Accumulation::gl_billboards;
    double taken_ms_ = 0;
};

}  // namespace seaglare::plugin
