// The pattern's layers as a 2D array texture, uploaded when the pattern has changed. In half precision: a node is off by
// 2^-11 of itself at most, and every fetch moves half the bytes (glare/apply/README.md has what that costs and saves).
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
    GLuint texture() const { return images_[now_].texture.name(); }
    // What a slot's texels are to be multiplied by, channel by channel; as many as the pattern has lamps.
    std::span<const std::array<float, 4>> scale() const { return scale_; }
    double memory_bytes() const { return images_[0].memory_bytes() + images_[1].memory_bytes(); }
    void forget() {
        for (Image& image : images_)
            image.texture.forget();
    }

  private:
    struct Image {
        GlObject texture;
        int width = 0;  // allocated nodes per side
        int depth = 0;  // allocated layers
        double memory_bytes() const { return 8.0 * width * width * depth; }
    };
    void allocate(Image& image, int side, int depth);

    const Gl& gl_;
    // A new pattern goes into the one that the GPU does not read for the last frame, so that no upload waits. Patterns
    // larger than most_spare_bytes have one texture only, for the sake of memory: a driver then copies, or waits.
    static constexpr double most_spare_bytes = 16e6;
    std::array<Image, 2> images_;
    std::size_t now_ = 0;
    std::uint64_t generation_ = 0;
    int layers_ = 0;  // in use
    std::array<std::array<float, 4>, most_lamps> scale_{};
    std::vector<Half> halves_;  // of a slot, on their way to GL
};

}  // namespace seaglare::glare
