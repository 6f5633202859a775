// The plan as a host has it: work that is left out is not done, channels with pinned costs plan alike, and what a time budget
// gives up is told.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "glare/device/gl_touched_state.h"
#include "lightdb/json/value.h"
#include "tests/gl/counted_gl.h"
#include "tests/gl/plugin_fixture.h"

namespace {

using namespace seaglare;
using namespace seaglare::test;

class PluginPlan : public PluginTest {
  protected:
    void TearDown() override {
        PluginTest::TearDown();
        std::filesystem::remove(file());
    }
    static std::filesystem::path file() {
        return std::filesystem::temp_directory_path() / (GetParam() == GlProfile::core
                                                             ? "seaglare_plan_core.json"
                                                             : "seaglare_plan_compatibility.json");
    }
    void configure(const std::string& members) {
        std::ofstream(file()) << R"({"pattern": {"transform_size": 1024, "wavelengths": 8}, )" << members
                              << "}";
        ASSERT_GE(plugin_->load_config(context_, file().c_str()), SEAGLARE_OK)
            << plugin_.last_error(context_);
    }
    seaglare_stats stats(seaglare_view* view) const {
        auto stats = sized<seaglare_stats>();
        EXPECT_EQ(plugin_.extension<seaglare_stats_api>("seaglare.stats/1")->get_stats(view, &stats),
                  SEAGLARE_OK);
        return stats;
    }
    json::Document plan(seaglare_view* view) const {
        const auto* api = plugin_.extension<seaglare_stats_api>("seaglare.stats/1");
        std::uint32_t size = 0;
        EXPECT_EQ(api->copy_plan(view, nullptr, 0, &size), SEAGLARE_OK);
        std::string text(size, '\0');
        EXPECT_EQ(api->copy_plan(view, text.data(), size, &size), SEAGLARE_OK);
        text.pop_back();
        return json::parse(text, "plan");
    }
    // 25 m off, of half a metre: larger than its pattern's point.
    void add_near_red_light() {
        auto light = sized<seaglare_light>();
        light.position_m[0] = 1;
        light.position_m[1] = 25;
        light.position_m[2] = 10;
        light.intensity_cd = 2;
        light.radius_m = 0.5;
        light.colour = SEAGLARE_COLOUR_RED;
        ASSERT_EQ(plugin_->add_light(context_, &light, nullptr), SEAGLARE_OK) << plugin_.last_error(context_);
    }
    static bool leaves_out(const json::Document& plan, const std::string& what) {
        for (const json::Value& entry : plan.root().find("left_out")->array())
            if (entry.find("what")->string() == what) return true;
        return false;
    }
};

TEST_P(PluginPlan, ATailThatChangesNoCodeIsNotDrawn) {
    if (!CountedGl::possible()) GTEST_SKIP() << "calls are counted by machine code for x86-64";
    configure(R"("budget": {"max_error_codes": 0.5})");
    const Target target = make_target();
    make_view(0, &CountedGl::get_proc);
    const seaglare_frame frame = frame_on(target);
    const auto draws_with = [&](double intensity_cd) {
        plugin_->clear_lights(context_);
        add_light(0, 1000, intensity_cd);
        CountedGl::reset();
        EXPECT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED) << plugin_.last_error(context_);
        return CountedGl::calls_of("glDrawArraysInstanced");
    };
    const std::uint64_t bright = draws_with(10000);
    EXPECT_FALSE(leaves_out(plan(view_), "frame"));
    const std::uint64_t faint = draws_with(0.02);
    const json::Document of_faint = plan(view_);
    EXPECT_EQ(of_faint.root().find("choices")->find("tail_cell_px")->number(), 0);
    EXPECT_LT(faint, bright) << "the pass of the tails was made";
    EXPECT_EQ(stats(view_).draw_calls, faint + 1) << "and the composite";
}

