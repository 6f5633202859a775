// The GL state that glare::ViewRenderer changes, for whoever saves it. The renderer restores nothing of this by itself.
//
// Constructor, render() and read_hdr() set, and never rely on the entry value of:
//   bindings        draw and read framebuffer; vertex array; program in use; GL_TEXTURE_BUFFER, GL_PIXEL_UNPACK_BUFFER,
//                   GL_PIXEL_PACK_BUFFER buffer bindings (not GL_ARRAY_BUFFER, no indexed binding); active texture unit;
//                   on texture units 0 ... 3: the 2D, 2D array, 2D multisample and buffer textures and the sampler
//   enables         blend (all draw buffers), depth test, depth clamp, stencil test, scissor test, cull face,
//                   colour logic op, dither, polygon offset fill, polygon smooth, multisample, sample alpha to coverage,
//                   sample alpha to one, sample coverage, sample mask, rasterizer discard, primitive restart,
//                   framebuffer sRGB, program point size is not touched; clip distances 0 ... 7;
//                   GL 4.0: sample shading; GL 4.3: fixed index primitive restart, and debug output is not touched
//   compatibility   alpha test, polygon stipple, clamp vertex colour, clamp fragment colour
//   values          blend function and equation (all draw buffers), colour mask (all draw buffers), depth mask is not
//                   touched; polygon mode; viewport and scissor box (all indices); clip control (GL 4.5); clamp read
//                   colour
//   pixel store     pack and unpack: alignment, row length, skip rows, skip pixels, swap bytes, lsb first;
//                   unpack also image height, skip images
//
// Must not be active around it, or draws are lost or counted: transform feedback, conditional render, queries of samples
// or primitives. Not defended against: the pixel transfer state of the compatibility profile (glPixelTransfer), and
// GL_DEPTH_TEXTURE_MODE, GL_DEPTH_STENCIL_TEXTURE_MODE or a swizzle of the host's own depth texture.
#pragma once

#include "glare/device/gl.h"

namespace seaglare::glare {

inline constexpr int touched_texture_units = 4;

// Sets every state that a draw of ours depends on, and that glBindFramebuffer and our own calls do not.
void set_neutral_state(const Gl& gl);
// Of uploads and readbacks.
void set_neutral_pixel_store(const Gl& gl);

}  // namespace seaglare::glare
