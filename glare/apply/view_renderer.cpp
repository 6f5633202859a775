#include "glare/apply/view_renderer.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "glare/apply/cl_gather.h"
#include "glare/apply/compositor.h"
#include "glare/apply/gl_billboards.h"
#include "glare/apply/hdr_sum.h"
#include "glare/apply/light_buffer.h"
#include "glare/apply/light_instance.h"
#include "glare/apply/occlusion.h"
#include "glare/device/cl_signal_guard.h"
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

// The rows that the lights' skirts and cores reach; tails are on the coarse grid.
struct Rows {
    int first = 0;
    int count = 1;
};
Rows rows_of(std::span<const LightInstance> lights, int height_px) {
    float bottom = static_cast<float>(height_px);
    float top = 0;
    for (const LightInstance& light : lights) {
        for (const RectPx& rect : {light.skirt_rect, light.core_rect}) {
            if (rect[2] <= rect[0] || rect[3] <= rect[1]) continue;
            bottom = std::min(bottom, rect[1]);
            top = std::max(top, rect[3]);
        }
    }
    const int first = std::clamp(static_cast<int>(std::floor(bottom)), 0, height_px - 1);
    const int end = std::clamp(static_cast<int>(std::ceil(top)), first + 1, height_px);
    return {first, end - first};
}

double area_px(const RectPx& rect) {
    const double width = static_cast<double>(rect[2]) - static_cast<double>(rect[0]);
    const double height = static_cast<double>(rect[3]) - static_cast<double>(rect[1]);
    return std::max(width, 0.0) * std::max(height, 0.0);
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
    DeviceMemory memory() const {
        DeviceMemory memory;
        memory.hdr = sum.full.memory_bytes();
        memory.coarse_grid = sum.coarse.memory_bytes();
        memory.background = compositor.memory_bytes();
        memory.occlusion = occlusion.memory_bytes();
        memory.lights = light_buffer.memory_bytes();
        memory.pattern_layers = billboards.memory_bytes();
        if (gather) memory.accumulation = gather->memory_bytes();
        return memory;
    }

    // Replaces sum.full by what is gathered, and leaves the rest of those lights, their cores, in `instances`.
    void add_gathered(const ScreenGeometry& g, const Pattern& pattern, const ReachSettings& reach,
                      double most_unknown_px, RenderStats& stats);
    void wait_for_unknown(const Pattern& pattern, int cell_px, double most_px, RenderStats& stats);

    const Gl gl;
    PassTimer timer;
    GlObject vertex_array, sampler;
    LightBuffer light_buffer;
    Occlusion occlusion;
    GlBillboards billboards;
    Compositor compositor;
    HdrSum sum;
    std::vector<LightInstance> instances;
    std::vector<std::uint32_t> tags;   // of the instances
    std::unique_ptr<ClGather> gather;  // null: cannot, or need not
    std::vector<float> visible;        // of the instances, where anything can hide them
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

RenderResult ViewRenderer::Impl::render(const Frame& frame, const ToneSettings& tone, const Pattern& pattern,
                                        std::span<const PointSource> sources, const AccumulationPlan& plan,
                                        RenderStats& stats) {
    const ScreenGeometry g = screen_geometry(frame);
    const bool has_tail = pattern.tail_scale > 0 && plan.tail_cell_px > 0;
    ReachSettings reach;
    reach.cell_px = has_tail ? std::min(coarse_cell_px(g, pattern), plan.tail_cell_px) : 1;
    // A grid of single pixels would be a second picture, and blurred by half a pixel: those tails go where skirts do.
    const int cell = reach.cell_px > 1 ? reach.cell_px : 0;
    reach.threshold_cd_m2 = plan.skirt_threshold_cd_m2;
    reach.tail_threshold_cd_m2 = plan.tail_threshold_cd_m2;
    reach.disc_scale = plan.disc_scale;
    reach.tails = has_tail;
    instances.clear();
    tags.clear();
    const PixelRect touched = append_instances(g, pattern, reach, sources, instances, &tags);
    stats.lights_outside += static_cast<std::uint32_t>(sources.size() - instances.size());
    nothing_drawn = true;
    if (instances.empty()) {
        width_px = g.width_px;
        height_px = g.height_px;
        return RenderResult::nothing_to_draw;
    }

    PassTimer::Frame passes(timer, Pass::upload);
    // Everything that can fail comes before the first change to the target.
    set_neutral_state(gl);
    for (GLuint unit = 0; unit < touched_texture_units; ++unit)
        gl.BindSampler(unit, sampler.name());
    gl.BindVertexArray(vertex_array.name());
    compositor.begin(frame);
    bool gathers = gather && plan.method == Accumulation::cl_tiles;
    occlusion.want_known(gathers);
    occlusion.begin(frame, instances, tags);
    // What is gathered has all tails at full resolution, and so every row.
    const bool tails_in_full = gathers || (has_tail && cell == 0);
    const Rows rows = tails_in_full ? Rows{0, g.height_px} : rows_of(instances, g.height_px);
    sum.resize(g.width_px, g.height_px, rows.first, rows.count, cell);
    width_px = g.width_px;
    height_px = g.height_px;
    billboards.begin(pattern);
    if (gathers && frame.occlusion.wait && occlusion.can_hide()) {
        for (std::size_t first = 0; first < instances.size(); first += lights_per_chunk) {
            const std::size_t count = std::min(lights_per_chunk, instances.size() - first);
            passes.enter(Pass::upload);
            light_buffer.upload(std::span<const LightInstance>(instances).subspan(first, count));
            passes.enter(Pass::occlusion);
            stats.draw_calls += occlusion.draw(frame, g, first, static_cast<int>(count));
        }
        occlusion.wait();
    }
    if (gathers) {
        passes.enter(Pass::accumulate);
        try {
            add_gathered(g, pattern, reach, plan.most_unknown_px, stats);
        } catch (const ClError&) {
            // A device that fails once is not asked again: from now on rectangles are drawn.
            gather.reset();
            gathers = false;
        }
    }

    for (std::size_t first = 0; first < instances.size(); first += lights_per_chunk) {
        const std::size_t count = std::min(lights_per_chunk, instances.size() - first);
        passes.enter(Pass::upload);
        light_buffer.upload(std::span<const LightInstance>(instances).subspan(first, count));
        if (first == 0) {  // here: what follows the occlusion reads it, see there
            if (!gathers)
                sum.clear();
            else if (cell > 0)
                sum.clear_coarse();
        }
        passes.enter(Pass::occlusion);
        stats.draw_calls += occlusion.draw(frame, g, first, static_cast<int>(count));
        passes.enter(Pass::accumulate);
        stats.draw_calls +=
            billboards.draw(g, pattern, has_tail, sum, static_cast<int>(count), occlusion.first_texel(first));
    }

    occlusion.end();

    passes.enter(Pass::composite);
    stats.draw_calls += compositor.draw(frame, tone, sum, touched);
    stats.cpu = passes.finish();
    stats.gpu = timer.gpu();
    stats.lights_drawn += static_cast<std::uint32_t>(instances.size());
    stats.memory = memory();
    nothing_drawn = false;
    return RenderResult::drawn;
}

void ViewRenderer::Impl::add_gathered(const ScreenGeometry& g, const Pattern& pattern,
                                      const ReachSettings& reach, double most_unknown_px,
                                      RenderStats& stats) {
    visible.clear();
    if (occlusion.can_hide()) {
        for (const std::uint32_t tag : tags)
            visible.push_back(occlusion.known(tag).value_or(-1.0F));
    }
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, sum.full.texture());
    std::uint32_t launches = gather->prepare({g, pattern, reach, instances, visible});
    launches += gather->sum({0, g.height_px}, [&](RowRange band, std::span<const float> rgbv) {
        gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, band.first, g.width_px, band.count, GL_RGBA, GL_FLOAT,
                         rgbv.data());
    });
    // Of those that are in the sum the billboards draw nothing but the core.
    for (std::size_t i = 0; i < instances.size(); ++i) {
        if (!is_gathered(pattern, instances[i], visible.empty() ? 1.0F : visible[i])) continue;
        instances[i].skirt_rect = {};
        instances[i].tail_rect = {};
        ++stats.lights_gathered;
    }
    stats.kernel_launches += launches;
    if (!visible.empty()) wait_for_unknown(pattern, reach.cell_px, most_unknown_px, stats);
}

