// What the host's visibility callback says is smoothed in time as what its depth hides is: the same at every frame rate.
#include "plugin_api/host_visibility.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace seaglare::plugin {
namespace {

constexpr double smoothing_s = 0.1;

glare::PointSource light(std::uint32_t tag, float east_m = 0) {
    glare::PointSource source;
    source.position_view_m = {east_m, 0, -1000};
    source.tag = tag;
    return source;
}

class HostVisibilityTest : public ::testing::Test {
  protected:
    // What is shown of each light when the host answers this.
    std::vector<float> shown(double time_s, const std::vector<glare::PointSource>& lights,
                             std::vector<float> answers) {
        visibility_.smooth(time_s, smoothing_s, lights, answers);
        return answers;
    }
    HostVisibility visibility_;
};

TEST_F(HostVisibilityTest, FallsAsTheExactExponentialAtEveryFrameRate) {
    for (const double rate_hz : {24.0, 60.0, 240.0}) {
        visibility_ = {};
        shown(10, {light(3)}, {1});
        float value = 1;
        const int frames = static_cast<int>(std::lround(0.25 * rate_hz));
        for (int i = 1; i <= frames; ++i)
            value = shown(10 + i / rate_hz, {light(3)}, {0})[0];
        EXPECT_NEAR(value, std::exp(-0.25 / smoothing_s), 1e-5) << rate_hz;
    }
}

TEST_F(HostVisibilityTest, ALightSeenForTheFirstTimeHasItsAnswerAtOnce) {
    EXPECT_EQ(shown(10, {light(3)}, {0})[0], 0);
    const std::vector<float> both = shown(10.02, {light(2), light(3)}, {0.5F, 1});
    EXPECT_EQ(both[0], 0.5F);
    EXPECT_GT(both[1], 0);
    EXPECT_LT(both[1], 0.3F) << "the other comes slowly";
}

TEST_F(HostVisibilityTest, EachLightKeepsItsOwnHistoryHoweverTheListChanges) {
    shown(10, {light(1), light(2), light(3)}, {1, 0, 1});
    const std::vector<float> now = shown(10.02, {light(3), light(2)}, {0, 0});
    EXPECT_GT(now[0], 0.7F);
    EXPECT_EQ(now[1], 0);
}

TEST_F(HostVisibilityTest, AJumpInTimeOrOfTheCameraBeginsAnew) {
    shown(10, {light(1)}, {1});
    EXPECT_EQ(shown(12, {light(1)}, {0})[0], 0) << "two seconds later";
    shown(12.02, {light(1)}, {0});
    EXPECT_EQ(shown(12.04, {light(1, 900)}, {1})[0], 1) << "somewhere else";
    EXPECT_EQ(shown(5, {light(1, 900)}, {0.25F})[0], 0.25F) << "back in time";
}

TEST_F(HostVisibilityTest, WithoutSmoothingAnswersCountAtOnceAndAFrameWithoutTheCallbackForgets) {
    std::vector<float> answer = {1};
    const std::vector<glare::PointSource> lights = {light(1)};
    visibility_.smooth(10, 0, lights, answer);
    answer = {0};
    visibility_.smooth(10.01, 0, lights, answer);
    EXPECT_EQ(answer[0], 0);
    shown(10.02, lights, {1});
    visibility_.clear();
    EXPECT_EQ(shown(10.03, lights, {0})[0], 0);
}

TEST_F(HostVisibilityTest, ComesToItsEnd) {
    shown(10, {light(1)}, {1});
    float value = 1;
    for (int i = 1; i <= 300; ++i)
        value = shown(10 + i / 60.0, {light(1)}, {0})[0];
    EXPECT_EQ(value, 0) << "a hidden light costs nothing any more";
}

}  // namespace
}  // namespace seaglare::plugin
