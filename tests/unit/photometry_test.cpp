// Photometry against the values of the nominal range's definition, the laws behind it, and the extremes.
#include "lightdb/photometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seaglare::lightdb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Row {
    double range_nm;
    double intensity_cd;
};

// Allard's law at 10 nm visibility and 2e-7 lx (IALA E-200-2).
TEST(Photometry, NominalRangesHaveTheirIntensities) {
    constexpr Row rows[] = {{1, 0.93},     {2, 4.99},    {3, 15.17},   {4, 36.4},    {5, 76.7},
                            {6, 149.0},    {7, 273.7},   {8, 482.3},   {10, 1372},   {15, 1.38e4},
                            {20, 1.098e5}, {25, 7.67e5}, {5.5, 107.8}, {6.5, 203.1}, {7.5, 364.9}};
    for (const Row& row : rows) {
        // 0.1 %, or one of the table's own last digit where that is more.
        const double last_digit = row.intensity_cd < 10 ? 0.01 : 0.1;
        const double tolerance_cd =
            std::max(last_digit, (row.intensity_cd > 1e4 ? 4e-3 : 1e-3) * row.intensity_cd);
        EXPECT_NEAR(intensity_for_range_cd(row.range_nm), row.intensity_cd, tolerance_cd) << row.range_nm;
    }
    EXPECT_NEAR(intensity_for_range_cd(1), 2e-7 * 1852 * 1852 * std::pow(20, 0.1), 1e-12);
}

// Night ranges of a lantern of R 120, G 180, W 250, Y 100 cd (Sabik VP LED).
TEST(Photometry, ALanternsIntensitiesHaveTheirRanges) {
    EXPECT_NEAR(range_for_intensity_nm(120), 5.66, 0.005);
    EXPECT_NEAR(range_for_intensity_nm(180), 6.30, 0.005);
    EXPECT_NEAR(range_for_intensity_nm(250), 6.85, 0.005);
    EXPECT_NEAR(range_for_intensity_nm(100), 5.39, 0.005);
}

TEST(Photometry, RangeAndIntensityAreInverse) {
    for (double intensity_cd = 1e-3; intensity_cd < 2e8; intensity_cd *= 1.7) {
        for (const double threshold_lx : {night_threshold_lx, day_threshold_lx}) {
            for (const double visibility_nm : {1.0, 10.0, 27.0}) {
                const double range_nm = range_for_intensity_nm(intensity_cd, threshold_lx, visibility_nm);
                EXPECT_NEAR(intensity_for_range_cd(range_nm, threshold_lx, visibility_nm) / intensity_cd, 1,
                            1e-12);
            }
        }
    }
}

// COLREG 1972 Annex I section 8 prints 0.9, 4.3, 12, 27, 52, 94 cd.
TEST(Photometry, ColregIntensitiesAreThoseOfTheRule) {
    constexpr Row rows[] = {{1, 0.86}, {2, 4.3}, {3, 12}, {4, 27}, {5, 52}, {6, 94}};
    for (const Row& row : rows)
        EXPECT_NEAR(colreg_intensity_cd(row.range_nm) / row.intensity_cd, 1, 0.02);
    EXPECT_NEAR(colreg_intensity_cd(1), 0.8575, 1e-9);
    EXPECT_EQ(colreg_intensity_cd(0), 0);
}

TEST(Photometry, ExtinctionLeavesFivePerCentAtTheVisibility) {
    EXPECT_NEAR(extinction_per_m(10 * metres_per_nautical_mile), 1.6176e-4, 1e-8);
    EXPECT_NEAR(transmission(extinction_per_m(5000), 5000), 0.05, 1e-15);
    EXPECT_EQ(extinction_per_m(infinity), 0);
    EXPECT_EQ(extinction_per_m(0), infinity);
    EXPECT_EQ(extinction_per_m(nan), infinity);
}

TEST(Photometry, IlluminanceFollowsTheInverseSquare) {
    for (double distance_m = 1; distance_m < 1e7; distance_m *= 3) {
        EXPECT_NEAR(illuminance_lx(500, distance_m, 0.05, 0) * distance_m * distance_m, 500, 1e-9);
    }
    EXPECT_NEAR(illuminance_lx(1e4, 1000, 0.05, 0), 1e-2, 1e-15);
    EXPECT_NEAR(illuminance_lx(0.01, 60e3, 0.05, 0), 2.8e-12, 0.05e-12);  // the faintest light that counts
}

TEST(Photometry, InsideALampItIsTheIlluminanceOfItsSurface) {
    EXPECT_EQ(illuminance_lx(100, 0, 0.5, 0), 400);
    EXPECT_EQ(illuminance_lx(100, 0.3, 0.5, 0), 400);
    EXPECT_EQ(illuminance_lx(100, 0.5, 0.5, 0), 400);
    EXPECT_LT(illuminance_lx(100, 0.51, 0.5, 0), 400);
    EXPECT_EQ(illuminance_lx(1e8, 0, 0, 0), 1e14);  // no radius: a millimetre
    EXPECT_NEAR(illuminance_lx(1e8, 0, 0.1, infinity), 1e10, 1);
}