// All or none: of a few that come into view the rectangles cost little; of a thousand, after a cut, the next frame's gather
// is there before a software rasteriser has drawn the half of them.
void ViewRenderer::Impl::wait_for_unknown(const Pattern& pattern, int cell_px, double most_px,
                                          RenderStats& stats) {
    const auto waits = [&](std::size_t i) {
        return visible[i] < 0 && is_gathered(pattern, instances[i], 1.0F);
    };
    double needed_px = 0;
    for (std::size_t i = 0; i < instances.size(); ++i) {
        if (!waits(i)) continue;
        needed_px +=
            area_px(instances[i].skirt_rect) + area_px(instances[i].tail_rect) / (cell_px * cell_px);
    }
    if (needed_px <= most_px) return;
    for (std::size_t i = 0; i < instances.size(); ++i) {
        if (!waits(i)) continue;
        instances[i].skirt_rect = {};
        instances[i].tail_rect = {};
        ++stats.lights_late;
    }
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
        auto gather = std::make_unique<ClGather>();
        gather->warm_up();
        impl_->gather = std::move(gather);
    } catch (const std::runtime_error&) {
        return false;
    }
    return true;
}

bool ViewRenderer::can_gather() const {
    return impl_->gather != nullptr;
}

void ViewRenderer::read_hdr(std::span<float> rgba) const {
    const Impl& self = *impl_;
    const std::size_t needed =
        static_cast<std::size_t>(self.width_px) * static_cast<std::size_t>(self.height_px) * 4;
    if (rgba.size() < needed) throw std::invalid_argument("read_hdr: the buffer is smaller than the picture");
    const std::span<float> picture = rgba.first(needed);
    if (self.nothing_drawn) {
        std::fill(picture.begin(), picture.end(), 0.0F);
        return;
    }
    set_neutral_pixel_store(self.gl);
    self.sum.full.read(picture);
    const int cell_px = self.sum.cell_px;
    if (cell_px == 0) return;
    const FloatBuffer& coarse = self.sum.coarse;
    std::vector<float> grid(static_cast<std::size_t>(coarse.width_px()) *
                            static_cast<std::size_t>(coarse.height_px()) * 4);
    coarse.read(grid);
    add_coarse_grid(grid, coarse.width_px(), cell_px, picture, self.width_px);
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
