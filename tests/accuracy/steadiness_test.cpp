// A light that glides under the pixel grid, as every light does in a ship that rolls, neither flickers nor beats.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/accuracy/channel.h"
#include "tests/accuracy/displayed.h"

namespace seaglare::test {
namespace {

struct Range {
    double lowest = 1e300, highest = 0;
    void add(double value) {
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
    }
    double variation() const { return highest / lowest - 1; }
};

struct Steadiness {
    Range peak;       // brightest luminance of the HDR buffer
    Range sum;        // the HDR buffer's energy
    Range displayed;  // sum of linear values on the display, 21 x 21 pixels
    Range codes;      // sum of codes there
};

// Two pixels of way in sixteenths, along (dx, dy).
Steadiness glide(Channel& channel, double illuminance_lx, double radius_px, double dx, double dy,
                 int colour) {
    Steadiness s;
    for (int step = 0; step <= 32; ++step) {
        channel.clear();
        channel.draw_black();
        auto light = white_light(channel.at_px(80.03 + step * dx / 16, 80.11 + step * dy / 16, 1000),
                                 illuminance_lx * 1e6, radius_of_px(radius_px, 1000));
        light.colour = colour;
        channel.add(light);
        EXPECT_EQ(channel.render(), SEAGLARE_OK) << channel.last_error();
        const auto hdr = channel.hdr();
        double peak = 0;
        for (std::size_t i = 0; i < hdr.size(); i += 4)
            peak = std::max(peak, luminance_of({hdr[i], hdr[i + 1], hdr[i + 2], 0}));
        s.peak.add(peak);
        s.sum.add(luminance_of(channel.energy_lx()));
        const Displayed d = displayed(channel.picture(), channel.width_px(), channel.height_px(), 10);
        s.displayed.add(luminance_of({d.linear[0], d.linear[1], d.linear[2], 0}));
        s.codes.add(d.codes[0] + d.codes[1] + d.codes[2]);
    }
    return s;
}

TEST(AccuracySteadiness, ALightGlidingUnderTheGridKeepsItsPeakAndItsSum) {
    ChannelOptions options;
    SEAGLARE_CHANNEL(channel, options);
    const struct { double dx, dy; } ways[] = {{1, 0}, {1, 1}, {0.3, 0.9}};
    for (const double radius_px : {0.01, 0.3, 0.7, 1.0, 1.5, 2.0, 3.5, 4.0}) {
        for (const auto& way : ways) {
            const Steadiness s = glide(channel, 2e-5, radius_px, way.dx, way.dy, SEAGLARE_COLOUR_WHITE);
            std::printf(
                "  radius %.2f px along (%.1f, %.1f): peak %.2f %%, sum %.4f %%, displayed %.2f %%, codes "
                "%.2f %%\n",
                radius_px, way.dx, way.dy, 100 * s.peak.variation(), 100 * s.sum.variation(),
                100 * s.displayed.variation(), 100 * s.codes.variation());
            // A box of one pixel would vary by a factor of 2.9; a disc of 1 px spread by the point's kernel by 40 %.
            EXPECT_LT(s.peak.variation(), 0.10);
            EXPECT_LT(s.sum.variation(), 0.001);
        }
    }
}

// The tone curve and the end of the display's range bend the sum, so what is displayed varies though the HDR sum does
// not: most where the core is just clipped, at one pixel in the middle or at four around it. In codes, which follow
// brightness as the eye does, it stays within 15 %; a one-pixel box would go on and off.
TEST(AccuracySteadiness, ADisplayedLightKeepsItsBrightnessFromTheFaintestToTheGlaring) {
    ChannelOptions options;
    SEAGLARE_CHANNEL(channel, options);
    for (const double illuminance_lx : {2e-6, 2e-5, 1e-4, 1e-3}) {
        for (const int colour : {SEAGLARE_COLOUR_WHITE, SEAGLARE_COLOUR_RED}) {
            const Steadiness s = glide(channel, illuminance_lx, 0.01, 0.8, 0.6, colour);
            std::printf("  E %.0e lx colour %d: displayed %.2f %%, codes %.2f %% of %.0f\n", illuminance_lx,
                        colour, 100 * s.displayed.variation(), 100 * s.codes.variation(), s.codes.highest);
            EXPECT_LT(s.codes.variation(), 0.15);
            EXPECT_LT(s.displayed.variation(), 0.45);
        }
    }
}

}  // namespace
}  // namespace seaglare::test
