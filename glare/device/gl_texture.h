// How textures of ours are made.
#pragma once

#include "glare/device/gl_object.h"

namespace seaglare::glare {

// Makes `texture`, whatever it was, a 2D array texture of one level: `format` is its internal one, of four floats or halves; side x
// side texels in each of `layers`, their contents undefined. It is bound to the active unit. `filter` is GL_NEAREST or GL_LINEAR,
// `name` what GL debuggers show.
void make_array_texture(const Gl& gl, GlObject& texture, GLenum format, int side, int layers, GLint filter,
                        const char* name);

}  // namespace seaglare::glare
