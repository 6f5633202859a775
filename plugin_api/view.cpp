#include "plugin_api/view.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <exception>
#include <span>

#include "glare/apply/cost_probe.h"
#include "plugin_api/failure.h"
#include "plugin_api/fp_environment.h"
#include "plugin_api/validate.h"

namespace seaglare::plugin {

namespace {

// A channel of 1080 lines and 45 degrees: what the pattern is warmed up with before the first frame tells its own pitch.
constexpr double typical_pitch = 1.0 / 1303.7;
constexpr double default_interval_s = 1.0 / 60;
constexpr double longest_probe_ms = 50;

class Stopwatch {
  public:
    double lap_ms() {
        const auto now = std::chrono::steady_clock::now();
        const double elapsed = std::chrono::duration<double, std::milli>(now - start_).count();
        start_ = now;
        return elapsed;
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Entry points are asked for once and never in a frame.
struct HostLoader {
    seaglare_get_proc_fn get_proc;
    void* user;
    static void* load(void* self, const char* name) {
        const auto* loader = static_cast<const HostLoader*>(self);
        const HostFpEnvironment host;
        return loader->get_proc(loader->user, name);
    }
};

bool has_robustness(const glare::Gl& gl) {
    return gl.GetGraphicsResetStatus != nullptr &&
           (gl.version >= 45 || glare::has_extension(gl, "GL_KHR_robustness"));
}

glare::Frame frame_for_glare(const seaglare_frame& from) {
    glare::Frame to;
    to.target_fbo = from.target_fbo;
    to.target_encoding = static_cast<glare::TargetEncoding>(from.target_encoding);
    std::copy_n(from.viewport_px, 4, to.viewport_px.begin());
    to.depth_source = static_cast<glare::DepthSource>(from.depth_source);
    to.depth_object = from.depth_object;
    to.depth_convention = static_cast<glare::DepthConvention>(from.depth_convention);
    std::copy_n(from.depth_origin_px, 2, to.depth_origin_px.begin());
    to.depth_log_c = from.depth_log_c;
    to.depth_log_far_m = from.depth_log_far_m;
    std::copy_n(from.clip_from_view, 16, to.clip_from_view.begin());
    to.time_s = from.time_s;
    to.ldr_white_luminance_cd_m2 = from.ldr_white_luminance_cd_m2;
    return to;
}

// The plan in the words of the stats extension.
void tell(const glare::Plan& plan, seaglare_stats& stats) {
    stats.max_error_codes = plan.max_error_codes;
    stats.error_bound_codes = plan.error_bound_codes;
    stats.quality_loss = plan.given_up.mean();
    for (std::size_t k = 0; k < glare::quality_kinds; ++k)
        if (plan.given_up.level[k] > 0) stats.given_up |= 1U << k;
    stats.accumulation = static_cast<std::uint32_t>(plan.accumulation.method);
    stats.omissions = static_cast<std::uint32_t>(plan.left_out.all().size());
    for (const glare::PlannedPass& pass : plan.passes.all()) {
        if (pass.kind != glare::PassKind::pattern) stats.predicted_ms += pass.predicted_ms;
        switch (pass.kind) {
            case glare::PassKind::evaluate:
                stats.predicted_evaluate_ms = pass.predicted_ms;
                break;
            case glare::PassKind::visibility:
                break;
            case glare::PassKind::pattern:
                stats.predicted_pattern_ms = pass.predicted_ms;
                break;
            case glare::PassKind::upload:
                stats.predicted_upload_ms = pass.predicted_ms;
                break;
            case glare::PassKind::occlusion:
                stats.predicted_occlusion_ms = pass.predicted_ms;
                break;
            case glare::PassKind::accumulate:
                stats.predicted_accumulate_ms = pass.predicted_ms;
                break;
            case glare::PassKind::composite:
                stats.predicted_composite_ms = pass.predicted_ms;
                break;
        }
    }
}

FrameTimes times_of(const seaglare_stats& stats, bool as_planned, bool took_pattern, bool drew) {
    return {.evaluate_ms = stats.evaluate_ms,
            .upload_ms = stats.upload_ms,
            .occlusion_ms = stats.occlusion_ms,
            .accumulate_ms = stats.accumulate_ms,
            .composite_ms = stats.composite_ms,
            .render_ms = stats.render_ms,
            .gpu_occlusion_ms = stats.gpu_occlusion_ms,
            .gpu_accumulate_ms = stats.gpu_accumulate_ms,
            .gpu_composite_ms = stats.gpu_composite_ms,
            .gpu_ms = stats.gpu_ms,
            .gpu_frames_ago = stats.gpu_frames_ago,
            .as_planned = as_planned,
            .took_pattern = took_pattern,
            .drew = drew};
}

}  // namespace

View::View(seaglare_context& owner, const seaglare_view_info& info)
    : context_(owner.context),
      channel_name_(info.channel_name == nullptr ? "" : info.channel_name),
      guard_mode_((info.flags & SEAGLARE_VIEW_HOST_RESTORES_STATE) != 0 ? GuardMode::host_restores
                                                                        : GuardMode::save_and_restore) {
    HostLoader loader{info.get_proc, info.get_proc_user};
    gl_ = glare::load_gl(&HostLoader::load, &loader);
    caps_ = gl_state_caps(gl_, &HostLoader::load, &loader);
    knows_reset_status_ = has_robustness(gl_);
    stats_.struct_size = sizeof stats_;
    facts_.channel = channel_name_;
    {
        // Making a view is no frame: its state is restored whatever render() was told.
        const GlStateGuard guard(gl_, caps_);
        const bool timed = (info.flags & SEAGLARE_VIEW_NO_GPU_TIMES) == 0;
        renderer_ = std::make_unique<glare::ViewRenderer>(gl_, timed);
    }
    const glare::EyeMoment at_rest = context_.eye_at_rest(typical_pitch);
    if (context_.degraded_reason().empty()) renderer_->enable_gather();
    context_.patterns()->warm_up(at_rest);
    warm_up_drawing(at_rest);
    renderer_->set_timed((info.flags & SEAGLARE_VIEW_NO_GPU_TIMES) == 0);
    context_.add_view();
}

// An OpenCL context that shares with GL must not outlive the GL context.
void View::forget_shared_context() noexcept {
    const std::shared_ptr<glare::ClShared> shared = renderer_->gather_context();
    if (!shared || !shared->shares_with_gl()) return;
    renderer_->set_prepared(nullptr);
    prepared_.reset();
    try {
        context_.patterns()->forget(*shared);
    } catch (const std::exception&) {
        return;  // no memory for the list of what to release: it ends with the store
    }
}

View::~View() {
    forget_shared_context();
    context_.remove_view();
}

// With the pattern that warming up has made. Views that wait for all they draw do not mind waiting for a compiler, too, and
// plan with the usual costs.
void View::warm_up_drawing(const glare::EyeMoment& moment) {
    const std::shared_ptr<const PlanSettings> settings = context_.settings_of_plans();
    if (settings->pattern.motion.wait) return;
    const std::shared_ptr<PatternStore> patterns = context_.patterns();
    const PatternLease lease = patterns->take({.moment = moment, .viewer = this});
    const GlStateGuard guard(gl_, caps_);
    try {
        glare::draw_each_kind_once(gl_, *renderer_, lease.pattern());
        if (!settings->pinned_costs)
            planner_.set_measured(glare::measured_costs(
                glare::probe_costs(gl_, *renderer_, lease.pattern(), longest_probe_ms)));
    } catch (const glare::GlError&) {
        return;  // the usual costs serve, too
    }
}

View::Hold::Hold(View& view) : view_(view) {
    if (view_.busy_.test_and_set())
        throw Failure(SEAGLARE_ERROR_BUSY, "the view is in use on another thread");
}

void View::declare_context_lost() {
    renderer_->abandon();
}

void View::check_context_alive() {
    // GL tells of a reset once only, and the context stays lost.
    if (!lost_ && knows_reset_status_) lost_ = gl_.GetGraphicsResetStatus() != GL_NO_ERROR;
    if (lost_) {
        throw Failure(SEAGLARE_ERROR_CONTEXT_LOST,
                      "the GL context was reset: destroy_view(view, 1), then make a new context and view");
    }
}

// The host is asked only about lights that survive culling.
void View::ask_visibility(const seaglare_frame& frame, double smoothing_s, std::size_t visible) {
    asked_.clear();
    for (std::size_t i = 0; i < visible; ++i)
        asked_.push_back(evaluated_.sources[i].tag);
    context_.visibility_queries(asked_, queries_);
    {
        const HostFpEnvironment host;
        frame.visibility(frame.visibility_user, queries_.data(), static_cast<std::uint32_t>(queries_.size()));
    }
    answers_.clear();
    for (std::size_t i = 0; i < visible; ++i) {
        // A NaN hides, as everything that is not a visibility does.
        const float given = queries_[i].visibility;
        answers_.push_back(given > 0 ? std::min(given, 1.0F) : 0.0F);
    }
    host_visibility_.smooth(frame.time_s, smoothing_s, std::span(evaluated_.sources).first(visible),
                            answers_);
    for (std::size_t i = 0; i < visible; ++i) {
        const float factor = answers_[i];
        if (factor == 0) ++facts_.hidden_by_host;
        glare::PointSource& source = evaluated_.sources[i];
        for (float& channel : source.illuminance_rgb_lx)
            channel *= factor;
        source.illuminance_scotopic_lx *= factor;
    }
}

seaglare_result View::render(const seaglare_frame* given) {
    Stopwatch whole;
    Stopwatch stage;
    const seaglare_frame frame = copy_struct(given, "frame");
    check(frame);
    glare::Frame glare_frame = frame_for_glare(frame);
    glare::PlanInput input;
    input.geometry = glare::screen_geometry(glare_frame);

    const FrameState state = context_.evaluate(frame, glare_frame, planner_.error_given_up(), evaluated_);
    glare_frame.adaptation_luminance_cd_m2 = state.adaptation_luminance_cd_m2;
    glare_frame.occlusion = state.occlusion;
    // Asked for determinism: nothing is taken as late as it comes, and no clock decides what is left out.
    const bool wait = (frame.flags & SEAGLARE_FRAME_WAIT) != 0 || state.plan->pattern.motion.wait;
    glare_frame.occlusion.wait = wait;

    stats_ = {};
    stats_.struct_size = sizeof stats_;
    stats_.lights_total = evaluated_.total;
    stats_.lights_dark = evaluated_.dark;
    stats_.lights_horizon = evaluated_.below_horizon;
    stats_.adaptation_luminance_cd_m2 = state.adaptation_luminance_cd_m2;
    stats_.pupil_mm = state.pupil_mm;
    facts_ = {};
    facts_.memory = memory_;
    stats_.device_memory_bytes = memory_.total();
    facts_.channel = channel_name_;
    facts_.rendered = true;

    glare::RenderStats culled;
    const auto cull = [&](std::span<glare::PointSource> sources) {
        return glare::ViewRenderer::cull(glare_frame, state.tone, sources, culled, state.angular_scale);
    };
    std::size_t visible = cull(evaluated_.sources);
    if (frame.visibility != nullptr && visible > 0) {
        facts_.asked_visibility = true;
        ask_visibility(frame, glare_frame.occlusion.smoothing_s, visible);
        const auto hidden = [](const glare::PointSource& s) {
            return s.illuminance_rgb_lx == std::array<float, 3>{} && s.illuminance_scotopic_lx == 0;
        };
        const auto first = evaluated_.sources.begin();
        const auto last = first + static_cast<std::ptrdiff_t>(visible);
        visible = static_cast<std::size_t>(std::remove_if(first, last, hidden) - first);
        visible = cull(std::span(evaluated_.sources).first(visible));
    } else {
        host_visibility_.clear();
    }
    stats_.lights_outside = culled.lights_outside;
    stats_.lights_below_threshold = culled.lights_below_threshold + evaluated_.too_faint;

    input.tone = state.tone;
    input.adaptation_cd_m2 = state.adaptation_luminance_cd_m2;
    input.lights_total = evaluated_.total;
    input.left_out = {.dark = evaluated_.dark,
                      .horizon = evaluated_.below_horizon,
                      .outside = culled.lights_outside,
                      .too_far = evaluated_.too_faint,
                      .too_faint = culled.lights_below_threshold,
                      .hidden = facts_.hidden_by_host};
    input.spectra_without_pattern = state.spectra_without_pattern;
    input.can_gather = renderer_->can_gather();
    input.has_depth = glare_frame.depth_source != glare::DepthSource::none;
    input.asks_visibility = frame.visibility != nullptr;
    input.frame_interval_s = frame.frame_interval_s > 0 ? frame.frame_interval_s : default_interval_s;
    const glare::Plan& plan = planner_.make(*state.plan, state.resting_pupil_mm, wait, input,
                                            std::span(evaluated_.sources).first(visible));
    tell(plan, stats_);
    stats_.time_budget_ms = state.plan->budget.time_ms;
    stats_.evaluate_ms = stage.lap_ms();

    seaglare_result result = SEAGLARE_NOTHING_TO_DRAW;
    if (visible == 0) {
        renderer_->mark_nothing_drawn(glare_frame);
    } else {
        check_context_alive();
        visible_.assign(evaluated_.sources.begin(),
                        evaluated_.sources.begin() + static_cast<std::ptrdiff_t>(visible));
        result = draw(glare_frame, state, input.geometry.pitch, frame.frame_interval_s, wait);
    }
    stats_.render_ms = whole.lap_ms();
    planner_.took(*state.plan, times_of(stats_, as_planned_, !facts_.pattern_reused, facts_.drawn),
                  frame.frame_interval_s > 0 ? frame.frame_interval_s : default_interval_s);
    stats_.taken_ms = planner_.taken_ms();
    stats_.saved_ms = planner_.saved_ms();
    stats_.could_save_ms = planner_.could_save_ms();
    const std::optional<glare::PassKind> limit = planner_.limiting_pass();
    if (limit) stats_.limiting_pass = static_cast<std::uint32_t>(*limit) + 1;  // NONE comes first
    return result;
}

seaglare_result View::draw(const glare::Frame& frame, const FrameState& state, double pitch,
                           double interval_s, bool wait) {
    Stopwatch stage;
    const glare::Plan& plan = planner_.plan();
    PatternStore& store = *state.patterns;
    PatternDemand demand;
    demand.interval_s = interval_s;
    demand.wait = wait;
    demand.viewer = this;
    demand.step_s = plan.pattern_step_s;
    demand.moment.adaptation_cd_m2 = state.adaptation_luminance_cd_m2;
    demand.moment.lamps = state.lamps;
    demand.moment.request = {.pupil_mm = state.pupil_mm,
                             .resting_pupil_mm = state.resting_pupil_mm,
                             .time_s = frame.time_s,
                             .pitch = pitch,
                             .lamps = plan.lamps_with_pattern,
                             .lamp_list = state.lamps.get(),
                             .largest_disc_nodes = static_cast<float>(plan.largest_disc_nodes),
                             .lids = state.lids,
                             .vitreous_roll_rad = state.vitreous_roll_rad};
    if (plan.pattern == glare::PatternAction::reuse) demand.moment = glare::at_rest(demand.moment);
    const bool fading = plan.filter_blend > 0 && std::popcount(plan.lamps_with_pattern) > 1;
    if (!fading) demand.use = renderer_->use_of_patterns(plan.accumulation);
    // From here on the last frame's glare cannot be read again.
    renderer_->mark_nothing_drawn(frame);
    renderer_->set_prepared(nullptr);
    prepared_.reset();
    const PatternLease lease = store.take(demand);
    prepared_ = lease.prepared();
    renderer_->set_prepared(prepared_.get());
    const glare::Pattern& pattern = faded_.of(lease.pattern(), plan.filter_blend);
    const std::shared_ptr<const PatternFacts> facts = store.facts();
    const bool degraded = !facts->reason.empty();
    stats_.pattern_ms = stage.lap_ms();

    glare::RenderStats drawn;
    glare::RenderResult outcome;
    {
        const GlStateGuard guard(gl_, caps_, guard_mode_);
        glare::ToneSettings tone = state.tone;
        tone.blue_shift = plan.rod_hue;
        outcome = renderer_->render(frame, tone, pattern, visible_, plan.accumulation, drawn);
    }
    stats_.degraded = degraded ? 1 : 0;
    stats_.lights_drawn = drawn.lights_drawn;
    stats_.lights_outside += drawn.lights_outside;
    stats_.lights_below_threshold += drawn.lights_below_threshold;
    as_planned_ = plan.accumulation.method != glare::Accumulation::cl_tiles ||
                  drawn.lights_gathered * 10 >= drawn.lights_drawn * 9;
    stats_.draw_calls = drawn.draw_calls;
    stats_.upload_ms = drawn.cpu.of(glare::Pass::upload);
    stats_.occlusion_ms = drawn.cpu.of(glare::Pass::occlusion);
    stats_.accumulate_ms = drawn.cpu.of(glare::Pass::accumulate);
    stats_.composite_ms = drawn.cpu.of(glare::Pass::composite);
    stats_.gpu_frames_ago = drawn.gpu.frames_ago;
    stats_.gpu_upload_ms = drawn.gpu.passes.of(glare::Pass::upload);
    stats_.gpu_occlusion_ms = drawn.gpu.passes.of(glare::Pass::occlusion);
    stats_.gpu_accumulate_ms = drawn.gpu.passes.of(glare::Pass::accumulate);
    stats_.gpu_composite_ms = drawn.gpu.passes.of(glare::Pass::composite);
    stats_.gpu_ms = drawn.gpu.whole_ms;
    stats_.kernel_launches = lease.reused() ? 0 : static_cast<std::uint32_t>(pattern.kernel_launches);
    stats_.pattern_size = static_cast<std::uint32_t>(pattern.transform_size);
    stats_.pattern_radius_px = static_cast<std::uint32_t>(pattern.radius_nodes);
    stats_.pattern_layers = static_cast<std::uint32_t>(pattern.layer_radius_nodes.size());
    stats_.pattern_wavelengths = static_cast<std::uint32_t>(pattern.wavelengths);
    stats_.pattern_angular_scale = pattern.angular_scale;
    memory_ = drawn.memory;
    memory_.take_pattern(store.device_memory());
    facts_.memory = memory_;
    stats_.device_memory_bytes = memory_.total();
    facts_.device = facts->device_name;
    facts_.degraded_reason = facts->reason;
    facts_.pattern_reused = lease.reused();
    facts_.drawn = outcome == glare::RenderResult::drawn;
    facts_.late_lights = drawn.lights_late;
    if (outcome == glare::RenderResult::nothing_to_draw) return SEAGLARE_NOTHING_TO_DRAW;
    return degraded ? SEAGLARE_DEGRADED : SEAGLARE_OK;
}

seaglare_memory View::memory() const {
    return {.struct_size = sizeof(seaglare_memory),
            .reserved = 0,
            .hdr_bytes = memory_.hdr,
            .coarse_grid_bytes = memory_.coarse_grid,
            .background_bytes = memory_.background,
            .occlusion_bytes = memory_.occlusion,
            .lights_bytes = memory_.lights,
            .pattern_layers_bytes = memory_.pattern_layers,
            .accumulation_bytes = memory_.accumulation,
            .pattern_core_bytes = memory_.pattern_core,
            .pattern_wide_field_bytes = memory_.pattern_wide_field,
            .pattern_screen_bytes = memory_.pattern_screen,
            .total_bytes = memory_.total()};
}

std::string View::plan() const {
    PlanFacts facts = facts_;
    const glare::SharingDecision& sharing = renderer_->sharing();
    facts.sharing = sharing.shares ? "shared memory" : "a copy: " + sharing.reason;
    return plan_text(facts, planner_.plan(), planner_.costs(), planner_.measured(), stats_);
}

void View::read_hdr(float* rgba, std::uint64_t capacity_floats, std::int32_t out_size_px[2]) {
    if (out_size_px == nullptr) invalid_argument("out_size_px is NULL");
    out_size_px[0] = renderer_->hdr_width();
    out_size_px[1] = renderer_->hdr_height();
    const std::uint64_t needed =
        4 * static_cast<std::uint64_t>(out_size_px[0]) * static_cast<std::uint64_t>(out_size_px[1]);
    if (rgba == nullptr && capacity_floats == 0) return;  // only the size was asked for
    if (capacity_floats < needed) {
        invalid_argument("capacity_floats is " + std::to_string(capacity_floats) + ": " +
                         std::to_string(needed) + " are needed");
    }
    if (needed == 0) return;
    if (rgba == nullptr) invalid_argument("rgba is NULL");
    check_context_alive();
    const GlStateGuard guard(gl_, caps_);
    renderer_->read_hdr(std::span(rgba, static_cast<std::size_t>(needed)));
}

}  // namespace seaglare::plugin
