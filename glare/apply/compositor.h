// The last pass: tone maps the HDR sum with what the host has drawn and adds the difference to its target.
#pragma once

#include <array>
#include <optional>

#include "glare/apply/hdr_sum.h"
#include "glare/apply/screen_geometry.h"
#include "glare/apply/target_reader.h"
#include "glare/device/gl_program.h"
#include "glare/tone/tone_settings.h"

namespace seaglare::glare {

// Whole pixels of the viewport; right and top are beyond the last.
struct PixelBox {
    int left = 0, bottom = 0, right = 0, top = 0;
};
// The pixels that change where light touches `touched`, on a grid of `cell_px` too (0: there is none).
PixelBox box_of(const PixelRect& touched, int cell_px, int width_px, int height_px);

class Compositor {
  public:
    // Throws GlError when the shader does not compile.
    explicit Compositor(const Gl& gl);
    // Throws as TargetReader::inspect, and as the constructor where the target is of a kind that no frame had before; the
    // target has not been touched then.
    void begin(const Frame& frame);
    // Writes a rectangle of the viewport, within the rows of the sum's band, with one draw call. Uses texture units 0, 2, 3;
    // leaves all colours writable and no scissor.
    void draw(const Frame& frame, const ToneSettings& tone, const HdrSum& sum, const PixelBox& box);
    double memory_bytes() const { return reader_.memory_bytes(); }
    void forget();

  private:
    // What is added to the target: composite.frag.glsl's ADDS.
    enum Adds { codes, dithered_light, light };
    // Without and with a coarse grid.
    using Programs = std::array<GlProgram, 2>;

    void compile(Adds adds);
    void bind(GLenum unit, GLuint texture) const {
        gl_.ActiveTexture(unit);
        gl_.BindTexture(GL_TEXTURE_2D, texture);
    }

    const Gl& gl_;
    std::array<std::optional<Programs>, 3> programs_;  // by what they add; those that a frame has needed
    TargetReader reader_;
    TargetFormat target_;
    Adds adds_ = codes;
    double code_ = 0;  // of the target, of its range; 0: they are so fine that no dither is needed
};

}  // namespace seaglare::glare
