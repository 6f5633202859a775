#include "glare/apply/pattern_texture.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "glare/device/gl_texture.h"

namespace seaglare::glare {

void PatternTexture::check(const Pattern& pattern) {
    const int side = 2 * pattern.radius_nodes + 1;
    const std::size_t nodes =
        static_cast<std::size_t>(std::max(side, 0)) * static_cast<std::size_t>(std::max(side, 0));
    if (pattern.layer_radius_nodes.size() > most_layers)
        throw std::invalid_argument("pattern: more layers than the shader has radii for");
    if (pattern.radius_nodes < 0 ||
        (!pattern.skirt.empty() &&
         pattern.skirt.size() != pattern.lamps.size() * pattern.layer_radius_nodes.size() * nodes * 4)) {
        throw std::invalid_argument("pattern: the skirt has not (2R+1)^2 nodes per layer and lamp");
    }
    if (largest_side_ == 0) gl_.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest_side_);
    if (side > largest_side_) {
        throw GlError("a glare pattern of " + std::to_string(side) +
                      " nodes: this GL has no texture larger than " + std::to_string(largest_side_));
    }
}

void PatternTexture::allocate(Image& image, int side, int depth) {
    image.width = std::max(side, image.width);
    image.depth = std::max(depth, image.depth);
    make_array_texture(gl_, image.texture, GL_RGBA16F, image.width, image.depth, GL_NEAREST,
                       "Seaglare: pattern");
}

void PatternTexture::reserve(const Pattern& pattern) {
    const int side = 2 * pattern.radius_nodes + 1;
    const auto depth = static_cast<int>(pattern.layer_radius_nodes.size() * pattern.lamps.size());
    Image& image = images_[now_];
    if (pattern.skirt.empty() || fits(image, side, depth)) return;
    const Image needed{{}, std::max(side, image.width), std::max(depth, image.depth)};
    if (needed.memory_bytes() > most_reserved_bytes) return;
    gl_.ActiveTexture(GL_TEXTURE2);
    allocate(image, side, depth);
    generation_ = 0;
}

void PatternTexture::update(const Pattern& pattern, const PatternTexels* texels, bool spare) {
    check(pattern);
    gl_.ActiveTexture(GL_TEXTURE2);
    if (texture() != 0) gl_.BindTexture(GL_TEXTURE_2D_ARRAY, texture());
    if (texture() != 0 && generation_ == pattern.generation && generation_ != 0) return;
    if (pattern.skirt.empty()) return;
    if (texels == nullptr) {
        make_texels(pattern, own_texels_);
        texels = &own_texels_;
    }
    const int side = 2 * pattern.radius_nodes + 1;
    const auto depth = static_cast<int>(pattern.layer_radius_nodes.size() * pattern.lamps.size());
    if (spare && generation_ != 0 && images_[now_].memory_bytes() <= most_spare_bytes) now_ = 1 - now_;
    Image& image = images_[now_];
    if (!fits(image, side, depth)) {
        allocate(image, side, depth);
        Image& other = images_[1 - now_];
        if (image.memory_bytes() > most_spare_bytes) other = {};
    } else {
        gl_.BindTexture(GL_TEXTURE_2D_ARRAY, image.texture.name());
    }
    gl_.TexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, side, side, depth, GL_RGBA, GL_HALF_FLOAT,
                      texels->halves.data());
    scale_ = texels->scale;
    generation_ = pattern.generation;
}

}  // namespace seaglare::glare
