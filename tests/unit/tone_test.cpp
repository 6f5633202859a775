#include <gtest/gtest.h>

#include <cmath>

#include "glare/tone/operators.h"

namespace seaglare::glare {
namespace {

// Cited: IEC 61966-2-1.
TEST(Tone, SrgbIsPiecewiseAndItsOwnInverse) {
    EXPECT_NEAR(srgb_encode(0.0031308), 0.04045, 1e-5);
    EXPECT_NEAR(srgb_encode(0.214041), 0.5, 1e-5);
    for (int code = 0; code <= 255; ++code)
        EXPECT_NEAR(srgb_encode(srgb_decode(code / 255.0)) * 255, code, 1e-4);
    EXPECT_EQ(srgb_encode(std::nan("")), 0);
}

// Cited: Krawczyk et al. 2005 with the +1 that its reprints lose.
TEST(Tone, KeyHasNoPoleInTheDark) {
    EXPECT_NEAR(key_value(0), 0.002, 1e-6);
    EXPECT_NEAR(key_value(9), 1.002 - 2.0 / 3, 1e-12);
    EXPECT_EQ(key_value(-1), key_value(1e-6));
    EXPECT_EQ(key_value(std::nan("")), key_value(1e-6));
}

TEST(Tone, WhiteMapsToOneAndTheInverseInverts) {
    const ToneSettings settings;
    for (const double adaptation : {1e-6, 0.001, 1.0, 1e4}) {
        const ToneCurve curve = tone_curve(settings, adaptation);
        EXPECT_NEAR(tone_map(curve, 2 / curve.scale), 1, 1e-12);
        double last = -1;
        for (double display = 0; display <= 1; display += 1.0 / 255) {
            const double luminance_cd_m2 = inverse_tone_map(curve, display);
            EXPECT_NEAR(tone_map(curve, luminance_cd_m2), display, 1e-12);
            EXPECT_GT(luminance_cd_m2, last);
            last = luminance_cd_m2;
        }
        EXPECT_EQ(tone_map(curve, std::nan("")), 0);
        EXPECT_TRUE(std::isfinite(tone_map(curve, 1e30)));
    }
}

TEST(Tone, GamutMappingKeepsLuminanceAndLeavesColoursInside) {
    const Rgb led = {-0.97, 1.69, -0.07};  // a 525 nm LED of unit luminance
    const Rgb mapped = mapped_into_gamut(led);
    EXPECT_NEAR(luminance(mapped), luminance(led), 1e-9);
    for (const double c : mapped)
        EXPECT_GE(c, 0);
    EXPECT_GT(mapped[1], mapped[2]);
    const Rgb inside = {0.2, 0.3, 0.4};
    EXPECT_EQ(mapped_into_gamut(inside), inside);
}

TEST(Tone, HueIsKeptWhereAChannelExceedsTheDisplay) {
    const ToneCurve curve = tone_curve({}, 0.001);
    const Rgb red = fitted_to_display(tone_mapped_rgb(curve, {47.03, 0, 0}));
    EXPECT_NEAR(red[0], 1, 1e-12);
    EXPECT_GT(red[1], 0);
    EXPECT_LE(red[1], overload_white);
    EXPECT_EQ(red[1], red[2]);
    // White is added, no other hue: differences between channels keep their proportion.
    const Rgb orange = fitted_to_display(tone_mapped_rgb(curve, {1000, 500, 100}));
    EXPECT_NEAR((orange[0] - orange[1]) / (orange[0] - orange[2]), (1000.0 - 500) / (1000 - 100), 1e-12);
}

TEST(Tone, MoreOfALightNeverLooksDarker) {
    const ToneCurve curve = tone_curve({}, 0.001);
    for (const Rgb& hue :
         {Rgb{4.703, 0, 0}, Rgb{0.016, 1.37, 0.233}, Rgb{0, 0, 13.85}, Rgb{2.67, 0.604, 0}}) {
        double before = 0;
        for (double level = 1e-5; level < 1e6; level *= 1.1) {
            // A veil of white lies over all of it, as before a sky.
            const double veil = 0.002;
            const double y = luminance(fitted_to_display(tone_mapped_rgb(
                curve, {hue[0] * level + veil, hue[1] * level + veil, hue[2] * level + veil})));
            EXPECT_GE(y, before * 0.97) << hue[0] << " " << hue[1] << " " << hue[2] << " at " << level;
            before = std::max(before, y);
        }
    }
}

TEST(Tone, YellowIsNoRedBeforeABrightSky) {
    const Rgb sky = {0.7, 0.55, 0.5};
    const Rgb yellow = display_delta({}, 5, 0, sky, {2.67e3, 0.604e3, 0}, 300);
    const Rgb red = display_delta({}, 5, 0, sky, {4.703e3, 0, 0}, 50);
    // On the display the sum is clipped; green is what tells them apart.
    EXPECT_GT(yellow[1], red[1] + 0.1);
    EXPECT_GT(yellow[0], 0.9);
    EXPECT_GT(red[0], 0.9);
}

TEST(Tone, RodTintHasUnitLuminance) {
    EXPECT_NEAR(luminance(rod_tint), 1, 1e-3);
}

TEST(Tone, BrightLightsKeepTheirColourAndFaintGlareLosesIt) {
    const Rgb bright = blue_shifted({4.703, 0, 0}, 0.046, 0.001);
    EXPECT_LT(bright[1] / bright[0], 0.01);
    const Rgb faint = blue_shifted({0.016e-3, 1.37e-3, 0.233e-3}, 2.77e-3, 0.0001);
    EXPECT_NEAR(faint[0] / faint[1], 1.05 / 0.97, 0.15);
}

TEST(Tone, WithoutGlareNothingIsAdded) {
    for (const auto mode : {CompositeMode::difference, CompositeMode::plain}) {
        ToneSettings settings;
        settings.mode = mode;
        const Rgb delta = display_delta(settings, 0.001, 0, {0.3, 0.2, 0.9}, {0, 0, 0}, 0);
        for (const double c : delta)
            EXPECT_NEAR(c, 0, 1e-15);
    }
}

TEST(Tone, DifferenceAddsLessByDuskThanPlainDoes) {
    ToneSettings plain;
    plain.mode = CompositeMode::plain;
    const Rgb grey = {0.4, 0.4, 0.4};
    const Rgb glare = {1, 1, 1};
    EXPECT_LT(display_delta({}, 1, 0, grey, glare, 2.464)[1],
              0.8 * display_delta(plain, 1, 0, grey, glare, 2.464)[1]);
}

TEST(Tone, ThresholdLuminanceMovesNoPixelByMoreThanItsCodes) {
    const ToneSettings settings;
    for (const double adaptation : {1e-6, 0.001, 1.0, 100.0}) {
        const double least = threshold_luminance_cd_m2(settings, adaptation, 0.25);
        for (const double background : {0.0, 0.002, 0.05, 0.5}) {
            const Rgb linear = {background, background, background};
            ToneSettings no_shift = settings;
            no_shift.blue_shift = false;
            const Rgb delta = display_delta(no_shift, adaptation, 0, linear, {least, least, least}, 0);
            EXPECT_LE((srgb_encode(background + delta[1]) - srgb_encode(background)) * 255, 0.2501);
        }
    }
}

}  // namespace
}  // namespace seaglare::glare
