// What is not seen draws nothing and says so; what is just seen draws.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "glare/plan/plan.h"
#include "tests/accuracy/channel.h"

namespace seaglare::test {
namespace {

TEST(AccuracyVisibility, AnEclipsedLightDrawsNothing) {
    SEAGLARE_CHANNEL(channel);
    auto light = white_light(channel.at_px(80, 80, 1000), 1000);
    light.character = "Fl 10s fl. 1s, ec. 9s";
    channel.add(light);
    int lit = 0;
    for (int i = 0; i < 40; ++i) {
        channel.draw_black();
        seaglare_frame frame = channel.frame();
        frame.time_s = 1000 + i * 0.25;
        const auto before = channel.picture();
        const seaglare_result drawn = channel.render(frame);
        ASSERT_TRUE(drawn == SEAGLARE_OK || drawn == SEAGLARE_NOTHING_TO_DRAW) << channel.last_error();
        EXPECT_EQ(channel.picture() != before, drawn == SEAGLARE_OK) << "at " << frame.time_s << " s";
        EXPECT_EQ(luminance_of(channel.energy_lx()) > 0, drawn == SEAGLARE_OK);
        EXPECT_EQ(channel.stats().lights_dark, drawn == SEAGLARE_OK ? 0U : 1U);
        if (drawn == SEAGLARE_OK) ++lit;
    }
    // One second of ten: four quarters, or five where a frame's exposure touches the edge.
    EXPECT_GE(lit, 4);
    EXPECT_LE(lit, 5);
}

TEST(AccuracyVisibility, AnObscuredLightDrawsNothing) {
    SEAGLARE_CHANNEL(channel);
    // Obscured from 010 to 350 true, from seaward: an eye south of it sees it on bearing 000, one west of it on 090.
    const TemporaryFile file("lights.json", R"({"lights": [{"name": "Obscured", "position": [0, 1000, 20],
        "character": "F W", "intensity_cd": 1000,
        "sectors": [{"colour": "W", "from": 350, "to": 10}, {"colour": null, "from": 10, "to": 350}]}]})");
    ASSERT_EQ(channel.plugin()->load_lights(channel.context(), file.path()), SEAGLARE_OK)
        << channel.last_error();
    channel.place_eye({0, 0, 20});
    channel.look_at({0, 1000, 20});
    EXPECT_EQ(channel.render(), SEAGLARE_OK) << channel.last_error();
    channel.place_eye({-1000, 1000, 20});
    channel.look_at({0, 1000, 20});
    channel.draw_black();
    const auto before = channel.picture();
    EXPECT_EQ(channel.render(), SEAGLARE_NOTHING_TO_DRAW);
    EXPECT_EQ(channel.picture(), before);
    EXPECT_EQ(channel.stats().draw_calls, 0U);
    EXPECT_EQ(channel.stats().lights_dark, 1U);
}

// Intensity of a lamp 1 km away below which nothing is drawn, within a thousandth.
double threshold_cd(Channel& channel, double x_px, double y_px) {
    double dark = 1e-9;
    double drawn = 1000;
    while (drawn / dark > 1.001) {
        const double middle = std::sqrt(drawn * dark);
        channel.clear();
        channel.add(white_light(channel.at_px(x_px, y_px, 1000), middle));
        (channel.render() == SEAGLARE_OK ? drawn : dark) = middle;
    }
    return drawn;
}

TEST(AccuracyVisibility, ALightJustOverTheThresholdDrawsAndOneJustUnderWouldChangeNothing) {
    ChannelOptions options;
    options.quality.threshold_codes = 0.25;
    options.quality.dither = false;
    options.width_px = 96;
    options.height_px = 96;
    SEAGLARE_CHANNEL(channel, options);
    const double threshold = threshold_cd(channel, 48.5, 48.5);
    channel.clear();
    channel.add(white_light(channel.at_px(48.5, 48.5, 1000), 1.01 * threshold));
    EXPECT_EQ(channel.render(), SEAGLARE_OK);
    EXPECT_EQ(channel.stats().lights_drawn, 1U);
    EXPECT_GT(luminance_of(channel.energy_lx()), 0);
    channel.clear();
    channel.add(white_light(channel.at_px(48.5, 48.5, 1000), 0.99 * threshold));
    EXPECT_EQ(channel.render(), SEAGLARE_NOTHING_TO_DRAW);
    EXPECT_EQ(channel.stats().lights_below_threshold, 1U);

    // The same lamp where nothing is left out: no code of a black picture changes.
    options.quality.threshold_codes = 0;
    SEAGLARE_CHANNEL(all, options);
    const auto brightest = [&](double intensity_cd) {
        all.clear();
        all.draw_black();
        all.add(white_light(all.at_px(48.5, 48.5, 1000), intensity_cd));
        EXPECT_EQ(all.render(), SEAGLARE_OK) << all.last_error();
        const auto picture = all.picture();
        int most = 0;
        for (std::size_t i = 0; i < picture.size(); i += 4)
            most = std::max({most, int{picture[i]}, int{picture[i + 1]}, int{picture[i + 2]}});
        return most;
    };
    EXPECT_EQ(brightest(0.99 * threshold), 0);
    // And the threshold is no wide margin: a lamp some times brighter than one that makes its share of the budget is seen.
    const glare::Budget budget{.max_error_codes = 0.25};
    const double code_per_threshold = glare::light_threshold_codes(budget, 0, 1);
    const double seen = 4 / code_per_threshold * threshold;
    EXPECT_GE(brightest(seen), 1);
    std::printf("  threshold %.2e lx; %.0f times that: code %d\n", threshold * 1e-6, seen / threshold,
                brightest(seen));
}

}  // namespace
}  // namespace seaglare::test
