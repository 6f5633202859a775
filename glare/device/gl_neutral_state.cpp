#include <array>

#include "glare/device/gl_touched_state.h"

namespace seaglare::glare {

namespace {

// Of the compatibility profile: not in glcorearb.h.
constexpr GLenum gl_alpha_test = 0x0BC0;
constexpr GLenum gl_polygon_stipple = 0x0B42;
constexpr GLenum gl_clamp_vertex_color = 0x891A;
constexpr GLenum gl_clamp_fragment_color = 0x891B;

constexpr std::array<GLenum, 16> disabled = {
    GL_DEPTH_TEST,      GL_DEPTH_CLAMP,         GL_STENCIL_TEST,
    GL_SCISSOR_TEST,    GL_CULL_FACE,           GL_COLOR_LOGIC_OP,
    GL_DITHER,          GL_POLYGON_OFFSET_FILL, GL_POLYGON_SMOOTH,
    GL_SAMPLE_COVERAGE, GL_SAMPLE_ALPHA_TO_ONE, GL_SAMPLE_ALPHA_TO_COVERAGE,
    GL_SAMPLE_MASK,     GL_RASTERIZER_DISCARD,  GL_PRIMITIVE_RESTART,
    GL_FRAMEBUFFER_SRGB};

}  // namespace

void set_neutral_state(const Gl& gl) {
    for (const GLenum state : disabled)
        gl.Disable(state);
    for (GLenum i = 0; i < 8; ++i)
        gl.Disable(GL_CLIP_DISTANCE0 + i);
    if (gl.version >= 40) gl.Disable(GL_SAMPLE_SHADING);
    if (gl.version >= 43) gl.Disable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
    gl.Enable(GL_MULTISAMPLE);
    gl.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    // The unindexed calls set every draw buffer.
    gl.Disable(GL_BLEND);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.BlendFunc(GL_ONE, GL_ONE);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    if (gl.version >= 45 && gl.ClipControl != nullptr) gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    if (gl.compatibility) {
        gl.Disable(gl_alpha_test);
        gl.Disable(gl_polygon_stipple);
        gl.ClampColor(gl_clamp_vertex_color, GL_FALSE);
        gl.ClampColor(gl_clamp_fragment_color, GL_FALSE);
    }
    set_neutral_pixel_store(gl);
}

void set_neutral_pixel_store(const Gl& gl) {
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    for (const GLenum parameter :
         {GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SWAP_BYTES,
          GL_UNPACK_LSB_FIRST, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_IMAGES, GL_PACK_ROW_LENGTH,
          GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST}) {
        gl.PixelStorei(parameter, 0);
    }
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl.ClampColor(GL_CLAMP_READ_COLOR, GL_FALSE);
}

}  // namespace seaglare::glare
