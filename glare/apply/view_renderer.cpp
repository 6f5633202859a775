#include "glare/apply/view_renderer.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "glare/apply/view_renderer_impl.h"
#include "glare/device/cl_signal_guard.h"
#include "glare/device/cl_turns.h"
#include "glare/device/gl_touched_state.h"
#include "glare/tone/operators.h"

namespace seaglare::glare {

namespace {

// Without a plan: more lights than this share a threshold on the coarse grid; beyond, their tails hardly fall on the
// same pixels.
constexpr double largest_tail_share = 64;

AccumulationPlan plan_without_plan(const ToneSettings& tone, double adaptation_cd_m2, std::size_t lights) {
    AccumulationPlan plan;
    plan.skirt_threshold_cd_m2 = threshold_luminance_cd_m2(tone, adaptation_cd_m2, tone.threshold_codes);
    plan.tail_threshold_cd_m2 =
        plan.skirt_threshold_cd_m2 / std::clamp(static_cast<double>(lights), 1.0, largest_tail_share);
    return plan;
}

ReachSettings reach_of(const ScreenGeometry& g, const Pattern& pattern, const AccumulationPlan& plan) {
    ReachSettings reach;
    reach.tails = pattern.tail_scale > 0 && plan.tail_cell_px > 0;
    reach.cell_px = reach.tails ? std::min(coarse_cell_px(g, pattern), plan.tail_cell_px) : 1;
    reach.threshold_cd_m2 = plan.skirt_threshold_cd_m2;
    reach.tail_threshold_cd_m2 = plan.tail_threshold_cd_m2;
    reach.disc_scale = plan.disc_scale;
    return reach;
}
// A grid of single pixels would be a second picture, and blurred by half a pixel: those tails go where skirts do. 0: there
// is no grid.
int grid_cell_px(const ReachSettings& reach) {
    return reach.cell_px > 1 ? reach.cell_px : 0;
}

// Of whole bands, from the one that holds row `bottom`.
RowRange bands_over(int bottom, int top) {
    const int first = bottom / band_rows * band_rows;
    return {first, std::max(top - first, 0)};
}

// The host may have an unpack buffer bound: textures made without data would read from it.
const Gl& ready_for_uploads(const Gl& gl) {
    set_neutral_pixel_store(gl);
    return gl;
}

}  // namespace

ViewRenderer::Impl::Impl(const Gl& table, bool timed)
    : gl(ready_for_uploads(table)),
      timer(gl, timed),
      vertex_array(gl, GlKind::vertex_array),
      sampler(gl, GlKind::sampler),
      light_buffer(gl),
      occlusion(gl),
      billboards(gl),
      grids(gl, sampler),
      compositor(gl),
      sum(gl) {
    for (const GLenum parameter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
        gl.SamplerParameteri(sampler.name(), parameter, GL_NEAREST);
    }
    for (const GLenum parameter : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
        gl.SamplerParameteri(sampler.name(), parameter, GL_CLAMP_TO_EDGE);
    }
    // The host's depth texture may compare: ours must not.
    gl.SamplerParameteri(sampler.name(), GL_TEXTURE_COMPARE_MODE, GL_NONE);
    gl.UseProgram(0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

PixelRect ViewRenderer::Impl::take_lights(const ScreenGeometry& g, const Pattern& pattern,
                                          const ReachSettings& reach, std::span<const PointSource> sources) {
    instances.clear();
    tags.clear();
    fine_reach.update(pattern);
    ReachSettings with_fine = reach;
    with_fine.fine = &fine_reach;
    const PixelRect touched = append_instances(g, pattern, with_fine, sources, instances, &tags);
    row_order.sort(g.height_px, instances, tags);
    return touched;
}

void ViewRenderer::Impl::bind_own_objects() {
    set_neutral_state(gl);
    for (GLuint unit = 0; unit < touched_texture_units; ++unit)
        gl.BindSampler(unit, sampler.name());
    gl.BindVertexArray(vertex_array.name());
}

RenderResult ViewRenderer::Impl::render(const Frame& frame, const ToneSettings& tone, const Pattern& pattern,
                                        std::span<const PointSource> sources, const AccumulationPlan& plan,
                                        RenderStats& stats) {
    const ScreenGeometry g = screen_geometry(frame);
    const ReachSettings reach = reach_of(g, pattern, plan);
    width_px = g.width_px;
    height_px = g.height_px;
    nothing_drawn = true;
    const PixelRect touched = take_lights(g, pattern, reach, sources);
    stats.lights_outside += static_cast<std::uint32_t>(sources.size() - instances.size());
    if (instances.empty()) return RenderResult::nothing_to_draw;

    PassTimer::Frame passes(timer, Pass::upload);
    // Everything that can fail comes before the first change to the target.
    bind_own_objects();
    compositor.begin(frame);
    gathers = gather && plan.method == Accumulation::cl_tiles;
    const CodeBudget structure = {
        plan.structure_codes, tone_curve(tone, frame.adaptation_luminance_cd_m2), tone.blue_shift,
        frame.ldr_white_luminance_cd_m2 > 0 ? 1 / frame.ldr_white_luminance_cd_m2 : 0};
    const AccumulationInput input{g, pattern, reach, instances, {}, structure};
    on_grids = !gathers && grids_pay(g, pattern, reach.cell_px);
    const int cell_px = on_grids ? 0 : grid_cell_px(reach);
    occlusion.want_known(gathers);
    occlusion.begin(frame, instances, tags);
    sum.begin(g.width_px, g.height_px, cell_px, compositor.least_cd_m2(frame, tone));
    billboards.begin(g, pattern, reach.tails);
    if (on_grids) {
        passes.enter(Pass::accumulate);
        leave_to_grids(input);
    }
    light_buffer.upload(instances);
    passes.enter(Pass::occlusion);
    look_what_hides(frame, g, stats);
    passes.enter(Pass::accumulate);
    std::optional<ClFrameTurn> turn;  // the next pattern's kernels let this frame's pass
    if (gathers) turn.emplace();
    if (gathers) gathers = leave_to_gather(input, plan.most_unknown_px, stats);
    take_pattern(pattern);
    draw_grid(reach, stats);

    const PixelBox box = box_of(touched, cell_px, g.width_px, g.height_px);
    RowRange rows = bands_over(box.bottom, box.top);
    const auto composite = [&](RowRange band) {
        passes.enter(Pass::composite);
        stats.draw_calls += compositor.draw(
            frame, tone, sum,
            {box.left, std::max(box.bottom, band.first), box.right, std::min(box.top, band.end())});
        rows = {band.end(), rows.end() - band.end()};
        if (rows.count > 0) passes.enter(Pass::accumulate);
    };
    try {
        for_each_band(rows, stats, std::ref(composite));  // a reference: no allocation
    } catch (const ClError&) {
        // A device that fails once is not asked again: the rest of this frame, and all others, are drawn as rectangles.
        gather.reset();
        gathers = false;
        take_lights(g, pattern, reach, sources);
        light_buffer.upload(instances);
        sum.begin(g.width_px, g.height_px, grid_cell_px(reach), compositor.least_cd_m2(frame, tone));
        take_pattern(pattern);
        draw_grid(reach, stats);
        for_each_band(rows, stats, std::ref(composite));
    }
    turn.reset();
    occlusion.end();

    stats.cpu = passes.finish();
    stats.gpu = timer.gpu();
    stats.lights_drawn += static_cast<std::uint32_t>(instances.size());
    stats.memory = memory();
    nothing_drawn = false;
    return RenderResult::drawn;
}

void ViewRenderer::Impl::look_what_hides(const Frame& frame, const ScreenGeometry& g, RenderStats& stats) {
    for (std::size_t first = 0; first < instances.size(); first += lights_per_chunk) {
        const std::size_t count = std::min(lights_per_chunk, instances.size() - first);
        light_buffer.bind(first / lights_per_chunk);
        stats.draw_calls += occlusion.draw(frame, g, first, static_cast<int>(count));
    }
    if (gathers && frame.occlusion.wait && occlusion.can_hide()) occlusion.wait();
}

// Whoever made them may write to them after this.
void ViewRenderer::Impl::let_go_of_copies() {
    prepared = nullptr;
    if (!gather) return;
    try {
        gather->settle();
    } catch (const ClError&) {
        gather.reset();
    }
}

// Where all lights are gathered, GL has no use for it; of the few that may be left, in some frames, no upload need overlap
// with the drawing of the last frame.
void ViewRenderer::Impl::take_pattern(const Pattern& pattern) {
    draws_skirts =
        on_grids || std::any_of(instances.begin(), instances.end(), [](const LightInstance& light) {
            return light.skirt_rect[0] < light.skirt_rect[2] && light.skirt_rect[1] < light.skirt_rect[3];
        });
    if (draws_skirts)
        // A view that can gather draws skirts now and then: one texture will do, for the sake of memory.
        billboards.take_pattern(pattern, prepared != nullptr ? prepared->texels_of(pattern) : nullptr,
                                gather == nullptr);
    else
        billboards.reserve_pattern(pattern);
}

DeviceMemory ViewRenderer::Impl::memory() const {
    DeviceMemory memory;
    memory.hdr = sum.band_bytes();
    memory.coarse_grid = sum.grid_bytes() + grids.grid_bytes();
    memory.background = compositor.memory_bytes();
    memory.occlusion = occlusion.memory_bytes();
    memory.lights = light_buffer.memory_bytes() + grids.light_bytes();
    memory.pattern_layers = billboards.memory_bytes() + grids.table_bytes();
    if (gather) memory.accumulation = gather->memory_bytes();
    return memory;
}

ViewRenderer::ViewRenderer(const Gl& gl, bool timed) : impl_(std::make_unique<Impl>(gl, timed)) {}

ViewRenderer::~ViewRenderer() = default;

void ViewRenderer::abandon() {
    Impl& self = *impl_;
    self.timer.forget();
    self.vertex_array.forget();
    self.sampler.forget();
    self.light_buffer.forget();
    self.occlusion.forget();
    self.billboards.forget();
    self.grids.forget();
    self.compositor.forget();
    self.sum.forget();
}

RenderResult ViewRenderer::render(const Frame& frame, const ToneSettings& tone, const Pattern& pattern,
                                  std::span<const PointSource> sources, const AccumulationPlan& plan,
                                  RenderStats& stats) {
    return impl_->render(frame, tone, pattern, sources, plan, stats);
}

RenderResult ViewRenderer::render(const Frame& frame, const ToneSettings& tone, const Pattern& pattern,
                                  std::span<const PointSource> sources, RenderStats& stats) {
    return impl_->render(frame, tone, pattern, sources,
                         plan_without_plan(tone, frame.adaptation_luminance_cd_m2, sources.size()), stats);
}

bool ViewRenderer::enable_gather() {
    if (impl_->gather) return true;
    try {
        // Drivers may touch signal handlers at any point of this.
        const SignalGuard guard;
        auto gather = std::make_unique<ClGather>(ClShared::acquire(current_gl_context(), impl_->sharing));
        gather->warm_up();
        impl_->gather = std::move(gather);
    } catch (const std::runtime_error&) {
        return false;
    }
    return true;
}

const SharingDecision& ViewRenderer::sharing() const {
    return impl_->sharing;
}

bool ViewRenderer::can_gather() const {
    return impl_->gather != nullptr;
}

void ViewRenderer::set_prepared(const PreparedPattern* prepared) {
    impl_->let_go_of_copies();
    impl_->prepared = prepared;
}

std::shared_ptr<ClShared> ViewRenderer::gather_context() const {
    return impl_->gather ? impl_->gather->shared() : nullptr;
}

PatternUse ViewRenderer::use_of_patterns(const AccumulationPlan& plan) const {
    const bool gathers = impl_->gather && plan.method == Accumulation::cl_tiles;
    return {.draws = impl_->draws_skirts || !gathers,
            .grids = impl_->on_grids && !gathers,
            .gather = gathers ? impl_->gather->shared() : nullptr};
}

void ViewRenderer::read_hdr(std::span<float> rgba) const {
    Impl& self = *impl_;
    const std::size_t needed =
        static_cast<std::size_t>(self.width_px) * static_cast<std::size_t>(self.height_px) * 4;
    if (rgba.size() < needed) throw std::invalid_argument("read_hdr: the buffer is smaller than the picture");
    const std::span<float> picture = rgba.first(needed);
    if (self.nothing_drawn)
        std::fill(picture.begin(), picture.end(), 0.0F);
    else
        self.read_hdr(picture);
}

int ViewRenderer::hdr_width() const {
    return impl_->width_px;
}
int ViewRenderer::hdr_height() const {
    return impl_->height_px;
}

void ViewRenderer::mark_nothing_drawn(const Frame& frame) {
    impl_->width_px = std::max(frame.viewport_px[2], 0);
    impl_->height_px = std::max(frame.viewport_px[3], 0);
    impl_->nothing_drawn = true;
}

void ViewRenderer::set_timed(bool timed) {
    impl_->timer.set_enabled(timed);
}

}  // namespace seaglare::glare
