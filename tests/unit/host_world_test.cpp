// The stub host's world: where things are, how bright the sky is, where a point falls in the picture.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "host_stub/camera.h"
#include "host_stub/geodesy.h"
#include "host_stub/night_scene.h"
#include "host_stub/simulation.h"
#include "host_stub/sky.h"
#include "host_stub/waves.h"

namespace seaglare::host {
namespace {

TEST(Geodesy, AMinuteOfLatitudeIsANauticalMile) {
    // 1855.2 m at 55 degrees on WGS 84; the nautical mile, 1852 m, is its mean over the globe.
    const glm::dvec2 m = east_north_m({55, 11}, {55 + 1.0 / 60, 11});
    EXPECT_NEAR(m.y, 1855.2, 0.5);
    EXPECT_NEAR(m.x, 0, 1e-6);
}

TEST(Geodesy, ADegreeOfLongitudeShrinksWithLatitude) {
    // 111.32 km cos 55 degrees and the ellipsoid's 0.2 %: 63.99 km.
    EXPECT_NEAR(east_north_m({55, 11}, {55, 11.01}).x, 639.9, 0.5);
}

TEST(Geodesy, BearingsRunClockwiseFromNorth) {
    EXPECT_DOUBLE_EQ(bearing_deg({0, 1}), 0);
    EXPECT_DOUBLE_EQ(bearing_deg({1, 0}), 90);
    EXPECT_DOUBLE_EQ(bearing_deg({0, -1}), 180);
    EXPECT_DOUBLE_EQ(bearing_deg({-1, 0}), 270);
}

TEST(Sky, TheSunSetsInTheWestAndIsBackAfterADay) {
    const SkyDirection noon{35, 180};
    const SkyDirection evening = after_hours(noon, 55, 5);
    EXPECT_LT(evening.elevation_deg, 35);
    EXPECT_GT(evening.azimuth_deg, 180);
    EXPECT_LT(evening.azimuth_deg, 360);
    const SkyDirection next = after_hours(noon, 55, 24);
    EXPECT_NEAR(next.elevation_deg, 35, 1e-9);
    EXPECT_NEAR(next.azimuth_deg, 180, 1e-9);
}

TEST(Sky, IlluminanceOfTheSunIsThatOfTheNavalObservatory) {
    // Explanatory Supplement to the Astronomical Almanac (1992), illumination: end of civil twilight 3.4 lx, of nautical
    // 8.3e-3 lx, of astronomical 6.5e-4 lx; full sun overhead 1.3e5 lx.
    EXPECT_NEAR(sun_illuminance_lx(-6), 3.4, 0.1);
    EXPECT_NEAR(sun_illuminance_lx(-12), 8.3e-3, 3e-4);
    EXPECT_NEAR(sun_illuminance_lx(-18), 6.5e-4, 2e-5);
    EXPECT_NEAR(sun_illuminance_lx(90), 1.3e5, 1e4);
    EXPECT_EQ(sun_illuminance_lx(-30), 0);
}

TEST(Sky, FullMoonOverheadGivesAQuarterLuxAndAHalfMoonATenthOfThat) {
    EXPECT_NEAR(moon_illuminance_lx(90, 0), 0.267, 0.01);
    EXPECT_NEAR(moon_illuminance_lx(90, 90) / moon_illuminance_lx(90, 0), 0.12, 0.03);
    EXPECT_EQ(moon_illuminance_lx(-5, 0), 0);
}

TEST(Sky, TheDomeOfTwilightGivesTheGroundTheIlluminanceItWasMadeFor) {
    SkyConditions c;
    c.sun = {-7, 300};
    c.night_luminance_cd_m2 = 1e-5;
    EXPECT_NEAR(SkyTable(c).illuminance_lx(), sun_illuminance_lx(-7), 0.001 * sun_illuminance_lx(-7));
}

TEST(Sky, TwilightIsBrightestAndReddestOverTheSun) {
    SkyConditions c;
    c.sun = {-8, 300};
    const SkyTable sky(c);
    EXPECT_GT(sky.luminance({1, 300}), 3 * sky.luminance({1, 120}));
    EXPECT_GT(sky.luminance({1, 300}), 3 * sky.luminance({80, 300}));
    const auto low = sky.radiance({1, 300}), high = sky.radiance({80, 300});
    EXPECT_GT(low[0] / low[2], 2 * high[0] / high[2]);
}

TEST(Sky, ATownGlowsOnlyLowAndInItsDirection) {
    SkyConditions dark, lit;
    lit.towns.push_back({70, 5e-3, 10, 4});
    const SkyTable a(dark), b(lit);
    EXPECT_NEAR(b.luminance({0, 70}) - a.luminance({0, 70}), 5e-3, 1e-4);
    EXPECT_NEAR(b.luminance({0, 250}), a.luminance({0, 250}), 1e-6);
    EXPECT_LT(b.luminance({30, 70}) - a.luminance({30, 70}), 5e-4);
}

TEST(Sky, TheTableIsPeriodicInAzimuth) {
    SkyConditions c;
    c.sun = {-8, 0.3};
    const SkyTable sky(c);
    EXPECT_NEAR(sky.luminance({5, 359.999}), sky.luminance({5, 0.001}), 1e-3 * sky.luminance({5, 0}));
}

TEST(Sea, SlopesHaveTheVarianceOfCoxAndMunk) {
    // Cox and Munk 1954: total mean square slope 0.003 + 0.00512 U, here per axis.
    EXPECT_NEAR(make_sea(10, 0).slope_variance, 0.0542 / 2, 1e-12);
    double resolved = 0;
    for (const Wave& w : make_sea(10, 0).waves)
        resolved += w.slope * w.slope / 4;
    EXPECT_LT(resolved, make_sea(10, 0).slope_variance);
}

TEST(Camera, ALevelCameraHasTheHorizonInTheMiddleRow) {
    Channel c;
    c.up_deg = 22.5, c.down_deg = -22.5, c.right_deg = 36, c.left_deg = -36;
    EXPECT_NEAR(horizon_row_px(c, make_camera(c, {0, 0, 10}, 77, 0)), 360, 1e-3);
    // Looking up by 5 degrees lowers it by f tan 5, f = 360 / tan 22.5.
    const double focal_px = 360 / std::tan(22.5 * 3.14159265358979 / 180);
    EXPECT_NEAR(horizon_row_px(c, make_camera(c, {0, 0, 10}, 77, 5)),
                360 - focal_px * std::tan(5 * 3.14159265358979 / 180), 1e-2);
}

TEST(Camera, WhatLiesOnTheHeadingIsInTheMiddleAndWhatLiesToStarboardIsRight) {
    Channel c;
    c.up_deg = 22.5, c.down_deg = -22.5, c.right_deg = 36, c.left_deg = -36;
    const Camera east = make_camera(c, {100, 200, 10}, 90, 0);
    const glm::dvec3 ahead = project_px(c, east, {1100, 200, 10});
    EXPECT_NEAR(ahead.x, 640, 1e-9);
    EXPECT_NEAR(ahead.y, 360, 1e-9);
    EXPECT_NEAR(ahead.z, 1000, 1e-9);
    EXPECT_GT(project_px(c, east, {1100, 100, 10}).x, 640);
    EXPECT_LT(project_px(c, east, {-1100, 200, 10}).z, 0);
}

TEST(Exposure, BrighterEyesNeedLessOfIt) {
    // key(0.001)/0.001 = (1.002 - 2 / (2 + log10 1.001)) / 0.001.
    EXPECT_NEAR(exposure_per_cd_m2(0.001), 2.217, 0.001);
    EXPECT_LT(exposure_per_cd_m2(10), exposure_per_cd_m2(1));
}

TEST(TimeOfDay, IsReadAsHoursMinutesAndSeconds) {
    EXPECT_DOUBLE_EQ(parse_time_of_day("23:30"), 23.5);
    EXPECT_DOUBLE_EQ(parse_time_of_day("00:00:36"), 0.01);
    for (const char* bad : {"", "24:00", "12", "12:60", "12:00:60", "12:00x", "noon", "12:00:nan"})
        EXPECT_THROW(parse_time_of_day(bad), std::invalid_argument) << bad;
}

}  // namespace
}  // namespace seaglare::host
