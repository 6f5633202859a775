#include "glare/apply/light_buffer.h"

#include <algorithm>

#include "glare/device/gl_debug.h"

namespace seaglare::glare {

LightBuffer::LightBuffer(const Gl& gl) : gl_(gl) {
    add_chunk(64 * sizeof(LightInstance));
}

void LightBuffer::add_chunk(std::size_t bytes) {
    Chunk chunk{GlObject(gl_, GlKind::buffer), GlObject(gl_, GlKind::texture), bytes};
    gl_.BindBuffer(GL_TEXTURE_BUFFER, chunk.buffer.name());
    gl_.BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_STREAM_DRAW);
    label(gl_, GL_BUFFER, chunk.buffer.name(), "Seaglare: lights");
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_BUFFER, chunk.texture.name());
    gl_.TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, chunk.buffer.name());
    chunks_.push_back(std::move(chunk));
}

void LightBuffer::upload(std::span<const LightInstance> lights) {
    for (std::size_t i = 0; !lights.empty(); ++i) {
        const std::span<const LightInstance> part = lights.first(std::min(lights.size(), lights_per_chunk));
        lights = lights.subspan(part.size());
        if (i == chunks_.size()) add_chunk(part.size_bytes());
        Chunk& chunk = chunks_[i];
        chunk.bytes = std::max(chunk.bytes, part.size_bytes());
        gl_.BindBuffer(GL_TEXTURE_BUFFER, chunk.buffer.name());
        // Orphaned: the GPU may still be reading the last frame's lights.
        gl_.BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(chunk.bytes), nullptr, GL_STREAM_DRAW);
        gl_.BufferSubData(GL_TEXTURE_BUFFER, 0, static_cast<GLsizeiptr>(part.size_bytes()), part.data());
    }
}

void LightBuffer::bind(std::size_t index) const {
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_BUFFER, chunks_[index].texture.name());
}

double LightBuffer::memory_bytes() const {
    double bytes = 0;
    for (const Chunk& chunk : chunks_)
        bytes += static_cast<double>(chunk.bytes);
    return bytes;
}

void LightBuffer::forget() {
    for (Chunk& chunk : chunks_) {
        chunk.buffer.forget();
        chunk.texture.forget();
    }
}

}  // namespace seaglare::glare
