#include "glare/apply/screen_uniforms.h"

#include <array>
#include <cmath>

namespace seaglare::glare {

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

}  // namespace seaglare::glare
