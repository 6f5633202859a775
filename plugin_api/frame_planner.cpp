#include "plugin_api/frame_planner.h"

#include <algorithm>
#include <cmath>

#include "glare/plan/pattern_motion.h"
#include "glare/plan/sensitivity.h"
#include "glare/psf/pattern_grid.h"

namespace seaglare::plugin {

namespace {

double predicted_ms(const glare::Plan& plan, glare::PassKind kind) {
    for (const glare::PlannedPass& pass : plan.passes.all())
        if (pass.kind == kind) return pass.predicted_ms;
    return 0;
}

// In the corner of the picture that is farthest from straight ahead.
double smallest_pixel_sr(const glare::ScreenGeometry& g) {
    const double off_axis_rad = g.cone_rad + std::acos(std::clamp(glare::dot(g.axis, g.forward), -1.0, 1.0));
    const double cosine = std::max(std::cos(std::min(off_axis_rad, 1.55)), 0.02);
    return g.plane_area_px * cosine * cosine * cosine;
}

}  // namespace

const glare::Plan& FramePlanner::make(const PlanSettings& settings, double resting_pupil_mm, bool wait,
                                      glare::PlanInput& input, std::span<const glare::PointSource> sources) {
    if (settings.pinned_costs || wait) {
        costs_ = settings.pinned_costs.value_or(glare::DeviceCosts{});
        costs_.pinned = true;
    } else {
        costs_ = measured_;
    }
    const glare::PatternGrid grid = glare::plan_grid(settings.pattern, input.geometry.pitch);
    input.pattern = &settings.pattern;
    input.window_inner = grid.window_inner;
    input.window_outer = grid.window_outer;
    input.radius_nodes = grid.radius;
    input.has_tail = settings.eye.cie_tail && settings.pattern.angular_scale == 1;
    input.tail_age_years = settings.eye.age_years;
    input.eye_focused = settings.eye.defocus_dioptre == 0 && !settings.eye.accommodation_moves_focus;
    input.tail_pigmentation = settings.eye.pigmentation;
    input.last_method = last_method_;
    input.given_up = control_.loss;
    glare::summarise(input.geometry, sources, grid.window_outer / input.geometry.pitch, summary_);
    input.lights = &summary_;
    // The eye at rest has a pattern that serves any instant.
    const glare::MotionSpread spread =
        glare::motion_spread(settings.eye, settings.pattern, resting_pupil_mm, input.geometry.pitch);
    const glare::Sensitivity sensitivity =
        glare::sensitivity(input.tone, input.adaptation_cd_m2, summary_.largest_channel_ratio);
    input.pattern_usable = true;
    input.pattern_motion_codes =
        glare::motion_bound_codes(spread, sensitivity, summary_, input.geometry.pitch,
                                  smallest_pixel_sr(input.geometry), settings.pattern.angular_scale);
    plan_ = glare::make_plan(input, settings.budget, costs_);
    if (plan_.draw) last_method_ = plan_.accumulation.method;
    look_what_could_be_saved(input, settings.budget);
    return plan_;
}

// Two more plans in a frame, and none without a time budget. While nothing is drawn - a light is dark - what was known stands.
void FramePlanner::look_what_could_be_saved(const glare::PlanInput& input, const glare::Budget& budget) {
    if (!(budget.time_ms > 0)) {
        savings_ = {};
        return;
    }
    if (!plan_.draw) return;
    const auto kind = static_cast<glare::Quality>(next_saving_);
    const glare::Saving saving = glare::saving_of(kind, input, budget, costs_);
    // Lights that the grown budget has left out already are in no plan: what they save is what was predicted with them.
    const bool lights_gone = kind == glare::Quality::error && control_.loss.of(kind) > 0 &&
                             input.left_out.too_faint + input.left_out.too_far > 0;
    glare::Saving& known = savings_[next_saving_];
    if (!lights_gone || saving.part > known.part) known = saving;
    next_saving_ = (next_saving_ + 1) % glare::quality_kinds;
}

std::optional<glare::PassKind> FramePlanner::limiting_pass() const {
    if (!time_is_short_ || could_save_ms() > 0) return std::nullopt;
    const glare::PlannedPass* dearest = nullptr;
    for (const glare::PlannedPass& pass : plan_.passes.all()) {
        if (pass.kind == glare::PassKind::pattern) continue;  // beside the frames
        if (dearest == nullptr || pass.predicted_ms > dearest->predicted_ms) dearest = &pass;
    }
    if (dearest == nullptr) return std::nullopt;
    return dearest->kind;
}

void FramePlanner::took(const PlanSettings& settings, const FrameTimes& times, double interval_s) {
    const bool drew = plan_.draw && times.drew;
    // Frames that are planned with pinned costs come between others: they are counted, and teach nothing.
    if (drew && costs_.pinned)
        drawn_[frames_drawn_ % drawn_.size()] = {};
    else if (drew)
        drawn_[frames_drawn_ % drawn_.size()] = {
            plan_.accumulation.method, times.as_planned, predicted_ms(plan_, glare::PassKind::accumulate),
            predicted_ms(plan_, glare::PassKind::composite), times.accumulate_ms};
    if (!costs_.pinned) learn_from(times);
    if (drew) ++frames_drawn_;
    // The pattern is made beside the frames.
    const double predicted = plan_.predicted_ms - predicted_ms(plan_, glare::PassKind::pattern);
    taken_ms_ = costs_.pinned ? predicted : std::max(times.render_ms, times.gpu_ms);
    control_ = glare::advanced(control_, settings.budget, taken_ms_, interval_s, savings_);
    time_is_short_ = settings.budget.time_ms > 0 && control_.load > 0;
}

void FramePlanner::learn_from(const FrameTimes& times) {
    using glare::PassKind;
    using glare::Work;
    const auto learned = [&](std::initializer_list<Work> kinds, PassKind kind, double measured_ms) {
        glare::learn(measured_, kinds, predicted_ms(plan_, kind), measured_ms);
    };
    learned({Work::light_evaluated}, PassKind::evaluate, times.evaluate_ms);
    if (!plan_.draw || !times.drew) return;
    // Of the two the pattern is the dearer by far: what it takes beyond the lights is its own.
    const double table_ms = times.took_pattern ? plan_.pattern_taken_ms : 0;
    const double lights_ms = plan_.upload_lights_ms;
    if (table_ms > lights_ms) {
        glare::learn(measured_, {Work::pattern_upload_node}, table_ms, times.upload_ms - lights_ms);
    } else if (table_ms == 0) {
        glare::learn(measured_, {Work::light_uploaded}, lights_ms, times.upload_ms);
    }

    if (times.gpu_frames_ago == 0) {
        learn_accumulation(drawn_[frames_drawn_ % drawn_.size()], 0);
    } else if (times.gpu_frames_ago < drawn_.size() && times.gpu_frames_ago <= frames_drawn_) {
        const Drawn& then = drawn_[(frames_drawn_ - times.gpu_frames_ago) % drawn_.size()];
        learn_accumulation(then, times.gpu_accumulate_ms);
        glare::learn(measured_, {Work::composite_px}, then.composite_ms, times.gpu_composite_ms);
    }
}

void FramePlanner::learn_accumulation(const Drawn& drawn, double gpu_ms) {
    using glare::Work;
    if (!drawn.as_planned) return;
    // A gather is the CPU's to wait for, rectangles are the GPU's.
    const double measured_ms = std::max(gpu_ms, drawn.cpu_accumulate_ms);
    const auto learned = [&](std::initializer_list<Work> kinds) {
        glare::learn(measured_, kinds, drawn.accumulate_ms, measured_ms);
    };
    switch (drawn.method) {
        case glare::Accumulation::gl_billboards:
            learned({Work::gl_draw, Work::gl_core_px, Work::gl_skirt_px, Work::gl_tail_cell});
            break;
        case glare::Accumulation::cl_tiles:
            learned({Work::cl_pass, Work::cl_screen_px, Work::cl_light, Work::cl_light_px});
            break;
    }
}

}  // namespace seaglare::plugin
