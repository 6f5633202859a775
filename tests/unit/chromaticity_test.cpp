#include "glare/colour/chromaticity.h"

#include <gtest/gtest.h>

#include "glare/colour/navigation_colours.h"

namespace seaglare::glare {
namespace {

// IEC 61966-2-1: the primaries and the white of sRGB.
TEST(Chromaticity, TheSrgbPrimariesAndWhiteAreWhereTheStandardPutsThem) {
    const std::array<std::array<double, 3>, 4> rgb = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}};
    const std::array<Chromaticity, 4> xy = {{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}}};
    for (std::size_t i = 0; i < rgb.size(); ++i) {
        const Chromaticity found = chromaticity_of(xyz_from_srgb(rgb[i]));
        EXPECT_NEAR(found.x, xy[i].x, 1e-6) << i;
        EXPECT_NEAR(found.y, xy[i].y, 1e-6) << i;
    }
    EXPECT_NEAR(luminance({1, 1, 1}), 1, 1e-9);
    EXPECT_NEAR(luminance({1, 0, 0}), 0.2126, 5e-5);
}

TEST(Chromaticity, ThereAndBackIsTheIdentity) {
    const std::array<double, 3> rgb = {-0.97, 1.69, 0.3};
    const auto back = srgb_from_xyz(xyz_from_srgb(rgb));
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(back[c], rgb[c], 1e-8);
    const Xyz xyz = xyz_from_chromaticity({0.28, 0.52}, 3);
    EXPECT_NEAR(chromaticity_of(xyz).x, 0.28, 1e-12);
    EXPECT_NEAR(chromaticity_of(xyz).y, 0.52, 1e-12);
    EXPECT_DOUBLE_EQ(xyz.y, 3);
}

TEST(Chromaticity, DegenerateColoursAreWhiteOrBlackAndNeverNan) {
    EXPECT_EQ(chromaticity_of({0, 0, 0}).x, srgb_white.x);
    EXPECT_EQ(xyz_from_chromaticity({0.3, 0}, 1).y, 0);
    EXPECT_EQ(unit_luminance_in_gamut({0, 0, 0})[2], 1);
    EXPECT_EQ(unit_luminance_in_gamut({-1, -1, -1})[0], 1);
}

TEST(Chromaticity, TheGamutKeepsLuminanceAndLosesOnlySaturation) {
    const auto green = unit_luminance_in_gamut({-0.97, 1.69, -0.07});
    EXPECT_NEAR(luminance(green), 1, 1e-9);
    EXPECT_NEAR(green[0], 0, 1e-12);
    for (double c : green)
        EXPECT_GE(c, 0);
    EXPECT_GT(green[1], green[2]);
}

// Unit-luminance linear sRGB of the marine colours: IALA E-200-1 and COLREG Annex I chromaticities.
TEST(NavigationColours, HaveUnitLuminanceAndTheirChromaticity) {
    for (int colour = 0; colour < 7; ++colour) {
        const auto& rgb = navigation_colour(colour).rgb;
        EXPECT_NEAR(luminance({static_cast<double>(rgb[0]), static_cast<double>(rgb[1]),
                               static_cast<double>(rgb[2])}),
                    1, 1e-6)
            << colour;
        for (float c : rgb)
            EXPECT_GE(c, 0.0F) << colour;
    }
    EXPECT_NEAR(navigation_colour(1).rgb[0], 4.703, 0.001);
    EXPECT_NEAR(navigation_colour(2).rgb[0], 0.016, 0.001);
    EXPECT_NEAR(navigation_colour(2).rgb[1], 1.370, 0.001);
    EXPECT_NEAR(navigation_colour(2).rgb[2], 0.233, 0.001);
    EXPECT_NEAR(navigation_colour(3).rgb[0], 2.670, 0.005);
    EXPECT_NEAR(navigation_colour(3).rgb[1], 0.604, 0.005);
    EXPECT_NEAR(navigation_colour(4).rgb[2], 13.85, 0.005);
    EXPECT_EQ(navigation_colour(99).rgb, navigation_colour(0).rgb);
}

// Rods see next to nothing of a red light and many times the luminance of a blue one.
TEST(NavigationColours, ScotopicRatiosAreThoseOfTheirLeds) {
    EXPECT_NEAR(navigation_colour(0).scotopic_per_photopic, 2.464F, 0.005F);
    EXPECT_NEAR(navigation_colour(1).scotopic_per_photopic, 0.046F, 0.001F);
    EXPECT_NEAR(navigation_colour(2).scotopic_per_photopic, 2.77F, 0.01F);
    EXPECT_NEAR(navigation_colour(4).scotopic_per_photopic, 19.0F, 0.5F);
    EXPECT_LT(navigation_colour(3).scotopic_per_photopic, 0.5F);
    EXPECT_LT(navigation_colour(5).scotopic_per_photopic, navigation_colour(3).scotopic_per_photopic);
    EXPECT_GT(navigation_colour(6).scotopic_per_photopic, 5.0F);
}

}  // namespace
}  // namespace seaglare::glare
