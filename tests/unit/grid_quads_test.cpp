// The rectangles that GL draws are what the lists of tiles say: every departure is covered, in the band it lies in, by
// rectangles of its light and of a kind that has all that its pixels need.
#include "glare/apply/grid_quads.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "glare/apply/light_instance.h"
#include "glare/tone/operators.h"
#include "tests/unit/needle_pattern.h"

namespace seaglare::glare {
namespace {

constexpr int width_px = 320;
constexpr int height_px = 200;  // the last band is not a whole one

class GridQuadsOfACrowd : public testing::Test {
  protected:
    GridQuadsOfACrowd()
        : geometry_(test::narrow_screen(width_px, height_px)),
          pattern_(test::needle_pattern(geometry_.pitch, {0.0F, 2.0F})) {
        std::mt19937_64 random(3);
        std::uniform_real_distribution<double> part(0, 1);
        std::vector<PointSource> sources;
        for (int i = 0; i < 60; ++i) {
            const Vec3 ray = ray_of_px(geometry_, part(random) * width_px, part(random) * height_px);
            PointSource source;
            for (std::size_t k = 0; k < 3; ++k)
                source.position_view_m[k] = static_cast<float>(1000 * ray[k]);
            source.radius_m = part(random) < 0.5 ? 0.0F : 0.5F;
            source.illuminance_rgb_lx.fill(static_cast<float>(std::pow(10.0, -5 + 2 * part(random))));
            sources.push_back(source);
        }
        ReachSettings reach;
        reach.threshold_cd_m2 = threshold_luminance_cd_m2({}, 0.001, 0.25);
        reach.tail_threshold_cd_m2 = reach.threshold_cd_m2 / 64;
        append_instances(geometry_, pattern_, reach, sources, lights_);
        PatternProfile profile;
        profile.update(pattern_);
        lists_.build(geometry_, pattern_, profile,
                     {reach.threshold_cd_m2, reach.tail_threshold_cd_m2, {0.25, tone_curve({}, 0.001), true}},
                     lights_, {});
        quads_.build(geometry_, lists_, lights_, pattern_.window_inner / pattern_.pitch);
    }

    // Rectangles of one kind in a band that hold a pixel and are a light's.
    int holding(QuadKind kind, RowRange band, std::size_t light, float x, float y) const {
        int count = 0;
        const QuadRange range = quads_.of_band(band, kind);
        for (int i = range.first; i < range.end; ++i) {
            const GridQuad& quad = quads_.quads()[static_cast<std::size_t>(i)];
            const bool inside = x > quad.rect[0] && x < quad.rect[2] && y > quad.rect[1] && y < quad.rect[3];
            if (inside && quad.light == static_cast<float>(light)) ++count;
        }
        return count;
    }

    ScreenGeometry geometry_;
    Pattern pattern_;
    std::vector<LightInstance> lights_;
    TileLists lists_;
    GridQuads quads_;
};

TEST_F(GridQuadsOfACrowd, EveryDepartureIsInOneRectangleOfItsBand) {
    const GridLevel& picture = lists_.levels()[0];
    const DepartureLists& departures = lists_.departures();
    ASSERT_GT(departures.entries().size(), 100U);
    double covered_px = 0;
    for (int tile = 0; tile < picture.tiles_across * picture.tiles_down; ++tile) {
        const int left = tile % picture.tiles_across * tile_width;
        const int bottom = tile / picture.tiles_across * tile_height;
        const int first = bottom / band_rows * band_rows;
        const RowRange band{first, std::min(band_rows, height_px - first)};
        const auto t = static_cast<std::size_t>(tile);
        for (auto i = static_cast<std::size_t>(departures.tile_begin()[t]);
             i < static_cast<std::size_t>(departures.tile_begin()[t + 1]); ++i) {
            const std::int32_t who = departures.entries()[i].light;
            const auto light = static_cast<std::size_t>(who < 0 ? -1 - who : who);
            const auto x = static_cast<float>(left) + 0.5F;
            const auto y = static_cast<float>(bottom) + 0.5F;
            const int one = holding(QuadKind::departs_one, band, light, x, y);
            const int two = holding(QuadKind::departs_two, band, light, x, y);
            const int fading = holding(QuadKind::departs_fading, band, light, x, y);
            EXPECT_EQ(one + two + fading, 1);
            if (one == 1) {
                EXPECT_TRUE(who < 0 || lists_.lights()[light].upper_share == 0);
            }
            covered_px += std::min(tile_width, width_px - left) * std::min(tile_height, height_px - bottom);
        }
    }
    // And what is near: nothing else is covered on the picture.
    for (std::size_t e = 0; e < lists_.entries().size(); ++e) {
        if (lists_.level_of_entry()[e] != 0) continue;
        const GatherEntry& entry = lists_.entries()[e];
        covered_px += static_cast<double>((entry.columns >> 16) - (entry.columns & 0xffffU) + 1) *
                      static_cast<double>((entry.rows >> 16) - (entry.rows & 0xffffU) + 1);
    }
    EXPECT_EQ(quads_.covered_px(), covered_px);
}

TEST_F(GridQuadsOfACrowd, OnlyDeparturesBeyondTheFadeAreDrawnWithoutIt) {
    int beyond = 0;
    for (int first = 0; first < height_px; first += band_rows) {
        const RowRange band{first, std::min(band_rows, height_px - first)};
        for (const QuadKind kind : {QuadKind::departs_one, QuadKind::departs_two}) {
            const QuadRange range = quads_.of_band(band, kind);
            for (int i = range.first; i < range.end; ++i) {
                const GridQuad& quad = quads_.quads()[static_cast<std::size_t>(i)];
                const auto light = static_cast<std::size_t>(quad.light);
                const LightInstance& instance = lights_[static_cast<std::size_t>(lists_.sources()[light])];
                const Vec3 towards = {static_cast<double>(instance.direction[0]),
                                      static_cast<double>(instance.direction[1]),
                                      static_cast<double>(instance.direction[2])};
                for (float y = quad.rect[1] + 0.5F; y < quad.rect[3]; ++y)
                    for (float x = quad.rect[0] + 0.5F; x < quad.rect[2]; ++x) {
                        const Vec3 ray =
                            normalised(ray_of_px(geometry_, static_cast<double>(x), static_cast<double>(y)));
                        const double nodes = length(cross(ray, towards)) / pattern_.pitch;
                        EXPECT_GT(nodes, fade_ratio * static_cast<double>(quad.departs_from));
                    }
                ++beyond;
            }
        }
    }
    EXPECT_GT(beyond, 10);
}

TEST_F(GridQuadsOfACrowd, EveryEntryOfAGridIsARectangleOfItsLevelWithTheLayersItNeeds) {
    for (int level = 1; level < lists_.levels_used(); ++level) {
        int of_level = 0;
        for (const std::uint8_t its_level : lists_.level_of_entry())
            of_level += its_level == level ? 1 : 0;
        const QuadRange one = quads_.of_level(level, QuadKind::mean_of_one);
        const QuadRange two = quads_.of_level(level, QuadKind::mean_of_two);
        EXPECT_EQ(one.count() + two.count(), of_level);
        for (int i = one.first; i < one.end; ++i) {
            const auto light = static_cast<std::size_t>(quads_.quads()[static_cast<std::size_t>(i)].light);
            EXPECT_EQ(lists_.lights()[light].upper_share, 0);
        }
    }
}

}  // namespace
}  // namespace seaglare::glare
