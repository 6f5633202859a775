// Adds lights to the HDR sum as rectangles drawn in GL, one a light and part of the pattern: tail, skirt, core.
#pragma once

#include "glare/apply/hdr_sum.h"
#include "glare/apply/pattern_texture.h"
#include "glare/apply/screen_geometry.h"
#include "glare/device/gl_program.h"

namespace seaglare::glare {

class GlBillboards {
  public:
    // Throws GlError when a shader does not compile.
    explicit GlBillboards(const Gl& gl);
    // Uploads the pattern when it is another than last time. Throws as PatternTexture::update.
    void begin(const Pattern& pattern) { texture_.update(pattern); }
    // Adds the `count` lights whose LightBuffer is on texture unit 0 and whose visibility on unit 1, from texel first_texel
    // on; their tails on the sum's grid where it has one. Returns the draw calls.
    std::uint32_t draw(const ScreenGeometry& geometry, const Pattern& pattern, bool tails, const HdrSum& sum,
                       int count, int first_texel = 0) const;
    double memory_bytes() const { return texture_.memory_bytes(); }
    void forget();

  private:
    const Gl& gl_;
    GlProgram core_;
    GlProgram skirt_;
    GlProgram tail_;
    PatternTexture texture_;
};

}  // namespace seaglare::glare
