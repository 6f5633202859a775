// WGS 84 and the scene's frame.
#include "lightdb/geodesy.h"

#include <gtest/gtest.h>

#include <cmath>

namespace seaglare::lightdb {
namespace {

// The semi-axes of WGS 84 (NIMA TR8350.2).
TEST(Geodesy, TheEllipsoidHasItsAxes) {
    EXPECT_NEAR(earth_centred_from_geographic({0, 0, 0})[0], 6378137, 1e-6);
    EXPECT_NEAR(earth_centred_from_geographic({0, 90, 0})[1], 6378137, 1e-6);
    EXPECT_NEAR(earth_centred_from_geographic({90, 0, 0})[2], 6356752.3142, 1e-3);
    EXPECT_NEAR(earth_centred_from_geographic({-90, 33, 100})[2], -6356852.3142, 1e-3);
}

// One minute of latitude is 1852 m to half a per cent everywhere: 1842.9 at the equator, 1861.6 at the poles.
TEST(Geodesy, AMinuteOfLatitudeIsAMile) {
    for (const double latitude_deg : {0.0, 30.0, 55.3, 80.0}) {
        const GeographicPoint origin = {latitude_deg, 11, 0};
        const Vec3 p = scene_from_geographic({latitude_deg + 1.0 / 60, 11, 0}, origin, Earth::flat);
        EXPECT_NEAR(p[1], 1852.2 - 9.3 * std::cos(2 * latitude_deg * 3.14159265 / 180), 0.5);
        EXPECT_NEAR(p[0], 0, 1e-9);
    }
}

TEST(Geodesy, FlatSceneKeepsHeightsAndRoundSceneSinks) {
    const GeographicPoint origin = {55.3, 11, 3};
    const GeographicPoint light = {55.3, 11.3, 20};
    const Vec3 flat = scene_from_geographic(light, origin, Earth::flat);
    const Vec3 round = scene_from_geographic(light, origin, Earth::round);
    EXPECT_EQ(flat[0], round[0]);
    EXPECT_EQ(flat[1], round[1]);
    EXPECT_EQ(flat[2], 17);
    EXPECT_NEAR(flat[2] - round[2], flat[0] * flat[0] / (2 * earth_radius_m), 0.2);  // 28 m at 19 km
}

TEST(Geodesy, TheOriginIsTheOrigin) {
    const GeographicPoint origin = {-33.9, 151.2, 5};
    const Vec3 p = scene_from_geographic(origin, origin, Earth::round);
    for (const double coordinate_m : p)
        EXPECT_NEAR(coordinate_m, 0, 1e-9);
    EXPECT_NEAR(true_north_in_scene_deg(origin, origin), 0, 1e-12);
}

TEST(Geodesy, LocalAndEarthCentredAreInverse) {
    const LocalFrame frame({55.3, 11, 3});
    const Vec3 p = {12345.6, -2345.6, 78.9};
    const Vec3 back = frame.local_from_earth_centred(frame.earth_centred_from_local(p));
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(back[i], p[i], 1e-8);
    EXPECT_NEAR(dot(cross(frame.east, frame.north), frame.up), 1, 1e-15);
}

// sin(latitude) times the difference of longitude: 0.29 degrees over 0.35 degrees across the Great Belt.
TEST(Geodesy, MeridiansConvergeAcrossTheGreatBelt) {
    const GeographicPoint origin = {55.5, 10.95, 0};
    EXPECT_NEAR(true_north_in_scene_deg({55.5, 11.30, 0}, origin), -0.29, 0.005);
    EXPECT_NEAR(true_north_in_scene_deg({55.5, 10.60, 0}, origin), 0.29, 0.005);
    EXPECT_NEAR(true_north_in_scene_deg({55.9, 10.95, 0}, origin), 0, 1e-12);
    EXPECT_GT(true_north_in_scene_deg({-55.5, 11.30, 0}, {-55.5, 10.95, 0}),
              0);  // the other way in the south
}

TEST(Geodesy, OnlyGeographicLightsArePlaced) {
    std::vector<Light> lights(2);
    lights[0].geographic = true;
    lights[0].latitude_deg = 55.4;
    lights[0].longitude_deg = 11.1;
    lights[0].height_m = 20;
    lights[1].position_m = {1, 2, 3};
    lights[1].true_north_deg = 4;
    place_lights(lights, {55.3, 11, 0}, Earth::flat);
    EXPECT_NEAR(lights[0].position_m[0], 6332, 20);
    EXPECT_NEAR(lights[0].position_m[1], 11135, 20);
    EXPECT_EQ(lights[0].position_m[2], 20);
    EXPECT_LT(lights[0].true_north_deg, 0);
    EXPECT_EQ(lights[1].position_m, (Vec3{1, 2, 3}));
    EXPECT_EQ(lights[1].true_north_deg, 4);
    place_lights(lights, {55.4, 11.1, 0}, Earth::flat);  // another scene
    EXPECT_NEAR(lights[0].position_m[0], 0, 1e-6);
}

}  // namespace
}  // namespace seaglare::lightdb
