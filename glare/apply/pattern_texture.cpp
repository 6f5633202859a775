#include "glare/apply/pattern_texture.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace seaglare::glare {

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
    if (texture_) gl_.BindTexture(GL_TEXTURE_2D_ARRAY, texture_.name());
    if (texture_ && generation_ == pattern.generation && generation_ != 0) return;
    layers_ = pattern.skirt.empty() ? 0 : layers;
    if (layers_ == 0) return;
    const int needed_depth = layers_ * static_cast<int>(slots);
    if (!texture_ || side > width_ || needed_depth > depth_) {
        GLint largest = 0;
        gl_.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
        if (side > largest)
            throw GlError("a glare pattern of " + std::to_string(side) +
                          " nodes: this GL has no texture larger than " + std::to_string(largest));
        width_ = std::max(side, width_);
        depth_ = std::max(needed_depth, depth_);
        texture_ = GlObject(gl_, GlKind::texture);
        gl_.BindTexture(GL_TEXTURE_2D_ARRAY, texture_.name());
        gl_.TexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA32F, width_, width_, depth_, 0, GL_RGBA, GL_FLOAT,
                       nullptr);
        gl_.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl_.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        gl_.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
    }
    for (std::size_t slot = 0; slot < slots; ++slot) {
        gl_.TexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, static_cast<GLint>(slot) * layers_, side, side,
                          layers_, GL_RGBA, GL_FLOAT, pattern.skirt.data() + slot * slot_floats);
    }
    generation_ = pattern.generation;
}

}  // namespace seaglare::glare