TEST_P(PluginPlan, WithPinnedCostsChannelsPlanAlike) {
    configure(R"("device_costs": {"gl_skirt_px_ns": 10}, "budget": {"max_error_codes": 1, "time_ms": 8})");
    const Target target = make_target();
    for (int i = 0; i < 30; ++i)
        add_light(10 * i - 150, 1000 + 20 * i, 50 * (i + 1));
    auto info = sized<seaglare_view_info>();
    info.get_proc = &HeadlessContext::get_proc;
    info.channel_name = "centre";
    seaglare_view* other = nullptr;
    ASSERT_EQ(plugin_->create_view(context_, &info, &other), SEAGLARE_OK) << plugin_.last_error(context_);
    seaglare_frame frame = frame_on(target);
    for (int i = 0; i < 5; ++i) {
        frame.time_s = i / 60.0;
        EXPECT_GE(plugin_->render(view_, &frame), SEAGLARE_OK);
    }
    // The other channel has drawn other frames before: what it measured does not count.
    EXPECT_GE(plugin_->render(other, &frame), SEAGLARE_OK);
    const json::Document a = plan(view_), b = plan(other);
    for (const char* choice : {"skirt_threshold_cd_m2", "tail_threshold_cd_m2", "tail_cell_px", "disc_scale",
                               "largest_disc_nodes", "filter_blend"}) {
        EXPECT_EQ(a.root().find("choices")->find(choice)->number(),
                  b.root().find("choices")->find(choice)->number())
            << choice;
    }
    EXPECT_EQ(a.root().find("choices")->find("accumulation")->string(),
              b.root().find("choices")->find("accumulation")->string());
    EXPECT_TRUE(a.root().find("device_costs_ns")->find("pinned")->boolean());
    EXPECT_EQ(a.root().find("device_costs_ns")->find("gl_skirt_px")->number(), 10);
    EXPECT_EQ(stats(view_).predicted_ms, stats(other).predicted_ms);
    EXPECT_NEAR(stats(view_).taken_ms, stats(view_).predicted_ms, 1e-9) << "not what a clock said";
    EXPECT_EQ(plugin_->destroy_view(other, 0), SEAGLARE_OK);
}

TEST_P(PluginPlan, ATimeBudgetGivesUpQualityAndSaysSo) {
    const Target target = make_target();
    seaglare_frame frame = frame_on(target);
    frame.frame_interval_s = 0.05;
    seaglare_stats before{};
    double least_ms = 1e12;
    const auto draw = [&](int frames) {
        for (int i = 0; i < frames; ++i) {
            frame.time_s += frame.frame_interval_s;
            ASSERT_GE(plugin_->render(view_, &frame), SEAGLARE_OK);
            const seaglare_stats now = stats(view_);
            EXPECT_LE(std::abs(now.quality_loss - before.quality_loss), 0.25 * 0.05 + 0.25 / 240 + 1e-9)
                << "it jumped";
            EXPECT_EQ(now.given_up != 0, now.quality_loss > 0);
            before = now;
            least_ms = std::min(least_ms, now.taken_ms);
        }
    };
    // Hours a frame, of the pattern.
    configure(R"("device_costs": {"pattern_upload_node_ns": 1e9}, "budget": {"time_ms": 8})");
    add_light(0, 300, 10000);
    add_near_red_light();
    draw(160);
    EXPECT_EQ(before.given_up, static_cast<std::uint32_t>(SEAGLARE_GIVEN_UP_MOTION | SEAGLARE_GIVEN_UP_DISCS |
                                                          SEAGLARE_GIVEN_UP_OWN_PATTERNS));
    EXPECT_EQ(before.quality_loss, 0.75) << "all of these, and nothing else";
    EXPECT_EQ(before.max_error_codes, 0.5) << "a larger error would buy nothing";
    EXPECT_EQ(before.time_budget_ms, 8);
    EXPECT_GT(before.taken_ms, 8);
    EXPECT_GT(before.saved_ms, 0);
    EXPECT_EQ(before.could_save_ms, 0);
    EXPECT_EQ(before.limiting_pass, static_cast<std::uint32_t>(SEAGLARE_PASS_UPLOAD));
    EXPECT_TRUE(leaves_out(plan(view_), "quality"));
    // And of the tail of a light that is just bright enough for it to show by half a code: four codes need none.
    configure(R"("device_costs": {"gl_tail_cell_ns": 1e9}, "budget": {"time_ms": 8})");
    double intensity_cd = 0.02;
    double cell_px = 0;
    while (cell_px == 0 && intensity_cd < 1e6) {
        plugin_->clear_lights(context_);
        add_light(0, 1000, intensity_cd *= 2);
        draw(1);
        const json::Document text = plan(view_);
        cell_px = text.root().find("choices")->find("tail_cell_px")->number();
    }
    least_ms = 1e12;
    draw(160);
    EXPECT_EQ(before.given_up, static_cast<std::uint32_t>(SEAGLARE_GIVEN_UP_ERROR_BUDGET))
        << "what buys no time any more has come back";
    EXPECT_GT(before.max_error_codes, 0.5);
    EXPECT_LT(before.max_error_codes, 4) << "no more than is needed";
    EXPECT_LE(least_ms, 8)
        << "with the tail it is hours, without it the budget is kept: it stands at the limit";
    EXPECT_EQ(before.limiting_pass, SEAGLARE_PASS_NONE);
}

