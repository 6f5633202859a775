// Sectors: from seaward or outward, across north, graded at their limits.
#include "lightdb/sector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace seaglare::lightdb {
namespace {

constexpr std::size_t white = static_cast<std::size_t>(Colour::white);
constexpr std::size_t red = static_cast<std::size_t>(Colour::red);
constexpr std::size_t green = static_cast<std::size_t>(Colour::green);

double total(const SectorFactors& factors) {
    return std::accumulate(factors.begin(), factors.end(), 0.0);
}

const std::vector<Sector> harbour = {
    {Colour::green, 292, 320}, {Colour::white, 320, 17.5}, {Colour::red, 17.5, 60}, {std::nullopt, 60, 292}};

TEST(Sector, TheLimitBelongsToTheSectorThatBeginsThere) {
    EXPECT_EQ(sector_factors(harbour, 292)[green], 1);
    EXPECT_EQ(total(sector_factors(harbour, 291.999)), 0);
    EXPECT_EQ(sector_factors(harbour, 319.999)[green], 1);
    EXPECT_EQ(sector_factors(harbour, 320)[white], 1);
    EXPECT_EQ(sector_factors(harbour, 17.5)[red], 1);
    EXPECT_EQ(sector_factors(harbour, 17.499)[white], 1);
}

TEST(Sector, ASectorMayWrapThroughNorth) {
    for (const double bearing_deg : {320.0, 359.999, 0.0, 360.0, 5.0, 720.0, -1.0}) {
        EXPECT_EQ(sector_factors(harbour, bearing_deg)[white], 1) << bearing_deg;
    }
    EXPECT_NEAR(sector_width_deg({Colour::white, 204, 95}), 251, 1e-12);  // "W. 204-095"
    EXPECT_NEAR(sector_width_deg({Colour::white, 95, 204}), 109, 1e-12);
    EXPECT_EQ(sector_width_deg({Colour::white, 0, 360}), 360);
    EXPECT_EQ(sector_width_deg({Colour::white, 30, 30}), 0);
}

TEST(Sector, OneColourAtATimeAllRound) {
    for (double bearing_deg = 0.01; bearing_deg < 360; bearing_deg += 0.1) {
        const double sum = total(sector_factors(harbour, bearing_deg));
        EXPECT_EQ(sum, bearing_deg < 60 || bearing_deg > 292 ? 1 : 0) << bearing_deg;
    }
}

TEST(Sector, NoSectorsShineAllRoundAndAWholeTurnTooButAGapIsDark) {
    for (const double bearing_deg : {0.0, 123.0, 359.9}) {
        EXPECT_EQ(sector_factors({}, bearing_deg)[white], 1);
        EXPECT_EQ(sector_factors({}, bearing_deg)[red], 1);
        const std::vector<Sector> turn = {{Colour::red, 0, 360, 1, 2}};
        EXPECT_EQ(sector_factors(turn, bearing_deg)[red], 1);
    }
    const std::vector<Sector> one = {{Colour::white, 10, 20}};
    EXPECT_EQ(total(sector_factors(one, 30)), 0);
}

TEST(Sector, WhereSectorsOverlapTheLaterHolds) {
    const std::vector<Sector> wide = {{Colour::white, 0, 360},
                                      {Colour::red, 100, 140},
                                      {std::nullopt, 120, 130},
                                      {Colour::white, 200, 250, 0.25}};
    EXPECT_EQ(sector_factors(wide, 90)[white], 1);
    EXPECT_EQ(sector_factors(wide, 110)[red], 1);
    EXPECT_EQ(sector_factors(wide, 110)[white], 0);
    EXPECT_EQ(total(sector_factors(wide, 125)), 0);
    EXPECT_EQ(sector_factors(wide, 225)[white], 0.25);  // unintensified
}

TEST(Sector, ALimitGradesEvenlyAndLosesNothing) {
    std::vector<Sector> graded = harbour;
    for (Sector& sector : graded)
        sector.transition_deg = 2;
    EXPECT_NEAR(sector_factors(graded, 320)[green], 0.5, 1e-12);
    EXPECT_NEAR(sector_factors(graded, 320)[white], 0.5, 1e-12);
    EXPECT_NEAR(sector_factors(graded, 319.5)[green], 0.75, 1e-12);
    EXPECT_EQ(sector_factors(graded, 318.9)[green], 1);
    EXPECT_EQ(sector_factors(graded, 321.1)[white], 1);
    EXPECT_NEAR(total(sector_factors(graded, 60)), 0.5, 1e-12);  // into the dark
    EXPECT_NEAR(total(sector_factors(graded, 60.999)), 0.0005, 1e-9);
    for (double bearing_deg = 300; bearing_deg < 415; bearing_deg += 0.01) {
        ASSERT_NEAR(total(sector_factors(graded, bearing_deg)), 1, 1e-12) << bearing_deg;
    }
}

TEST(Sector, NothingJumpsInAGradedLight) {
    std::vector<Sector> graded = harbour;
    for (Sector& sector : graded)
        sector.transition_deg = 1;
    SectorFactors before = sector_factors(graded, 0);
    for (double bearing_deg = 0; bearing_deg < 360; bearing_deg += 0.01) {
        const SectorFactors here = sector_factors(graded, bearing_deg);
        for (std::size_t c = 0; c < here.size(); ++c)
            ASSERT_LE(std::abs(here[c] - before[c]), 0.0101) << bearing_deg;
        before = here;
    }
}

TEST(Sector, ASectorNarrowerThanItsTransitionKeepsItsShare) {
    const std::vector<Sector> narrow = {
        {Colour::red, 0, 10, 1, 2}, {Colour::white, 10, 10.5, 1, 2}, {Colour::green, 10.5, 20, 1, 2}};
    const SectorFactors middle = sector_factors(narrow, 10.25);
    EXPECT_NEAR(middle[white], 0.25, 1e-12);
    EXPECT_NEAR(middle[red], 0.375, 1e-12);
    EXPECT_NEAR(middle[green], 0.375, 1e-12);
}

TEST(Sector, TheBearingFromSeawardIsWhatTheNavigatorReads) {
    EXPECT_NEAR(bearing_from_seaward_deg({0, 100, 0}, 0), 0, 1e-12);   // the light lies north
    EXPECT_NEAR(bearing_from_seaward_deg({100, 0, 0}, 0), 90, 1e-12);  // east
    EXPECT_NEAR(bearing_from_seaward_deg({0, -100, 0}, 0), 180, 1e-12);
    EXPECT_NEAR(bearing_from_seaward_deg({-100, 0, 0}, 0), 270, 1e-12);
    EXPECT_NEAR(bearing_from_seaward_deg({-1, 1, 50}, 0), 315, 1e-12);
    // True north 0.29 degrees west of the scene's: all bearings are 0.29 more.
    EXPECT_NEAR(bearing_from_seaward_deg({0, 100, 0}, -0.29), 0.29, 1e-12);
    EXPECT_NEAR(bearing_from_seaward_deg({0, 100, 0}, 0.29), 359.71, 1e-12);
}

TEST(Sector, TheBearingFromAheadRunsOverStarboard) {
    EXPECT_NEAR(bearing_from_ahead_deg({0, 100, 0}), 0, 1e-12);
    EXPECT_NEAR(bearing_from_ahead_deg({100, 0, 0}), 90, 1e-12);
    EXPECT_NEAR(bearing_from_ahead_deg({0, -100, 7}), 180, 1e-12);
    EXPECT_NEAR(bearing_from_ahead_deg({-100, 0, 0}), 270, 1e-12);
}

TEST(Sector, StraightOverheadTheBearingIsZero) {
    EXPECT_EQ(bearing_from_ahead_deg({0, 0, 30}), 0);
    EXPECT_EQ(bearing_from_seaward_deg({0, 0, 30}, 12), 0);
    EXPECT_EQ(bearing_from_seaward_deg({0, 0, 0}, 0), 0);
}

TEST(Sector, AnglesWrapIntoOneTurn) {
    EXPECT_EQ(wrapped_deg(360), 0);
    EXPECT_EQ(wrapped_deg(-90), 270);
    EXPECT_EQ(wrapped_deg(-1e-20), 0);
    EXPECT_EQ(wrapped_deg(725), 5);
    EXPECT_EQ(wrapped_deg(std::nan("")), 0);
    EXPECT_EQ(wrapped_deg(std::numeric_limits<double>::infinity()), 0);
}

}  // namespace
}  // namespace seaglare::lightdb
