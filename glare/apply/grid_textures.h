// A pattern as GlGrids reads it: radial means, and what the nodes have beside them in half precision.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "glare/apply/pattern_profile.h"
#include "glare/device/gl_object.h"
#include "glare/device/half.h"
#include "glare/psf/pattern.h"

namespace seaglare::glare {

class GridTextures {
  public:
    explicit GridTextures(const Gl& gl) : gl_(gl) {}
    // Nothing to do where it is of this pattern already. Keeps nothing of it but copies. Uses texture unit 3.
    void update(const Pattern& pattern);

    const PatternProfile& profile() const { return profile_; }
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
    void upload_tables(Image& image);
    void upload_departures(Image& image, const Pattern& pattern);

    const Gl& gl_;
    PatternProfile profile_;
    std::uint64_t generation_ = 0;
    // As PatternTexture has it: a new pattern goes where the GPU does not read, unless that is too large.
    static constexpr double most_spare_bytes = 16e6;
    std::array<Image, 2> images_;
    std::size_t now_ = 0;
    float departures_scale_ = 1;
    std::vector<float> departures_;
    std::vector<Half> halves_;
};

}  // namespace seaglare::glare
