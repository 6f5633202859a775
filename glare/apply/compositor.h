// The last pass: tone maps the HDR sum with what the host has drawn and adds the difference to its target.
#pragma once

#include "glare/apply/hdr_sum.h"
#include "glare/apply/screen_geometry.h"
#include "glare/apply/target_reader.h"
#include "glare/device/gl_program.h"
#include "glare/tone/tone_settings.h"

namespace seaglare::glare {

class Compositor {
  public:
    // Throws GlError when the shader does not compile.
    explicit Compositor(const Gl& gl);
    // Throws as TargetReader::inspect; the target has not been touched then.
    void begin(const Frame& frame) { target_ = reader_.inspect(frame); }
    // Writes the pixels that `touched` touches. Uses texture units 0, 1, 2.
    std::uint32_t draw(const Frame& frame, const ToneSettings& tone, const HdrSum& sum,
                       const PixelRect& touched);
    double memory_bytes() const { return reader_.memory_bytes(); }
    void forget();

  private:
    void bind(GLenum unit, GLuint texture) const {
        gl_.ActiveTexture(unit);
        gl_.BindTexture(GL_TEXTURE_2D, texture);
    }

    const Gl& gl_;
    GlProgram program_;
    TargetReader reader_;
    TargetFormat target_;
};

}  // namespace seaglare::glare
