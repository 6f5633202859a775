#include "glare/apply/view_renderer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "glare/apply/depth_model.h"
#include "glare/apply/depth_reader.h"
#include "glare/apply/hdr_buffers.h"
#include "glare/apply/light_instance.h"
#include "glare/apply/pattern_texture.h"
#include "glare/apply/target_reader.h"
#include "glare/device/gl_program.h"
#include "glare/device/gl_touched_state.h"
#include "glare/tone/operators.h"

namespace seaglare::glare {

namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Lights drawn with one call: eight texels each stay within the 65536 texels of a buffer texture that GL promises.
constexpr std::size_t lights_per_chunk = 8192;
constexpr int visibility_width = 256;
constexpr int visibility_height = static_cast<int>(lights_per_chunk) / visibility_width;
// More lights than this share a threshold on the coarse grid: beyond, their tails hardly fall on the same pixels.
constexpr double largest_tail_share = 64;

// Texels of LightInstance.
constexpr int skirt_rect_texel = 3;
constexpr int tail_rect_texel = 4;
constexpr int core_rect_texel = 5;

void set_geometry(const GlProgram& program, const ScreenGeometry& g, double node_pitch) {
    std::array<float, 9> ray{};
    for (std::size_t i = 0; i < ray.size(); ++i)
        ray[i] = static_cast<float>(g.ray_from_ndc[i]);
    program.gl().UniformMatrix3fv(program.location("ray_from_ndc"), 1, GL_FALSE, ray.data());
    program.set("viewport_px", static_cast<double>(g.width_px), static_cast<double>(g.height_px));
    program.set("screen_forward", g.forward[0], g.forward[1], g.forward[2]);
    program.set("screen_right", g.right[0], g.right[1], g.right[2]);
    program.set("screen_up", g.up[0], g.up[1], g.up[2]);
    program.set("pixel_plane_area", g.plane_area_px);
    program.set("pitch", node_pitch);
}

void set_tail(const GlProgram& program, const Pattern& pattern) {
    program.set("tail_scale", pattern.tail_scale);
    program.set("tail_age4", std::pow(pattern.tail_age_years / 70, 4));
    program.set("tail_pigment", pattern.tail_pigmentation);
    program.set("window_inner", pattern.window_inner);
    program.set("window_outer", pattern.window_outer);
}

void set_depth(const GlProgram& program, const DepthModel& model, const DepthImage& image) {
    program.set("depth_origin", image.origin_px[0], image.origin_px[1]);
    program.set("depth_size", image.width_px, image.height_px);
    program.set("depth_logarithmic", model.logarithmic ? 1 : 0);
    program.set("depth_log", model.log_c, model.log_range);
    program.set("depth_scale_anchor", model.scale, model.anchor);
    program.set("depth_far_z", model.far_z);
    program.set("depth_offset", model.offset[0], model.offset[1], model.offset[2]);
    program.set("depth_constants", model.z_constant, model.w_constant);
    program.set("depth_row_w", model.row_w[0], model.row_w[1], model.row_w[2]);
    // A float near zero, where a reversed projection has its far plane, is exact in proportion; anywhere else it is
    // not better than its largest values.
    const bool proportional = image.quantum_relative > 0 && model.far_z == 0 && model.anchor == 0;
    program.set("depth_quantum", proportional ? 0.0 : image.quantum);
    program.set("depth_quantum_relative", proportional ? image.quantum_relative : 0.0);
}

}  // namespace

struct ViewRenderer::Impl {
    explicit Impl(const Gl& table);

    RenderResult render(const Frame& frame, const ToneSettings& tone, const Pattern& pattern,
                        std::span<const PointSource> sources, RenderStats& stats);
    void resize(const ScreenGeometry& g, int cell);
    void upload(std::span<const LightInstance> chunk);
    void draw_visibility(const Frame& frame, const ScreenGeometry& g, const DepthImage& depth,
                         int count) const;
    void draw_lights(const ScreenGeometry& g, const Pattern& pattern, int cell, int count,
                     RenderStats& stats) const;
    void composite(const Frame& frame, const ToneSettings& tone, const TargetFormat& target, int cell,
                   const PixelRect& touched);
    void bind(GLenum unit, GLenum target, GLuint texture) const {
        gl.ActiveTexture(unit);
        gl.BindTexture(target, texture);
    }
    double memory_bytes() const;

