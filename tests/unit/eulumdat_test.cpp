// EULUMDAT photometric files, small ones written here and worked by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "lightdb/photometry_file.h"

namespace seaglare::lightdb {
namespace {

constexpr double rad_per_deg = std::numbers::pi / 180;

// The fields that the tests vary; the rest is that of a lantern of 2000 lm.
struct Ldt {
    std::string symmetry = "0";
    std::string planes = "1";
    std::string plane_step = "0";
    std::string intensities = "2";
    std::string intensity_step = "180";
    std::string length_mm = "0";
    std::string width_mm = "0";
    std::vector<std::string> heights_mm = {"0", "0", "0", "0"};
    std::string downward = "0";
    std::string output_ratio = "0";
    std::string conversion = "1";
    std::string tilt = "0";
    std::string lamps =
        "1\n1\nLED\n2000\n3000\n80\n20\n";  // sets, then lamps, type, lumens, colour, rendering, watts
    std::string angles;                     // C, then gamma
    std::string values;
};

std::string text_of(const Ldt& ldt) {
    std::string text = "Maker\n1\n" + ldt.symmetry + "\n" + ldt.planes + "\n" + ldt.plane_step + "\n" +
                       ldt.intensities + "\n" + ldt.intensity_step +
                       "\nreport\nBuoy lantern\n42\nlantern.ldt\n2024\n0\n0\n0\n" + ldt.length_mm + "\n" +
                       ldt.width_mm + "\n";
    for (const std::string& height : ldt.heights_mm)
        text += height + "\n";
    text +=
        ldt.downward + "\n" + ldt.output_ratio + "\n" + ldt.conversion + "\n" + ldt.tilt + "\n" + ldt.lamps;
    for (int i = 0; i < 10; ++i)
        text += "0\n";
    std::string lists = ldt.angles + " " + ldt.values;
    for (char& c : lists)
        c = c == ' ' ? '\n' : c;
    return text + lists + "\n";
}

PhotometryFile read(const Ldt& ldt) {
    return parse_photometry(text_of(ldt), "lantern.ldt");
}

std::string error_of(const Ldt& ldt) {
    try {
        read(ldt);
    } catch (const PhotometryFileError& error) {
        return error.what();
    }
    return "no error";
}

double at_horizon(const PhotometryFile& file, double bearing_deg) {
    return candela_towards(*file.solid,
                           {std::sin(bearing_deg * rad_per_deg), std::cos(bearing_deg * rad_per_deg), 0});
}

TEST(Eulumdat, AnIsotropicFileIsEquallyBrightInAllDirections) {
    Ldt ldt;
    ldt.symmetry = "1";
    ldt.angles = "0 0 180";
    ldt.values = "79.5774715459 79.5774715459";  // 1000 lm / 4 pi
    ldt.output_ratio = "100";
    ldt.downward = "50";
    const PhotometryFile file = read(ldt);
    for (double bearing_deg = 0; bearing_deg < 360; bearing_deg += 31)
        EXPECT_NEAR(at_horizon(file, bearing_deg), 2 * 79.5774715459, 1e-9);
    EXPECT_NEAR(candela_towards(*file.solid, {0, 0, 1}), 2 * 79.5774715459, 1e-9);
    EXPECT_NEAR(flux_lm(*file.solid), 2000, 1e-6);
    EXPECT_EQ(file.lamp_flux_lm, 2000);
    EXPECT_EQ(file.name, "Buoy lantern");
    EXPECT_TRUE(file.warnings.empty());
}

// Intensities are per 1000 lm: the lamps' 2000 lm double them. C counts anticlockwise from ahead.
TEST(Eulumdat, WithoutSymmetryEveryPlaneStandsInTheFile) {
    Ldt ldt;
    ldt.symmetry = "0";
    ldt.planes = "4";
    ldt.plane_step = "90";
    ldt.angles = "0 90 180 270 0 180";
    ldt.values = "10 10 20 20 30 30 40 40";
    const PhotometryFile file = read(ldt);
    EXPECT_NEAR(at_horizon(file, 0), 20, 1e-9);
    EXPECT_NEAR(at_horizon(file, 270), 40, 1e-9);
    EXPECT_NEAR(at_horizon(file, 180), 60, 1e-9);
    EXPECT_NEAR(at_horizon(file, 90), 80, 1e-9);
    EXPECT_NEAR(at_horizon(file, 315), 30, 1e-9);
    EXPECT_NEAR(at_horizon(file, 45), 50, 1e-9);  // between C 270 and C 360 = 0
    EXPECT_EQ(file.solid->reference_cd, 80);
}

TEST(Eulumdat, OnePlaneStandsForAllWhenTheAxisIsVertical) {
    Ldt ldt;
    ldt.symmetry = "1";
    ldt.planes = "4";
    ldt.plane_step = "90";
    ldt.intensities = "3";
    ldt.intensity_step = "90";
    ldt.angles = "0 90 180 270 0 90 180";
    ldt.values = "0 50 10";
    const PhotometryFile file = read(ldt);
    EXPECT_NEAR(at_horizon(file, 77), 100, 1e-9);
    EXPECT_NEAR(candela_towards(*file.solid, {1, 0, -1}), 50, 1e-9);
    EXPECT_NEAR(candela_towards(*file.solid, {0, -1, 1}), 60, 1e-9);
}

TEST(Eulumdat, SymmetryToThePlaneC0C180) {
    Ldt ldt;
    ldt.symmetry = "2";
    ldt.planes = "4";
    ldt.plane_step = "90";
    ldt.angles = "0 90 180 270 0 180";
    ldt.values = "10 10 20 20 40 40";
    const PhotometryFile file = read(ldt);
    EXPECT_NEAR(at_horizon(file, 90), 40, 1e-9);
    EXPECT_NEAR(at_horizon(file, 270), 40, 1e-9);
    EXPECT_NEAR(at_horizon(file, 135), 60, 1e-9);
    EXPECT_NEAR(at_horizon(file, 225), 60, 1e-9);
    EXPECT_NEAR(at_horizon(file, 180), 80, 1e-9);
}

// The planes run from C270 over C0 to C90.
TEST(Eulumdat, SymmetryToThePlaneC90C270) {
    Ldt ldt;
    ldt.symmetry = "3";
    ldt.planes = "4";
    ldt.plane_step = "90";
    ldt.angles = "0 90 180 270 0 180";
    ldt.values = "10 10 20 20 40 40";
    const PhotometryFile file = read(ldt);
    EXPECT_NEAR(at_horizon(file, 90), 20, 1e-9);   // C 270
    EXPECT_NEAR(at_horizon(file, 0), 40, 1e-9);    // C 0
    EXPECT_NEAR(at_horizon(file, 270), 80, 1e-9);  // C 90
    EXPECT_NEAR(at_horizon(file, 180), 40, 1e-9);
    EXPECT_NEAR(at_horizon(file, 225), 60, 1e-9);  // C 135, the mirror of C 45
    EXPECT_NEAR(at_horizon(file, 315), 60, 1e-9);
}

TEST(Eulumdat, SymmetryToBothPlanes) {
    Ldt ldt;
    ldt.symmetry = "4";
    ldt.planes = "8";
    ldt.plane_step = "45";
    ldt.angles = "0 45 90 135 180 225 270 315 0 180";
    ldt.values = "10 10 20 20 40 40";
    const PhotometryFile file = read(ldt);
    for (const double bearing_deg : {45.0, 135.0, 225.0, 315.0})
        EXPECT_NEAR(at_horizon(file, bearing_deg), 40, 1e-9);
    for (const double bearing_deg : {22.5, 157.5, 202.5, 337.5})
        EXPECT_NEAR(at_horizon(file, bearing_deg), 30, 1e-9);
    EXPECT_NEAR(at_horizon(file, 90), 80, 1e-9);
}

TEST(Eulumdat, ALambertianLampAddsUpToItsOutputRatio) {
    Ldt ldt;
    ldt.symmetry = "1";
    ldt.intensities = "91";
    ldt.intensity_step = "1";
    ldt.angles = "0";
    for (int gamma = 0; gamma <= 90; ++gamma) {
        ldt.angles += " " + std::to_string(gamma);
        // 80 % of 1000 lm over pi.
        ldt.values +=
            (gamma > 0 ? " " : "") + std::to_string(800 / std::numbers::pi * std::cos(gamma * rad_per_deg));
    }
    ldt.output_ratio = "80";
    ldt.downward = "100";
    const PhotometryFile file = read(ldt);
    EXPECT_NEAR(flux_lm(*file.solid) / 1600, 1, 1e-4);
    EXPECT_NEAR(flux_below_horizon_lm(*file.solid) / 1600, 1, 1e-4);
    EXPECT_TRUE(file.warnings.empty());
    ldt.output_ratio = "60";
    ldt.downward = "40";
    const PhotometryFile doubted = read(ldt);
    ASSERT_EQ(doubted.warnings.size(), 2U);
    EXPECT_NE(doubted.warnings[0].find("80 % of the lamps' flux, the light output ratio LORL is 60 %"),
              std::string::npos);
    EXPECT_NE(doubted.warnings[1].find("100 % of their flux down, the downward fraction DFF is 40 %"),
              std::string::npos);
}

TEST(Eulumdat, TheFirstSetOfLampsBurnsAndANegativeNumberMeansAbsolutePhotometry) {
    Ldt ldt;
    ldt.angles = "0 0 180";
    ldt.values = "10 10";
    ldt.lamps = "2\n1\nA\n2000\n\n\n20\n2\nB\n5000\n\n\n40\n";
    const PhotometryFile file = read(ldt);
    EXPECT_EQ(file.solid->reference_cd, 20);
    EXPECT_EQ(file.lamp_flux_lm, 2000);
    EXPECT_EQ(file.warnings.size(), 1U);
    ldt.lamps = "1\n-1\nLED\n3000\n\n\n20\n";
    const PhotometryFile absolute = read(ldt);
    EXPECT_EQ(absolute.solid->reference_cd, 30);
    EXPECT_EQ(absolute.lamp_flux_lm, 0);
}

TEST(Eulumdat, DecimalCommasWindowsLinesAndBlankSizesAreRead) {
    Ldt ldt;
    ldt.angles = "0 0 22,5 180";
    ldt.intensities = "3";
    ldt.intensity_step = "0";
    ldt.values = "10,5 10,5 10,5";
    ldt.length_mm = "";
    std::string windows;
    for (const char c : text_of(ldt))
        windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    const PhotometryFile file = parse_photometry(windows, "LANTERN.LDT");
    EXPECT_NEAR(at_horizon(file, 10), 21, 1e-9);
    EXPECT_FALSE(file.solid->radius_m.has_value());
}

TEST(Eulumdat, TheOpeningGivesADiscAsLargeAsItIsSeen) {
    Ldt ldt;
    ldt.angles = "0 0 180";
    ldt.values = "10 10";
    ldt.length_mm = "300";
    EXPECT_NEAR(*read(ldt).solid->radius_m, 0.15, 1e-12);  // round, from below
    ldt.heights_mm = {"200", "200", "200", "200"};
    EXPECT_NEAR(*read(ldt).solid->radius_m, std::sqrt(0.06 / std::numbers::pi),
                1e-12);  // a drum from the side
    ldt.heights_mm = {"0", "0", "0", "0"};
    ldt.width_mm = "100";
    EXPECT_NEAR(*read(ldt).solid->radius_m, std::sqrt(0.03 / std::numbers::pi), 1e-12);
}

TEST(Eulumdat, WhatTheHeaderSaysOfTiltConversionAndStepsIsHeardOrDoubted) {
    Ldt ldt;
    ldt.angles = "0 0 90 180";
    ldt.intensities = "3";
    ldt.intensity_step = "45";
    ldt.values = "10 10 10";
    ldt.conversion = "1.5";
    ldt.tilt = "5";
    const PhotometryFile file = read(ldt);
    EXPECT_EQ(file.solid->reference_cd, 30);
    ASSERT_EQ(file.warnings.size(), 3U);
    EXPECT_NE(file.warnings[0].find("lantern.ldt:24: the intensities are multiplied"), std::string::npos);
    EXPECT_NE(file.warnings[1].find("lantern.ldt:25: the luminaire was measured tilted by 5"),
              std::string::npos);
    EXPECT_NE(file.warnings[2].find("the gamma angles do not lie 45 degrees apart"), std::string::npos);
}

TEST(Eulumdat, ErrorsNameLineAndColumn) {
    Ldt good;
    good.angles = "0 0 180";
    good.values = "10 10";
    const auto begins = [&](auto change, const std::string& expected) {
        Ldt ldt = good;
        change(ldt);
        EXPECT_EQ(error_of(ldt).substr(0, expected.size()), expected);
    };
    // 25 lines, 7 of lamps, 10 ratios; then one C angle, two gamma, two intensities from line 46 on.
    begins([](Ldt& l) { l.values = "10"; },
           "lantern.ldt:47:1: the file ends where luminous intensity should stand");
    begins([](Ldt& l) { l.values = "10 10 7"; },
           "lantern.ldt:48:1: nothing should follow the luminous intensities");
    begins([](Ldt& l) { l.values = "10 -1"; }, "lantern.ldt:47:1: luminous intensity is -1");
    begins([](Ldt& l) { l.values = "NaN 1"; }, "lantern.ldt:46:1: 'NaN' is no number");
    begins([](Ldt& l) { l.values = "0 0"; }, "lantern.ldt:48:1: all luminous intensities are 0");
    begins([](Ldt& l) { l.angles = "0 180 0"; }, "lantern.ldt:45:1: gamma angle 0 does not lie above");
    begins([](Ldt& l) { l.angles = "361 0 180"; }, "lantern.ldt:43:1: C angle is 361");
    begins([](Ldt& l) { l.symmetry = "5"; }, "lantern.ldt:3:1: the symmetry indicator Isym is 5");
    begins([](Ldt& l) { l.symmetry = ""; },
           "lantern.ldt:3:1: the line is blank where the symmetry indicator");
    begins([](Ldt& l) { l.planes = "0"; }, "lantern.ldt:4:1: the number of C planes, Mc is 0");
    begins([](Ldt& l) { l.intensities = "1.5"; },
           "lantern.ldt:6:1: the number of intensities per plane, Ng is 1.5");
    begins([](Ldt& l) { l.lamps = "1\n1\nLED\n0\n\n\n20\n"; },
           "lantern.ldt:29:1: the total luminous flux of the lamps is 0");
    begins([](Ldt& l) { l.symmetry = "2"; }, "lantern.ldt:45:1: 1 C planes cannot be parted by 2");
    begins(
        [](Ldt& l) {
            l.symmetry = "2";
            l.planes = "2";
            l.angles = "0 170 0 180";
        },
        "lantern.ldt:46:1: C plane 2 stands at 170 degrees, the symmetry Isym 2 needs it at 180");
}

TEST(Eulumdat, ACountThatNoFileCouldHoldIsRefusedBeforeRoomIsMade) {
    Ldt ldt;
    ldt.angles = "0 0 180";
    ldt.values = "10 10";
    ldt.planes = "1000000";
    EXPECT_NE(error_of(ldt).find("the file is too short for the"), std::string::npos);
    ldt.planes = "1000000000";
    EXPECT_NE(error_of(ldt).find("lantern.ldt:4:1: the number of C planes"), std::string::npos);
    ldt.planes = "1";
    ldt.intensities = "1000000";
    EXPECT_NE(error_of(ldt).find("the file is too short for the"), std::string::npos);
}

}  // namespace
}  // namespace seaglare::lightdb
