// A GL texture as an OpenCL image. As gl_sharing.h: written against the specification.
#pragma once

#include "glare/device/cl_device.h"

namespace seaglare::glare {

// The texture must be whole (all of its images given) and of a format that both know: GL_RGBA32F is CL_RGBA of CL_FLOAT
// (OpenCL 1.2 Extension Specification, table 9.4). While this lives, it must neither be deleted nor given another image.
class ClGlTexture {
  public:
    ClGlTexture() = default;
    // Level 0 of a GL_TEXTURE_2D, to be written to. Needs the GL context current. Throws ClError.
    ClGlTexture(cl_context context, unsigned texture);

    unsigned texture() const { return texture_; }
    // Copies rows of `width` pixels, four floats each, from a buffer to the texture's first rows, on the device and in the
    // order of the queue. GL commands of this thread that came before are done with the texture by then, those that come
    // after find it filled (cl_khr_gl_event makes both so for the context that is current). Waits for nothing. Throws
    // ClError.
    void fill(cl_command_queue queue, cl_mem buffer, std::size_t width, std::size_t rows) const;

  private:
    ClOwned<cl_mem> image_;
    unsigned texture_ = 0;
};

}  // namespace seaglare::glare
