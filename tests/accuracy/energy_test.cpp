// Conservation, end to end: the light that a host's lamp sends to the eye (E = I/D^2) is in the picture, wherever on the
// pixel grid it falls and however large the lamp appears.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "glare/eye/eye_model.h"
#include "glare/psf/cie_curve.h"
#include "tests/accuracy/channel.h"

namespace seaglare::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double lamp_distance_m = 400;
constexpr double illuminance_lx = 1e-4;
constexpr int sub_pixel_positions = 10;
constexpr double apparent_radii_px[] = {0.01, 0.5, 1.5, 4, 10, 30};

ChannelOptions with(const Quality& quality, int side_px) {
    ChannelOptions options;
    options.quality = quality;
    options.width_px = side_px;
    options.height_px = side_px;
    return options;
}

// Draws one lamp of E = 1e-4 lx alone, offset from the middle of the picture.
Rgbv64 energy_of(Channel& channel, double dx_px, double dy_px, double radius_px,
                 int colour = SEAGLARE_COLOUR_WHITE) {
    channel.clear();
    const Point position =
        channel.at_px(channel.width_px() / 2.0 + dx_px, channel.height_px() / 2.0 + dy_px, lamp_distance_m);
    auto light = white_light(position, illuminance_lx * lamp_distance_m * lamp_distance_m,
                             radius_of_px(radius_px, lamp_distance_m));
    light.colour = colour;
    channel.add(light);
    const seaglare_result drawn = channel.render();
    EXPECT_TRUE(drawn == SEAGLARE_OK || drawn == SEAGLARE_DEGRADED) << channel.last_error();
    return channel.energy_lx();
}

struct Spread {
    double lowest = 1e300, highest = -1e300;
    void add(double value) {
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
    }
    std::string text() const { return std::to_string(lowest) + " ... " + std::to_string(highest); }
};

// The share of a light's glare that falls outside the picture when everything there follows the CIE curve.
double cie_energy_outside(const Channel& channel) {
    const double half_deg = 180 / pi * std::atan(channel.width_px() / 2.0 / 869.117);
    constexpr double step_deg = 0.05;
    constexpr int azimuths = 256;
    double energy = 0;
    for (double angle = 0.9 * half_deg + step_deg / 2; angle < 90; angle += step_deg) {
        int outside = 0;
        for (int k = 0; k < azimuths; ++k) {
            const Point d = channel.direction_around(channel.width_px() / 2.0, channel.height_px() / 2.0,
                                                     angle * pi / 180, 2 * pi * (k + 0.5) / azimuths);
            if (!channel.in_picture(d)) ++outside;
        }
        // The young eye of config/eye: 24 years, brown.
        energy += glare::cie_total_glare_sr(angle, 24, 0.5) * outside * 2 * pi / azimuths *
                  std::sin(angle * pi / 180) * step_deg * pi / 180;
    }
    return energy;
}

// White light: R, G, B and their luminance each are the illuminance.
void expect_illuminance_everywhere(Channel& channel, double expected_lx, double tolerance) {
    for (const double radius_px : apparent_radii_px) {
        Spread spread;
        for (int i = 0; i < sub_pixel_positions; ++i) {
            const auto offset = sub_pixel(i);
            const Rgbv64 energy = energy_of(channel, offset[0], offset[1], radius_px);
            for (std::size_t c = 0; c < 3; ++c) {
                spread.add(energy[c] / expected_lx);
                EXPECT_NEAR(energy[c] / expected_lx, 1, tolerance)
                    << "channel " << c << ", radius " << radius_px << " px, position " << i;
            }
        }
        ::testing::Test::RecordProperty("sum_over_E_at_" + std::to_string(radius_px) + "_px", spread.text());
        std::printf("  radius %5.2f px: sum/E %s\n", radius_px, spread.text().c_str());
    }
}

TEST(AccuracyEnergy, OfALightWhoseGlareLiesInThePictureIsItsIlluminance) {
    SEAGLARE_CHANNEL(channel, with({.cie_tail = false, .gratings = false}, 160));
    expect_illuminance_everywhere(channel, illuminance_lx, 0.002);
}

TEST(AccuracyEnergy, WithTheTailIsItsIlluminanceLessWhatFallsOutsideThePicture) {
    SEAGLARE_CHANNEL(channel, with({.gratings = false}, 240));
    const double outside = cie_energy_outside(channel);
    EXPECT_GT(outside, 0.02) << "a test of nothing: the tail reaches beyond the picture";
    std::printf("  outside the picture: %.4f of E\n", outside);
    expect_illuminance_everywhere(channel, illuminance_lx * (1 - outside), 0.005);
}

