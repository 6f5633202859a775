#include "glare/apply/pattern_texture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "glare/device/gl_debug.h"

namespace seaglare::glare {

namespace {

// Powers of two that put the largest of each channel between 2^14 and 2^15, where half precision ends: 2^29 of dynamic
// range below it are as precise as it is, and factor and its inverse are exact.
struct Scale {
    std::array<float, 4> to_half{};
    std::array<float, 4> from_half{};
};
Scale scale_of(std::span<const float> rgba) {
    std::array<float, 4> largest{};
    for (std::size_t i = 0; i + 4 <= rgba.size(); i += 4)
        for (std::size_t c = 0; c < 4; ++c) {
            const float magnitude = std::abs(rgba[i + c]);
            largest[c] = largest[c] < magnitude ? magnitude : largest[c];
        }
    Scale scale;
    for (std::size_t c = 0; c < 4; ++c) {
        // An empty channel, and one that is not finite, stays as it is.
        const bool ordinary = largest[c] > 1e-30F && largest[c] < 1e30F;
        const int exponent = ordinary ? 14 - std::ilogb(largest[c]) : 0;
        scale.to_half[c] = std::ldexp(1.0F, exponent);
        scale.from_half[c] = std::ldexp(1.0F, -exponent);
    }
    return scale;
}

}  // namespace

void PatternTexture::allocate(Image& image, int side, int depth) {
    GLint largest = 0;
    gl_.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (side > largest) {
        throw GlError("a glare pattern of " + std::to_string(side) +
                      " nodes: this GL has no texture larger than " + std::to_string(largest));
    }
    image.width = std::max(side, image.width);
    image.depth = std::max(depth, image.depth);
    image.texture = GlObject(gl_, GlKind::texture);
    gl_.BindTexture(GL_TEXTURE_2D_ARRAY, image.texture.name());
    gl_.TexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA16F, image.width, image.width, image.depth, 0, GL_RGBA,
                   GL_HALF_FLOAT, nullptr);
    gl_.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
    label(gl_, GL_TEXTURE, image.texture.name(), "Seaglare: pattern");
}

void PatternTexture::update(const Pattern& pattern) {
    const int side = 2 * pattern.radius_nodes + 1;
    const auto layers = static_cast<int>(pattern.layer_radius_nodes.size());
    const std::size_t slots = pattern.lamps.size();
    const std::size_t layer_floats = static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 4;
    const std::size_t slot_floats = layer_floats * pattern.layer_radius_nodes.size();
    if (layers > most_layers)
        throw std::invalid_argument("pattern: more layers than the shader has radii for");
    if (pattern.radius_nodes < 0 || (!pattern.skirt.empty() && pattern.skirt.size() != slots * slot_floats)) {
        throw std::invalid_argument("pattern: the skirt has not (2R+1)^2 nodes per layer and lamp");
    }
    gl_.ActiveTexture(GL_TEXTURE2);
    if (texture() != 0) gl_.BindTexture(GL_TEXTURE_2D_ARRAY, texture());
    if (texture() != 0 && generation_ == pattern.generation && generation_ != 0) return;
    layers_ = pattern.skirt.empty() ? 0 : layers;
    if (layers_ == 0) return;
    const int needed_depth = layers_ * static_cast<int>(slots);
    if (images_[now_].memory_bytes() <= most_spare_bytes) now_ = 1 - now_;
    Image& image = images_[now_];
    if (!image.texture || side > image.width || needed_depth > image.depth) {
        allocate(image, side, needed_depth);
        Image& other = images_[1 - now_];
        if (image.memory_bytes() > most_spare_bytes) other = {};
    } else {
        gl_.BindTexture(GL_TEXTURE_2D_ARRAY, image.texture.name());
    }
    halves_.resize(std::max(halves_.size(), slot_floats));
    for (std::size_t slot = 0; slot < slots; ++slot) {
        const std::span<const float> skirt =
            std::span(pattern.skirt).subspan(slot * slot_floats, slot_floats);
        const Scale scale = scale_of(skirt);
        scale_[slot] = scale.from_half;
        halves_from_floats(skirt, scale.to_half, halves_);
        gl_.TexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, static_cast<GLint>(slot) * layers_, side, side,
                          layers_, GL_RGBA, GL_HALF_FLOAT, halves_.data());
    }
    generation_ = pattern.generation;
}

}  // namespace seaglare::glare
