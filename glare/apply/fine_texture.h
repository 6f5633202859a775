// The finer nodes of a pattern (psf/fine_nodes.h) as a 2D array texture, which cores are drawn with: slot by slot, in single
// precision, since they are few and of both signs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "glare/device/gl_object.h"
#include "glare/psf/pattern.h"

namespace seaglare::glare {

class FineTexture {
  public:
    explicit FineTexture(const Gl& gl) : gl_(gl) {}
    // Uploads a pattern that is another than last time, on texture unit 2. Nothing of a pattern without them. Throws
    // std::invalid_argument when there are not as many as its lamps.
    void update(const Pattern& pattern);
    // Layer s is slot s; 0: of none yet.
    GLuint texture() const { return images_[now_].texture.name(); }
    double memory_bytes() const { return images_[0].memory_bytes() + images_[1].memory_bytes(); }
    void forget() {
        for (Image& image : images_)
            image.texture.forget();
    }

  private:
    struct Image {
        GlObject texture;
        int depth = 0;  // allocated slots
        double memory_bytes() const { return static_cast<double>(fine_floats * sizeof(float)) * depth; }
    };
    const Gl& gl_;
    // A new pattern goes into the one that the GPU does not read for the last frame, so that no upload waits.
    std::array<Image, 2> images_;
    std::size_t now_ = 0;
    std::uint64_t generation_ = 0;  // in images_[now_]
};

}  // namespace seaglare::glare
