#include "glare/apply/light_buffer.h"

#include <algorithm>

#include "glare/device/gl_debug.h"

namespace seaglare::glare {

LightBuffer::LightBuffer(const Gl& gl)
    : gl_(gl),
      buffer_(gl, GlKind::buffer),
      texture_(gl, GlKind::texture),
      bytes_(64 * sizeof(LightInstance)) {
    gl_.BindBuffer(GL_TEXTURE_BUFFER, buffer_.name());
    gl_.BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(bytes_), nullptr, GL_STREAM_DRAW);
    label(gl_, GL_BUFFER, buffer_.name(), "Seaglare: lights");
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_BUFFER, texture_.name());
    gl_.TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, buffer_.name());
}

void LightBuffer::upload(std::span<const LightInstance> chunk) {
    gl_.BindBuffer(GL_TEXTURE_BUFFER, buffer_.name());
    bytes_ = std::max(bytes_, chunk.size_bytes());
    // Orphaned: the GPU may still be reading the last frame's lights.
    gl_.BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(bytes_), nullptr, GL_STREAM_DRAW);
    gl_.BufferSubData(GL_TEXTURE_BUFFER, 0, static_cast<GLsizeiptr>(chunk.size_bytes()), chunk.data());
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_BUFFER, texture_.name());
}

void LightBuffer::forget() {
    buffer_.forget();
    texture_.forget();
}

}  // namespace seaglare::glare
