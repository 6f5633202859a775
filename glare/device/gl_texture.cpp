#include "glare/device/gl_texture.h"

#include "glare/device/gl_debug.h"

namespace seaglare::glare {

void make_array_texture(const Gl& gl, GlObject& texture, GLenum format, int side, int layers, GLint filter,
                        const char* name) {
    // The old one's memory is free before the new one has any.
    texture = GlObject(gl, GlKind::texture);
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, texture.name());
    gl.TexImage3D(GL_TEXTURE_2D_ARRAY, 0, static_cast<GLint>(format), side, side, layers, 0, GL_RGBA,
                  GL_FLOAT, nullptr);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, filter);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, filter);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
    label(gl, GL_TEXTURE, texture.name(), name);
}

}  // namespace seaglare::glare
