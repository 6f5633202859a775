// The pattern that views share, for who waits: when it is made anew, when it is the one made before, and that neither is
// ever stale.
#include "plugin_api/pattern_store.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

using namespace seaglare;
using plugin::PatternDemand;
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

PatternDemand of(double pitch, double pupil_mm = 6) {
    PatternDemand demand;
    demand.moment.request.pitch = pitch;
    demand.moment.request.pupil_mm = pupil_mm;
    demand.wait = true;
    return demand;
}

class Store : public ::testing::Test {
  protected:
    PatternStore store_{glare::young_eye(), small_settings(), 1, no_opencl};
};

TEST_F(Store, GivesTheSameInstantOnce) {
    std::uint64_t first = 0;
    {
        const auto lease = store_.take(of(1e-3));
        first = lease.pattern().generation;
        EXPECT_FALSE(lease.reused());
    }
    {
        const auto lease = store_.take(of(1e-3));
        EXPECT_EQ(lease.pattern().generation, first);
        EXPECT_TRUE(lease.reused());
    }
    const auto other = store_.take(of(2e-3));
    EXPECT_NE(other.pattern().generation, first);
    EXPECT_FALSE(other.reused());
}

// The CPU's pattern stands still while the pupil hardly moves: nothing was made, and the plan says so.
TEST_F(Store, SaysThatAPatternWhichTheSourceKeptIsReused) {
    const std::uint64_t first = store_.take(of(1e-3)).pattern().generation;
    {
        const auto lease = store_.take(of(1e-3, 6.01));
        EXPECT_EQ(lease.pattern().generation, first);
        EXPECT_TRUE(lease.reused());
    }
    const auto other = store_.take(of(1e-3, 3));
    EXPECT_NE(other.pattern().generation, first);
    EXPECT_FALSE(other.reused());
}

// A store forgets patterns: a window that is resized while the time stands still comes back to its first size.
TEST_F(Store, AfterManyPitchesTheFirstIsStillThatOfItsPitch) {
    const glare::Pattern first = store_.take(of(1e-3)).pattern();
    for (int i = 1; i <= 40; ++i) {
        EXPECT_EQ(store_.take(of(1e-3 + i * 1e-5)).pattern().pitch, 1e-3 + i * 1e-5);
        ASSERT_EQ(store_.take(of(1e-3)).pattern().pitch, 1e-3);
    }
    for (int i = 1; i <= 40; ++i)
        static_cast<void>(store_.take(of(2e-3 + i * 1e-5)));
    const auto again = store_.take(of(1e-3));
    EXPECT_EQ(again.pattern().pitch, first.pitch);
    EXPECT_EQ(again.pattern().skirt, first.skirt);
}

TEST_F(Store, WarmingUpThePitchInUseSpoilsNoPattern) {
    const glare::Pattern before = store_.take(of(1e-3, 3)).pattern();
    store_.warm_up(1e-3);
    const auto after = store_.take(of(1e-3, 3));
    EXPECT_EQ(after.pattern().pupil_mm, before.pupil_mm);
    EXPECT_EQ(after.pattern().skirt, before.skirt);
}

TEST_F(Store, NoTwoStoresGiveOneGeneration) {
    PatternStore other(glare::young_eye(), small_settings(), 2, no_opencl);
    const std::uint64_t here = store_.take(of(1e-3)).pattern().generation;
    const std::uint64_t there = other.take(of(1e-3)).pattern().generation;
    EXPECT_NE(here, there);
    EXPECT_GT(here, 0U);
}

// A view may still draw on its thread with what another has replaced.
TEST_F(Store, APatternStaysAsItIsWhileItIsLeased) {
    const auto lease = store_.take(of(1e-3, 6));
    const std::uint64_t generation = lease.pattern().generation;
    const std::vector<float> skirt(lease.pattern().skirt.begin(), lease.pattern().skirt.end());
    for (const double pupil_mm : {3.0, 4.0, 5.0, 7.0})
        EXPECT_NE(store_.take(of(1e-3, pupil_mm)).pattern().skirt, skirt);
    for (int i = 1; i <= 40; ++i)
        static_cast<void>(store_.take(of(1e-3 + i * 1e-5)));
    EXPECT_EQ(lease.pattern().skirt, skirt);
    EXPECT_EQ(lease.pattern().generation, generation);
}

TEST_F(Store, RefusesAPitchThatIsNone) {
    EXPECT_THROW(static_cast<void>(store_.take(of(0))), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(store_.take(of(std::numeric_limits<double>::quiet_NaN()))),
                 std::invalid_argument);
}

}  // namespace