    const Gl gl;
    GlProgram visibility_program, visibility_ms_program, core_program, skirt_program, tail_program,
        composite_program;
    GlObject vertex_array, sampler, light_buffer, light_texture;
    FloatBuffer hdr, coarse, visibility;
    PatternTexture pattern_texture;
    DepthReader depth_reader;
    TargetReader target_reader;
    std::vector<LightInstance> instances;
    std::size_t light_buffer_bytes = 0;
    int cell_px = 0;  // of the coarse grid in the last frame; 0: there was none
    int width_px = 0;
    int height_px = 0;
    bool nothing_drawn = true;
};

ViewRenderer::Impl::Impl(const Gl& table)
    : gl(table),
      visibility_program(gl, "visibility", {"screen.vert.glsl"},
                         {"geometry.glsl", "lights.glsl", "footprint.glsl", "visibility.frag.glsl"}),
      visibility_ms_program(gl, "visibility of multisampled depth", {"screen.vert.glsl"},
                            {"geometry.glsl", "lights.glsl", "footprint.glsl", "visibility.frag.glsl"},
                            "#define SEAGLARE_DEPTH_MS\n"),
      core_program(gl, "core", {"geometry.glsl", "lights.glsl", "lash_warp.glsl", "light_quad.vert.glsl"},
                   {"geometry.glsl", "lights.glsl", "footprint.glsl", "core.frag.glsl"}),
      skirt_program(gl, "skirt", {"geometry.glsl", "lights.glsl", "lash_warp.glsl", "light_quad.vert.glsl"},
                    {"geometry.glsl", "lights.glsl", "cie_tail.glsl", "skirt.frag.glsl"}),
      tail_program(gl, "tail", {"geometry.glsl", "lights.glsl", "lash_warp.glsl", "light_quad.vert.glsl"},
                   {"geometry.glsl", "lights.glsl", "cie_tail.glsl", "tail.frag.glsl"}),
      composite_program(gl, "composite", {"screen.vert.glsl"}, {"tone.glsl", "composite.frag.glsl"}),
      vertex_array(gl, GlKind::vertex_array),
      sampler(gl, GlKind::sampler),
      light_buffer(gl, GlKind::buffer),
      light_texture(gl, GlKind::texture),
      hdr(gl),
      coarse(gl),
      visibility(gl),
      pattern_texture(gl),
      depth_reader(gl),
      target_reader(gl) {
    for (const GLenum parameter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
        gl.SamplerParameteri(sampler.name(), parameter, GL_NEAREST);
    }
    for (const GLenum parameter : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
        gl.SamplerParameteri(sampler.name(), parameter, GL_CLAMP_TO_EDGE);
    }
    // The host's depth texture may compare: ours must not.
    gl.SamplerParameteri(sampler.name(), GL_TEXTURE_COMPARE_MODE, GL_NONE);
    set_neutral_pixel_store(gl);
    visibility.resize(GL_R32F, visibility_width, visibility_height, "the lights' visibility buffer");
    light_buffer_bytes = 64 * sizeof(LightInstance);
    gl.BindBuffer(GL_TEXTURE_BUFFER, light_buffer.name());
    gl.BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(light_buffer_bytes), nullptr, GL_STREAM_DRAW);
    bind(GL_TEXTURE0, GL_TEXTURE_BUFFER, light_texture.name());
    gl.TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, light_buffer.name());

    // Which unit a sampler reads from never changes.
    for (const GlProgram* program : {&visibility_program, &visibility_ms_program, &core_program,
                                     &skirt_program, &tail_program, &composite_program}) {
        program->use();
        program->set("lights", 0);
        program->set("visibility", 1);
        program->set("pattern", 2);
        program->set("depth", 2);
        program->set("hdr", 0);
        program->set("coarse", 1);
        program->set("background", 2);
    }
    gl.UseProgram(0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

void ViewRenderer::Impl::resize(const ScreenGeometry& g, int cell) {
    hdr.resize(GL_RGBA32F, g.width_px, g.height_px, "the HDR buffer");
    if (cell > 0) {
        coarse.resize(GL_RGBA32F, (2 * g.width_px - 1) / (2 * cell) + 2,
                      (2 * g.height_px - 1) / (2 * cell) + 2, "the coarse HDR buffer");
    }
    width_px = g.width_px;
    height_px = g.height_px;
    cell_px = cell;
}

void ViewRenderer::Impl::upload(std::span<const LightInstance> chunk) {
    gl.BindBuffer(GL_TEXTURE_BUFFER, light_buffer.name());
    light_buffer_bytes = std::max(light_buffer_bytes, chunk.size_bytes());
    // Orphaned: the GPU may still be reading the last frame's lights.
    gl.BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(light_buffer_bytes), nullptr, GL_STREAM_DRAW);
    gl.BufferSubData(GL_TEXTURE_BUFFER, 0, static_cast<GLsizeiptr>(chunk.size_bytes()), chunk.data());
    bind(GL_TEXTURE0, GL_TEXTURE_BUFFER, light_texture.name());
}

