// The pattern that views share: when it is made anew, when it is the one made before, and that neither is ever stale.
#include "plugin_api/pattern_store.h"

#include <gtest/gtest.h>

namespace {

using namespace seaglare;
using plugin::PatternStore;

constexpr bool no_opencl = false;

glare::PatternSettings small_settings() {
    glare::PatternSettings settings;
    settings.transform_size = 256;
    settings.wavelengths = 3;
    settings.max_radius_nodes = 12;
    settings.layer_radii_px = {0};
    return settings;
}

glare::PatternRequest request_of(double pitch, double pupil_mm = 6) {
    glare::PatternRequest request;
    request.pitch = pitch;
    request.pupil_mm = pupil_mm;
    return request;
}

class Store : public ::testing::Test {
  protected:
    PatternStore store_{glare::young_eye(), small_settings(), 1, no_opencl};
    std::unique_lock<std::mutex> lock_ = store_.lock();
};

TEST_F(Store, GivesTheSameInstantOnce) {
    const std::uint64_t first = store_.pattern(request_of(1e-3)).generation;
    EXPECT_FALSE(store_.reused());
    EXPECT_EQ(store_.pattern(request_of(1e-3)).generation, first);
    EXPECT_TRUE(store_.reused());
    EXPECT_NE(store_.pattern(request_of(2e-3)).generation, first);
    EXPECT_FALSE(store_.reused());
}

// The CPU's pattern stands still while the pupil hardly moves: nothing was made, and the plan says so.
TEST_F(Store, SaysThatAPatternWhichTheSourceKeptIsReused) {
    const std::uint64_t first = store_.pattern(request_of(1e-3)).generation;
    EXPECT_EQ(store_.pattern(request_of(1e-3, 6.01)).generation, first);
    EXPECT_TRUE(store_.reused());
    EXPECT_NE(store_.pattern(request_of(1e-3, 3)).generation, first);
    EXPECT_FALSE(store_.reused());
}

// A source forgets patterns: a window that is resized while the time stands still comes back to its first size.
TEST_F(Store, AfterManyPitchesTheFirstIsStillThatOfItsPitch) {
    const glare::Pattern first = store_.pattern(request_of(1e-3));
    for (int i = 1; i <= 40; ++i) {
        EXPECT_EQ(store_.pattern(request_of(1e-3 + i * 1e-5)).pitch, 1e-3 + i * 1e-5);
        const glare::Pattern& again = store_.pattern(request_of(1e-3));
        ASSERT_EQ(again.pitch, 1e-3);
    }
    for (int i = 1; i <= 40; ++i)
        store_.pattern(request_of(2e-3 + i * 1e-5));
    const glare::Pattern& again = store_.pattern(request_of(1e-3));
    EXPECT_EQ(again.pitch, first.pitch);
    EXPECT_EQ(again.skirt, first.skirt);
}

TEST_F(Store, WarmingUpThePitchInUseSpoilsNoPattern) {
    const glare::Pattern before = store_.pattern(request_of(1e-3, 3));
    store_.warm_up(1e-3);
    const glare::Pattern& after = store_.pattern(request_of(1e-3, 3));
    EXPECT_EQ(after.pupil_mm, before.pupil_mm);
    EXPECT_EQ(after.skirt, before.skirt);
}

TEST_F(Store, NoTwoStoresGiveOneGeneration) {
    PatternStore other(glare::young_eye(), small_settings(), 2, no_opencl);
    const auto other_lock = other.lock();
    const std::uint64_t here = store_.pattern(request_of(1e-3)).generation;
    const std::uint64_t there = other.pattern(request_of(1e-3)).generation;
    EXPECT_NE(here, there);
    EXPECT_GT(here, 0U);
}

}  // namespace
