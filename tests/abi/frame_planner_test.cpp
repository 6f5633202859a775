// What a view learns of its device from the frames that it has drawn.
#include "plugin_api/frame_planner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

namespace seaglare::plugin {
namespace {

using glare::Work;

class FramePlannerTest : public ::testing::Test {
  protected:
    FramePlannerTest() : settings_(plan_settings(default_settings())) {
        glare::Frame frame;
        frame.viewport_px = {0, 0, 1280, 720};
        const double t = std::tan(45.0 / 2 * std::numbers::pi / 180);
        frame.clip_from_view = {9 / (16 * t), 0, 0, 0, 0, 1 / t, 0, 0, 0, 0, -1, -1, 0, 0, -0.2, 0};
        input_.geometry = glare::screen_geometry(frame);
        glare::PointSource source;
        source.position_view_m = {0, 0, -1000};
        source.illuminance_rgb_lx = {1e-2F, 1e-2F, 1e-2F};
        source.illuminance_scotopic_lx = 2.5e-2F;
        sources_ = {source};
    }

    // Draws a frame of which is known what it took now, and what the GPU took for an earlier one.
    void draw(bool can_gather, const FrameTimes& times) {
        input_.can_gather = can_gather;
        planner_.make(*settings_, 6, false, input_, sources_);
        planner_.took(*settings_, times, 1.0 / 60);
    }
    double cost(Work work) const { return planner_.measured().of(work); }

    std::shared_ptr<const PlanSettings> settings_;
    glare::PlanInput input_;
    std::vector<glare::PointSource> sources_;
    FramePlanner planner_;
    const glare::DeviceCosts usual_;
};

TEST_F(FramePlannerTest, AGpuTimeThatComesLateTeachesTheCostsOfItsOwnFrame) {
    draw(false, {.accumulate_ms = 1});
    ASSERT_EQ(planner_.plan().accumulation.method, glare::Accumulation::gl_billboards);
    const double billboards = cost(Work::gl_skirt_px);
    // The method changes; what comes in is still the rectangles' time.
    sources_.assign(2000, sources_[0]);
    draw(true, {.accumulate_ms = 1, .gpu_accumulate_ms = 9000, .gpu_ms = 9000, .gpu_frames_ago = 1});
    ASSERT_EQ(planner_.plan().accumulation.method, glare::Accumulation::cl_tiles);
    EXPECT_GT(cost(Work::gl_skirt_px), billboards);
    EXPECT_EQ(cost(Work::cl_light_px), usual_.of(Work::cl_light_px));
}

// gpu_frames_ago counts frames that drew.
TEST_F(FramePlannerTest, FramesOfWhichNothingIsDrawnOrThatWaitDoNotShiftWhoseAGpuTimeIs) {
    draw(false, {.accumulate_ms = 1});
    ASSERT_EQ(planner_.plan().accumulation.method, glare::Accumulation::gl_billboards);
    const double billboards = cost(Work::gl_skirt_px);
    sources_.assign(2000, sources_[0]);
    draw(true, {.drew = false});
    ASSERT_EQ(planner_.plan().accumulation.method, glare::Accumulation::cl_tiles);
    input_.can_gather = true;
    planner_.make(*settings_, 6, true, input_, sources_);
    planner_.took(*settings_, {.accumulate_ms = 1}, 1.0 / 60);
    draw(true, {.accumulate_ms = 1e-9,
                .gpu_accumulate_ms = 9000,
                .gpu_composite_ms = 9000,
                .gpu_ms = 9000,
                .gpu_frames_ago = 1});
    EXPECT_EQ(cost(Work::composite_px), usual_.of(Work::composite_px)) << "of the frame that waited";
    EXPECT_EQ(cost(Work::gl_skirt_px), billboards);
    draw(true, {.accumulate_ms = 1e-9, .gpu_accumulate_ms = 9000, .gpu_ms = 9000, .gpu_frames_ago = 3});
    EXPECT_GT(cost(Work::gl_skirt_px), billboards) << "of the first";
    EXPECT_EQ(cost(Work::cl_light_px), usual_.of(Work::cl_light_px));
}

TEST_F(FramePlannerTest, AFrameThatWasNotDrawnAsPlannedTeachesNothing) {
    sources_.assign(2000, sources_[0]);
    draw(true, {.accumulate_ms = 1e5, .as_planned = false});
    ASSERT_EQ(planner_.plan().accumulation.method, glare::Accumulation::cl_tiles);
    EXPECT_EQ(cost(Work::cl_light_px), usual_.of(Work::cl_light_px));
    EXPECT_EQ(cost(Work::gl_skirt_px), usual_.of(Work::gl_skirt_px));
    draw(true, {.accumulate_ms = 1e5});
    EXPECT_GT(cost(Work::cl_light_px), usual_.of(Work::cl_light_px));
}

TEST_F(FramePlannerTest, AnUploadTeachesWhatItUploaded) {
    draw(false, {.upload_ms = 1000, .took_pattern = true});
    const double node = cost(Work::pattern_upload_node);
    EXPECT_GT(node, usual_.of(Work::pattern_upload_node));
    EXPECT_EQ(cost(Work::light_uploaded), usual_.of(Work::light_uploaded)) << "one light is no part of it";
    draw(false, {.upload_ms = 1000, .took_pattern = false});
    EXPECT_EQ(cost(Work::pattern_upload_node), node) << "none came";
    EXPECT_GT(cost(Work::light_uploaded), usual_.of(Work::light_uploaded));
}

TEST_F(FramePlannerTest, ATimeBudgetNamesThePassOnceNothingIsLeftToGiveUp) {
    Settings quality = default_settings();
    quality.budget.time_ms = 1;
    settings_ = plan_settings(quality);
    EXPECT_EQ(planner_.limiting_pass(), std::nullopt);
    bool gave_up = false;
    for (int i = 0; i < 3000; ++i) {
        draw(false, {.gpu_composite_ms = 20, .gpu_ms = 50, .gpu_frames_ago = 1});
        gave_up = gave_up || planner_.saved_ms() > 0;
        EXPECT_EQ(planner_.limiting_pass().has_value(), i > 0 && planner_.could_save_ms() == 0) << i;
        if (HasFailure()) break;
    }
    EXPECT_TRUE(gave_up) << "an error budget, a pattern less often";
    ASSERT_TRUE(planner_.limiting_pass().has_value());
    EXPECT_NE(*planner_.limiting_pass(), glare::PassKind::pattern) << "it is made beside the frames";
}

TEST_F(FramePlannerTest, AFrameThatWaitsIsPlannedWithTheUsualCostsWhateverWasMeasured) {
    sources_.assign(2000, sources_[0]);
    input_.can_gather = true;
    glare::DeviceCosts odd;
    odd.of(Work::cl_light_px) = 1e6;
    planner_.set_measured(odd);
    planner_.make(*settings_, 6, false, input_, sources_);
    EXPECT_EQ(planner_.plan().accumulation.method, glare::Accumulation::gl_billboards) << "as measured";
    planner_.make(*settings_, 6, true, input_, sources_);
    EXPECT_EQ(planner_.plan().accumulation.method, glare::Accumulation::cl_tiles);
    EXPECT_TRUE(planner_.costs().pinned);
    const double predicted_ms = planner_.plan().predicted_ms;
    planner_.took(*settings_, {.accumulate_ms = 1e5, .render_ms = 1e5}, 1.0 / 60);
    EXPECT_LE(planner_.taken_ms(), predicted_ms) << "not what a clock said";
    EXPECT_EQ(planner_.measured(), odd) << "nothing is learned";
}

}  // namespace
}  // namespace seaglare::plugin
