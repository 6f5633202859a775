#include "glare/apply/gl_billboards.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "glare/apply/footprint.h"
#include "glare/apply/layer_moment.h"
#include "glare/apply/screen_uniforms.h"

namespace seaglare::glare {

namespace {

// Texels of LightInstance.
constexpr int skirt_rect_texel = 3;
constexpr int tail_rect_texel = 4;
constexpr int core_rect_texel = 5;
// Of a pattern of the point layer alone: a larger disc than this is drawn as several of them.
constexpr float lone_layer_until_nodes = 0.25F;

}  // namespace

GlBillboards::GlBillboards(const Gl& gl)
    : gl_(gl),
      core_(gl, "core",
            {"geometry.glsl", "lights.glsl", "lash_warp.glsl", "footprint.glsl", "light_quad.vert.glsl"},
            {"geometry.glsl", "lights.glsl", "footprint.glsl", "core.frag.glsl"}),
      fine_(gl, "fine",
            {"geometry.glsl", "lights.glsl", "lash_warp.glsl", "footprint.glsl", "light_quad.vert.glsl"},
            {"geometry.glsl", "lights.glsl", "lash_lookup.glsl", "fine.frag.glsl"}),
      skirt_(gl, "skirt",
             {"geometry.glsl", "lights.glsl", "lash_warp.glsl", "footprint.glsl", "light_quad.vert.glsl"},
             {"geometry.glsl", "lights.glsl", "cie_tail.glsl", "lash_lookup.glsl", "skirt.frag.glsl"}),
      tail_(gl, "tail",
            {"geometry.glsl", "lights.glsl", "lash_warp.glsl", "footprint.glsl", "light_quad.vert.glsl"},
            {"geometry.glsl", "lights.glsl", "cie_tail.glsl", "tail.frag.glsl"}),
      texture_(gl),
      fine_texture_(gl) {
    for (const GlProgram* program : {&core_, &fine_, &skirt_, &tail_}) {
        program->use();
        program->set("lights", 0);
        program->set("visibility", 1);
        program->set("pattern", 2);
    }
    core_.use();
    core_.set("margin_px", kernel_reach_px + 0.5);
    fine_.use();
    fine_.set("fine_nodes", 2);
    fine_.set("fine_per_node", static_cast<double>(fine_per_node));
    fine_.set("fine_radius", static_cast<double>(fine_per_node * fine_radius_nodes));
}

void GlBillboards::begin(const ScreenGeometry& g, const Pattern& pattern, bool tails) {
    texture_.check(pattern);
    const double node_pitch = pattern.pitch > 0 ? pattern.pitch : g.pitch;
    for (const GlProgram* program : {&core_, &fine_, &skirt_, &tail_}) {
        program->use();
        set_geometry(*program, g, node_pitch);
        set_tail(*program, pattern);
    }
    const int layers = pattern.skirt.empty() ? 0 : static_cast<int>(pattern.layer_radius_nodes.size());
    has_skirts_ = layers > 0 || tails;
    std::array<float, most_layers> radii{};
    std::copy_n(pattern.layer_radius_nodes.begin(), layers, radii.begin());
    skirt_.use();
    skirt_.set("radius_nodes", layers > 0 ? pattern.radius_nodes : 0);
    skirt_.set("lash_turn", pattern.lash_turn_rad);
    skirt_.set("lash_bend", pattern.lash_bend_per_rad);
    skirt_.set("layer_count", std::max(layers, 1));
    skirt_.set("layer_radii_a", radii[0], radii[1], radii[2], radii[3]);
    skirt_.set("layer_radii_b", radii[4], radii[5], radii[6], radii[7]);
    core_.use();
    core_.set("core_energy", std::span(pattern.core_energy).first(pattern.lamps.size()));
    const std::vector<float>& discs = pattern.layer_radius_nodes;
    const float next_layer_nodes = discs.size() > 1 ? discs[1] : lone_layer_until_nodes;
    fine_.use();
    fine_.set("fine_moment", static_cast<double>(layer_moment(next_layer_nodes)));
    fine_.set("lash_turn", pattern.lash_turn_rad);
    fine_.set("lash_bend", pattern.lash_bend_per_rad);
    fine_texture_.update(pattern);
    has_fine_ = !pattern.fine.empty();
}

void GlBillboards::take_pattern(const Pattern& pattern, const PatternTexels* texels, bool spare) {
    texture_.update(pattern, texels, spare);
    skirt_.use();
    skirt_.set("pattern_scale", texture_.scale().first(pattern.lamps.size()));
}

std::uint32_t GlBillboards::draw(const GlProgram& program, int rect_texel, int cell_px, const FloatBuffer& to,
                                 const LightRun& lights) const {
    program.use();
    program.set("first_light", lights.first);
    program.set("first_texel", lights.first_texel);
    program.set("rect_texel", rect_texel);
    program.set("cell_px", static_cast<double>(cell_px));
    program.set("buffer_size", static_cast<double>(to.width_px()), static_cast<double>(to.height_px()));
    program.set("buffer_bottom", static_cast<double>(to.first_row()));
    to.bind_for_drawing();
    gl_.Enable(GL_BLEND);
    gl_.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, lights.count);
    return 1;
}

std::uint32_t GlBillboards::draw_tails(const FloatBuffer& to, int cell_px, const LightRun& lights) const {
    return draw(tail_, tail_rect_texel, cell_px, to, lights);
}

std::uint32_t GlBillboards::draw_skirts(const FloatBuffer& to, const LightRun& lights) const {
    if (!has_skirts_) return 0;
    gl_.ActiveTexture(GL_TEXTURE2);
    gl_.BindTexture(GL_TEXTURE_2D_ARRAY, texture_.texture());
    return draw(skirt_, skirt_rect_texel, 0, to, lights);
}

std::uint32_t GlBillboards::draw_cores(const FloatBuffer& to, const LightRun& lights) const {
    const std::uint32_t cores = draw(core_, core_rect_texel, 0, to, lights);
    if (!has_fine_) return cores;
    gl_.ActiveTexture(GL_TEXTURE2);
    gl_.BindTexture(GL_TEXTURE_2D_ARRAY, fine_texture_.texture());
    return cores + draw(fine_, core_rect_texel, 0, to, lights);
}

void GlBillboards::forget() {
    for (GlProgram* program : {&core_, &fine_, &skirt_, &tail_})
        program->forget();
    texture_.forget();
    fine_texture_.forget();
}

}  // namespace seaglare::glare
