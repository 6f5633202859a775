#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "glare/apply/screen_geometry.h"

namespace seaglare::glare {
namespace {

Frame frame_of(double left, double right, double bottom, double top, int width, int height,
               double ahead = -1) {
    Frame frame;
    frame.viewport_px = {0, 0, width, height};
    auto& m = frame.clip_from_view;
    m[0] = 2 / (right - left);
    m[5] = 2 / (top - bottom);
    m[8] = -ahead * (right + left) / (right - left);
    m[9] = -ahead * (top + bottom) / (top - bottom);
    m[10] = ahead;
    m[11] = ahead;
    m[14] = -0.2;
    return frame;
}

// Cited: 720 lines at 45 degrees give f = 869.1 px.
TEST(ScreenGeometry, PitchIsOneOverTheFocalLength) {
    const double t = std::tan(22.5 * std::numbers::pi / 180);
    const ScreenGeometry g = screen_geometry(frame_of(-t * 16 / 9, t * 16 / 9, -t, t, 1280, 720));
    EXPECT_NEAR(1 / g.pitch, 869.117, 1e-3);
    EXPECT_NEAR(g.plane_area_px, g.pitch * g.pitch, 1e-12);
}

TEST(ScreenGeometry, RaysProjectBackToTheirPixelsInEveryFrustumAndHandedness) {
    for (const double ahead : {-1.0, 1.0}) {
        const ScreenGeometry g = screen_geometry(frame_of(-0.2, 0.9, 0.1, 0.6, 300, 200, ahead));
        EXPECT_GT(g.forward[2] * ahead, 0.99);
        for (double x = 0; x <= 300; x += 37) {
            for (double y = 0; y <= 200; y += 23) {
                std::array<double, 2> px{};
                ASSERT_TRUE(project_px(g, ray_of_px(g, x, y), px));
                EXPECT_NEAR(px[0], x, 1e-9);
                EXPECT_NEAR(px[1], y, 1e-9);
            }
        }
    }
}

TEST(ScreenGeometry, PixelsOfAFullSideOfACubeAddUpToASixthOfTheSphere) {
    const ScreenGeometry g = screen_geometry(frame_of(-1, 1, -1, 1, 200, 200));
    double sum = 0;
    for (int y = 0; y < 200; ++y) {
        for (int x = 0; x < 200; ++x)
            sum += pixel_solid_angle_sr(g, ray_of_px(g, x + 0.5, y + 0.5));
    }
    EXPECT_NEAR(sum, 4 * std::numbers::pi / 6, 1e-4);
}

TEST(ScreenGeometry, TangentsAgreeWithTheScreenInTheMiddleAndStayPerpendicular) {
    const ScreenGeometry g = screen_geometry(frame_of(-1, 1, -1, 1, 200, 200));
    const Tangents middle = pattern_tangents(g, g.forward);
    EXPECT_NEAR(middle.u[0], 1, 1e-12);
    EXPECT_NEAR(middle.v[1], 1, 1e-12);
    const Vec3 d = ray_of_px(g, 190, 15);
    const Tangents t = pattern_tangents(g, d);
    EXPECT_NEAR(dot(t.u, d), 0, 1e-12);
    EXPECT_NEAR(dot(t.u, t.v), 0, 1e-12);
    EXPECT_NEAR(length(t.u), 1, 1e-12);
}

TEST(ScreenGeometry, ConeBoundsHoldEveryDirectionOfTheCone) {
    const ScreenGeometry g = screen_geometry(frame_of(-0.2, 0.9, -0.4, 0.6, 300, 200));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 d = normalised({unit(random), unit(random), unit(random)});
        const double angle = 0.8 * std::abs(unit(random));
        const PixelRect rect = cone_bounds_px(g, d, angle);
        const double outside = angle_outside_rad(g, d);
        for (int k = 0; k < 20; ++k) {
            const Vec3 ray = ray_of_px(g, 150 * (1 + unit(random)), 100 * (1 + unit(random)));
            const double to_light = std::acos(std::clamp(dot(ray, d), -1.0, 1.0));
            EXPECT_GE(to_light, outside - 1e-7);
            if (to_light > angle) continue;
            std::array<double, 2> px{};
            ASSERT_TRUE(project_px(g, ray, px));
            EXPECT_GE(px[0], rect.left - 1e-6);
            EXPECT_LE(px[0], rect.right + 1e-6);
            EXPECT_GE(px[1], rect.bottom - 1e-6);
            EXPECT_LE(px[1], rect.top + 1e-6);
        }
    }
}

TEST(ScreenGeometry, RefusesWhatIsNoPerspective) {
    Frame frame = frame_of(-1, 1, -1, 1, 10, 10);
    frame.clip_from_view[11] = 0;  // parallel
    EXPECT_THROW(screen_geometry(frame), std::invalid_argument);
    frame = frame_of(-1, 1, -1, 1, 10, 10);
    frame.clip_from_view[0] = 0;
    EXPECT_THROW(screen_geometry(frame), std::invalid_argument);
    frame.clip_from_view[0] = std::nan("");
    EXPECT_THROW(screen_geometry(frame), std::invalid_argument);
    frame = frame_of(-1, 1, -1, 1, 0, 10);
    EXPECT_THROW(screen_geometry(frame), std::invalid_argument);
}

}  // namespace
}  // namespace seaglare::glare
