// The bound below which lights are not even evaluated foresees what cull() does.
#include "glare/apply/least_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "glare/apply/view_renderer.h"
#include "glare/colour/navigation_colours.h"

namespace seaglare::glare {
namespace {

Frame picture(double vertical_fov_deg, int height_px, double adaptation_cd_m2) {
    Frame frame;
    frame.viewport_px = {0, 0, 16 * height_px / 9, height_px};
    const double t = std::tan(vertical_fov_deg / 2 * std::numbers::pi / 180);
    frame.clip_from_view = {9 / (16 * t), 0, 0, 0, 0, 1 / t, 0, 0, 0, 0, -1, -1, 0, 0, -0.2, 0};
    frame.adaptation_luminance_cd_m2 = adaptation_cd_m2;
    return frame;
}

PointSource coloured(int colour, double lux) {
    const UnitColour unit = navigation_colour(colour);
    PointSource source;
    for (std::size_t i = 0; i < 3; ++i)
        source.illuminance_rgb_lx[i] = static_cast<float>(lux * static_cast<double>(unit.rgb[i]));
    source.illuminance_scotopic_lx =
        static_cast<float>(lux * static_cast<double>(unit.scotopic_per_photopic));
    source.position_view_m = {0, 0, -1000};
    return source;
}

TEST(LeastLight, WhatLiesBelowItIsCulledWhereverItStands) {
    std::mt19937 engine(5);
    std::uniform_real_distribution<float> anywhere(-1000, 1000);
    for (const double fov_deg : {5.0, 45.0, 120.0}) {
        for (const double adaptation : {0.0, 0.001, 1.0, 5000.0}) {
            for (const double scale : {1.0, 4.0}) {
                const Frame frame = picture(fov_deg, 720, adaptation);
                const double least_lx = least_illuminance_lx(frame, {}, scale);
                ASSERT_GT(least_lx, 0);
                std::vector<PointSource> sources;
                for (int i = 0; i < 300; ++i) {
                    sources.push_back(coloured(i % lamp_count, least_lx * 0.999999));
                    if (i > 50)
                        sources.back().position_view_m = {anywhere(engine), anywhere(engine),
                                                          anywhere(engine)};
                    sources.back().radius_m = i % 5 == 0 ? 200.0F : 0.05F;
                }
                RenderStats stats;
                EXPECT_EQ(ViewRenderer::cull(frame, {}, sources, stats, scale), 0U);
            }
        }
    }
}

// In a crowd, where each light has the smallest share of the threshold, the strongest colour passes just above it.
TEST(LeastLight, ItIsNoLowerThanItMustBe) {
    const Frame frame = picture(45, 720, 0.001);
    const double least_lx = least_illuminance_lx(frame, {});
    std::vector<PointSource> sources;
    for (int i = 0; i < 70; ++i)
        sources.push_back(coloured(i % lamp_count, least_lx * 1.00001));
    RenderStats stats;
    EXPECT_EQ(ViewRenderer::cull(frame, {}, sources, stats), 10U);
}

// So many lights in one pixel that what cull() may leave out comes to the threshold: it leaves out no more than that.
TEST(LeastLight, ACrowdInOnePixelIsLeftOutOnlyUpToTheThreshold) {
    const Frame frame = picture(45, 720, 0.001);
    const double least_lx = least_illuminance_lx(frame, {});
    for (const std::size_t count : {100U, 1000U, 20000U}) {
        std::vector<PointSource> sources(count, coloured(4, least_lx * 0.99));
        RenderStats stats;
        const std::size_t kept = ViewRenderer::cull(frame, {}, sources, stats);
        EXPECT_LE(static_cast<double>(count - kept), least_lights_to_threshold / 0.99);
        EXPECT_GE(static_cast<double>(count - kept), least_lights_to_threshold * 0.9);
    }
}

// Spread over the picture they do not add up to anything.
TEST(LeastLight, ACrowdAllOverThePictureMayBeLeftOut) {
    const Frame frame = picture(45, 720, 0.001);
    std::vector<PointSource> sources;
    for (int i = 0; i < 400; ++i) {
        const int row = i / 20;
        sources.push_back(coloured(i % lamp_count, least_illuminance_lx(frame, {}) * 0.99));
        sources.back().position_view_m = {static_cast<float>(i % 20 - 10) * 35,
                                          static_cast<float>(row - 10) * 35, -1000};
    }
    RenderStats stats;
    EXPECT_EQ(ViewRenderer::cull(frame, {}, sources, stats), 0U);
}

TEST(LeastLight, WithoutAThresholdEveryLightCounts) {
    ToneSettings tone;
    tone.threshold_codes = 0;
    EXPECT_EQ(least_illuminance_lx(picture(45, 720, 0.001), tone), 0);
}

}  // namespace
}  // namespace seaglare::glare
