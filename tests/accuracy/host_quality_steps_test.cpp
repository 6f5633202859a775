// A time budget that cannot be kept gives up all quality there is to give up, and no step of it is seen: from one frame to
// the next, at 60 a second, no pixel of a shipped scene changes by more than is said here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

#include "tests/accuracy/scene_picture.h"

namespace seaglare::host {
namespace {

// Codes of 8 bits. Seen: 0.37 where the tails of a few faint lights end, 0.11 elsewhere.
constexpr double most_step_codes = 0.5;

struct Steps {
    int frames = 0;
    double largest = 0;
    double at_loss = 0;
    double whole = 0;
};

// Draws, and looks at each step, until nothing is left to give up. The scene stands still meanwhile.
Shown give_all_up(ScenePicture& picture, Glare& glare, const Shown& best, Steps& steps) {
    constexpr int until_known = 8;  // what each kind saves: a frame for each
    constexpr int most = 600;
    Shown before = best;
    for (int i = 0; i < most && (i < until_known || before.stats.could_save_ms > 0); ++i) {
        Shown now = picture.draw(glare, SEAGLARE_FRAME_WAIT);
        const double step = largest_difference_codes(before, now);
        if (step > steps.largest) {
            steps.largest = step;
            steps.at_loss = now.stats.quality_loss;
        }
        EXPECT_LE(step, most_step_codes) << "at a loss of " << now.stats.quality_loss << "\n" << now.plan;
        before = std::move(now);
        ++steps.frames;
        if (testing::Test::HasFailure()) break;
    }
    return before;
}

struct SceneCase {
    const char* name;
    bool
        shows;  // what is given up; of Sønderborg's three lights nothing but the pattern's motion is worth giving up
};

class QualitySteps : public testing::TestWithParam<SceneCase> {};

TEST_P(QualitySteps, AreTooSmallToSee) {
    std::string why_not;
    const std::unique_ptr<HeadlessContext> gl = headless_context(why_not);
    if (!gl) GTEST_SKIP() << why_not;
    ScenePicture picture(GetParam().name, "240x135");
    Steps steps;
    Shown best, worst;
    // Minutes a frame, by pinned costs: all that saves any of them is given up, as fast as ever. With dear lights that is one
    // thing, with a dear pattern another: one that is drawn with, for one that is gathered is copied beside the frames.
    for (const char* const dear :
         {R"("device_costs": {"gl_skirt_px_ns": 1e6, "gl_tail_cell_ns": 1e6, "cl_light_px_ns": 1e6})",
          R"("device_costs": {"pattern_upload_node_ns": 1e6, "cl_pass_ns": 1e12})"}) {
        const auto glare = picture.attached(0.5, dear, 8);
        best = picture.draw(*glare, SEAGLARE_FRAME_WAIT);
        EXPECT_EQ(best.stats.quality_loss, 0);
        worst = give_all_up(picture, *glare, best, steps);
        EXPECT_EQ(worst.stats.could_save_ms, 0) << "all is given up";
        EXPECT_NE(worst.stats.limiting_pass, SEAGLARE_PASS_NONE);
        steps.whole = std::max(steps.whole, largest_difference_codes(best, worst));
        if (HasFailure()) break;
    }
    std::printf("%-24s %d frames, largest step %.2f codes at a loss of %.2f, from first to last %.2f\n",
                GetParam().name, steps.frames, steps.largest, steps.at_loss, steps.whole);
    if (GetParam().shows) {
        EXPECT_GT(steps.frames, 200) << "four seconds at 60 frames";
        EXPECT_GT(steps.whole, 0) << "nothing was given up";
    } else {
        EXPECT_GT(steps.frames, 100) << "two seconds";
        EXPECT_LE(steps.whole, 0.06) << "rounding to halves";
    }
}

INSTANTIATE_TEST_SUITE_P(OfShippedScenes, QualitySteps,
                         testing::Values(SceneCase{"great_belt_night", true},
                                         SceneCase{"ships_at_night", true},
                                         SceneCase{"sonderborg_leading_line", false},
                                         SceneCase{"storebaelt_dusk", true},
                                         SceneCase{"thesis_many_lights", true}),
                         [](const auto& given) { return std::string(given.param.name); });

}  // namespace
}  // namespace seaglare::host
