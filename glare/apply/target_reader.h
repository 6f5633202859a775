// The host's target: whether it can be drawn to, what its bytes are, and a copy of its pixels.
#pragma once

#include <string>

#include "glare/apply/accumulator.h"
#include "glare/device/gl_object.h"
#include "glare/frame.h"

namespace seaglare::glare {

struct TargetFormat {
    GLenum draw_buffer = GL_NONE;  // of fragment output 0
    int red_bits = 0;
    int alpha_bits = 0;
    bool floating = false;
    int samples = 0;
};

class TargetReader {
  public:
    explicit TargetReader(const Gl& gl) : gl_(gl) {}
    // Binds the target for drawing. Throws GlError naming target_fbo when it does not exist, is not complete, or draws
    // to no colour buffer; makes no GL error itself.
    TargetFormat inspect(const Frame& frame) const;
    // Copies a rectangle of the viewport, in viewport pixels, to the background texture: column x to column x, row y to row
    // 0. At most band_rows high: a picture is copied and added to band by band, and no second one is held. The target's
    // read buffer has its entry value again on return.
    void copy_background(const Frame& frame, const TargetFormat& format, int x, int y, int width, int height);
    GLuint background() const { return texture_.name(); }
    double memory_bytes() const { return texture_ ? bytes_per_px_ * width_px_ * height_px_ : 0; }
    void forget();

  private:
    void make_texture(const Frame& frame, const TargetFormat& format);

    const Gl& gl_;
    GlObject texture_;
    GlObject framebuffer_;
    GLenum format_ = 0;
    int width_px_ = 0;
    int height_px_ = 0;
    double bytes_per_px_ = 0;
};

}  // namespace seaglare::glare