TEST(AccuracyEnergy, OfTheDefaultPatternIsWhatTheEyesLensPasses) {
    // The default quality: 4096 samples. The fibres at the lens's edge absorb, so what arrives is a little less.
    SEAGLARE_CHANNEL(channel, with({.transform_size = 4096, .cie_tail = false}, 240));
    energy_of(channel, 0, 0, 0);
    const double passed = glare::transmitted_fraction(glare::young_eye(), channel.stats().pupil_mm);
    EXPECT_EQ(channel.stats().pattern_size, 4096U);
    EXPECT_LT(passed, 0.98) << "by starlight the pupil lays the fibres open";
    std::printf("  pupil %.2f mm passes %.4f\n", channel.stats().pupil_mm, passed);
    for (const double radius_px : {0.01, 4.0, 30.0}) {
        for (int i = 0; i < 4; ++i) {
            const auto offset = sub_pixel(i);
            const double sum = luminance_of(energy_of(channel, offset[0], offset[1], radius_px));
            EXPECT_NEAR(sum / (passed * illuminance_lx), 1, 0.01) << "radius " << radius_px << " px";
        }
    }
}

TEST(AccuracyEnergy, HoldsWithoutOpenCl) {
    ChannelOptions options = with({.transform_size = 512, .cie_tail = false, .gratings = false}, 160);
    options.create_flags = SEAGLARE_CREATE_NO_OPENCL;
    SEAGLARE_CHANNEL(channel, options);
    expect_illuminance_everywhere(channel, illuminance_lx, 0.002);
}

TEST(AccuracyEnergy, ChangesByLessThanATenthOfAPercentPerTenthOfAPixel) {
    SEAGLARE_CHANNEL(channel, with({}, 160));
    for (const double radius_px : apparent_radii_px) {
        double last = 0;
        double worst = 0;
        for (int step = 0; step <= 12; ++step) {
            const double sum =
                luminance_of(energy_of(channel, 0.1 * step * 0.8, 0.1 * step * 0.6, radius_px));
            if (step > 0) {
                worst = std::max(worst, std::abs(sum / last - 1));
                EXPECT_NEAR(sum / last, 1, 0.001) << "radius " << radius_px << " px, step " << step;
            }
            last = sum;
        }
        std::printf("  radius %5.2f px: worst change per tenth of a pixel %.5f %%\n", radius_px, 100 * worst);
    }
}

TEST(AccuracyEnergy, IsTheLuminanceOfEveryColourAndItsScotopicLight) {
    SEAGLARE_CHANNEL(channel, with({.cie_tail = false, .gratings = false}, 160));
    struct Lamp {
        int colour;
        double scotopic_per_photopic;
    };
    // V'/V of the lamps' spectra: D65 and Gaussian LEDs at 625, 525 nm (physics notes, from the CIE tables), each to what
    // three printed digits are worth. The yellow LED's is not printed there.
    const Lamp lamps[] = {{SEAGLARE_COLOUR_WHITE, 2.464},
                          {SEAGLARE_COLOUR_RED, 0.046},
                          {SEAGLARE_COLOUR_GREEN, 2.77},
                          {SEAGLARE_COLOUR_YELLOW, 0}};
    for (const Lamp& lamp : lamps) {
        for (int i = 0; i < 3; ++i) {
            const auto offset = sub_pixel(i);
            const Rgbv64 energy = energy_of(channel, offset[0], offset[1], i == 2 ? 4 : 0.01, lamp.colour);
            EXPECT_NEAR(luminance_of(energy) / illuminance_lx, 1, 0.01) << "colour " << lamp.colour;
            if (lamp.scotopic_per_photopic > 0) {
                EXPECT_NEAR(energy[3] / illuminance_lx / lamp.scotopic_per_photopic, 1, 0.05)
                    << "colour " << lamp.colour;
            }
            if (i > 0) continue;
            std::printf("  colour %d: luminance/E %.5f, scotopic/E %.4f\n", lamp.colour,
                        luminance_of(energy) / illuminance_lx, energy[3] / illuminance_lx);
        }
    }
}

TEST(AccuracyEnergy, HoldsOnAFineChannel) {
    // 2160 lines of 30 degrees.
    ChannelOptions options = with({.cie_tail = false, .gratings = false}, 480);
    options.focal_px = 1080 / std::tan(15 * pi / 180);
    SEAGLARE_CHANNEL(channel, options);
    for (const double radius_px : {0.01, 4.0, 30.0}) {
        channel.clear();
        channel.add(white_light(channel.at_px(240.3, 239.6, lamp_distance_m),
                                illuminance_lx * lamp_distance_m * lamp_distance_m,
                                radius_of_px(radius_px, lamp_distance_m, options.focal_px)));
        ASSERT_EQ(channel.render(), SEAGLARE_OK) << channel.last_error();
        const double sum = luminance_of(channel.energy_lx());
        EXPECT_NEAR(sum / illuminance_lx, 1, 0.01) << "radius " << radius_px << " px";
        std::printf("  radius %5.2f px: sum/E %.5f\n", radius_px, sum / illuminance_lx);
    }
}

}  // namespace
}  // namespace seaglare::test
