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

// COLREG 1972 Annex I section 10.
TEST(Profile, TheColregProfilesAreTheRulesMinimum) {
    const AngleTable power = *named_vertical_profile("colreg_power");
    EXPECT_EQ(clamped_factor(power, 5), 1);
    EXPECT_NEAR(clamped_factor(power, -7.5), 0.6, 1e-15);
    const AngleTable sail = *named_vertical_profile("colreg_sail");
    EXPECT_NEAR(clamped_factor(sail, 25), 0.5, 1e-15);
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

}  // namespace
}  // namespace seaglare::lightdb
