// Photometers switch once at dusk and once at dawn, however the light flickers.
#include "lightdb/daylight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

namespace seaglare::lightdb {
namespace {

// 1 to 300 cd/m2 and back in ten thousand frames, with 20 % of jitter from frame to frame.
TEST(Daylight, ASlowDuskWithJitterSwitchesOnceEachWay) {
    std::optional<bool> day;
    int to_day = 0;
    int to_night = 0;
    for (int frame = 0; frame <= 10000; ++frame) {
        const double height = 1 - std::abs(frame / 5000.0 - 1);
        const double luminance = std::pow(300, height) * (1 + 0.2 * std::sin(12.9898 * frame));
        const bool now = is_day(luminance, day);
        if (day && now && !*day) ++to_day;
        if (day && !now && *day) ++to_night;
        day = now;
    }
    EXPECT_EQ(to_day, 1);
    EXPECT_EQ(to_night, 1);
}

TEST(Daylight, BetweenItsLevelsItStaysAsItWasAndAtFirstItIsNight) {
    const double between = (day_above_cd_m2 + night_below_cd_m2) / 2;
    EXPECT_TRUE(is_day(between, true));
    EXPECT_FALSE(is_day(between, false));
    EXPECT_FALSE(is_day(between, std::nullopt));
    EXPECT_TRUE(is_day(31, false));
    EXPECT_FALSE(is_day(14, true));
    EXPECT_FALSE(is_day(0, true));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(is_day(nan, true));
    EXPECT_FALSE(is_day(nan, false));
}

}  // namespace
}  // namespace seaglare::lightdb
