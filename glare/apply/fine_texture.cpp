#include "glare/apply/fine_texture.h"

#include <stdexcept>

#include "glare/device/gl_texture.h"

namespace seaglare::glare {

void FineTexture::update(const Pattern& pattern) {
    if (pattern.fine.empty()) return;
    if (pattern.fine.size() != pattern.lamps.size() * fine_floats)
        throw std::invalid_argument("pattern: finer nodes for some of its lamps only");
    if (generation_ == pattern.generation && generation_ != 0) return;
    gl_.ActiveTexture(GL_TEXTURE2);
    now_ = 1 - now_;
    generation_ = 0;  // what follows may throw
    Image& image = images_[now_];
    constexpr auto side = static_cast<GLsizei>(fine_side);
    const auto depth = static_cast<GLsizei>(pattern.lamps.size());
    if (!image.texture || depth > image.depth) {
        image.depth = depth;
        make_array_texture(gl_, image.texture, GL_RGBA32F, side, depth, GL_NEAREST, "Seaglare: fine nodes");
    } else {
        gl_.BindTexture(GL_TEXTURE_2D_ARRAY, image.texture.name());
    }
    gl_.TexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, side, side, depth, GL_RGBA, GL_FLOAT,
                      pattern.fine.data());
    generation_ = pattern.generation;
}

}  // namespace seaglare::glare
