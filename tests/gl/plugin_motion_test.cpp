// Where no light is bright enough for the eye's motion to show, frames make no pattern: the picture with and without the
// motion differs by no more than the plan's bound, and no kernel is launched.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "tests/gl/plugin_fixture.h"

namespace seaglare::test {
namespace {

class PluginMotion : public PluginTest {
  protected:
    // The eye moves in every frame with the second: nothing may be left out.
    static constexpr const char* as_the_budget_allows =
        R"({"pattern": {"transform_size": 256, "wavelengths": 5,
        "max_radius_nodes": 24, "layer_radii_px": [0]}, "display": {"dither": false}})";
    static constexpr const char* whatever_it_costs = R"({"pattern": {"transform_size": 256, "wavelengths": 5,
        "max_radius_nodes": 24, "layer_radii_px": [0]}, "display": {"dither": false},
        "budget": {"max_error_codes": 0}})";

    void SetUp() override {
        try {
            gl_context_ = std::make_unique<HeadlessContext>(HeadlessOptions{.profile = GetParam()});
        } catch (const std::exception& error) {
            GTEST_SKIP() << error.what();
        }
        target_ = make_target();
        if (cl_context_.created() == SEAGLARE_DEGRADED)
            GTEST_SKIP() << "no OpenCL: the pattern does not move";
        auto info = sized<seaglare_view_info>();
        info.get_proc = &HeadlessContext::get_proc;
        ASSERT_EQ(plugin_->create_view(cl_context_, &info, &view_), SEAGLARE_OK);
        auto light = sized<seaglare_light>();
        light.position_m[1] = 2000;
        light.position_m[2] = 10;
        light.intensity_cd = 200;
        ASSERT_EQ(plugin_->add_light(cl_context_, &light, nullptr), SEAGLARE_OK);
    }
    void configure(const char* quality) {
        const TemporaryFile file("quality.json", quality);
        ASSERT_EQ(plugin_->load_config(cl_context_, file.path()), SEAGLARE_OK)
            << plugin_.last_error(cl_context_);
    }
    void add_bright_light() {
        auto light = sized<seaglare_light>();
        light.position_m[0] = 100;
        light.position_m[1] = 1000;
        light.position_m[2] = 10;
        light.intensity_cd = 20000;
        ASSERT_EQ(plugin_->add_light(cl_context_, &light, nullptr), SEAGLARE_OK);
    }
    seaglare_stats draw(double time_s, double adaptation_cd_m2) {
        gl().BindFramebuffer(GL_FRAMEBUFFER, target_.framebuffer);
        gl().ClearColor(0.1F, 0.1F, 0.1F, 1);
        gl().Clear(GL_COLOR_BUFFER_BIT);
        seaglare_frame frame = frame_on(target_);
        frame.flags |= frame_flags_;
        frame.time_s = time_s;
        frame.adaptation_luminance_cd_m2 = adaptation_cd_m2;
        EXPECT_EQ(plugin_->render(view_, &frame), SEAGLARE_OK) << plugin_.last_error(cl_context_);
        auto stats = sized<seaglare_stats>();
        EXPECT_EQ(plugin_.extension<seaglare_stats_api>("seaglare.stats/1")->get_stats(view_, &stats),
                  SEAGLARE_OK);
        return stats;
    }

    std::string plan_text() const {
        const auto* const stats = plugin_.extension<seaglare_stats_api>("seaglare.stats/1");
        std::string plan(65536, '\0');
        std::uint32_t size = 0;
        EXPECT_EQ(stats->copy_plan(view_, plan.data(), static_cast<std::uint32_t>(plan.size()), &size),
                  SEAGLARE_OK);
        return plan;
    }

    QuickContext cl_context_{plugin_, 0};
    Target target_;
    std::uint32_t frame_flags_ = 0;
};

TEST_P(PluginMotion, MakesNoPatternForAFaintLightByDay) {
    configure(as_the_budget_allows);
    constexpr double by_day_cd_m2 = 300;
    ASSERT_EQ(draw(0, by_day_cd_m2).lights_drawn, 1U);
    for (int frame = 1; frame < 30; ++frame)
        EXPECT_EQ(draw(0.21 * frame, by_day_cd_m2).kernel_launches, 0U) << frame;
    const std::string plan = plan_text();
    EXPECT_NE(plan.find("no light is bright enough for the eye's motion to show"), std::string::npos) << plan;
}

TEST_P(PluginMotion, TheSameLightByStarlightHasAPatternForEachInstant) {
    configure(as_the_budget_allows);
    static_cast<void>(draw(0, 0.001));
    for (int frame = 1; frame < 5; ++frame)
        EXPECT_GT(draw(0.21 * frame, 0.001).kernel_launches, 0U) << frame;
}

