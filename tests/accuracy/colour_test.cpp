// By starlight the colours of navigation lights are still told apart on the display.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "tests/accuracy/channel.h"
#include "tests/accuracy/displayed.h"

namespace seaglare::test {
namespace {

// The measure: the distance in CIE 1976 u'v' between what two lights add to the display, summed over 7 x 7 pixels about
// the brightest. 0.05 is more than ten just noticeable differences (about 0.004 in u'v').
constexpr double told_apart = 0.05;

TEST(AccuracyColour, ByStarlightRedGreenWhiteAndYellowAreToldApart) {
    ChannelOptions options;
    options.quality.threshold_codes = 0.25;
    SEAGLARE_CHANNEL(channel, options);
    const int colours[] = {SEAGLARE_COLOUR_WHITE, SEAGLARE_COLOUR_RED, SEAGLARE_COLOUR_GREEN,
                           SEAGLARE_COLOUR_YELLOW};
    const char names[] = "WRGY";
    for (const double illuminance_lx : {2e-6, 5e-6, 2e-5, 1e-4, 3e-4, 1e-3}) {
        std::array<std::array<double, 3>, 4> seen{};
        for (std::size_t i = 0; i < 4; ++i) {
            channel.clear();
            channel.draw_black();
            auto light = white_light(channel.at_px(80.3, 80.6, 2000), illuminance_lx * 2000 * 2000);
            light.colour = colours[i];
            channel.add(light);
            ASSERT_EQ(channel.render(), SEAGLARE_OK) << channel.last_error();
            const Displayed d = displayed(channel.picture(), channel.width_px(), channel.height_px());
            seen[i] = d.linear;
            const auto uv = uv_of(d.linear);
            std::printf("  E %.0e lx %c: brightest code %3d, u'v' %.3f %.3f\n", illuminance_lx, names[i],
                        d.brightest_code, uv[0], uv[1]);
        }
        for (std::size_t a = 0; a < 4; ++a) {
            for (std::size_t b = a + 1; b < 4; ++b) {
                const double apart = uv_distance(seen[a], seen[b]);
                EXPECT_GE(apart, told_apart)
                    << names[a] << " and " << names[b] << " of " << illuminance_lx << " lx";
                std::printf("    %c-%c %.3f\n", names[a], names[b], apart);
            }
        }
    }
}

}  // namespace
}  // namespace seaglare::test
