// The lights of a frame as buffer textures (shaders/lights.glsl), uploaded without waiting for the last frame's.
#pragma once

#include <span>
#include <vector>

#include "glare/apply/light_instance.h"
#include "glare/device/gl_object.h"

namespace seaglare::glare {

// Lights of a buffer texture: eight texels each stay within the 65536 texels that GL promises one.
inline constexpr std::size_t lights_per_chunk = 8192;

class LightBuffer {
  public:
    // Uses texture unit 0.
    explicit LightBuffer(const Gl& gl);
    // Replaces all of them: in chunks of lights_per_chunk, of which the last may have fewer. Uses texture unit 0.
    void upload(std::span<const LightInstance> lights);
    // Chunk `index` to texture unit 0.
    void bind(std::size_t index) const;
    double memory_bytes() const;
    void forget();

  private:
    struct Chunk {
        GlObject buffer;
        GlObject texture;
        std::size_t bytes = 0;
    };
    void add_chunk(std::size_t bytes);

    const Gl& gl_;
    std::vector<Chunk> chunks_;
};

}  // namespace seaglare::glare
