// The pattern's layers as a 2D array texture, uploaded when the pattern has changed. In half precision: a node is off by
// 2^-12 of itself at most, and every fetch moves half the bytes (glare/apply/README.md has what that costs and saves).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "glare/device/gl_object.h"
#include "glare/device/half.h"
#include "glare/psf/pattern.h"

namespace seaglare::glare {

class PatternTexture {
  public:
    explicit PatternTexture(const Gl& gl) : gl_(gl) {}
    // Binds it to texture unit 2. Throws std::invalid_argument when the pattern contradicts itself.
    void update(const Pattern& pattern);
    // Per lamp; layer l of slot s is s * layer_count() + l.
    int layer_count() const { return layers_; }
    GLuint texture() const { return texture_.name(); }
    // What a slot's texels are to be multiplied by, channel by channel; as many as the pattern has lamps.
    std::span<const std::array<float, 4>> scale() const { return scale_; }
    double memory_bytes() const { return 8.0 * width_ * width_ * depth_; }
    void forget() { texture_.forget(); }

  private:
    const Gl& gl_;
    GlObject texture_;
    std::uint64_t generation_ = 0;
    int width_ = 0;   // allocated nodes per side
    int depth_ = 0;   // allocated layers
    int layers_ = 0;  // in use
    std::array<std::array<float, 4>, most_lamps> scale_{};
    std::vector<Half> halves_;  // of a slot, on their way to GL
};

}  // namespace seaglare::glare
