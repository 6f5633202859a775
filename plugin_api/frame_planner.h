// Plans the frames of one view: sums its lights up, makes the plan, compares what frames took with what was predicted, and
// keeps to a time budget. The decisions themselves are glare/plan's, pure functions.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "glare/plan/plan.h"
#include "glare/plan/quality_control.h"
#include "plugin_api/settings.h"

namespace seaglare::plugin {

// What frames took, in ms; GPU times are of the frame that was drawn gpu_frames_ago before this one, 0 while there are none.
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
    std::uint32_t gpu_frames_ago = 0;
    bool as_planned =
        true;  // all lights were added as the plan says: one falls back to billboards where it must
};

class FramePlanner {
  public:
    // What a time budget gives up in the next frame.
    double quality_loss() const { return control_.loss; }

    // Fills in what is known here: lights, the pattern's grid and motion, the tail, quality. The plan stays until the next
    // call. `wait`: the same plan in every run and on every machine, so with pinned costs or, without, the usual ones.
    const glare::Plan& make(const PlanSettings& settings, double resting_pupil_mm, bool wait,
                            glare::PlanInput& input, std::span<const glare::PointSource> sources);
    const glare::Plan& plan() const { return plan_; }

    // The frame just planned has taken this; the next follows after interval_s.
    void took(const PlanSettings& settings, const FrameTimes& times, double interval_s);
    // What a frame was counted as having taken: with pinned costs, or when it waits, what was predicted, so that channels
    // agree; else the longer of the CPU's and the GPU's time.
    double taken_ms() const { return taken_ms_; }
    // What the last plan was made from; `pinned` where no clock has a say in it.
    const glare::DeviceCosts& costs() const { return costs_; }
    // Measured when the view was made, and learned since.
    const glare::DeviceCosts& measured() const { return measured_; }
    void set_measured(const glare::DeviceCosts& costs) { measured_ = costs; }

  private:
    // What was predicted of a frame that was drawn, and what it took of the CPU.
    struct Drawn {
        glare::Accumulation method = glare::Accumulation::gl_billboards;
        bool as_planned = false;
        double accumulate_ms = 0;
        double composite_ms = 0;
        double cpu_accumulate_ms = 0;
    };
    void learn_from(const FrameTimes& times);
    void learn_accumulation(const Drawn& drawn, double gpu_ms);

    glare::DeviceCosts costs_;
    glare::DeviceCosts measured_;
    glare::LightSummary summary_;
    glare::Plan plan_;
    glare::QualityControl control_;
    glare::Accumulation last_method_ = glare::Accumulation::gl_billboards;
    double taken_ms_ = 0;
    std::array<Drawn, 8> drawn_{};  // by the number of the frame: GPU times come late
    std::uint64_t frames_drawn_ = 0;
};

}  // namespace seaglare::plugin
