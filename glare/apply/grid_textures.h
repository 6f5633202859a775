// GridTexels as textures of GL, uploaded when something is drawn on grids and the pattern has changed.
#pragma once

#include <array>
#include <cstdint>

#include "glare/apply/grid_texels.h"
#include "glare/device/gl_object.h"
#include "glare/psf/pattern.h"

namespace seaglare::glare {

class GridTextures {
  public:
    explicit GridTextures(const Gl& gl) : gl_(gl) {}
    // `texels` are this pattern's, or null: they are made here. The profile returned is theirs, or holds until this is called
    // again. Nothing to upload where the textures are of this pattern already. Uses texture unit 3.
    const PatternProfile& update(const Pattern& pattern, const GridTexels* texels);

    // 2D: RadialTable::entries wide, a row for each of the profile's tables.
    GLuint radial() const { return images_[now_].radial.name(); }
    // 2D array: a layer for each table but the last. 0: the pattern has no skirt.
    GLuint departures() const { return images_[now_].departures.name(); }
    int nodes_across() const { return images_[now_].side; }
    float departures_scale() const { return departures_scale_; }
    double memory_bytes() const { return images_[0].memory_bytes() + images_[1].memory_bytes(); }
    void forget();

  private:
    struct Image {
        GlObject radial;
        int tables = 0;  // allocated
        GlObject departures;
        int side = 0;
        int layers = 0;
        double memory_bytes() const {
            return 16.0 * RadialTable::entries * tables + 8.0 * side * side * layers;
        }
    };
    void upload_tables(Image& image, const PatternProfile& profile);
    void upload_departures(Image& image, const Pattern& pattern, const GridTexels& texels);

    const Gl& gl_;
    std::uint64_t generation_ = 0;  // in images_[now_]
    // As PatternTexture has it: a new pattern goes where the GPU does not read, unless that is too large.
    static constexpr double most_spare_bytes = 16e6;
    std::array<Image, 2> images_;
    std::size_t now_ = 0;
    float departures_scale_ = 1;
    GridTexelMaker maker_;
    GridTexels own_texels_;  // of patterns that come without
};

}  // namespace seaglare::glare