TEST(Photometry, FogEndsInExactZeroAndNeverInNaN) {
    EXPECT_EQ(transmission(970 / 60e3, 60e3), 0);
    EXPECT_EQ(illuminance_lx(1e8, 60e3, 0.1, 970 / 60e3), 0);
    EXPECT_EQ(transmission(infinity, 0), 1);
    EXPECT_EQ(transmission(0, infinity), 1);
    EXPECT_EQ(illuminance_lx(1e8, infinity, 0.1, 0), 0);
    EXPECT_EQ(illuminance_lx(1e8, nan, 0.1, 0), 0);
    EXPECT_EQ(illuminance_lx(nan, 1, 0.1, 0), 0);
    EXPECT_EQ(illuminance_lx(-5, 1, 0.1, 0), 0);
    EXPECT_EQ(illuminance_lx(0, 0, 0, infinity), 0);
    EXPECT_EQ(illuminance_lx(100, 10, 0.1, infinity), 0);
}

TEST(Photometry, RangesThatAreNoneGiveNoLight) {
    for (const double range_nm : {0.0, -1.0, nan})
        EXPECT_EQ(intensity_for_range_cd(range_nm), 0);
    for (const double intensity_cd : {0.0, -1.0, nan})
        EXPECT_EQ(range_for_intensity_nm(intensity_cd), 0);
    EXPECT_TRUE(std::isfinite(range_for_intensity_nm(std::numeric_limits<double>::max())));
    EXPECT_GT(range_for_intensity_nm(std::numeric_limits<double>::denorm_min()), 0);
}

// 2.08 (sqrt 25 + sqrt 9) nm: the Admiralty's formula.
TEST(Photometry, TheGeographicalRangeHasItsFormula) {
    EXPECT_NEAR(geographical_range_nm(25, 9), 2.08 * 8, 1e-12);
    EXPECT_NEAR(geographical_range_nm(25, -3), 2.08 * 5, 1e-12);
    EXPECT_EQ(geographical_range_nm(-1, 0), 0);
}

// The table of nominal ranges read the other way: the range to 0.1 %, or to half of a last digit of the intensity.
TEST(Photometry, IntensitiesHaveTheirNominalRanges) {
    constexpr Row rows[] = {{3, 15.17},   {4, 36.4},    {5, 76.7},    {6, 149.0},    {7, 273.7},
                            {8, 482.3},   {10, 1372},   {15, 1.38e4}, {20, 1.098e5}, {25, 7.67e5},
                            {5.5, 107.8}, {6.5, 203.1}, {7.5, 364.9}};
    for (const Row& row : rows)
        EXPECT_NEAR(range_for_intensity_nm(row.intensity_cd) / row.range_nm, 1, 1e-3) << row.range_nm;
}

// A light 16 m up, 20 nm off, rises for an eye that climbs past (20 / 2.08 - 4)^2 = 31.5 m, within a few metres of its own.
TEST(Photometry, ALightDipsAsTheEyeSinks) {
    const double distance_m = 20 * metres_per_nautical_mile;
    const double root = 20 / 2.08 - 4;
    EXPECT_NEAR(root * root, 31.53, 0.01);
    EXPECT_NEAR(geographical_range_nm(16, root * root), 20, 0.02);
    EXPECT_NEAR(fraction_above_horizon(distance_m, 16, 0.05, root * root), 0.5, 1e-6);
    EXPECT_EQ(fraction_above_horizon(distance_m, 16, 0.05, root * root + 0.2), 1);
    EXPECT_EQ(fraction_above_horizon(distance_m, 16, 0.05, root * root - 0.2), 0);
}

TEST(Photometry, ALampSinksIntoTheSeaOverItsOwnDisc) {
    const double range_m = geographical_range_nm(25, 9) * metres_per_nautical_mile;
    EXPECT_NEAR(fraction_above_horizon(range_m, 25, 0.5, 9), 0.5, 1e-9);
    EXPECT_EQ(fraction_above_horizon(0.98 * range_m, 25, 0.5, 9), 1);
    EXPECT_EQ(fraction_above_horizon(1.02 * range_m, 25, 0.5, 9), 0);
    double before = 1;
    for (double x = 0.98; x < 1.02; x += 1e-5) {
        const double fraction = fraction_above_horizon(x * range_m, 25, 0.5, 9);
        EXPECT_LE(fraction, before);
        EXPECT_LT(before - fraction, 0.01) << "it pops";
        before = fraction;
    }
    EXPECT_EQ(fraction_above_horizon(100, 2, 0.05, 9), 1);     // nearer than the eye's horizon
    EXPECT_EQ(fraction_above_horizon(5000, -4, 0.05, -1), 0);  // both below the water count as on it
    EXPECT_EQ(fraction_above_horizon(0, 0, 0, 0), 1);
}

// Blondel and Rey: a rectangle of 0.1, 0.2, 0.5, 1 s gives 0.333, 0.5, 0.714, 0.833 of its intensity.
TEST(Photometry, EffectiveIntensityOfAFlash) {
    EXPECT_NEAR(effective_intensity_cd(1, 0.1), 0.3333, 1e-4);
    EXPECT_NEAR(effective_intensity_cd(1, 0.2), 0.5, 1e-15);
    EXPECT_NEAR(effective_intensity_cd(1, 0.5), 0.7143, 1e-4);
    EXPECT_NEAR(effective_intensity_cd(1, 1), 0.8333, 1e-4);
    EXPECT_EQ(effective_intensity_cd(1, 0), 0);
    EXPECT_EQ(effective_intensity_cd(7, infinity), 7);
}

}  // namespace
}  // namespace seaglare::lightdb
