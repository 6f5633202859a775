#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "glare/apply/glare_bound.h"
#include "glare/apply/view_renderer.h"
#include "glare/psf/cie_curve.h"
#include "glare/tone/operators.h"

namespace seaglare::glare {
namespace {

Frame night() {
    Frame frame;
    frame.viewport_px = {0, 0, 1280, 720};
    const double t = std::tan(22.5 * std::numbers::pi / 180);
    frame.clip_from_view = {9 / (16 * t), 0, 0, 0, 0, 1 / t, 0, 0, 0, 0, -1, -1, 0, 0, -0.2, 0};
    frame.adaptation_luminance_cd_m2 = 0.001;
    return frame;
}

PointSource source(double azimuth_deg, double lux) {
    PointSource s;
    const double a = azimuth_deg * std::numbers::pi / 180;
    s.position_view_m = {static_cast<float>(1000 * std::sin(a)), 0, static_cast<float>(-1000 * std::cos(a))};
    s.illuminance_rgb_lx = {static_cast<float>(lux), static_cast<float>(lux), static_cast<float>(lux)};
    s.illuminance_scotopic_lx = static_cast<float>(2.464 * lux);
    return s;
}

TEST(Cull, BoundLiesAboveTheCurveAndItsReachIsOutside) {
    const GlareBound bound(24, 0.5);
    for (double angle = 1e-4; angle < 1.57; angle *= 1.3) {
        EXPECT_GE(bound.psf_sr(angle), 3.99 * cie_total_glare_sr(angle * 180 / std::numbers::pi, 24, 0.5));
        EXPECT_GE(bound.reach_rad(bound.psf_sr(angle)) * 1.0001, angle * 0.9);
        const double reach = bound.reach_rad(0.5 * bound.psf_sr(angle));
        if (reach < 1.57) {
            EXPECT_LE(bound.psf_sr(reach * 1.0001), 0.5 * bound.psf_sr(angle) * 1.0001);
        }
    }
    EXPECT_NEAR(bound.reach_rad(0), std::numbers::pi / 2, 1e-12);
}

TEST(Cull, KeepsWhatCanBeSeenAndCountsTheRest) {
    std::vector<PointSource> lights = {source(0, 1e-6),  source(180, 1e3),  source(0, 1e-14),
                                       source(50, 1e-2), source(60, 1e-10), source(10, 2e-7),
                                       source(0, 0)};
    lights.push_back(source(0, 1));
    lights.back().position_view_m[0] = std::nanf("");
    RenderStats stats;
    const std::size_t kept = ViewRenderer::cull(night(), {}, lights, stats);
    ASSERT_EQ(kept, 3U);
    EXPECT_EQ(lights[0].illuminance_rgb_lx[0], 1e-6F);
    EXPECT_EQ(lights[1].illuminance_rgb_lx[0], 1e-2F) << "off screen, but its glare reaches in";
    EXPECT_EQ(lights[2].illuminance_rgb_lx[0], 2e-7F) << "the faintest light of the nominal range";
    EXPECT_EQ(stats.lights_outside, 2U);
    EXPECT_EQ(stats.lights_below_threshold, 3U);
}

TEST(Cull, WhatIsLeftOutOffScreenCouldNotHaveMovedACode) {
    const Frame frame = night();
    const ToneSettings tone;
    const double least = threshold_luminance_cd_m2(tone, 0.001, tone.threshold_codes);
    const double edge_deg =
        std::atan(16.0 / 9 * std::tan(22.5 * std::numbers::pi / 180)) * 180 / std::numbers::pi;
    int left_out = 0;
    for (double beyond_deg = 0.5; beyond_deg < 50; beyond_deg += 0.5) {
        for (double lux = 1e-9; lux < 1; lux *= 3) {
            std::vector<PointSource> one = {source(edge_deg + beyond_deg, lux)};
            RenderStats stats;
            if (ViewRenderer::cull(frame, tone, one, stats) == 1) continue;
            ++left_out;
            EXPECT_LT(lux * cie_total_glare_sr(beyond_deg, 24, 0.5), least);
        }
    }
    EXPECT_GT(left_out, 100);
}

TEST(Cull, AMagnifiedPatternReachesFurther) {
    std::vector<PointSource> a = {source(45, 2e-5)};
    std::vector<PointSource> b = a;
    RenderStats stats;
    EXPECT_EQ(ViewRenderer::cull(night(), {}, a, stats, 1), 0U);
    EXPECT_EQ(ViewRenderer::cull(night(), {}, b, stats, 8), 1U);
}

}  // namespace
}  // namespace seaglare::glare
