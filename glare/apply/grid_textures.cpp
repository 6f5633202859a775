#include "glare/apply/grid_textures.h"

#include <algorithm>

#include "glare/device/gl_debug.h"
#include "glare/device/gl_texture.h"

namespace seaglare::glare {

const PatternProfile& GridTextures::update(const Pattern& pattern, const GridTexels* texels) {
    if (texels == nullptr) {
        maker_.make(pattern, own_texels_);
        texels = &own_texels_;
    } else {
        own_texels_ = {};
    }
    if (pattern.generation == generation_ && generation_ != 0) return texels->profile;
    generation_ = 0;
    if (images_[now_].memory_bytes() <= most_spare_bytes) now_ = 1 - now_;
    Image& image = images_[now_];
    gl_.ActiveTexture(GL_TEXTURE3);
    upload_tables(image, texels->profile);
    upload_departures(image, pattern, *texels);
    if (image.memory_bytes() > most_spare_bytes) images_[1 - now_] = {};
    generation_ = pattern.generation;
    return texels->profile;
}

void GridTextures::upload_tables(Image& image, const PatternProfile& profile) {
    const auto tables = static_cast<int>(profile.tail_table() + 1);
    if (!image.radial || image.tables < tables) {
        image.radial = GlObject(gl_, GlKind::texture);
        image.tables = tables;
        gl_.BindTexture(GL_TEXTURE_2D, image.radial.name());
        gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, RadialTable::entries, tables, 0, GL_RGBA, GL_FLOAT,
                       nullptr);
        gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
        label(gl_, GL_TEXTURE, image.radial.name(), "Seaglare: radial means");
    } else {
        gl_.BindTexture(GL_TEXTURE_2D, image.radial.name());
    }
    gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, RadialTable::entries, tables, GL_RGBA, GL_FLOAT,
                      profile.tables().data());
}

void GridTextures::upload_departures(Image& image, const Pattern& pattern, const GridTexels& texels) {
    const auto layers = static_cast<int>(texels.profile.tail_table());
    if (layers == 0) {
        image.departures.reset();
        image.side = image.layers = 0;
        return;
    }
    const int side = 2 * pattern.radius_nodes + 1;
    if (!image.departures || image.side != side || image.layers < layers) {
        image.side = side;  // exactly: beyond its edges there must be nothing
        image.layers = std::max(layers, image.layers);
        make_array_texture(gl_, image.departures, GL_RGBA16F, image.side, image.layers, GL_LINEAR,
                           "Seaglare: departures from the means");
    } else {
        gl_.BindTexture(GL_TEXTURE_2D_ARRAY, image.departures.name());
    }
    departures_scale_ = texels.departures_scale;
    gl_.TexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, side, side, layers, GL_RGBA, GL_HALF_FLOAT,
                      texels.departures.data());
}

void GridTextures::forget() {
    for (Image& image : images_) {
        image.radial.forget();
        image.departures.forget();
    }
}

}  // namespace seaglare::glare
