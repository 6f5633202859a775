// The pattern's layers as a 2D array texture, uploaded when something is drawn with it and it has changed. In half precision: a
// node is off by 2^-11 of itself at most, and every fetch moves half the bytes (glare/apply/README.md has what that costs and
// saves).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "glare/apply/pattern_texels.h"
#include "glare/device/gl_object.h"
#include "glare/psf/pattern.h"

namespace seaglare::glare {

class PatternTexture {
  public:
    explicit PatternTexture(const Gl& gl) : gl_(gl) {}
    // Throws std::invalid_argument when the pattern contradicts itself, GlError when no texture can hold it.
    void check(const Pattern& pattern);
    // Binds it to texture unit 2: layer l of slot s is s times the pattern's layers + l. `texels` are this pattern's, or null:
    // they are made here. Throws as check().
    // `spare`: a texture may be held beside the one that is drawn with.
    void update(const Pattern& pattern, const PatternTexels* texels = nullptr, bool spare = true);
    // Where nothing is drawn with it now: has the memory for when it is, if that is no more than most_reserved_bytes.
    void reserve(const Pattern& pattern);
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
    static bool fits(const Image& image, int side, int depth) {
        return image.texture && side <= image.width && depth <= image.depth;
    }

    const Gl& gl_;
    // A new pattern goes into the one that the GPU does not read for the last frame, so that no upload waits. Patterns
    // larger than most_spare_bytes have one texture only, for the sake of memory: a driver then copies, or waits.
    static constexpr double most_spare_bytes = 16e6;
    static constexpr double most_reserved_bytes = 3.5e6;
    std::array<Image, 2> images_;
    std::size_t now_ = 0;
    std::uint64_t generation_ = 0;  // in images_[now_]
    GLint largest_side_ = 0;        // that GL has; 0: not asked yet
    std::array<std::array<float, 4>, most_lamps> scale_{};
    PatternTexels own_texels_;  // of patterns that come without
};

}  // namespace seaglare::glare
