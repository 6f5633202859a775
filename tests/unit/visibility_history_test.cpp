// Smoothing in time: what a light's visibility becomes does not hang on the frame rate.
#include "glare/apply/visibility_history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace seaglare::glare {
namespace {

LightInstance light_ahead(float east = 0, float distance_m = 1000) {
    LightInstance light;
    const float length = std::sqrt(1 + east * east);
    light.direction = {east / length, 0, -1 / length};
    light.distance_m = distance_m;
    return light;
}

// What the shader does with blend() and match(), for one light of visibility 1 at first and 0 from then on.
double after(double seconds, double rate_hz, double smoothing_s) {
    VisibilityHistory history;
    const std::vector<LightInstance> lights{light_ahead()};
    const std::vector<std::uint32_t> tags{7};
    std::vector<std::int32_t> previous;
    double value = 0;
    const int frames = static_cast<int>(std::lround(seconds * rate_hz));
    for (int frame = 0; frame <= frames; ++frame) {
        history.begin(100 + frame / rate_hz, smoothing_s);
        history.match(lights, tags, previous);
        const double seen = frame == 0 ? 1 : 0;
        value = previous[0] < 0 ? seen : value + history.blend() * (seen - value);
    }
    return value;
}

TEST(VisibilityHistory, IsTheExactExponentialAtEveryFrameRate) {
    for (const double rate_hz : {10.0, 24.0, 60.0, 240.0}) {
        // A law: y' = (g - y)/tau from 1 to 0.
        EXPECT_NEAR(after(0.5, rate_hz, 0.2), std::exp(-0.5 / 0.2), 1e-9) << rate_hz << " Hz";
    }
    EXPECT_EQ(after(0.5, 60, 0), 0) << "no smoothing";
}

TEST(VisibilityHistory, TwoHalfStepsAreOneStep) {
    VisibilityHistory whole;
    VisibilityHistory halves;
    const std::vector<LightInstance> lights{light_ahead()};
    const std::vector<std::uint32_t> tags{1};
    std::vector<std::int32_t> previous;
    for (VisibilityHistory* history : {&whole, &halves}) {
        history->begin(0, 0.1);
        history->match(lights, tags, previous);
    }
    whole.begin(0.25, 0.1);
    halves.begin(0.125, 0.1);
    const double first = halves.blend();
    halves.match(lights, tags, previous);
    halves.begin(0.25, 0.1);
    EXPECT_NEAR((1 - first) * (1 - halves.blend()), 1 - whole.blend(), 1e-15);
}

TEST(VisibilityHistory, FindsALightAgainByItsTagWhereverItStandsInTheList) {
    VisibilityHistory history;
    std::vector<std::int32_t> previous;
    history.begin(0, 0.1);
    std::vector<LightInstance> lights{light_ahead(-0.2F), light_ahead(0), light_ahead(0.2F)};
    history.match(lights, std::vector<std::uint32_t>{10, 20, 30}, previous);
    EXPECT_EQ(previous, (std::vector<std::int32_t>{-1, -1, -1})) << "first sight";
    history.begin(0.1, 0.1);
    std::swap(lights[0], lights[2]);
    lights.insert(lights.begin() + 1, light_ahead(0.1F));
    history.match(lights, std::vector<std::uint32_t>{30, 25, 20, 10}, previous);
    EXPECT_EQ(previous, (std::vector<std::int32_t>{2, -1, 1, 0})) << "in no order";
    history.begin(0.2, 0.1);
    history.match(std::vector<LightInstance>{light_ahead(-0.2F), light_ahead(0.1F)},
                  std::vector<std::uint32_t>{10, 25}, previous);
    EXPECT_EQ(previous, (std::vector<std::int32_t>{3, 1}));
}

TEST(VisibilityHistory, ForgetsALightThatWasAwayForAFrame) {
    VisibilityHistory history;
    std::vector<std::int32_t> previous;
    const std::vector<LightInstance> lights{light_ahead()};
    const std::vector<std::uint32_t> tags{5};
    history.begin(0, 0.1);
    history.match(lights, tags, previous);
    history.begin(0.1, 0.1);
    history.match({}, {}, previous);
    history.begin(0.2, 0.1);
    history.match(lights, tags, previous);
    EXPECT_EQ(previous[0], -1);
}

TEST(VisibilityHistory, TakesALightThatIsElsewhereForAnotherOne) {
    const std::vector<std::uint32_t> tags{5};
    const struct {
        LightInstance light;
        int previous;
    } cases[] = {{light_ahead(0.1F, 1000), 0}, {light_ahead(0.5F, 1000), -1}, {light_ahead(0, 1900), 0},
                 {light_ahead(0, 2100), -1},   {light_ahead(0, 600), 0},      {light_ahead(0, 450), -1}};
    for (const auto& c : cases) {
        VisibilityHistory history;
        std::vector<std::int32_t> previous;
        history.begin(0, 0.1);
        history.match(std::vector<LightInstance>{light_ahead()}, tags, previous);
        history.begin(0.02, 0.1);
        history.match(std::vector<LightInstance>{c.light}, tags, previous);
        EXPECT_EQ(previous[0], c.previous) << c.light.direction[0] << ", " << c.light.distance_m << " m";
    }
}

TEST(VisibilityHistory, AJumpInTimeBeginsAnew) {
    for (const double step_s : {-0.01, 1.01, 1e7, std::numeric_limits<double>::quiet_NaN()}) {
        VisibilityHistory history;
        std::vector<std::int32_t> previous;
        const std::vector<LightInstance> lights{light_ahead()};
        const std::vector<std::uint32_t> tags{5};
        history.begin(50, 0.1);
        EXPECT_TRUE(history.begins_anew());
        history.match(lights, tags, previous);
        history.begin(50 + step_s, 0.1);
        EXPECT_TRUE(history.begins_anew()) << step_s;
        EXPECT_EQ(history.blend(), 1);
        history.match(lights, tags, previous);
        EXPECT_EQ(previous[0], -1) << step_s;
    }
}

TEST(VisibilityHistory, ATimeDrawnTwiceMakesNoStepButAPausedClockShowsWhatIsSeen) {
    VisibilityHistory history;
    std::vector<std::int32_t> previous;
    const std::vector<LightInstance> lights{light_ahead()};
    const std::vector<std::uint32_t> tags{5};
    history.begin(1, 0.1);
    history.match(lights, tags, previous);
    for (int frame = 0; frame < VisibilityHistory::longest_standstill_frames; ++frame) {
        history.begin(1, 0.1);
        history.match(lights, tags, previous);
        EXPECT_EQ(history.blend(), 0) << frame;
        EXPECT_EQ(previous[0], 0);
    }
    history.begin(1, 0.1);
    EXPECT_EQ(history.blend(), 1);
    history.match(lights, tags, previous);
    history.begin(1.1, 0.1);
    EXPECT_NEAR(history.blend(), 1 - std::exp(-1), 1e-12) << "the clock runs again";
}

}  // namespace
}  // namespace seaglare::glare
