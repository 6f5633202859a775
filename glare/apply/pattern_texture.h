// The pattern's layers as a 2D array texture, uploaded when the pattern has changed.
#pragma once

#include "glare/device/gl_object.h"
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
    double memory_bytes() const { return 16.0 * width_ * width_ * depth_; }
    void forget() { texture_.forget(); }

  private:
    const Gl& gl_;
    GlObject texture_;
    std::uint64_t generation_ = 0;
    int width_ = 0;   // allocated nodes per side
    int depth_ = 0;   // allocated layers
    int layers_ = 0;  // in use
};

}  // namespace seaglare::glare
