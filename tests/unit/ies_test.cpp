// ANSI/IES LM-63 photometric files, small ones written here and worked by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numbers>
#include <string>
#include <system_error>

#include "lightdb/photometry_file.h"

namespace seaglare::lightdb {
namespace {

constexpr double rad_per_deg = std::numbers::pi / 180;

PhotometryFile read(const std::string& text) {
    return parse_photometry(text, "lantern.ies");
}

// The message of the error that reading gives.
std::string error_of(const std::string& text) {
    try {
        read(text);
    } catch (const PhotometryFileError& error) {
        return error.what();
    }
    return "no error";
}

// A file of the 2002 edition with one lamp. `sizes`: numbers of vertical and horizontal angles; type 1 C, 2 B, 3 A.
std::string ies(const std::string& sizes, int type, const std::string& rest) {
    return "IESNA:LM-63-2002\n[TEST] 1\n[MANUFAC] none\nTILT=NONE\n1 -1 1 " + sizes + " " +
           std::to_string(type) + " 2 0 0 0\n1 1 0\n" + rest;
}

// Towards a bearing from ahead and an elevation, as the light's frame has them.
double towards(const PhotometryFile& file, double bearing_deg, double elevation_deg) {
    const double bearing = bearing_deg * rad_per_deg;
    const double elevation = elevation_deg * rad_per_deg;
    return candela_towards(*file.solid, {std::cos(elevation) * std::sin(bearing),
                                         std::cos(elevation) * std::cos(bearing), std::sin(elevation)});
}

TEST(Ies, AnIsotropicFileIsEquallyBrightInAllDirections) {
    const PhotometryFile file = read(ies("3 1", 1, "0 90 180\n0\n100 100 100\n"));
    for (double bearing_deg = 0; bearing_deg < 360; bearing_deg += 17) {
        for (double elevation_deg = -90; elevation_deg <= 90; elevation_deg += 7.5) {
            EXPECT_NEAR(towards(file, bearing_deg, elevation_deg), 100, 1e-9);
        }
    }
    EXPECT_NEAR(flux_lm(*file.solid), 400 * std::numbers::pi, 1e-9);
    EXPECT_EQ(file.solid->reference_cd, 100);
    EXPECT_TRUE(file.warnings.empty());
}

TEST(Ies, InTypeCTheVerticalAngleCountsFromTheNadir) {
    const PhotometryFile file = read(ies("4 1", 1, "0 60 90 180\n0\n0 30 90 180\n"));
    EXPECT_NEAR(towards(file, 12, -90), 0, 1e-9);
    EXPECT_NEAR(towards(file, 12, -30), 30, 1e-9);
    EXPECT_NEAR(towards(file, 12, -10), 70, 1e-9);  // two thirds from 30 at 60 to 90 at 90
    EXPECT_NEAR(towards(file, 12, 0), 90, 1e-9);
    EXPECT_NEAR(towards(file, 12, 90), 180, 1e-9);
}

TEST(Ies, InTypeCHorizontalAnglesCountAnticlockwiseFromAhead) {
    const PhotometryFile file =
        read(ies("2 5", 1, "0 180\n0 90 180 270 360\n10 10\n20 20\n30 30\n40 40\n10 10\n"));
    EXPECT_NEAR(towards(file, 0, 0), 10, 1e-9);
    EXPECT_NEAR(towards(file, 270, 0), 20, 1e-9);  // C 90 lies to port
    EXPECT_NEAR(towards(file, 180, 0), 30, 1e-9);
    EXPECT_NEAR(towards(file, 90, 0), 40, 1e-9);
    EXPECT_NEAR(towards(file, 315, 0), 15, 1e-9);
    EXPECT_NEAR(towards(file, 22.5, 0), 17.5, 1e-9);  // a quarter of the way from 10 ahead to 40
    EXPECT_NEAR(towards(file, 359.999, 0), towards(file, 0.001, 0), 1e-2);
}

TEST(Ies, AQuadrantIsMirroredToAllFour) {
    const PhotometryFile file = read(ies("3 3", 1, "0 90 180\n0 45 90\n10 20 30\n10 40 30\n10 60 30\n"));
    for (const double bearing_deg : {22.5, 157.5, 202.5, 337.5})
        EXPECT_NEAR(towards(file, bearing_deg, 0), 30, 1e-9) << bearing_deg;
    for (const double bearing_deg : {90.0, 270.0})
        EXPECT_NEAR(towards(file, bearing_deg, 0), 60, 1e-9) << bearing_deg;
    EXPECT_NEAR(towards(file, 180, 0), 20, 1e-9);
    EXPECT_NEAR(towards(file, 180, 45), 25, 1e-9);
    EXPECT_NEAR(towards(file, 202.5, -45), 20, 1e-9);  // half way between 10 and 30
}

TEST(Ies, AHalfIsMirroredAboutThePlaneThroughAheadAndAstern) {
    const PhotometryFile file = read(ies("2 3", 1, "0 180\n0 90 180\n20 20\n40 40\n80 80\n"));
    EXPECT_NEAR(towards(file, 90, 0), 40, 1e-9);
    EXPECT_NEAR(towards(file, 270, 0), 40, 1e-9);
    EXPECT_NEAR(towards(file, 135, 0), 60, 1e-9);
    EXPECT_NEAR(towards(file, 225, 0), 60, 1e-9);
    EXPECT_NEAR(towards(file, 0, 0), 20, 1e-9);
    EXPECT_NEAR(towards(file, 180, 0), 80, 1e-9);
}

TEST(Ies, AHalfFrom90To270IsMirroredAboutThePlaneThroughPortAndStarboard) {
    const PhotometryFile file = read(ies("2 3", 1, "0 180\n90 180 270\n10 10\n20 20\n40 40\n"));
    EXPECT_NEAR(towards(file, 270, 0), 10, 1e-9);
    EXPECT_NEAR(towards(file, 90, 0), 40, 1e-9);
    EXPECT_NEAR(towards(file, 0, 0), 20, 1e-9);
    EXPECT_NEAR(towards(file, 180, 0), 20, 1e-9);
    EXPECT_NEAR(towards(file, 315, 0), 15, 1e-9);                  // C 45, the mirror of 135
    EXPECT_NEAR(towards(file, 60, 0), 20 + 20 * 60.0 / 90, 1e-9);  // C 300, the mirror of 240
}

TEST(Ies, BeyondWhatWasMeasuredItIsDark) {
    const PhotometryFile file = read(ies("2 1", 1, "0 90\n0\n50 50\n"));
    EXPECT_NEAR(towards(file, 40, -0.001), 50, 1e-9);
    EXPECT_NEAR(towards(file, 40, 0), 50, 1e-9);
    EXPECT_EQ(towards(file, 40, 0.001), 0);
    EXPECT_NEAR(flux_lm(*file.solid), 100 * std::numbers::pi, 1e-9);
    EXPECT_NEAR(flux_below_horizon_lm(*file.solid), 100 * std::numbers::pi, 1e-9);
}

const char* const beam = "-10 0 10\n-20 0 20\n1 2 3\n4 5 6\n7 8 9\n";  // columns port, middle, starboard

TEST(Ies, InTypeABearingAndElevationAreTheAngles) {
    const PhotometryFile file = read(ies("3 3", 3, beam));
    EXPECT_NEAR(towards(file, 0, 0), 5, 1e-9);
    EXPECT_NEAR(towards(file, 20, 10), 9, 1e-6);
    EXPECT_NEAR(towards(file, 340, 0), 2, 1e-6);
    EXPECT_NEAR(towards(file, 10, 5), 7, 1e-9);  // half way between 5, 6, 8 and 9
    EXPECT_EQ(towards(file, 21, 0), 0);
    EXPECT_EQ(towards(file, 0, -11), 0);
    EXPECT_EQ(towards(file, 180, 0), 0);
    EXPECT_EQ(file.solid->reference_cd, 8);  // the largest at elevation 0
}

TEST(Ies, InTypeBThePlanesTurnAboutTheStarboardAxis) {
    const PhotometryFile file = read(ies("3 3", 2, beam));
    const auto at = [&](double horizontal_deg, double vertical_deg) {
        const double h = horizontal_deg * rad_per_deg;
        const double v = vertical_deg * rad_per_deg;
        return candela_towards(*file.solid,
                               {std::sin(h), std::cos(h) * std::cos(v), std::cos(h) * std::sin(v)});
    };
    EXPECT_NEAR(at(0, 0), 5, 1e-9);
    EXPECT_NEAR(at(19.999999, 9.999999), 9, 1e-5);
    EXPECT_NEAR(at(-10, -5), 3, 1e-9);
    EXPECT_NEAR(at(10, 5), 7, 1e-9);
    EXPECT_EQ(at(0, 11), 0);
    EXPECT_EQ(at(-21, 0), 0);
    EXPECT_EQ(towards(file, 180, 0), 0);
    EXPECT_EQ(file.solid->reference_cd, 8);
    // A direction at 20 to starboard and 10 up by Type A's angles lies at V = atan(tan 10 / cos 20) = 10.62 in Type B:
    // beyond the grid.
    EXPECT_EQ(towards(file, 20, 10), 0);
}

TEST(Ies, BeamsThatBeginAtZeroAreMirroredToPort) {
    for (const int type : {2, 3}) {
        const PhotometryFile file = read(ies("3 3", type, "-10 0 10\n0 10 20\n1 2 3\n4 5 6\n7 8 9\n"));
        EXPECT_NEAR(towards(file, 5, 0), 3.5, 1e-9) << type;
        EXPECT_NEAR(towards(file, 355, 0), 3.5, 1e-9) << type;
        EXPECT_NEAR(towards(file, 345, 0), 6.5, 1e-9) << type;
    }
}

// A Lambertian disc of I0 sends pi I0 lumens, whichever way it faces and whatever angles describe it.
TEST(Ies, ALambertianLampSendsPiTimesItsPeakInEveryType) {
    std::string angles_c, angles, down, type_a, type_b;
    for (int i = 0; i <= 180; ++i)
        angles_c += std::to_string(i) + " ";
    for (int i = -90; i <= 90; ++i)
        angles += std::to_string(i) + "\n";
    const auto cosine = [](int deg) { return std::cos(deg * rad_per_deg); };
    for (int i = 0; i <= 180; ++i)
        down += std::to_string(1000 * std::max(cosine(i), 0.0)) + "\n";
    for (int h = -90; h <= 90; ++h) {
        for (int v = -90; v <= 90; ++v)
            type_a += std::to_string(std::max(1000 * cosine(h) * cosine(v), 0.0)) + " ";
        type_a += "\n";
    }
    const double lumens = 1000 * std::numbers::pi;
    const PhotometryFile c = read(ies("181 1", 1, angles_c + "\n0\n" + down));
    EXPECT_NEAR(flux_lm(*c.solid) / lumens, 1, 1e-4);
    // Facing ahead its candela go with cos h cos v in Type A as in Type B.
    for (const int type : {2, 3}) {
        const PhotometryFile file = read(ies("181 181", type, angles + angles + type_a));
        EXPECT_NEAR(flux_lm(*file.solid) / lumens, 1, 1e-4) << type;
        EXPECT_NEAR(towards(file, 30, 0), 866.0254, 0.1) << type;
        EXPECT_NEAR(towards(file, 0, 60), 500, 0.1) << type;
        EXPECT_NEAR(towards(file, 300, 20), 1000 * cosine(300) * cosine(20), 0.2) << type;
    }
}

TEST(Ies, TheCandelaTakeTheirFactorsAsTheEditionHasThem) {
    const auto candela = [](const std::string& header) {
        return read(header + "TILT=NONE\n1 1000 2 2 1 1 2 0 0 0\n0.9 0.5 60\n0 180\n0\n100 100\n")
            .solid->reference_cd;
    };
    // Multiplier 2, ballast factor 0.9; the third was the ballast-lamp photometric factor until 1991.
    EXPECT_NEAR(candela("any text\nmore text\n"), 90, 1e-12);
    EXPECT_NEAR(candela(""), 90, 1e-12);
    EXPECT_NEAR(candela("IESNA91\n[TEST] 1\n"), 90, 1e-12);
    EXPECT_NEAR(candela("IESNA:LM-63-1991\n"), 90, 1e-12);
    EXPECT_NEAR(candela("IESNA:LM-63-1995\n"), 180, 1e-12);
    EXPECT_NEAR(candela("IESNA:LM-63-2002\n"), 180, 1e-12);
    EXPECT_NEAR(candela("IES:LM-63-2019\n"), 180, 1e-12);
}

TEST(Ies, TheFileGenerationTypeOf2019IsNoFactorAndNoDoubt) {
    const PhotometryFile file = read(
        "IES:LM-63-2019\r\n[TEST] 7\r\n[TESTLAB] A\r\n[ISSUEDATE] 2024\r\n[MANUFAC] B\r\nTILT=NONE\r\n"
        "1 -1 1 2 1 1 2 -0.2 -0.2 0.3\r\n1.0 1.11000 12\r\n0 180\r\n0\r\n40 40\r\n");
    EXPECT_EQ(file.solid->reference_cd, 40);
    EXPECT_EQ(file.lamp_flux_lm, 0);
    EXPECT_TRUE(file.warnings.empty());
    const PhotometryFile odd =
        read("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1.5 0\n0 180\n0\n40 40\n");
    ASSERT_EQ(odd.warnings.size(), 1U);
    EXPECT_EQ(odd.warnings[0].substr(0, 15), "lantern.ies:4: ");
}

TEST(Ies, ATiltTableIncludedGivesItsFactorForALanternThatStandsAsMeasured) {
    const std::string head = "IESNA:LM-63-1995\nTILT=INCLUDE\n1\n3\n-90 0 90\n0.5 0.8 0.6\n";
    const PhotometryFile file = read(head + "1 1000 1 2 1 1 2 0 0 0\n1 1 60\n0 180\n0\n50 50\n");
    EXPECT_NEAR(file.solid->reference_cd, 40, 1e-12);
    EXPECT_NE(error_of("TILT=lamp.tlt\n1 1000\n")
                  .find("lantern.ies:1:1: TILT names another file: write TILT=INCLUDE"),
              std::string::npos);
}

TEST(Ies, KeywordsContinueWithMore) {
    const PhotometryFile file = read(
        "IESNA:LM-63-1995\n[TEST] 12 A\n[MANUFAC] Fyrbelysning\n[LUMINAIRE] Sector lantern\n[MORE] 300 mm,\n"
        "[MORE] white\n[LUMCAT] SL300\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 0\n0 180\n0\n1 1\n");
    EXPECT_EQ(file.name, "Sector lantern 300 mm, white");
    ASSERT_EQ(file.keywords.size(), 4U);
    EXPECT_EQ(file.keywords[1], (std::pair<std::string, std::string>("MANUFAC", "Fyrbelysning")));
    EXPECT_EQ(file.keywords[3].second, "SL300");
}

TEST(Ies, NumbersMayStandInAnyLayout) {
    const std::string tidy = ies("2 2", 1, "0 180\n0 180\n1.5 2\n3 4\n");
    const PhotometryFile file = read(tidy);
    const std::string head = "IESNA:LM-63-2002\r[TEST] 1\r[MANUFAC] none\rTILT=NONE\r";
    for (const char* const text : {"1,-1,1,2,2,1,2,0,0,0,1,1,0,0,180,0,180,1.5,2,3,4",
                                   "1 -1 1 2\r2 1\r\r2 0 0 0 1 1 0 0 180 0 180 +1.5 2e0 3.0\r 4\r\x1A",
                                   "1\t-1 1 2 2 1 2\r0 0 0\r1 1 0 0\r180 0 180 1.5 , 2 , 3 4\r\r\r"}) {
        EXPECT_TRUE(*read(head + text).solid == *file.solid) << text;
    }
    std::string windows;
    for (const char c : tidy)
        windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    EXPECT_TRUE(*read(windows).solid == *file.solid);
    EXPECT_TRUE(*read("\xEF\xBB\xBF" + tidy).solid == *file.solid);
}

// By LM-63-2002 a negative size is a diameter; 1 foot is 0.3048 m.
TEST(Ies, TheOpeningGivesADiscAsLargeAsItIsSeen) {
    const auto radius_m = [](const std::string& opening) {
        return read("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 " + opening + "\n1 1 0\n0 180\n0\n1 1\n")
            .solid->radius_m;
    };
    EXPECT_FALSE(radius_m("2 0 0 0").has_value());           // a point
    EXPECT_NEAR(*radius_m("2 -0.3 -0.3 0"), 0.15, 1e-12);    // a disc from below
    EXPECT_NEAR(*radius_m("1 -1 -1 0"), 0.1524, 1e-12);      // in feet
    EXPECT_NEAR(*radius_m("2 -0.3 0 0"), 0.15, 1e-12);       // as 1995 wrote it
    EXPECT_NEAR(*radius_m("2 -0.2 -0.2 -0.2"), 0.1, 1e-12);  // a sphere
    EXPECT_NEAR(*radius_m("2 0.4 0.5 0"), std::sqrt(0.2 / std::numbers::pi),
                1e-12);  // a rectangle from below
    EXPECT_NEAR(*radius_m("2 -0.2 -0.2 0.3"), std::sqrt(0.06 / std::numbers::pi),
                1e-12);  // a drum from the side
}

TEST(Ies, TheReferenceIsThePeakInTheHorizontalPlane) {
    EXPECT_EQ(read(ies("3 2", 1, "0 90 180\n0 180\n500 20 0\n500 30 0\n")).solid->reference_cd, 30);
    // A lamp that shines down only: its peak, or else a faint rest at the horizon would be blown up without end.
    EXPECT_EQ(read(ies("3 1", 1, "0 90 180\n0\n500 2 0\n")).solid->reference_cd, 500);
}

TEST(Ies, MoreLightThanTheLampsHaveIsDoubted) {
    const PhotometryFile file =
        read("IESNA:LM-63-1995\nTILT=NONE\n2 500 1 2 1 1 2 0 0 0\n1 1 60\n0 180\n0\n100 100\n");
    EXPECT_EQ(file.lamp_flux_lm, 1000);
    ASSERT_EQ(file.warnings.size(), 1U);  // 1257 lm
    EXPECT_NE(file.warnings[0].find("1257 lm, more than the lamps' 1000 lm"), std::string::npos);
}

TEST(Ies, SolidsAreComparedByWhatTheyHold) {
    const std::string text = ies("2 1", 1, "0 180\n0\n1 1\n");
    const SharedSolid a = parse_ies(text, "a.ies").solid;
    const SharedSolid b = parse_ies(text, "b.ies").solid;
    const SharedSolid other = parse_ies(ies("2 1", 1, "0 180\n0\n1 2\n"), "a.ies").solid;
    EXPECT_TRUE(a == b);
    EXPECT_FALSE(a == other);
    EXPECT_FALSE(a == SharedSolid());
    EXPECT_TRUE(SharedSolid() == SharedSolid());
    EXPECT_EQ(b->file, "b.ies");
}

// Line 5 holds the ten numbers, line 6 three, line 7 begins the angles.
TEST(Ies, ErrorsNameLineAndColumn) {
    const auto begins = [](const std::string& text, const std::string& expected) {
        EXPECT_EQ(error_of(text).substr(0, expected.size()), expected);
    };
    begins(ies("2 1", 1, "0 180\n0\n5\n"),
           "lantern.ies:10:1: the file ends where candela value should stand");
    begins(ies("2 1", 1, "0 180\n0\n5 5\n7\n"),
           "lantern.ies:10:1: nothing should follow the candela values, but there is '7'");
    begins(ies("2 1", 1, "90 0\n0\n5 5\n"),
           "lantern.ies:7:4: vertical angle 0 does not lie above the one before it, 90");
    begins(ies("2 2", 1, "0 90\n0 0\n5 5 5 5\n"), "lantern.ies:8:3: horizontal angle 0 does not lie above");
    begins(ies("2 1", 1, "0 180\n0\n5 nan\n"),
           "lantern.ies:9:3: 'nan' is no number: candela value should stand here");
    begins(ies("2 1", 1, "0 180\n0\n5 inf\n"), "lantern.ies:9:3: 'inf' is no number");
    begins(ies("2 1", 1, "0 180\n0\n5 1e999\n"), "lantern.ies:9:3: '1e999' is no number");
    begins(ies("2 1", 1, "0 180\n0\n-5 5\n"), "lantern.ies:9:1: candela value is -5, not 0 to 1e+09");
    begins(ies("2 1", 1, "0 190\n0\n5 5\n"), "lantern.ies:7:3: vertical angle is 190, not 0 to 180");
    begins(ies("2 1", 3, "0 91\n0\n5 5\n"), "lantern.ies:7:3: vertical angle is 91, not -90 to 90");
    begins(ies("2.5 1", 1, ""), "lantern.ies:5:8: the number of vertical angles is 2.5, no whole number");
    begins(ies("1 1", 1, ""), "lantern.ies:5:8: the number of vertical angles is 1, not 2 to 1e+09");
    begins(ies("2 0", 1, ""), "lantern.ies:5:10: the number of horizontal angles is 0");
    begins(ies("2 1", 4, "0 180\n0\n5 5\n"),
           "lantern.ies:5:12: the photometric type is 1 (C), 2 (B) or 3 (A)");
    begins(ies("2 1", 2, "0 90\n0\n5 5\n"), "lantern.ies:8:1: a file of Type B needs two horizontal angles");
    begins(ies("2 2", 1, "0 90\n0 100\n5 5 5 5\n"),
           "lantern.ies:8:3: the horizontal angles run from 0 to 100: Type C has");
    begins(ies("2 1", 1, "0 180\n0\n0 0\n"), "lantern.ies:10:1: all candela are 0");
    begins(ies("2 1", 1, "0 180\n0\n5 x\x1B[2J\n"), "lantern.ies:9:3: 'x?[2J' is no number");
    begins("IESNA:LM-63-2002\n[TEST] 1\n",
           "lantern.ies:3:1: the file ends where a line TILT=NONE or TILT=INCLUDE should stand");
    begins("", "lantern.ies:1:1: the file ends");
}

TEST(Ies, ACountThatNoFileCouldHoldIsRefusedBeforeRoomIsMade) {
    for (const char* const sizes : {"1000000000 1", "2 1000000000", "1000000000 1000000000", "40000 40000"}) {
        const std::string error = error_of(ies(sizes, 1, "0 180\n0\n5 5\n"));
        EXPECT_NE(error.find("the file is too short for the"), std::string::npos) << error;
    }
    const std::string tilt = error_of("TILT=INCLUDE\n1\n999999999\n0\n1\n");
    EXPECT_NE(tilt.find("lantern.ies:3:1: the file is too short for the 999999999 tilt angles"),
              std::string::npos)
        << tilt;
}

TEST(Ies, WhatIsWrongAMillionTimesIsSaidAFewTimes) {
    std::string text = "IESNA:LM-63-1995\n";
    for (int i = 0; i < 100'000; ++i)
        text += "[\n";
    for (int i = 0; i < 5000; ++i)
        text += "[]\n";
    const PhotometryFile file = read(text + "TILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 0\n0 180\n0\n1 1\n");
    EXPECT_LE(file.warnings.size(), 20U);
    EXPECT_LE(file.keywords.size(), 1000U);
}

TEST(Ies, AFileIsReadFromItsPathAndAMissingOneIsASystemError) {
    const std::string path = testing::TempDir() + "seaglare_ies_test.IES";
    std::ofstream(path) << "1986 text\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 0\n0 180\n0\n3 3\n";
    const PhotometryFile file = load_photometry_file(path);
    EXPECT_EQ(file.solid->file, path);
    EXPECT_EQ(file.solid->reference_cd, 3);
    std::filesystem::remove(path);
    EXPECT_THROW(load_photometry_file(path), std::system_error);
    EXPECT_THROW(load_photometry_file(testing::TempDir()), std::system_error);
}

TEST(Ies, TextThatIsNeitherFormatSaysSo) {
    try {
        parse_photometry("hello\n", "x.txt");
        FAIL();
    } catch (const PhotometryFileError& error) {
        EXPECT_STREQ(error.what(),
                     "x.txt:1:1: neither an LM-63 file, which has a line TILT=, nor a EULUMDAT file");
        EXPECT_EQ(error.line(), 1U);
        EXPECT_EQ(error.column(), 1U);
    }
}

}  // namespace
}  // namespace seaglare::lightdb
