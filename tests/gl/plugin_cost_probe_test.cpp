// What work costs is measured when a view is made, and never in a frame.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/gl/counted_gl.h"
#include "tests/gl/plugin_fixture.h"

namespace {

using namespace seaglare;
using namespace seaglare::test;

class PluginCostProbe : public PluginTest {
  protected:
    void SetUp() override {
        if (!CountedGl::possible()) GTEST_SKIP() << "calls are counted by machine code for x86-64";
        PluginTest::SetUp();
    }
    // glFinish is what only a measurement calls.
    std::uint64_t waits_of_a_new_view() {
        CountedGl::reset();
        make_view(0, &CountedGl::get_proc);
        return CountedGl::calls_of("glFinish");
    }
};

TEST_P(PluginCostProbe, OfAViewIsMadeWithItAndNoFrameWaits) {
    EXPECT_GT(waits_of_a_new_view(), 0U);
    const Target target = make_target();
    add_light(0, 1000);
    seaglare_frame frame = frame_on(target);
    CountedGl::reset();
    for (int i = 0; i < 5; ++i) {
        frame.time_s = i / 60.0;
        EXPECT_GE(plugin_->render(view_, &frame), SEAGLARE_OK) << plugin_.last_error(context_);
    }
    EXPECT_EQ(CountedGl::calls_of("glFinish"), 0U);
}

TEST_P(PluginCostProbe, IsLeftOutWhereTheConfigurationPinsTheCosts) {
    const auto file =
        std::filesystem::temp_directory_path() /
        (GetParam() == GlProfile::core ? "seaglare_probe_core.json" : "seaglare_probe_compat.json");
    std::ofstream(file) << R"({"device_costs": {"gl_skirt_px_ns": 10}})";
    ASSERT_GE(plugin_->load_config(context_, file.c_str()), SEAGLARE_OK) << plugin_.last_error(context_);
    std::filesystem::remove(file);
    EXPECT_EQ(waits_of_a_new_view(), 0U);
}

TEST_P(PluginCostProbe, LeavesNothingOfItsPictures) {
    const auto* hdr = plugin_.extension<seaglare_hdr_api>("seaglare.hdr/1");
    ASSERT_NE(hdr, nullptr);
    std::int32_t size_px[2] = {-1, -1};
    ASSERT_EQ(hdr->read(view_, nullptr, 0, size_px), SEAGLARE_OK) << plugin_.last_error(context_);
    EXPECT_EQ(size_px[0], 0) << "no frame has been drawn";
    EXPECT_EQ(size_px[1], 0);
    auto stats = sized<seaglare_stats>();
    ASSERT_EQ(plugin_.extension<seaglare_stats_api>("seaglare.stats/1")->get_stats(view_, &stats),
              SEAGLARE_OK);
    EXPECT_EQ(stats.gpu_frames_ago, 0U);
    EXPECT_EQ(stats.draw_calls, 0U);
}

SEAGLARE_BOTH_PROFILES(PluginCostProbe);

}  // namespace
