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

// A narrow white sector between a red one and a green one whose edge grades five times as wide: by hand, with the ramp
// 0.5 - (limit - bearing) / width behind each limit.
TEST(Sector, TransitionsOfDifferentWidthsMeetInANarrowSector) {
    const std::vector<Sector> sectors = {
        {Colour::red, 0, 10, 1, 2}, {Colour::white, 10, 10.5, 1, 2}, {Colour::green, 10.5, 60, 1, 10}};
    // Behind the red limit 0.5 + 0.5 / 2, behind the green one 0.5.
    const SectorFactors middle = sector_factors(sectors, 10.5);
    EXPECT_NEAR(middle[red], 0.25, 1e-12);
    EXPECT_NEAR(middle[white], 0.25, 1e-12);
    EXPECT_NEAR(middle[green], 0.5, 1e-12);
    // Green alone would show 0.5 - 3.5 / 10 here, but the red limit before it has not begun to pass.
    EXPECT_EQ(sector_factors(sectors, 7)[red], 1);
    // Behind both: red 0, white and green by the green limit, 0.5 + 2 / 10.
    const SectorFactors behind = sector_factors(sectors, 12.5);
    EXPECT_NEAR(behind[white], 0.3, 1e-12);
    EXPECT_NEAR(behind[green], 0.7, 1e-12);
}

TEST(Sector, TransitionsOfAnyWidthsLoseAndWinNothingAndNeverJump) {
    const std::vector<Sector> sectors = {{Colour::red, 350, 10, 1, 3},     {Colour::white, 10, 10.5, 1, 0.5},
                                         {Colour::green, 10.5, 13, 1, 20}, {Colour::red, 13, 14, 1, 7},
                                         {Colour::white, 14, 180, 1, 40},  {Colour::green, 180, 350, 1, 1},
                                         {Colour::white, 352, 8, 1, 2},    {Colour::red, 170, 200, 1, 60}};
    constexpr double step_deg = 0.01;
    SectorFactors before = sector_factors(sectors, -step_deg);
    for (double bearing_deg = 0; bearing_deg < 360; bearing_deg += step_deg) {
        const SectorFactors here = sector_factors(sectors, bearing_deg);
        EXPECT_NEAR(total(here), 1, 1e-12) << bearing_deg;
        for (const std::size_t colour : {white, red, green}) {
            EXPECT_GE(here[colour], 0) << bearing_deg;
            // No steeper than the steepest ramps together: 1 / 0.5 and 1 / 1 per degree and a rest.
            EXPECT_LT(std::abs(here[colour] - before[colour]), 4 * step_deg) << bearing_deg;
        }
        before = here;
    }
}

TEST(Sector, TransitionsTreatLeftAndRightAlike) {
    const std::vector<Sector> sectors = {{Colour::red, 0, 10, 1, 3},
                                         {Colour::white, 10, 11, 1, 0.5},
                                         {Colour::green, 11, 13, 1, 9},
                                         {Colour::red, 13, 13.5, 1, 1},
                                         {Colour::white, 13.5, 60, 1, 30}};
    std::vector<Sector> mirrored = sectors;
    for (Sector& sector : mirrored) {
        sector.from_deg = -sector.to_deg;
        sector.to_deg = -sectors[static_cast<std::size_t>(&sector - mirrored.data())].from_deg;
    }
    for (double bearing_deg = -40.003; bearing_deg < 100; bearing_deg += 0.05) {
        const SectorFactors here = sector_factors(sectors, bearing_deg);
        const SectorFactors there = sector_factors(mirrored, -bearing_deg);
        for (const std::size_t colour : {white, red, green})
            EXPECT_NEAR(here[colour], there[colour], 1e-9) << bearing_deg;
    }
}

TEST(Sector, ASharpLimitLetsNothingAcrossWhateverGradesBesideIt) {
    const std::vector<Sector> sectors = {
        {Colour::red, 0, 10}, {Colour::white, 10, 12}, {Colour::green, 12, 60, 1, 8}};
    EXPECT_EQ(sector_factors(sectors, 9.999)[red], 1);
    const SectorFactors behind = sector_factors(sectors, 10);
    EXPECT_NEAR(behind[green], 0.25, 1e-12);  // 0.5 - 2 / 8
    EXPECT_NEAR(behind[white], 0.75, 1e-12);
    // Mirrored, the same.
    const std::vector<Sector> mirrored = {
        {Colour::red, 350, 0}, {Colour::white, 348, 350}, {Colour::green, 300, 348, 1, 8}};
    EXPECT_EQ(sector_factors(mirrored, 350)[red], 1);
    EXPECT_NEAR(total(sector_factors(mirrored, 350)), 1, 1e-12);
    EXPECT_NEAR(sector_factors(mirrored, 349.999999)[green], 0.25, 1e-6);
}

