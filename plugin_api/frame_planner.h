// Plans the frames of one view: sums its lights up, makes the plan, compares what frames took with what was predicted, and
// keeps to a time budget. The decisions themselves are glare/plan's, pure functions.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "glare/plan/plan.h"
#include "glare/plan/quality_control.h"
#include "glare/plan/quality_savings.h"
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
    bool took_pattern = true;  // a new one came to this frame
    bool drew = true;  // something of what was planned: only such frames are counted by gpu_frames_ago
};

class FramePlanner {
  public:
    // How much of the error budget's growth a time budget gives up in the next frame, 0 ... 1.
    double error_given_up() const { return control_.loss.of(glare::Quality::error); }

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
    // What the time budget has given up saves, and what could be saved beyond that, ms of a frame, predicted.
    double saved_ms() const { return glare::saved_ms(control_.loss, savings_); }
    double could_save_ms() const { return glare::could_save_ms(control_.loss, savings_); }
    // The dearest pass, where the time budget cannot be kept: nothing is left to give up that would save time.
    std::optional<glare::PassKind> limiting_pass() const;
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
    void look_what_could_be_saved(const glare::PlanInput& input, const glare::Budget& budget);
    void learn_from(const FrameTimes& times);
    void learn_accumulation(const Drawn& drawn, double gpu_ms);

    glare::DeviceCosts costs_;
    glare::DeviceCosts measured_;
    glare::LightSummary summary_;
    glare::Plan plan_;
    glare::QualityControl control_;
    glare::QualitySavings savings_;  // of one kind after the other, a frame each
    std::size_t next_saving_ = 0;
    bool time_is_short_ = false;
    glare::Accumulation last_method_ = glare::Accumulation::gl_billboards;
    double taken_ms_ = 0;
    std::array<Drawn, 128> drawn_{};  // by the number of the frame: GPU times come late, and not of every one
    std::uint64_t frames_drawn_ = 0;
};

}  // namespace seaglare::plugin
