// Tables of intensity against an angle.
#include "lightdb/profile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace seaglare::lightdb {
namespace {

// Sabik VP LED: half the peak at +-5 degrees of elevation, a tenth at +-10.
TEST(Profile, TheSabikLanternHasItsWidths) {
    const AngleTable sabik = *named_vertical_profile("sabik_vp");
    EXPECT_EQ(clamped_factor(sabik, 0), 1);
    EXPECT_EQ(clamped_factor(sabik, 5), 0.5);
    EXPECT_EQ(clamped_factor(sabik, -5), 0.5);
    EXPECT_NEAR(clamped_factor(sabik, 10), 0.1, 1e-15);
    EXPECT_NEAR(clamped_factor(sabik, 2.5), 0.75, 1e-15);
}

// COLREG 1972 Annex I section 10: (a) the required intensity from 5 degrees above to 5 below the horizontal, at least 60 %
// of it from 7.5 above to 7.5 below; (b) sailing vessels under way: at least 50 % from 25 above to 25 below.
TEST(Profile, TheColregProfilesAreTheRulesMinimum) {
    const AngleTable power = *named_vertical_profile("colreg_power");
    const AngleTable sail = *named_vertical_profile("colreg_sail");
    for (double elevation_deg = -30; elevation_deg <= 30; elevation_deg += 0.125) {
        const double away_deg = std::abs(elevation_deg);
        const double least_power = away_deg <= 5 ? 1 : away_deg <= 7.5 ? 0.6 : 0;
        const double least_sail = away_deg <= 5 ? 1 : away_deg <= 25 ? 0.5 : 0;
        EXPECT_GE(clamped_factor(power, elevation_deg), least_power - 1e-12) << elevation_deg;
        EXPECT_GE(clamped_factor(sail, elevation_deg), least_sail - 1e-12) << elevation_deg;
        EXPECT_LE(clamped_factor(power, elevation_deg), 1);
        EXPECT_LE(clamped_factor(sail, elevation_deg), 1);
    }
    // No better than the rule where it changes.
    EXPECT_NEAR(clamped_factor(power, -7.5), 0.6, 1e-15);
    EXPECT_NEAR(clamped_factor(power, 6.25), 0.8, 1e-15);
    EXPECT_NEAR(clamped_factor(sail, 25), 0.5, 1e-15);
    EXPECT_NEAR(clamped_factor(sail, -15), 0.75, 1e-15);
}

TEST(Profile, EveryNameHasAProfile) {
    for (const std::string_view name : vertical_profile_names()) {
        EXPECT_TRUE(named_vertical_profile(name).has_value()) << name;
    }
    EXPECT_FALSE(named_vertical_profile("sabik").has_value());
}

TEST(Profile, BeyondItsEndsATableKeepsItsEnds) {
    const AngleTable table = {{-10, 10}, {0.2, 0.8}};
    EXPECT_EQ(clamped_factor(table, -90), 0.2);
    EXPECT_EQ(clamped_factor(table, 90), 0.8);
    EXPECT_NEAR(clamped_factor(table, 0), 0.5, 1e-15);
}

TEST(Profile, ShortAndEmptyTablesAreConstant) {
    EXPECT_EQ(clamped_factor({}, 12), 1);
    EXPECT_EQ(periodic_factor({}, 12), 1);
    for (const double angle_deg : {-90.0, 3.0, 400.0}) {
        EXPECT_EQ(clamped_factor({{3}, {0.4}}, angle_deg), 0.4);
        EXPECT_EQ(periodic_factor({{3}, {0.4}}, angle_deg), 0.4);
        EXPECT_EQ(clamped_factor({{3, 4}, {0, 0}}, angle_deg), 0);
    }
    EXPECT_EQ(clamped_factor({{3}, {0.4}}, std::nan("")), 0);
    EXPECT_EQ(periodic_factor({{3}, {0.4}}, std::nan("")), 0);
}

TEST(Profile, APeriodicTableRunsOnThroughNorth) {
    const AngleTable table = {{10, 100, 350}, {1, 3, 5}};
    EXPECT_NEAR(periodic_factor(table, 0), 3, 1e-12);  // half way from 5 at 350 to 1 at 370
    EXPECT_NEAR(periodic_factor(table, 360), 3, 1e-12);
    EXPECT_NEAR(periodic_factor(table, 355), 4, 1e-12);
    EXPECT_NEAR(periodic_factor(table, 55), 2, 1e-12);
    EXPECT_NEAR(periodic_factor(table, 55 - 720), 2, 1e-12);
    EXPECT_NEAR(periodic_factor(table, 10), 1, 1e-12);
    EXPECT_NEAR(periodic_factor(table, 370), 1, 1e-12);
}

// The mean of a periodic table over the turn is that of its trapezia, wherever the turn begins.
TEST(Profile, APeriodicTableIsContinuousAndKeepsItsMean) {
    const AngleTable table = {{20, 100, 250, 340}, {2, 0, 4, 1}};
    // (2 + 0) 80 / 2 + (0 + 4) 150 / 2 + (4 + 1) 90 / 2 + (1 + 2) 40 / 2 = 665
    constexpr int steps = 36000;
    for (const double first_deg : {-500.0, 0.0, 123.4}) {
        double sum = 0;
        double before = periodic_factor(table, first_deg);
        for (int i = 1; i <= steps; ++i) {
            const double here = periodic_factor(table, first_deg + i * 360.0 / steps);
            EXPECT_LT(std::abs(here - before), 0.001);
            sum += (here + before) / 2;
            before = here;
        }
        EXPECT_NEAR(sum / steps, 665 / 360.0, 1e-5);
    }
}

}  // namespace
}  // namespace seaglare::lightdb
