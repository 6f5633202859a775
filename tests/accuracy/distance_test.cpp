// The law of distance, end to end: one lamp approached from 20 km to 20 m.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/accuracy/channel.h"

namespace seaglare::test {
namespace {

constexpr double intensity_cd = 10000;
constexpr double distances_m[] = {20000, 10000, 5000, 2000, 1000, 500, 200, 100, 50, 20};

ChannelOptions whole_glare() {
    ChannelOptions options;
    options.quality = {.cie_tail = false, .gratings = false};
    return options;
}

// Illuminance of the picture with the lamp at a distance; the visibility in m, 0 for clear air.
double seen_lx(Channel& channel, double distance_m, double visibility_m) {
    channel.clear();
    channel.place_eye({0, 0, 60});  // so that 20 km is above the horizon
    channel.add(white_light(channel.at_px(80.4, 80.7, distance_m), intensity_cd));
    seaglare_frame frame = channel.frame();
    if (visibility_m > 0) {
        frame.flags |= SEAGLARE_FRAME_HAS_FOG;
        frame.meteorological_visibility_m = visibility_m;
    }
    EXPECT_EQ(channel.render(frame), SEAGLARE_OK) << channel.last_error();
    return luminance_of(channel.energy_lx());
}

TEST(AccuracyDistance, InClearAirEnergyTimesDistanceSquaredIsTheIntensity) {
    SEAGLARE_CHANNEL(channel, whole_glare());
    for (const double d : distances_m) {
        const double ratio = seen_lx(channel, d, 0) * d * d / intensity_cd;
        EXPECT_NEAR(ratio, 1, 0.01) << d << " m";
        std::printf("  %6.0f m: E D^2/I = %.5f\n", d, ratio);
    }
}

TEST(AccuracyDistance, FogTakesWhatAllardsLawSays) {
    // E = I exp(-rho D)/D^2, rho = -ln 0.05 / V (Allard 1876; the 5 % of the meteorological optical range, WMO).
    SEAGLARE_CHANNEL(channel, whole_glare());
    for (const double visibility_m : {18520.0, 5000.0, 1000.0}) {
        const double rho = -std::log(0.05) / visibility_m;
        for (const double d : distances_m) {
            if (rho * d > 12) continue;  // less than a ten-thousandth of a moonless night's darkest star
            const double ratio =
                seen_lx(channel, d, visibility_m) * d * d / intensity_cd / std::exp(-rho * d);
            EXPECT_NEAR(ratio, 1, 0.01) << d << " m in a visibility of " << visibility_m << " m";
        }
    }
}

}  // namespace
}  // namespace seaglare::test
