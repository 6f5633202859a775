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

class QualitySteps : public testing::TestWithParam<const char*> {};

TEST_P(QualitySteps, AreTooSmallToSee) {
    std::unique_ptr<HeadlessContext> gl;
    try {
        gl = std::make_unique<HeadlessContext>();
    } catch (const GlFailure& e) {
        GTEST_SKIP() << e.what();
    }
    ScenePicture picture(GetParam(), "240x135");
    // A frame of a minute, by pinned costs: quality goes as fast as it ever does. The scene stands still meanwhile.
    const auto glare = picture.attached(0.5, R"("device_costs": {"composite_px_ns": 1e10})", 8);
    Shown before = picture.draw(*glare, SEAGLARE_FRAME_WAIT);
    const Shown best = before;
    EXPECT_EQ(before.stats.quality_loss, 0);
    double largest = 0;
    double at_loss = 0;
    int frames = 0;
    while (before.stats.quality_loss < 1 && frames < 400) {
        Shown now = picture.draw(*glare, SEAGLARE_FRAME_WAIT);
        const double step = largest_difference_codes(before, now);
        if (step > largest) {
            largest = step;
            at_loss = now.stats.quality_loss;
        }
        EXPECT_LE(step, most_step_codes) << "at a loss of " << now.stats.quality_loss << "\n" << now.plan;
        before = std::move(now);
        ++frames;
        if (HasFailure()) break;
    }
    const double whole = largest_difference_codes(best, before);
    std::printf("%-24s %d frames, largest step %.2f codes at a loss of %.2f, from first to last %.2f\n",
                GetParam(), frames, largest, at_loss, whole);
    EXPECT_GT(frames, 200) << "four seconds at 60 frames";
    EXPECT_GT(whole, 0) << "nothing was given up";
}

INSTANTIATE_TEST_SUITE_P(OfShippedScenes, QualitySteps,
                         testing::Values("great_belt_night", "ships_at_night", "sonderborg_leading_line",
                                         "storebaelt_dusk", "thesis_many_lights"),
                         [](const auto& given) { return std::string(given.param); });

}  // namespace
}  // namespace seaglare::host
