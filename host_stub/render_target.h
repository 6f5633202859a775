// The host's framebuffer: colour in the format the channel asks for, depth in 32-bit float, drawn with four
// samples and resolved, as image generators do.
#pragma once

#include <cstdint>
#include <vector>

#include "host_stub/gl_objects.h"
#include "host_stub/scene.h"

namespace seaglare::host {

class RenderTarget {
  public:
    // Throws GlFailure when the framebuffer is not complete.
    RenderTarget(int width_px, int height_px, TargetFormat format);

    int width_px() const { return width_px_; }
    int height_px() const { return height_px_; }
    TargetFormat format() const { return format_; }

    // Bound while the scene is drawn.
    GLuint multisampled_fbo() const { return multisampled_fbo_; }
    // Copies colour and depth into the single-sampled framebuffer and leaves that one bound.
    void resolve();
    // The finished picture, and its depth as a GL_TEXTURE_2D.
    GLuint fbo() const { return fbo_; }
    GLuint depth_texture() const { return depth_; }
    GLuint colour_texture() const { return colour_; }

    // The bytes as they would reach a display, RGBA, upper row first; a linear target is encoded to sRGB.
    std::vector<std::uint8_t> read_srgb_rgba8() const;
    // Exactly what the colour image holds, for comparing: bytes as GL gives them back.
    std::vector<std::uint8_t> read_raw() const;
    // Depth, lower row first.
    std::vector<float> read_depth() const;

  private:
    int width_px_, height_px_;
    TargetFormat format_;
    GlName colour_, depth_, fbo_;
    GlName multisampled_colour_, multisampled_depth_, multisampled_fbo_;
};

}  // namespace seaglare::host
