// Lights in the order of their rows, and the ranges of them that bands are drawn from.
#include "glare/apply/band_lights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace seaglare::glare {
namespace {

constexpr int height_px = 200;  // four bands, of which the last has eight rows

LightInstance light_at(float row, float reach_px) {
    LightInstance light;
    light.centre_px = {50, row};
    light.core_rect = {40, row - reach_px, 60, row + reach_px};
    return light;
}

bool reaches(const LightInstance& light, RowRange band) {
    const RectPx& r = light.core_rect;
    return r[0] < r[2] && r[1] < static_cast<float>(band.end()) && r[3] > static_cast<float>(band.first);
}

struct Lights {
    std::vector<LightInstance> list;
    std::vector<std::uint32_t> tags;
    void add(const LightInstance& light) {
        tags.push_back(static_cast<std::uint32_t>(list.size()));
        list.push_back(light);
    }
};

Lights random_lights(unsigned seed) {
    Lights lights;
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> part(0, 1);
    for (int i = 0; i < 60; ++i) {
        LightInstance light = light_at(300 * part(random) - 50, 1 + 40 * part(random) * part(random));
        if (i % 9 == 8) light.core_rect = {};
        lights.add(light);
    }
    return lights;
}

TEST(BandLights, EveryLightThatReachesABandIsInItsRangeAndTheEndsOfTheRangeReachIt) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        Lights lights = random_lights(seed);
        RowOrder order;
        order.sort(height_px, lights.list, lights.tags);
        BandLights found;
        found.find(lights.list, &LightInstance::core_rect, height_px);
        for (int first = 0; first < height_px; first += band_rows) {
            const RowRange band{first, std::min(band_rows, height_px - first)};
            const LightRange range = found.of(band);
            for (std::size_t i = 0; i < lights.list.size(); ++i) {
                if (!reaches(lights.list[i], band)) continue;
                EXPECT_GE(i, range.first);
                EXPECT_LT(i, range.end);
            }
        }
    }
}

TEST(BandLights, SmallLightsInTheOrderOfTheirRowsAreDrawnHardlyTwice) {
    Lights lights;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> part(0, 1);
    for (int i = 0; i < 1000; ++i)
        lights.add(light_at(static_cast<float>(height_px) * part(random), 2));
    RowOrder order;
    order.sort(height_px, lights.list, lights.tags);
    BandLights found;
    found.find(lights.list, &LightInstance::core_rect, height_px);
    std::size_t drawn = 0;
    for (int first = 0; first < height_px; first += band_rows) {
        const LightRange range = found.of({first, band_rows});
        drawn += range.empty() ? 0 : range.end - range.first;
    }
    // Each reaches 1.06 bands; a step of the order, eight rows of the neighbour's, comes on top.
    EXPECT_LE(drawn, 5 * lights.list.size() / 4);
}

TEST(BandLights, NothingReachesABandWithoutLights) {
    Lights lights;
    lights.add(light_at(10, 3));
    lights.add(light_at(196, 3));
    BandLights found;
    found.find(lights.list, &LightInstance::core_rect, height_px);
    EXPECT_FALSE(found.of({0, band_rows}).empty());
    EXPECT_TRUE(found.of({64, band_rows}).empty());
    EXPECT_TRUE(found.of({128, band_rows}).empty());
    EXPECT_FALSE(found.of({192, 8}).empty());
    found.find({}, &LightInstance::core_rect, height_px);
    EXPECT_TRUE(found.of({0, band_rows}).empty());
}

TEST(RowOrder, KeepsTagsWithTheirLightsAndLightsOfAStepInTheirOrder) {
    Lights lights = random_lights(5);
    lights.add(light_at(std::numeric_limits<float>::quiet_NaN(), 1));
    lights.add(light_at(std::numeric_limits<float>::infinity(), 1));
    const std::vector<LightInstance> before = lights.list;
    RowOrder order;
    order.sort(height_px, lights.list, lights.tags);
    ASSERT_EQ(lights.list.size(), before.size());
    const auto step_of = [](const LightInstance& light) {
        const float row = light.centre_px[1];
        return std::isnan(row)
                   ? 0
                   : static_cast<int>(std::clamp(row, 0.0F, height_px - 1.0F)) / RowOrder::step_rows;
    };
    for (std::size_t i = 0; i < before.size(); ++i) {
        const LightInstance& same = before[lights.tags[i]];
        EXPECT_EQ(lights.list[i].core_rect[0], same.core_rect[0]);
        if (std::isfinite(same.centre_px[1])) {
            EXPECT_EQ(lights.list[i].centre_px[1], same.centre_px[1]);
        }
        if (i == 0) continue;
        const int step = step_of(lights.list[i]);
        EXPECT_GE(step, step_of(lights.list[i - 1]));
        if (step == step_of(lights.list[i - 1])) {
            EXPECT_GT(lights.tags[i], lights.tags[i - 1]);
        }
    }
}

}  // namespace
}  // namespace seaglare::glare
