#include "glare/device/cl_gl_texture.h"

#include <CL/cl_gl.h>

#include <array>

namespace seaglare::glare {

namespace {
constexpr cl_GLenum texture_2d = 0x0DE1;  // GL_TEXTURE_2D
}

ClGlTexture::ClGlTexture(cl_context context, unsigned texture) : texture_(texture) {
    cl_int code = CL_SUCCESS;
    image_.reset(clCreateFromGLTexture(context, CL_MEM_WRITE_ONLY, texture_2d, 0, texture, &code));
    check_cl(code, "clCreateFromGLTexture");
}

void ClGlTexture::fill(cl_command_queue queue, cl_mem buffer, std::size_t width, std::size_t rows) const {
    cl_mem image = image_.get();
    check_cl(clEnqueueAcquireGLObjects(queue, 1, &image, 0, nullptr, nullptr), "clEnqueueAcquireGLObjects");
    const std::array<std::size_t, 3> origin = {0, 0, 0};
    const std::array<std::size_t, 3> region = {width, rows, 1};
    const cl_int copied = clEnqueueCopyBufferToImage(queue, buffer, image, 0, origin.data(), region.data(), 0,
                                                     nullptr, nullptr);
    // What was acquired is given back, whatever happened: GL must not touch it otherwise.
    const cl_int released = clEnqueueReleaseGLObjects(queue, 1, &image, 0, nullptr, nullptr);
    check_cl(copied, "clEnqueueCopyBufferToImage(HDR sum)");
    check_cl(released, "clEnqueueReleaseGLObjects");
    check_cl(clFlush(queue), "clFlush");
}

}  // namespace seaglare::glare
