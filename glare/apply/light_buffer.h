// The lights of one draw call as a buffer texture (shaders/lights.glsl), uploaded without waiting for the last frame's.
#pragma once

#include <span>

#include "glare/apply/light_instance.h"
#include "glare/device/gl_object.h"

namespace seaglare::glare {

// Lights drawn with one call: eight texels each stay within the 65536 texels of a buffer texture that GL promises.
inline constexpr std::size_t lights_per_chunk = 8192;

class LightBuffer {
  public:
    // Uses texture unit 0.
    explicit LightBuffer(const Gl& gl);
    // At most lights_per_chunk. Leaves its texture bound to texture unit 0.
    void upload(std::span<const LightInstance> chunk);
    double memory_bytes() const { return static_cast<double>(bytes_); }
    void forget();

  private:
    const Gl& gl_;
    GlObject buffer_;
    GlObject texture_;
    std::size_t bytes_ = 0;
};

}  // namespace seaglare::glare
