// The error budget is kept: whatever a plan leaves out, no channel of any pixel of a shipped scene is off by more codes than
// the budget says, against the same frame with nothing left out.
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <string>

#include "tests/accuracy/scene_picture.h"

namespace seaglare::host {
namespace {

class Budget : public testing::TestWithParam<ShippedScene> {};

TEST_P(Budget, NoPixelIsOffByMoreThanItAllows) {
    std::string why_not;
    const std::unique_ptr<HeadlessContext> gl = headless_context(why_not);
    if (!gl) GTEST_SKIP() << why_not;
    ScenePicture picture(GetParam().name, GetParam().size);
    const Shown everything = picture.at_budget(0);
    EXPECT_EQ(everything.stats.max_error_codes, 0);
    EXPECT_GT(everything.stats.lights_drawn, 0U);
    // Half floats are rounded to 0.06 codes at white when light is added.
    constexpr double of_the_target = 0.15;
    double predicted_ms = everything.stats.predicted_ms;
    for (const double budget : {0.5, 1.0, 2.0, 4.0}) {
        const Shown shown = picture.at_budget(budget);
        const double error = largest_difference_codes(everything, shown);
        std::printf("%-24s budget %.2f: off by %.3f codes, bound %.3f, %.1f ms, predicted %.1f\n",
                    GetParam().name, budget, error, shown.stats.error_bound_codes, shown.stats.render_ms,
                    shown.stats.predicted_ms);
        EXPECT_LE(error, budget + of_the_target) << shown.plan;
        EXPECT_LE(shown.stats.error_bound_codes, budget * 1.000001) << shown.plan;
        EXPECT_GT(shown.stats.omissions, 2U);
        // Frames that wait are planned with the same costs on every machine.
        EXPECT_LT(shown.stats.predicted_ms, predicted_ms) << "the time falls as the budget grows";
        predicted_ms = shown.stats.predicted_ms;
    }
}

INSTANTIATE_TEST_SUITE_P(OfEveryShippedScene, Budget, testing::ValuesIn(shipped_scenes), name_of);

}  // namespace
}  // namespace seaglare::host
