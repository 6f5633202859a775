// Adds lights to the HDR sum in GL as shaders/gather.cl does in OpenCL: the mean of each over the azimuth on a pyramid of
// grids, and on the picture what its pattern has beside it. glare/apply/tile_lists.h decides what goes where, with which error.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "glare/apply/accumulator.h"
#include "glare/apply/grid_quads.h"
#include "glare/apply/grid_textures.h"
#include "glare/apply/hdr_buffers.h"
#include "glare/apply/pattern_texture.h"
#include "glare/apply/tile_lists.h"
#include "glare/device/gl_program.h"

namespace seaglare::glare {

class GlGrids {
  public:
    // Throws GlError when a shader does not compile. `plain` is the sampler that is bound to every unit, and is again when
    // anything has been drawn.
    GlGrids(const Gl& gl, const GlObject& plain);

    // Whose skirts and tails it draws: never lamps larger than the largest layer. Their cores are left to the billboards.
    static bool takes(const Pattern& pattern, const LightInstance& light) {
        return is_gathered(pattern, light, 1);
    }
    // Takes up those of input.lights that it takes(), as if nothing hid them; input.visible is what is known of them, none
    // where nothing can hide them. Draws nothing yet, but clears. False: this GL cannot hold so many, and nothing of it may
    // be drawn. Throws GlError.
    bool prepare(const AccumulationInput& input);
    // The grids of what was prepared; `pattern` holds input.pattern, also for the bands. What hides the lights is on texture
    // unit 1, light by light (Occlusion).
    std::uint32_t draw_grids(const PatternTexture& pattern);
    // Adds a band of the picture to `to`. May be called again.
    std::uint32_t draw_band(const FloatBuffer& to, RowRange band);

    const TileLists& lists() const { return lists_; }
    const GridQuads& quads() const { return quads_; }
    double grid_bytes() const;
    double light_bytes() const { return static_cast<double>(bytes_); }
    double table_bytes() const { return textures_.memory_bytes(); }
    void forget();

  private:
    template <typename Visit>
    void for_each_program(Visit visit);
    void set_uniforms(const AccumulationInput& input);
    bool upload();
    void bind(GLuint pattern) const;
    std::uint32_t upsample(const FloatBuffer& to, int level) const;
    std::uint32_t draw(QuadKind kind, const FloatBuffer& to, const GridLevel& grid, QuadRange quads) const;
    const GlProgram& program_of(QuadKind kind) const;

    const Gl& gl_;
    std::array<GlProgram, quad_kinds> programs_;
    // Of patterns that lashes turn and bend: whatever the kind.
    GlProgram near_lashes_;
    GlProgram departs_lashes_;
    GlProgram upsample_;
    const GlObject& plain_;
    GlObject linear_;  // the sampler of departures
    GridTextures textures_;
    TileLists lists_;
    GridQuads quads_;
    std::vector<FloatBuffer> grids_;  // level 1 first
    bool lashes_ = false;
    double tail_from_nodes_ = 0;
    int tail_table_ = 0;
    std::size_t slots_ = 0;  // of the pattern
    GLuint pattern_ = 0;     // its texture
    GlObject buffer_;        // lights, then rectangles
    GlObject buffer_texture_;
    std::size_t bytes_ = 0;
    std::size_t most_bytes_ = 0;                 // that this GL reads of such a buffer
    std::vector<std::array<float, 20>> texels_;  // of lights, on their way to GL
};

}  // namespace seaglare::glare