TEST_P(PluginPlan, QualityThatBuysNoTimeIsKeptAndTheDearestPassIsNamed) {
    // Draw calls take all the time, and none of them can be given up.
    configure(R"("device_costs": {"gl_draw_ns": 1e12}, "budget": {"time_ms": 8})");
    const Target target = make_target();
    add_light(0, 300, 10000);
    add_near_red_light();
    seaglare_frame frame = frame_on(target);
    frame.frame_interval_s = 0.05;
    for (int i = 0; i < 60; ++i) {
        frame.time_s = i * frame.frame_interval_s;
        ASSERT_GE(plugin_->render(view_, &frame), SEAGLARE_OK);
    }
    const seaglare_stats now = stats(view_);
    EXPECT_GT(now.taken_ms, 1000 * now.time_budget_ms);
    EXPECT_EQ(now.quality_loss, 0);
    EXPECT_EQ(now.given_up, 0U);
    EXPECT_EQ(now.max_error_codes, 0.5);
    EXPECT_EQ(now.could_save_ms, 0);
    EXPECT_EQ(now.limiting_pass, static_cast<std::uint32_t>(SEAGLARE_PASS_ACCUMULATE));
    const json::Document text = plan(view_);
    EXPECT_FALSE(leaves_out(text, "quality"));
    ASSERT_NE(text.root().find("time_budget_cannot_be_kept_for"), nullptr);
    EXPECT_EQ(text.root().find("time_budget_cannot_be_kept_for")->string(), "accumulate");
}

TEST_P(PluginPlan, EveryPassSaysWhatItWasPredictedToTake) {
    configure(R"("budget": {"max_error_codes": 0.5})");
    const Target target = make_target();
    add_light(0, 1000);
    const seaglare_frame frame = frame_on(target);
    ASSERT_GE(plugin_->render(view_, &frame), SEAGLARE_OK);
    const json::Document text = plan(view_);
    double predicted = 0;
    for (const json::Value& pass : text.root().find("passes")->array()) {
        EXPECT_FALSE(pass.find("reason")->string().empty());
        if (pass.find("pass")->string() != "pattern") predicted += pass.find("predicted_ms")->number();
    }
    const seaglare_stats now = stats(view_);
    EXPECT_NEAR(now.predicted_ms, predicted, 1e-9);
    EXPECT_EQ(now.omissions, text.root().find("left_out")->array().size());
    EXPECT_EQ(now.max_error_codes, 0.5);
    EXPECT_LE(now.error_bound_codes, 0.5);
    EXPECT_EQ(now.accumulation, static_cast<std::uint32_t>(SEAGLARE_ACCUMULATION_GL_BILLBOARDS));
}

SEAGLARE_BOTH_PROFILES(PluginPlan);

}  // namespace
