#include "glare/apply/view_renderer.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "glare/apply/band_lights.h"
#include "glare/apply/cl_gather.h"
#include "glare/apply/compositor.h"
#include "glare/apply/gl_billboards.h"
#include "glare/apply/gl_grids.h"
#include "glare/apply/hdr_sum.h"
#include "glare/apply/light_buffer.h"
#include "glare/apply/light_instance.h"
#include "glare/apply/occlusion.h"
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

double area_px(const RectPx& rect) {
    const double width = static_cast<double>(rect[2]) - static_cast<double>(rect[0]);
    const double height = static_cast<double>(rect[3]) - static_cast<double>(rect[1]);
    return std::max(width, 0.0) * std::max(height, 0.0);
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

// Grids cost what they cost, however few the lights: passes over the picture and over the coarser ones, and the profile of the
// pattern. Rectangles that cover no more than the picture so many times, as those of one light never do, are drawn as they are.
constexpr double grids_from_pictures = 2;

bool reaches_anything(std::span<const LightInstance> lights, RectPx LightInstance::*rect) {
    return std::any_of(lights.begin(), lights.end(),
                       [rect](const LightInstance& light) { return area_px(light.*rect) > 0; });
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

struct ViewRenderer::Impl {
    Impl(const Gl& table, bool timed);

    RenderResult render(const Frame& frame, const ToneSettings& tone, const Pattern& pattern,
                        std::span<const PointSource> sources, const AccumulationPlan& plan,
                        RenderStats& stats);
    void read_hdr(std::span<float> rgba);
    DeviceMemory memory() const;

    // The steps of render(), in their order.
    PixelRect take_lights(const ScreenGeometry& g, const Pattern& pattern, const ReachSettings& reach,
                          std::span<const PointSource> sources);
    void bind_own_objects();
    void look_what_hides(const Frame& frame, const ScreenGeometry& g, RenderStats& stats);
    bool leave_to_gather(AccumulationInput input, double most_unknown_px, RenderStats& stats);
    void leave_unknown(const Pattern& pattern, int cell_px, double most_px, RenderStats& stats);
    bool grids_pay(const ScreenGeometry& g, const Pattern& pattern, int cell_px) const;
    void leave_to_grids(const AccumulationInput& input);
    void let_go_of_copies();
    void take_pattern(const Pattern& pattern);
    void draw_grid(const ReachSettings& reach, RenderStats& stats);
    // Makes one band after the other and has it used. Throws ClError when the gather fails, GlError, or as `use` does.
    void for_each_band(RowRange rows, RenderStats& stats, const std::function<void(RowRange)>& use);
    void draw_band(RowRange band, RenderStats& stats);
    template <typename Draw>
    void draw_lights(LightRange range, RenderStats& stats, Draw draw);

    const Gl gl;
    PassTimer timer;
    GlObject vertex_array, sampler;
    LightBuffer light_buffer;
    Occlusion occlusion;
    GlBillboards billboards;
    GlGrids grids;
    Compositor compositor;
    HdrSum sum;
    FineReach fine_reach;
    std::vector<LightInstance> instances;
    std::vector<std::uint32_t> tags;  // of the instances
    RowOrder row_order;
    BandLights tail_lights, skirt_lights, core_lights;  // of the instances; tails where the bands carry them
    std::unique_ptr<ClGather> gather;                   // null: cannot, or need not
    SharingDecision sharing = {false, "nothing is gathered"};
    double shared_bytes = 0;  // of the bands when they were shared last
    const PreparedPattern* prepared = nullptr;
    bool draws_skirts = false;   // in the last frame that drew
    std::vector<float> visible;  // of the instances, where anything can hide them
    bool gathers = false;        // in this frame
    bool on_grids = false;       // in this frame: what is not gathered
    int width_px = 0;
    int height_px = 0;
    bool nothing_drawn = true;
};

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

// Takes skirts and tails of what is gathered off the instances, which leaves the cores to be drawn. False: the device failed.
bool ViewRenderer::Impl::leave_to_gather(AccumulationInput input, double most_unknown_px,
                                         RenderStats& stats) {
    visible.clear();
    if (occlusion.can_hide()) {
        for (const std::uint32_t tag : tags)
            visible.push_back(occlusion.known(tag).value_or(-1.0F));
    }
    if (prepared != nullptr) input.copies = prepared->copies_of(input.pattern, *gather->shared());
    try {
        input.visible = visible;
        stats.kernel_launches += gather->prepare(input);
    } catch (const ClError&) {
        gather.reset();
        return false;
    }
    for (std::size_t i = 0; i < instances.size(); ++i) {
        if (!is_gathered(input.pattern, instances[i], visible.empty() ? 1.0F : visible[i])) continue;
        instances[i].skirt_rect = {};
        instances[i].tail_rect = {};
        ++stats.lights_gathered;
    }
    if (!visible.empty()) leave_unknown(input.pattern, input.reach.cell_px, most_unknown_px, stats);
    light_buffer.upload(instances);
    return true;
}

// All or none: of a few that come into view the rectangles cost little; of a thousand, after a cut, the next frame's gather
// is there before a software rasteriser has drawn the half of them.
void ViewRenderer::Impl::leave_unknown(const Pattern& pattern, int cell_px, double most_px,
                                       RenderStats& stats) {
    const auto waits = [&](std::size_t i) {
        return visible[i] < 0 && is_gathered(pattern, instances[i], 1.0F);
    };
    double needed_px = 0;
    for (std::size_t i = 0; i < instances.size(); ++i) {
        if (!waits(i)) continue;
        needed_px += area_px(instances[i].skirt_rect) + area_px(instances[i].tail_rect) / (cell_px * cell_px);
    }
    if (needed_px <= most_px) return;
    for (std::size_t i = 0; i < instances.size(); ++i) {
        if (!waits(i)) continue;
        instances[i].skirt_rect = {};
        instances[i].tail_rect = {};
        ++stats.lights_late;
    }
}

// Whether it is cheaper to draw the lights on grids than as rectangles.
bool ViewRenderer::Impl::grids_pay(const ScreenGeometry& g, const Pattern& pattern, int cell_px) const {
    double covered_px = 0;
    for (const LightInstance& light : instances)
        if (GlGrids::takes(pattern, light))
            covered_px += area_px(light.skirt_rect) + area_px(light.tail_rect) / (cell_px * cell_px);
    return covered_px > grids_from_pictures * g.width_px * g.height_px;
}

// Takes skirts and tails of what the grids take off the instances, before these are uploaded.
void ViewRenderer::Impl::leave_to_grids(const AccumulationInput& input) {
    AccumulationInput taken = input;
    visible.clear();
    // What hides them is drawn, and fetched where they are.
    if (occlusion.can_hide()) visible.assign(instances.size(), -1.0F);
    taken.visible = visible;
    if (prepared != nullptr) taken.grid_texels = prepared->grid_texels_of(input.pattern);
    on_grids = grids.prepare(taken);
    if (!on_grids) return;
    for (LightInstance& light : instances) {
        if (!GlGrids::takes(input.pattern, light)) continue;
        light.skirt_rect = {};
        light.tail_rect = {};
    }
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

// Before any band: the far tails of all lights. And which lights each band is drawn from.
void ViewRenderer::Impl::draw_grid(const ReachSettings& reach, RenderStats& stats) {
    const bool in_bands = reach.tails && sum.cell_px() == 0;
    const std::span<const LightInstance> none;
    tail_lights.find(in_bands ? std::span<const LightInstance>(instances) : none, &LightInstance::tail_rect,
                     height_px);
    skirt_lights.find(instances, &LightInstance::skirt_rect, height_px);
    core_lights.find(instances, &LightInstance::core_rect, height_px);
    if (on_grids) stats.draw_calls += grids.draw_grids(billboards.pattern());
    if (!reach.tails || in_bands || !reaches_anything(instances, &LightInstance::tail_rect)) return;
    sum.light_grid();
    draw_lights({0, instances.size()}, stats, [this](const LightRun& lights) {
        return billboards.draw_tails(sum.grid(), sum.cell_px(), lights);
    });
}

void ViewRenderer::Impl::for_each_band(RowRange rows, RenderStats& stats,
                                       const std::function<void(RowRange)>& use) {
    if (gathers && sharing.shares) {
        const double bytes = sum.band_bytes();
        if (shared_bytes != bytes)
            gather->forget_textures();  // their names may be those of other textures now
        shared_bytes = bytes;
        const auto take = [&](RowRange band) {
            sum.given(band);
            draw_band(band, stats);
            use(band);
        };
        stats.kernel_launches +=
            gather->sum_into(rows, {sum.texture_in_turn(1), sum.texture_in_turn(2)}, std::ref(take));
        return;
    }
    if (gathers) {
        const auto take = [&](RowRange band, std::span<const float> rgbv) {
            sum.fill(band, rgbv);
            draw_band(band, stats);
            use(band);
            // While the next band is waited for, GL works on this one: and its time is not that of the wait.
            gl.Flush();
        };
        stats.kernel_launches += gather->sum(rows, std::ref(take));
        return;
    }
    for (int first = rows.first; first < rows.end(); first += band_rows) {
        const RowRange band{first, std::min(band_rows, rows.end() - first)};
        sum.empty(band);
        draw_band(band, stats);
        use(band);
    }
}

void ViewRenderer::Impl::draw_band(RowRange band, RenderStats& stats) {
    const FloatBuffer& to = sum.band();
    if (on_grids)
        sum.tiles().light_all();
    else
        sum.tiles().light(instances, sum.lit_cell_px());
    if (on_grids) stats.draw_calls += grids.draw_band(to, band);
    draw_lights(tail_lights.of(band), stats,
                [&](const LightRun& lights) { return billboards.draw_tails(to, 0, lights); });
    draw_lights(skirt_lights.of(band), stats,
                [&](const LightRun& lights) { return billboards.draw_skirts(to, lights); });
    draw_lights(core_lights.of(band), stats,
                [&](const LightRun& lights) { return billboards.draw_cores(to, lights); });
}

template <typename Draw>
void ViewRenderer::Impl::draw_lights(LightRange range, RenderStats& stats, Draw draw) {
    for (std::size_t i = range.first; i < range.end;) {
        const std::size_t chunk = i / lights_per_chunk;
        const std::size_t first = chunk * lights_per_chunk;
        const std::size_t end = std::min(range.end, first + lights_per_chunk);
        light_buffer.bind(chunk);
        stats.draw_calls += draw(
            LightRun{static_cast<int>(i - first), static_cast<int>(end - i), occlusion.first_texel(first)});
        i = end;
    }
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

// No picture is kept: the bands are made once more, of the lights and the pattern that GL and OpenCL still hold.
void ViewRenderer::Impl::read_hdr(std::span<float> rgba) {
    bind_own_objects();
    occlusion.bind();
    const auto row_floats = static_cast<std::size_t>(width_px) * 4;
    const auto rows_of = [&](RowRange band) {
        return rgba.subspan(static_cast<std::size_t>(band.first) * row_floats,
                            static_cast<std::size_t>(band.count) * row_floats);
    };
    RenderStats not_counted;
    try {
        for_each_band({0, height_px}, not_counted, [&](RowRange band) { sum.band().read(rows_of(band)); });
    } catch (const ClError& error) {
        throw GlError(std::string("reading the glare: ") + error.what());
    }
    if (sum.cell_px() == 0) return;
    const FloatBuffer& grid = sum.grid();
    std::vector<float> cells(static_cast<std::size_t>(grid.width_px()) *
                             static_cast<std::size_t>(grid.height_px()) * 4);
    grid.read(cells);
    add_coarse_grid(cells, grid.width_px(), sum.cell_px(), rgba, width_px);
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