TEST_P(PluginMotion, TheStillEyesPictureIsWithinTheBudgetOfTheMovingEyes) {
    constexpr double by_day_cd_m2 = 300;
    configure(as_the_budget_allows);
    std::vector<std::vector<std::uint8_t>> still;
    for (int frame = 0; frame < 6; ++frame) {
        static_cast<void>(draw(0.37 * frame, by_day_cd_m2));
        still.push_back(pixels_of(target_));
    }
    configure(whatever_it_costs);
    for (int frame = 0; frame < 6; ++frame) {
        EXPECT_GT(draw(0.37 * frame, by_day_cd_m2).kernel_launches, 0U);
        const std::vector<std::uint8_t> moving = pixels_of(target_);
        int worst = 0;
        for (std::size_t i = 0; i < moving.size(); ++i)
            worst = std::max(worst, std::abs(static_cast<int>(moving[i]) -
                                             static_cast<int>(still[static_cast<std::size_t>(frame)][i])));
        // Half a code of budget may round to a whole one.
        EXPECT_LE(worst, 1) << "frame " << frame;
    }
}

// A pattern whose upload takes hours by pinned costs: a time budget gives up how often it follows the eye, and nothing else
// that there is here.
constexpr const char* every_frame = R"({"pattern": {"transform_size": 256, "wavelengths": 5,
        "max_radius_nodes": 24, "layer_radii_px": [0], "motion": {"mode": "every_frame"}},
        "display": {"dither": false}, "budget": {"max_error_codes": 0}})";
constexpr const char* dear_pattern = R"({"pattern": {"transform_size": 256, "wavelengths": 5,
        "max_radius_nodes": 24, "layer_radii_px": [0], "motion": {"mode": "every_frame"}}, "display": {"dither": false},
        "device_costs": {"pattern_upload_node_ns": 1e9},
        "budget": {"max_error_codes": 0.5, "time_ms": 8}})";

TEST_P(PluginMotion, WhereTimeIsShortAPatternIsMadeSixteenTimesASecond) {
    configure(dear_pattern);
    frame_flags_ = SEAGLARE_FRAME_WAIT;
    int made = 0, made_in_the_last_second = 0;
    seaglare_stats now{};
    for (int i = 0; i < 240; ++i) {
        now = draw((i + 0.5) / 60.0, 0.001);
        made += now.kernel_launches > 0 ? 1 : 0;
        if (i >= 180) made_in_the_last_second += now.kernel_launches > 0 ? 1 : 0;
    }
    EXPECT_EQ(now.given_up, static_cast<std::uint32_t>(SEAGLARE_GIVEN_UP_MOTION));
    EXPECT_EQ(made_in_the_last_second, 16);
    EXPECT_GT(made, 60) << "at first with every frame";
    EXPECT_NE(plan_text().find("the pattern follows the eye less often"), std::string::npos);
}

TEST_P(PluginMotion, AtSixteenPatternsASecondThePictureIsWithinTheBoundOfEveryFrames) {
    configure(dear_pattern);
    add_bright_light();
    frame_flags_ = SEAGLARE_FRAME_WAIT;
    constexpr int settled = 150, frames = 160;
    std::vector<std::vector<std::uint8_t>> stepped;
    double bound_codes = 0;
    for (int i = 0; i < frames; ++i) {
        bound_codes = draw((i + 0.5) / 60.0, 0.001).error_bound_codes;
        if (i >= settled) stepped.push_back(pixels_of(target_));
    }
    EXPECT_LT(bound_codes, 255) << "or nothing is held here";
    configure(every_frame);
    int worst = 0;
    for (int i = settled; i < frames; ++i) {
        EXPECT_GT(draw((i + 0.5) / 60.0, 0.001).kernel_launches, 0U);
        const std::vector<std::uint8_t> every = pixels_of(target_);
        const std::vector<std::uint8_t>& seen = stepped[static_cast<std::size_t>(i - settled)];
        for (std::size_t p = 0; p < every.size(); ++p)
            worst = std::max(worst, std::abs(static_cast<int>(every[p]) - static_cast<int>(seen[p])));
    }
    EXPECT_LE(worst, bound_codes + 0.5);
    EXPECT_LE(worst, 4) << "and far within: the eye moves little in a sixteenth of a second";
    // A light this bright has speckles that move by whole codes in that time.
    EXPECT_GT(worst, 0) << "it moves";
}

// Between the patterns of motion.rate_hz none is made: two are mixed, in no kernel.
TEST_P(PluginMotion, BetweenThePatternsOfAFixedRateNoneIsMade) {
    configure(R"({"pattern": {"transform_size": 256, "wavelengths": 5, "max_radius_nodes": 24,
        "layer_radii_px": [0], "motion": {"mode": "interpolated", "rate_hz": 15}},
        "budget": {"max_error_codes": 0}})");
    frame_flags_ = SEAGLARE_FRAME_WAIT;
    int made = 0;
    for (int i = 0; i < 120; ++i) {
        const bool makes = draw((i + 0.5) / 60.0, 0.001).kernel_launches > 0;
        if (i >= 60) made += makes ? 1 : 0;
    }
    EXPECT_EQ(made, 15);
}

SEAGLARE_BOTH_PROFILES(PluginMotion);

}  // namespace
}  // namespace seaglare::test
