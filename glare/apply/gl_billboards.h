// Adds lights to the HDR sum as rectangles drawn in GL, one a light and part of the pattern: tail, skirt, core.
#pragma once

#include "glare/apply/fine_texture.h"
#include "glare/apply/hdr_buffers.h"
#include "glare/apply/pattern_texture.h"
#include "glare/apply/screen_geometry.h"
#include "glare/device/gl_program.h"

namespace seaglare::glare {

// Lights drawn with one call: consecutive ones of the LightBuffer's chunk on texture unit 0, whose visibility is on unit 1.
struct LightRun {
    int first = 0;
    int count = 0;
    int first_texel = 0;  // of the chunk's first light in the visibility
};

class GlBillboards {
  public:
    // Throws GlError when a shader does not compile.
    explicit GlBillboards(const Gl& gl);
    // What the draws of a frame share; `tails`: whether any are drawn. Throws as PatternTexture::check.
    void begin(const ScreenGeometry& geometry, const Pattern& pattern, bool tails);
    // Before skirts are drawn. Uploads the pattern when it is another than last time; keeps nothing of it but what is in GL.
    // `texels` and `spare` as PatternTexture::update.
    void take_pattern(const Pattern& pattern, const PatternTexels* texels, bool spare);
    // Instead of it where none is drawn.
    void reserve_pattern(const Pattern& pattern) { texture_.reserve(pattern); }
    // Each adds one of the lights' parts to a buffer and returns the draw calls. The tails' is a grid of `cell_px`, or with 0
    // has full resolution.
    std::uint32_t draw_tails(const FloatBuffer& to, int cell_px, const LightRun& lights) const;
    std::uint32_t draw_skirts(const FloatBuffer& to, const LightRun& lights) const;
    std::uint32_t draw_cores(const FloatBuffer& to, const LightRun& lights) const;
    const PatternTexture& pattern() const { return texture_; }
    double memory_bytes() const { return texture_.memory_bytes() + fine_texture_.memory_bytes(); }
    void forget();

  private:
    std::uint32_t draw(const GlProgram& program, int rect_texel, int cell_px, const FloatBuffer& to,
                       const LightRun& lights) const;

    const Gl& gl_;
    GlProgram core_;
    GlProgram fine_;
    GlProgram skirt_;
    GlProgram tail_;
    PatternTexture texture_;
    FineTexture fine_texture_;
    bool has_fine_ = false;
    bool has_skirts_ = false;  // without layers and tails a skirt is nothing
};

}  // namespace seaglare::glare
