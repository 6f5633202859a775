// From each of the host's conventions to the scene: the same point, the same heading, whatever the axes are called.
#include "plugin_api/world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "lightdb/geodesy.h"
#include "lightdb/vector_math.h"

namespace {

using namespace seaglare;
using plugin::Mat4;
using plugin::Vec3;

plugin::World world(std::int32_t axes, double latitude_deg = 0, double longitude_deg = 0,
                    double height_m = 0) {
    seaglare_create_info info{};
    info.axes = axes;
    info.origin_latitude_deg = latitude_deg;
    info.origin_longitude_deg = longitude_deg;
    info.origin_height_m = height_m;
    return plugin::World(info);
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-9) {
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

constexpr std::int32_t all_axes[] = {SEAGLARE_AXES_EAST_NORTH_UP, SEAGLARE_AXES_EAST_UP_SOUTH,
                                     SEAGLARE_AXES_EAST_UP_NORTH, SEAGLARE_AXES_NORTH_EAST_DOWN,
                                     SEAGLARE_AXES_EARTH_CENTRED};

// The unit vectors east, north and up in the host's axes.
Vec3 host_axis(std::int32_t axes, int direction) {
    static constexpr double table[4][3][3] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                              {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                              {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                              {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}};
    const auto& axis = table[axes][direction];
    return {axis[0], axis[1], axis[2]};
}

TEST(World, EastNorthAndUpLieWhereTheConventionSays) {
    for (std::int32_t axes = 0; axes < SEAGLARE_AXES_EARTH_CENTRED; ++axes) {
        SCOPED_TRACE(axes);
        for (int direction = 0; direction < 3; ++direction) {
            Vec3 expected{};
            expected[static_cast<std::size_t>(direction)] = 1;
            expect_near(world(axes).scene_from_host(host_axis(axes, direction).data()), expected);
        }
    }
}

TEST(World, PositionsSurviveTheRoundTrip) {
    for (const std::int32_t axes : all_axes) {
        SCOPED_TRACE(axes);
        const plugin::World w = world(axes, 55.3, 11.0, 2);
        const Vec3 point = {1234.5, -987.25, 12};
        expect_near(w.scene_from_host(w.host_from_scene(point).data()), point, 1e-6);
    }
}

// WGS 84 at latitude 0, longitude 0: x up, y east, z north; the semi-major axis is 6378137 m (NIMA TR8350.2).
TEST(World, AnEarthCentredOriginIsTheScenesOrigin) {
    const plugin::World w = world(SEAGLARE_AXES_EARTH_CENTRED, 0, 0, 10);
    const double point[3] = {6378137.0 + 15, 100, 200};
    expect_near(w.scene_from_host(point), {100, 200, 5}, 1e-6);
}

TEST(World, TheIdentityAttitudeIsUprightAndHeadsNorth) {
    const double identity[4] = {0, 0, 0, 1};
    for (std::int32_t axes = 0; axes < SEAGLARE_AXES_EARTH_CENTRED; ++axes) {
        SCOPED_TRACE(axes);
        const plugin::Quaternion q = world(axes).scene_from_body(identity);
        expect_near(lightdb::rotate(q, {0, 1, 0}), {0, 1, 0});
        expect_near(lightdb::rotate(q, {0, 0, 1}), {0, 0, 1});
    }
}

// A turn about the host's vertical that takes its north to its east, in its own quaternions, is a heading of 090.
TEST(World, AQuarterTurnToStarboardHeadsEastInEveryConvention) {
    const double h = std::numbers::sqrt2 / 2;
    // About up it is clockwise seen from above, so negative in right-handed axes with up; about down it is positive; in
    // left-handed axes the sign turns round.
    const std::vector<std::array<double, 4>> turns = {
        {0, 0, -h, h}, {0, -h, 0, h}, {0, h, 0, h}, {0, 0, h, h}};
    for (std::int32_t axes = 0; axes < SEAGLARE_AXES_EARTH_CENTRED; ++axes) {
        SCOPED_TRACE(axes);
        const plugin::Quaternion q =
            world(axes).scene_from_body(turns[static_cast<std::size_t>(axes)].data());
        expect_near(lightdb::rotate(q, {0, 1, 0}), {1, 0, 0});
        expect_near(lightdb::rotate(q, {1, 0, 0}), {0, -1, 0});
    }
}

// What a host sees of a point through its own view matrix is what the scene's view matrix sees of it.
TEST(World, TheViewSeesTheSamePointThere) {
    for (const std::int32_t axes : all_axes) {
        SCOPED_TRACE(axes);
        const plugin::World w = world(axes, 55.3, 11.0, 2);
        const Vec3 eye_host = w.host_from_scene({10, -20, 30});
        // Any rotation will do.
        const double c = std::cos(0.4), s = std::sin(0.4);
        Mat4 view = {c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 0, 0, 0, 1};
        for (std::size_t row = 0; row < 3; ++row)
            for (std::size_t k = 0; k < 3; ++k)
                view[12 + row] -= view[4 * k + row] * eye_host[k];
        const Mat4 view_from_scene = w.view_from_scene(view.data());
        expect_near(plugin::eye_of_view(view_from_scene), {10, -20, 30}, 1e-6);

        const Vec3 point = {500, 700, 40};
        const Vec3 point_host = w.host_from_scene(point);
        for (std::size_t row = 0; row < 3; ++row) {
            double host_sees = view[12 + row], scene_sees = view_from_scene[12 + row];
            for (std::size_t k = 0; k < 3; ++k) {
                host_sees += view[4 * k + row] * point_host[k];
                scene_sees += view_from_scene[4 * k + row] * point[k];
            }
            EXPECT_NEAR(host_sees, scene_sees, 1e-6);
        }
    }
}

TEST(World, AnUnnormalisedQuaternionTurnsAsItsUnitDoes) {
    const double unit[4] = {0.1, 0.2, 0.3, 0.9}, longer[4] = {10, 20, 30, 90};
    const plugin::World w = world(SEAGLARE_AXES_EAST_UP_SOUTH);
    const auto a = w.scene_from_body(unit), b = w.scene_from_body(longer);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(a[i], b[i], 1e-12);
}

}  // namespace