void ViewRenderer::Impl::draw_visibility(const Frame& frame, const ScreenGeometry& g, const DepthImage& depth,
                                         int count) const {
    const bool multisampled = depth.samples > 0 && depth.target == GL_TEXTURE_2D_MULTISAMPLE;
    const GlProgram& program = multisampled ? visibility_ms_program : visibility_program;
    program.use();
    set_geometry(program, g, g.pitch);
    program.set("light_count", count);
    program.set("depth_samples", depth.samples);
    if (depth.samples > 0) {
        set_depth(program, depth_model(frame), depth);
        bind(GL_TEXTURE2, depth.target, depth.texture);
    }
    gl.Disable(GL_BLEND);
    visibility.bind_for_drawing();
    gl.Viewport(0, 0, visibility_width, (count + visibility_width - 1) / visibility_width);
    gl.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void ViewRenderer::Impl::draw_lights(const ScreenGeometry& g, const Pattern& pattern, int cell, int count,
                                     RenderStats& stats) const {
    const double node_pitch = pattern.pitch > 0 ? pattern.pitch : g.pitch;
    bind(GL_TEXTURE1, GL_TEXTURE_2D, visibility.texture());
    gl.Enable(GL_BLEND);
    const auto draw = [&](const GlProgram& program, int rect_texel, int cell_size,
                          const FloatBuffer& buffer) {
        program.use();
        set_geometry(program, g, node_pitch);
        set_tail(program, pattern);
        program.set("rect_texel", rect_texel);
        program.set("cell_px", static_cast<double>(cell_size));
        program.set("buffer_size", static_cast<double>(buffer.width_px()),
                    static_cast<double>(buffer.height_px()));
        buffer.bind_for_drawing();
    };
    if (cell > 0) {
        draw(tail_program, tail_rect_texel, cell, coarse);
        gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
        ++stats.draw_calls;
    }
    if (pattern_texture.layer_count() > 0 || cell > 0) {
        draw(skirt_program, skirt_rect_texel, 1, hdr);
        std::array<float, most_layers> radii{};
        for (int i = 0; i < pattern_texture.layer_count(); ++i) {
            radii[static_cast<std::size_t>(i)] = pattern.layer_radius_nodes[static_cast<std::size_t>(i)];
        }
        skirt_program.set("radius_nodes", pattern_texture.layer_count() > 0 ? pattern.radius_nodes : 0);
        skirt_program.set("lash_turn", pattern.lash_turn_rad);
        skirt_program.set("lash_bend", pattern.lash_bend_per_rad);
        skirt_program.set("layer_count", std::max(pattern_texture.layer_count(), 1));
        skirt_program.set("layer_radii_a", radii[0], radii[1], radii[2], radii[3]);
        skirt_program.set("layer_radii_b", radii[4], radii[5], radii[6], radii[7]);
        bind(GL_TEXTURE2, GL_TEXTURE_2D_ARRAY, pattern_texture.texture());
        gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
        ++stats.draw_calls;
    }
    draw(core_program, core_rect_texel, 1, hdr);
    for (std::size_t slot = 0; slot < pattern.lamps.size(); ++slot) {
        const std::string name = "core_energy[" + std::to_string(slot) + "]";
        const Rgbv& energy = pattern.core_energy[slot];
        core_program.set(name.c_str(), energy[0], energy[1], energy[2], energy[3]);
    }
    gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
    ++stats.draw_calls;
}

void ViewRenderer::Impl::composite(const Frame& frame, const ToneSettings& tone, const TargetFormat& target,
                                   int cell, const PixelRect& touched) {
    const int left = std::clamp(static_cast<int>(std::floor(touched.left)) - cell, 0, width_px);
    const int bottom = std::clamp(static_cast<int>(std::floor(touched.bottom)) - cell, 0, height_px);
    const int right = std::clamp(static_cast<int>(std::ceil(touched.right)) + cell, 0, width_px);
    const int top = std::clamp(static_cast<int>(std::ceil(touched.top)) + cell, 0, height_px);
    target_reader.copy_background(frame, target, left, bottom, right - left, top - bottom);

    composite_program.use();
    const ToneCurve curve = tone_curve(tone, frame.adaptation_luminance_cd_m2);
    composite_program.set("tone_scale", curve.scale);
    composite_program.set("tone_inverse_white2", curve.inverse_white2);
    composite_program.set("ldr_white", std::max(frame.ldr_white_luminance_cd_m2, 0.0));
    composite_program.set("blue_shift", tone.blue_shift ? 1 : 0);
    composite_program.set("difference_mode", tone.mode == CompositeMode::difference ? 1 : 0);
    composite_program.set("cell_px", static_cast<double>(cell));
    composite_program.set("viewport_origin", frame.viewport_px[0], frame.viewport_px[1]);
    composite_program.set("encoding", static_cast<int>(frame.target_encoding));
    const bool dither = tone.dither && !target.floating && target.red_bits > 0 && target.red_bits <= 10;
    composite_program.set("dither_step", dither ? 1 / (std::exp2(target.red_bits) - 1) : 0.0);
    bind(GL_TEXTURE0, GL_TEXTURE_2D, hdr.texture());
    if (cell > 0) bind(GL_TEXTURE1, GL_TEXTURE_2D, coarse.texture());
    bind(GL_TEXTURE2, GL_TEXTURE_2D, target_reader.background());

    gl.BindFramebuffer(GL_FRAMEBUFFER, frame.target_fbo);
    gl.Viewport(frame.viewport_px[0], frame.viewport_px[1], width_px, height_px);
    gl.Enable(GL_SCISSOR_TEST);
    gl.Scissor(frame.viewport_px[0] + left, frame.viewport_px[1] + bottom, right - left, top - bottom);
    // Only the colour that fragment output 0 goes to, and no alpha: the host's other buffers are not ours.
    gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gl.ColorMaski(0, GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
    gl.Enable(GL_BLEND);
    if (frame.target_encoding == TargetEncoding::srgb_format)
        gl.Enable(GL_FRAMEBUFFER_SRGB);
    else
        gl.Disable(GL_FRAMEBUFFER_SRGB);
    gl.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

double ViewRenderer::Impl::memory_bytes() const {
    return hdr.memory_bytes() + coarse.memory_bytes() + visibility.memory_bytes() +
           pattern_texture.memory_bytes() + depth_reader.memory_bytes() + target_reader.memory_bytes() +
           static_cast<double>(light_buffer_bytes);
}

RenderResult ViewRenderer::Impl::render(const Frame& frame, const ToneSettings& tone, const Pattern& pattern,
                                        std::span<const PointSource> sources, RenderStats& stats) {
    const auto start = Clock::now();
    const ScreenGeometry g = screen_geometry(frame);
    const int cell = pattern.tail_scale > 0 ? coarse_cell_px(g, pattern) : 0;
    ReachSettings reach;
    reach.cell_px = std::max(cell, 1);
    reach.threshold_cd_m2 =
        threshold_luminance_cd_m2(tone, frame.adaptation_luminance_cd_m2, tone.threshold_codes);
    reach.tail_threshold_cd_m2 =
        reach.threshold_cd_m2 / std::clamp(static_cast<double>(sources.size()), 1.0, largest_tail_share);
    instances.clear();
    const PixelRect touched = append_instances(g, pattern, reach, sources, instances);
    stats.lights_outside += static_cast<std::uint32_t>(sources.size() - instances.size());
    if (instances.empty()) {
        width_px = g.width_px;
        height_px = g.height_px;
        nothing_drawn = true;
        return RenderResult::nothing_to_draw;
    }

    // Everything that can fail comes before the first change to the target.
    set_neutral_state(gl);
    for (GLuint unit = 0; unit < touched_texture_units; ++unit)
        gl.BindSampler(unit, sampler.name());
    gl.BindVertexArray(vertex_array.name());
    const TargetFormat target = target_reader.inspect(frame);
    const DepthImage depth = depth_reader.read(frame);
    nothing_drawn = true;
    resize(g, cell);
    pattern_texture.update(pattern);
    stats.upload_ms += ms_since(start);

    const auto accumulate_start = Clock::now();
    hdr.bind_for_drawing();
    hdr.clear();
    if (cell > 0) {
        coarse.bind_for_drawing();
        coarse.clear();
    }
    for (std::size_t first = 0; first < instances.size(); first += lights_per_chunk) {
        const std::size_t count = std::min(lights_per_chunk, instances.size() - first);
        upload(std::span<const LightInstance>(instances).subspan(first, count));
        draw_visibility(frame, g, depth, static_cast<int>(count));
        ++stats.draw_calls;
        draw_lights(g, pattern, cell, static_cast<int>(count), stats);
    }
    stats.accumulate_ms += ms_since(accumulate_start);

    const auto composite_start = Clock::now();
    composite(frame, tone, target, cell, touched);
    ++stats.draw_calls;
    stats.composite_ms += ms_since(composite_start);
    stats.lights_drawn += static_cast<std::uint32_t>(instances.size());
    stats.gl_memory_bytes = memory_bytes();
    nothing_drawn = false;
    return RenderResult::drawn;
}

ViewRenderer::ViewRenderer(const Gl& gl) : impl_(std::make_unique<Impl>(gl)) {}

ViewRenderer::~ViewRenderer() = default;

void ViewRenderer::abandon() {
    Impl& self = *impl_;
    for (GlProgram* program : {&self.visibility_program, &self.visibility_ms_program, &self.core_program,
                               &self.skirt_program, &self.tail_program, &self.composite_program}) {
        program->forget();
    }
    for (GlObject* object : {&self.vertex_array, &self.sampler, &self.light_buffer, &self.light_texture}) {
        object->forget();
    }
    self.hdr.forget();
    self.coarse.forget();
    self.visibility.forget();
    self.pattern_texture.forget();
    self.depth_reader.forget();
    self.target_reader.forget();
}

RenderResult ViewRenderer::render(const Frame& frame, const ToneSettings& tone, const Pattern& pattern,
                                  std::span<const PointSource> sources, RenderStats& stats) {
    return impl_->render(frame, tone, pattern, sources, stats);
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
    self.hdr.read(picture);
    if (self.cell_px == 0) return;
    std::vector<float> grid(static_cast<std::size_t>(self.coarse.width_px()) *
                            static_cast<std::size_t>(self.coarse.height_px()) * 4);
    self.coarse.read(grid);
    add_coarse_grid(grid, self.coarse.width_px(), self.cell_px, picture, self.width_px);
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

}  // namespace seaglare::glare
