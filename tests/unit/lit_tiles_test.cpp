// Which tiles of a band can change the picture.
#include "glare/apply/lit_tiles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace seaglare::glare {
namespace {

constexpr int width_px = 150;  // four tiles and a part of a fifth

std::vector<float> dark_band(int rows) {
    return std::vector<float>(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(rows) * 4);
}
std::size_t component(int x, int y, int c) {
    return (static_cast<std::size_t>(y) * width_px + static_cast<std::size_t>(x)) * 4 +
           static_cast<std::size_t>(c);
}

int times_covered(std::span<const PixelBox> boxes, int x, int y) {
    int times = 0;
    for (const PixelBox& box : boxes)
        times += x >= box.left && x < box.right && y >= box.bottom && y < box.top;
    return times;
}

class Tiles : public ::testing::Test {
  protected:
    Tiles() { tiles_.begin(width_px, 0.5); }
    // Boxes of a band of this many rows from row 64 on, of the whole of it.
    std::span<const PixelBox> boxes(int rows = band_rows) {
        return tiles_.boxes_in({0, 64, width_px, 64 + rows});
    }
    LitTiles tiles_;
};

TEST_F(Tiles, AreDarkUntilSomethingIsLitAndAllOfABandIsOneBox) {
    tiles_.turn_to({64, band_rows});
    EXPECT_TRUE(boxes().empty());
    tiles_.light_all();
    ASSERT_EQ(boxes().size(), 1U);
    EXPECT_EQ(boxes()[0].width(), width_px);
    EXPECT_EQ(boxes()[0].height(), band_rows);
    tiles_.turn_to({128, band_rows});
    EXPECT_TRUE(tiles_.boxes_in({0, 128, width_px, 192}).empty());
}

TEST_F(Tiles, AreLitByAnyComponentOfAnyPixelAboveTheLeastAndByNothingBelowIt) {
    constexpr int rows = 40;
    std::mt19937 random(7);
    for (int i = 0; i < 400; ++i) {
        const int x = static_cast<int>(random() % width_px);
        const int y = static_cast<int>(random() % rows);
        const int c = static_cast<int>(random() % 4);
        // Rods count by half; a negative colour moves what it is mixed with.
        const float enough = c == 3 ? 0.99F : 0.51F;
        for (const float sign : {1.0F, -1.0F}) {
            if (c == 3 && sign < 0) continue;
            auto band = dark_band(rows);
            band[component(x, y, c)] = sign * enough;
            tiles_.turn_to({64, rows});
            tiles_.light(band);
            ASSERT_EQ(boxes(rows).size(), 1U) << x << ", " << y << ", " << c;
            EXPECT_EQ(times_covered(boxes(rows), x, 64 + y), 1);
            EXPECT_LE(boxes(rows)[0].width(), LitTiles::tile_width_px);
            EXPECT_LE(boxes(rows)[0].height(), LitTiles::tile_height_px);
            band[component(x, y, c)] *= 0.95F;
            tiles_.turn_to({64, rows});
            tiles_.light(band);
            EXPECT_TRUE(boxes(rows).empty()) << x << ", " << y << ", " << c;
        }
    }
}

TEST_F(Tiles, AreNotLitByWhatIsNoNumber) {
    auto band = dark_band(band_rows);
    band[component(70, 20, 1)] = std::nanf("");
    tiles_.turn_to({64, band_rows});
    tiles_.light(band);
    EXPECT_TRUE(boxes().empty());
    band[component(71, 20, 1)] = HUGE_VALF;
    tiles_.light(band);
    EXPECT_EQ(times_covered(boxes(), 71, 84), 1);
}

TEST_F(Tiles, ThatRectanglesTouchAreCoveredOnceAndFewOthers) {
    std::mt19937 random(8);
    std::uniform_real_distribution<float> uniform(-40, 200);
    for (int i = 0; i < 300; ++i) {
        tiles_.turn_to({64, band_rows});
        std::vector<RectPx> rects;
        for (int k = 0; k < 4; ++k) {
            const float x = uniform(random);
            const float y = uniform(random);
            rects.push_back({x, y, x + 0.2F * uniform(random), y + 0.2F * uniform(random)});
            tiles_.light(rects.back());
        }
        const std::span<const PixelBox> covered = boxes();
        for (int y = 64; y < 64 + band_rows; ++y) {
            for (int x = 0; x < width_px; ++x) {
                bool touched = false;
                bool near = false;
                for (const RectPx& r : rects) {
                    if (!(r[0] < r[2] && r[1] < r[3])) continue;
                    const auto fx = static_cast<float>(x);
                    const auto fy = static_cast<float>(y);
                    touched |= r[0] < fx + 1 && r[2] > fx && r[1] < fy + 1 && r[3] > fy;
                    near |= r[0] < fx + LitTiles::tile_width_px && r[2] > fx - LitTiles::tile_width_px &&
                            r[1] < fy + LitTiles::tile_height_px && r[3] > fy - LitTiles::tile_height_px;
                }
                const int times = times_covered(covered, x, y);
                ASSERT_LE(times, 1);
                if (touched) {
                    ASSERT_EQ(times, 1) << x << ", " << y;
                }
                if (!near) {
                    ASSERT_EQ(times, 0) << x << ", " << y;
                }
            }
        }
    }
}

TEST_F(Tiles, OfALightAreThoseOfItsRectanglesAndOfItsTailAsFarAsItsGridCarriesIt) {
    LightInstance light;
    light.core_rect = {3, 70, 5, 72};
    light.tail_rect = {97, 100, 99, 101};
    tiles_.turn_to({64, band_rows});
    tiles_.light(std::span<const LightInstance>(&light, 1), 4);
    EXPECT_EQ(times_covered(boxes(), 4, 71), 1);
    EXPECT_EQ(times_covered(boxes(), 98, 100), 1);
    EXPECT_EQ(times_covered(boxes(), 94, 100), 1) << "a cell further";
    EXPECT_EQ(times_covered(boxes(), 40, 71), 0);
}

TEST_F(Tiles, AreCutToTheBoxAskedFor) {
    tiles_.turn_to({64, band_rows});
    tiles_.light_all();
    const std::span<const PixelBox> cut = tiles_.boxes_in({10, 70, 100, 90});
    EXPECT_EQ(times_covered(cut, 9, 75) + times_covered(cut, 100, 75) + times_covered(cut, 50, 69) +
                  times_covered(cut, 50, 90),
              0);
    EXPECT_EQ(times_covered(cut, 10, 70), 1);
    EXPECT_EQ(times_covered(cut, 99, 89), 1);
}

}  // namespace
}  // namespace seaglare::glare
