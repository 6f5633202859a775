// Three small pictures, kept in tests/accuracy/golden, that the product must go on drawing. Look at them: they are meant to
// be seen. After a change that is meant to change pictures, draw them anew and look again:
//
//     SEAGLARE_REGENERATE_GOLDEN=1 ctest --test-dir BUILD -R accuracy.AccuracyGolden
//
// A comparison that fails writes NAME.actual.png into the folder it runs in, and says where.
//
// Tolerances. The pictures are drawn by OpenCL at a fixed time and seed: between machines only rounding differs. A change of
// a ten-thousandth in every light, a hundred times what rounding does, moves single pixels by one code; the other
// implementation of the pattern (on the CPU, in double precision) stays within the tolerance, too. A light a tenth of a
// pixel away or two per cent brighter does not. The last two tests measure all of this anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "tests/accuracy/channel.h"
#include "tests/accuracy/displayed.h"
#include "tests/accuracy/png_file.h"

namespace seaglare::test {
namespace {

constexpr int width_px = 320;
constexpr int height_px = 180;
constexpr int largest_allowed = 4;      // codes, of any pixel
constexpr double mean_allowed = 0.015;  // codes

struct Comparison {
    int largest = 0;
    double mean = 0;
};
Comparison compare(const RgbPicture& a, const RgbPicture& b) {
    Comparison c;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        const int difference = std::abs(int{a.rgb[i]} - int{b.rgb[i]});
        c.largest = std::max(c.largest, difference);
        c.mean += difference;
    }
    c.mean /= static_cast<double>(a.rgb.size());
    return c;
}

RgbPicture picture_of(const Channel& channel) {
    const auto rgba = channel.picture();
    RgbPicture picture{width_px, height_px, {}};
    for (int y = height_px - 1; y >= 0; --y) {
        for (int x = 0; x < width_px; ++x) {
            const auto* p = &rgba[(static_cast<std::size_t>(y) * width_px + x) * 4];
            picture.rgb.insert(picture.rgb.end(), p, p + 3);
        }
    }
    return picture;
}

// A sky that darkens upwards over a darker sea; codes of sRGB at the horizon, the zenith and the sea.
using Code = std::array<double, 3>;
std::vector<std::uint8_t> sea_and_sky(const Code& horizon, const Code& zenith, const Code& sea) {
    std::vector<std::uint8_t> rgba;
    for (int y = 0; y < height_px; ++y) {
        const double up = (y - height_px * 0.4) / (height_px * 0.6);
        for (int x = 0; x < width_px; ++x) {
            for (std::size_t c = 0; c < 3; ++c) {
                const double value = up < 0 ? sea[c] : horizon[c] + (zenith[c] - horizon[c]) * std::sqrt(up);
                rgba.push_back(static_cast<std::uint8_t>(std::lround(value)));
            }
            rgba.push_back(255);
        }
    }
    return rgba;
}

ChannelOptions small_picture() {
    ChannelOptions options;
    options.quality.threshold_codes = 0.25;
    options.width_px = width_px;
    options.height_px = height_px;
    options.focal_px = 434.6;  // 360 lines of 45 degrees
    return options;
}

void add(Channel& channel, double x_px, double y_px, double distance_m, double intensity_cd, int colour,
         double radius_m = 0.1) {
    auto light = white_light(channel.at_px(x_px, y_px, distance_m), intensity_cd, radius_m);
    light.colour = colour;
    channel.add(light);
}

// White, red and green, near and far, by starlight.
void draw_starlight(Channel& channel, double shift_px = 0, double brighter = 1) {
    channel.clear();
    channel.draw_background(sea_and_sky({14, 16, 22}, {5, 6, 10}, {4, 5, 8}));
    const int colours[] = {SEAGLARE_COLOUR_GREEN, SEAGLARE_COLOUR_WHITE, SEAGLARE_COLOUR_RED};
    for (int i = 0; i < 3; ++i) {
        const double x = 60 + 100 * i + shift_px;
        add(channel, x + 0.3, 74.6, 600, 150 * brighter, colours[i]);     // near: 4e-4 lx
        add(channel, x + 22.7, 73.2, 4000, 150 * brighter, colours[i]);   // 1e-5 lx
        add(channel, x + 40.1, 72.8, 12000, 150 * brighter, colours[i]);  // 1e-6 lx
    }
    ASSERT_GE(channel.render(), SEAGLARE_OK) << channel.last_error();
}

// The same colours at dusk, 5 cd/m2: brighter eyes, smaller pupil, lights that only just hold their own.
void draw_dusk(Channel& channel) {
    channel.draw_background(sea_and_sky({196, 150, 120}, {70, 90, 130}, {62, 66, 80}));
    add(channel, 60.3, 80.6, 600, 3000, SEAGLARE_COLOUR_GREEN);
    add(channel, 160.3, 80.6, 300, 3000, SEAGLARE_COLOUR_WHITE);
    add(channel, 260.3, 80.6, 600, 3000, SEAGLARE_COLOUR_RED);
    add(channel, 110.7, 74.1, 2500, 20000, SEAGLARE_COLOUR_YELLOW);
    add(channel, 205.2, 74.9, 2500, 3000, SEAGLARE_COLOUR_WHITE);
    seaglare_frame frame = channel.frame();
    frame.adaptation_luminance_cd_m2 = 5;
    ASSERT_EQ(channel.render(frame), SEAGLARE_OK) << channel.last_error();
}

// Lamps with a visible disc and their coronas.
void draw_discs(Channel& channel) {
    channel.draw_background(sea_and_sky({14, 16, 22}, {5, 6, 10}, {4, 5, 8}));
    add(channel, 70.4, 100.3, 20, 0.5, SEAGLARE_COLOUR_RED, 0.09);   // 2 px
    add(channel, 160.2, 95.8, 20, 60, SEAGLARE_COLOUR_WHITE, 0.37);  // 8 px
    add(channel, 255.6, 88.1, 20, 2, SEAGLARE_COLOUR_GREEN, 0.74);   // 16 px
    ASSERT_EQ(channel.render(), SEAGLARE_OK) << channel.last_error();
}

void expect_golden(const Channel& channel, const std::string& name) {
    const std::string golden_path = SEAGLARE_SOURCE_DIR "/tests/accuracy/golden/" + name + ".png";
    const RgbPicture actual = picture_of(channel);
    if (std::getenv("SEAGLARE_REGENERATE_GOLDEN") != nullptr) {
        ASSERT_TRUE(write_png(golden_path, actual)) << "cannot write " << golden_path;
        GTEST_SKIP() << "drawn anew: look at " << golden_path;
    }
    const auto golden = read_png(golden_path);
    Comparison c{255, 255};
    if (golden && golden->rgb.size() == actual.rgb.size() && golden->width_px == actual.width_px)
        c = compare(*golden, actual);
    std::printf("  %s: largest %d, mean %.4f codes\n", name.c_str(), c.largest, c.mean);
    if (c.largest <= largest_allowed && c.mean <= mean_allowed) return;
    const std::string path = (std::filesystem::current_path() / (name + ".actual.png")).string();
    write_png(path, actual);
    ADD_FAILURE() << "differs from " << golden_path << " by up to " << c.largest << " codes, " << c.mean
                  << " in the mean (allowed " << largest_allowed << " and " << mean_allowed
                  << "); drawn here: " << path;
}

TEST(AccuracyGolden, WhiteRedAndGreenNearAndFarByStarlight) {
    SEAGLARE_CHANNEL(channel, small_picture());
    draw_starlight(channel);
    expect_golden(channel, "starlight");
}

TEST(AccuracyGolden, LightsAtDusk) {
    SEAGLARE_CHANNEL(channel, small_picture());
    draw_dusk(channel);
    expect_golden(channel, "dusk");
}

TEST(AccuracyGolden, LampsWithDiscsAndCoronas) {
    SEAGLARE_CHANNEL(channel, small_picture());
    draw_discs(channel);
    expect_golden(channel, "discs");
}

bool within(const RgbPicture& a, const RgbPicture& b, const char* what) {
    const Comparison c = compare(a, b);
    std::printf("  %s: largest %d, mean %.4f codes\n", what, c.largest, c.mean);
    return c.largest <= largest_allowed && c.mean <= mean_allowed;
}

TEST(AccuracyGolden, TheToleranceAllowsRoundingAndSeesAChange) {
    SEAGLARE_CHANNEL(channel, small_picture());
    draw_starlight(channel);
    const RgbPicture picture = picture_of(channel);
    draw_starlight(channel);
    EXPECT_EQ(compare(picture, picture_of(channel)).largest, 0) << "the same frame twice is the same picture";
    draw_starlight(channel, 0, 1.0001);
    EXPECT_TRUE(within(picture, picture_of(channel), "a ten-thousandth brighter"));
    draw_starlight(channel, 0.1);
    EXPECT_FALSE(within(picture, picture_of(channel), "a tenth of a pixel"));
    draw_starlight(channel, 0, 1.02);
    EXPECT_FALSE(within(picture, picture_of(channel), "two per cent brighter"));
}

TEST(AccuracyGolden, TheOtherImplementationOfThePatternDrawsTheSame) {
    SEAGLARE_CHANNEL(channel, small_picture());
    ChannelOptions options = small_picture();
    options.create_flags = SEAGLARE_CREATE_NO_OPENCL;
    SEAGLARE_CHANNEL(other, options);
    draw_starlight(other);
    const RgbPicture second = picture_of(other);
    draw_starlight(channel);
    EXPECT_TRUE(within(second, picture_of(channel), "on the CPU"));
}

}  // namespace
}  // namespace seaglare::test
