// Makes the host's depth readable as a texture: the texture the frame names, or a copy of a framebuffer's depth.
#pragma once

#include <string>

#include "glare/device/gl_object.h"
#include "glare/frame.h"

namespace seaglare::glare {

struct DepthImage {
    GLenum target = GL_TEXTURE_2D;
    GLuint texture = 0;
    int samples = 0;  // 0: no depth
    int width_px = 0;
    int height_px = 0;
    int origin_px[2] = {0, 0};    // of the viewport
    double quantum = 0;           // error of a stored fixed-point value
    double quantum_relative = 0;  // error of a floating-point value
};

class DepthReader {
  public:
    explicit DepthReader(const Gl& gl) : gl_(gl) {}
    // Throws GlError naming depth_object when it is no depth image that can be read. Makes no GL error itself.
    DepthImage read(const Frame& frame);
    double memory_bytes() const;
    void forget();

  private:
    DepthImage texture(const Frame& frame) const;
    DepthImage copy(const Frame& frame);
    void make_copy_target(GLenum format, int width, int height, const std::string& what);

    const Gl& gl_;
    GlObject copy_texture_;
    GlObject copy_framebuffer_;
    GLenum copy_format_ = 0;
    int copy_width_px_ = 0;
    int copy_height_px_ = 0;
};

}  // namespace seaglare::glare