// A PEL sector light changes within a minute of arc or a few; a lighthouse's filter grades over degrees.
TEST(Sector, AnEdgeIsAsSharpAsItsTransition) {
    for (const double transition_deg : {1.0 / 60, 0.25, 3.0}) {
        const std::vector<Sector> sectors = {{Colour::green, 90, 100, 1, transition_deg},
                                             {Colour::white, 100, 101, 1, transition_deg}};
        EXPECT_EQ(sector_factors(sectors, 100 - transition_deg / 2)[green], 1);
        EXPECT_NEAR(sector_factors(sectors, 100 - transition_deg / 4)[white], 0.25, 1e-9);
        EXPECT_NEAR(sector_factors(sectors, 100)[green], 0.5, 1e-9);
        if (transition_deg < 1) {
            EXPECT_NEAR(sector_factors(sectors, 100 + transition_deg / 2)[white], 1, 1e-9);
        }
    }
}

TEST(Sector, ALimitThatNobodySeesGradesNothing) {
    // White ends at 180 under a red sector laid over it, whose own limits are sharp.
    const std::vector<Sector> sectors = {{Colour::white, 0, 195, 1, 20}, {Colour::red, 150, 200}};
    EXPECT_EQ(sector_factors(sectors, 199.9)[red], 1);
    EXPECT_EQ(total(sector_factors(sectors, 200.1)), 0);
    // Two neighbours of one look.
    const std::vector<Sector> alike = {{Colour::white, 0, 90, 1, 4}, {Colour::white, 90, 180, 1, 4}};
    for (const double bearing_deg : {88.5, 89.9, 90.0, 91.3})
        EXPECT_EQ(sector_factors(alike, bearing_deg)[white], 1);
}

TEST(Sector, TheUnintensifiedArcIsGradedInBrightness) {
    const std::vector<Sector> sectors = {{Colour::white, 0, 360}, {Colour::white, 200, 250, 0.2, 4}};
    EXPECT_NEAR(sector_factors(sectors, 200)[white], 0.6, 1e-12);
    EXPECT_NEAR(sector_factors(sectors, 249)[white], 0.75 * 0.2 + 0.25, 1e-12);
    EXPECT_NEAR(sector_factors(sectors, 251)[white], 0.75 + 0.25 * 0.2, 1e-12);
    EXPECT_EQ(sector_factors(sectors, 225)[white], 0.2);
}

// A glide slope of light for a drawbridge or an airfield: red below, white on it, green above.
TEST(Sector, VerticalSectorsChangeWithElevation) {
    std::vector<Sector> sectors = {
        {Colour::red, 80, 100}, {Colour::white, 80, 100}, {Colour::green, 80, 100}};
    sectors[0].to_elevation_deg = 2;
    sectors[1].from_elevation_deg = 2;
    sectors[1].to_elevation_deg = 4;
    sectors[2].from_elevation_deg = 4;
    EXPECT_EQ(sector_factors(sectors, 90, -90)[red], 1);
    EXPECT_EQ(sector_factors(sectors, 90, 1.999)[red], 1);
    EXPECT_EQ(sector_factors(sectors, 90, 2)[white], 1);
    EXPECT_EQ(sector_factors(sectors, 90, 4)[green], 1);
    EXPECT_EQ(sector_factors(sectors, 90, 90)[green], 1);  // the zenith is inside
    EXPECT_EQ(total(sector_factors(sectors, 79.9, 3)), 0);
    for (Sector& sector : sectors)
        sector.transition_deg = 1;
    EXPECT_NEAR(sector_factors(sectors, 90, 2)[red], 0.5, 1e-12);
    EXPECT_NEAR(sector_factors(sectors, 90, 2.25)[white], 0.75, 1e-12);
    EXPECT_NEAR(sector_factors(sectors, 90, 2.25)[red], 0.25, 1e-12);
    EXPECT_EQ(sector_factors(sectors, 90, 2.5)[white], 1);
    // At the corner of both kinds of limit: half of what the elevation shows.
    EXPECT_NEAR(sector_factors(sectors, 80, 2.25)[white], 0.375, 1e-12);
    EXPECT_NEAR(sector_factors(sectors, 80, 2.25)[red], 0.125, 1e-12);
}

TEST(Sector, AnObscuredVerticalSectorMayBeLaidOverAWideOne) {
    std::vector<Sector> sectors = {{Colour::white, 0, 360}, {std::nullopt, 0, 360, 1, 2}};
    sectors[1].from_elevation_deg = 20;
    EXPECT_EQ(sector_factors(sectors, 123, 18.9)[white], 1);
    EXPECT_NEAR(sector_factors(sectors, 123, 20.5)[white], 0.25, 1e-12);
    EXPECT_EQ(total(sector_factors(sectors, 123, 45)), 0);
    sectors[1].to_elevation_deg = 10;  // upside down: it holds nowhere
    EXPECT_EQ(sector_factors(sectors, 123, 45)[white], 1);
}

TEST(Sector, MoreLimitsThanCanBeGradedStillGiveNoMoreLightThanThereIs) {
    std::vector<Sector> sectors;
    for (int i = 0; i < 1000; ++i) {
        sectors.push_back({i % 2 == 0 ? Colour::red : Colour::green, 0.1 * i, 0.1 * (i + 1), 1, 60});
    }
    for (const double bearing_deg : {40.0, 50.0, 60.0})
        EXPECT_NEAR(total(sector_factors(sectors, bearing_deg)), 1, 1e-9);
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
