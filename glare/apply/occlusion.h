// How much of each light the host's picture leaves visible, from its depth: one texel a light, in a texture that the
// vertex shader of the lights reads (shaders/light_quad.vert.glsl).
#pragma once

#include "glare/apply/depth_reader.h"
#include "glare/apply/hdr_buffers.h"
#include "glare/apply/light_buffer.h"
#include "glare/apply/screen_geometry.h"
#include "glare/device/gl_program.h"

namespace seaglare::glare {

class Occlusion {
  public:
    // Throws GlError when a shader does not compile. Uses texture unit 0 and leaves a framebuffer bound.
    explicit Occlusion(const Gl& gl);
    // Takes the frame's depth; one call a frame, before the first draw(). Throws as DepthReader::read.
    void begin(const Frame& frame) { depth_ = reader_.read(frame); }
    // Of the `count` lights in the LightBuffer on texture unit 0. Uses texture unit 2, leaves its result on unit 1 and
    // blending off.
    void draw(const Frame& frame, const ScreenGeometry& geometry, int count) const;
    double memory_bytes() const { return visibility_.memory_bytes() + reader_.memory_bytes(); }
    void forget();

  private:
    const Gl& gl_;
    GlProgram program_;
    GlProgram program_ms_;
    FloatBuffer visibility_;
    DepthReader reader_;
    DepthImage depth_;
};

}  // namespace seaglare::glare
