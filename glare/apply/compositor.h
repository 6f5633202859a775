// The last pass: tone maps the HDR sum with what the host has drawn and adds the difference to its target.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "glare/apply/hdr_sum.h"
#include "glare/apply/screen_geometry.h"
#include "glare/apply/target_reader.h"
#include "glare/device/gl_program.h"
#include "glare/tone/tone_settings.h"

namespace seaglare::glare {

// The pixels that change where light touches `touched`, on a grid of `cell_px` too (0: there is none).
PixelBox box_of(const PixelRect& touched, int cell_px, int width_px, int height_px);

class Compositor {
  public:
    // Throws GlError when the shader does not compile.
    explicit Compositor(const Gl& gl);
    // Throws as TargetReader::inspect, and as the constructor where the target is of a kind that no frame had before; the
    // target has not been touched then.
    void begin(const Frame& frame);
    // Of the frame begun: luminance of a sum of lights that no 8-bit target (or whatever its codes) shows, as it moves no
    // channel by a quarter of a code before whatever host's pixel. 0 where the target shows everything.
    double least_cd_m2(const Frame& frame, const ToneSettings& tone) const;
    // Writes the lit tiles of the sum's band, as far as they are in a rectangle of the viewport. Uses texture units 0, 2, 3;
    // leaves all colours writable and no scissor. Returns the draw calls made.
    std::uint32_t draw(const Frame& frame, const ToneSettings& tone, HdrSum& sum, const PixelBox& within);
    double memory_bytes() const { return reader_.memory_bytes(); }
    void forget();

  private:
    // What is added to the target: composite.frag.glsl's ADDS.
    enum Adds { codes, dithered_light, light };
    // Without and with a coarse grid.
    using Programs = std::array<GlProgram, 2>;

    void compile(Adds adds);
    std::uint32_t draw_boxes(const GlProgram& program, int width_px, int height_px,
                             std::span<const PixelBox> boxes) const;
    void bind(GLenum unit, GLuint texture) const {
        gl_.ActiveTexture(unit);
        gl_.BindTexture(GL_TEXTURE_2D, texture);
    }

    const Gl& gl_;
    std::array<std::optional<Programs>, 3> programs_;  // by what they add; those that a frame has needed
    TargetReader reader_;
    TargetFormat target_;
    Adds adds_ = codes;
    double code_ = 0;  // step of the target, of its range; 0: a float has none
};

}  // namespace seaglare::glare
