// Turning beams: the mean over an exposure by exact integration, from every bearing, either way round.
#include "lightdb/rotation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "lightdb/profile.h"

namespace seaglare::lightdb {
namespace {

// A triangle of 2 degrees' width at the foot, so its integral is 1 degree.
RotatingBeam narrow(double period_s) {
    return {period_s, {{-1, 0, 1, 2, 358}, {0, 1, 0, 0, 0}}};
}
// Nothing symmetrical about it.
RotatingBeam crooked(double period_s) {
    return {period_s, {{10, 40, 41, 200, 300}, {0.2, 1, 0.1, 0.5, 0}}};
}

double circle_mean(const AngleTable& table) {
    double sum = 0;
    for (std::size_t i = 0; i < table.angle_deg.size(); ++i) {
        const bool last = i + 1 == table.angle_deg.size();
        const double next_deg = last ? table.angle_deg.front() + 360 : table.angle_deg[i + 1];
        const double next = last ? table.factor.front() : table.factor[i + 1];
        sum += (next_deg - table.angle_deg[i]) * (table.factor[i] + next) / 2;
    }
    return sum / 360;
}

TEST(RhythmRotation, TheZeroPointsAheadAtTime0AndThenGoesClockwise) {
    const RotatingBeam beam = narrow(12);
    EXPECT_EQ(mean_beam_factor(beam, 0, 0, 0), 1);
    EXPECT_EQ(mean_beam_factor(beam, 90, 0, 0), 0);
    EXPECT_NEAR(mean_beam_factor(beam, 90, 3, 0), 1, 1e-12);
    EXPECT_NEAR(mean_beam_factor(beam, 270, 9, 0), 1, 1e-12);
    EXPECT_NEAR(mean_beam_factor(narrow(-12), 270, 3, 0), 1, 1e-12) << "the other way";
    EXPECT_NEAR(mean_beam_factor(beam, -90, -3, 0), 1, 1e-12) << "before the clock's zero";
}

TEST(RhythmRotation, WhatDoesNotTurnIsTheTable) {
    EXPECT_EQ(mean_beam_factor({}, 123, 4, 0.02), 1);
    for (double bearing_deg = -400; bearing_deg < 400; bearing_deg += 7.3) {
        EXPECT_EQ(mean_beam_factor(crooked(0), bearing_deg, 5, 0.02),
                  periodic_factor(crooked(0).beam, bearing_deg));
        EXPECT_NEAR(mean_beam_factor(crooked(1e10), bearing_deg, 0, 0.02),
                    periodic_factor(crooked(0).beam, bearing_deg), 1e-9);
    }
}

TEST(RhythmRotation, WholeTurnsGiveTheMeanAroundTheCircleFromEverywhere) {
    for (const double period_s : {8.0, -8.0, 0.3}) {
        const RotatingBeam beam = crooked(period_s);
        const double mean = circle_mean(beam.beam);
        for (const int turns : {1, 2, 5}) {
            for (double bearing_deg = 0; bearing_deg < 360; bearing_deg += 31) {
                EXPECT_NEAR(mean_beam_factor(beam, bearing_deg, 3.21, turns * std::abs(period_s)), mean,
                            1e-12);
            }
        }
    }
}

TEST(RhythmRotation, AMeanIsTheSumOfSamples) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < 300; ++i) {
        const RotatingBeam beam = crooked((unit(random) - 0.5) * 20);
        const double bearing_deg = unit(random) * 720 - 360;
        const double end_s = unit(random) * 100;
        const double duration_s = unit(random) * (i % 2 == 0 ? 0.05 : 30);
        constexpr int samples = 20000;
        double sum = 0;
        for (int k = 0; k < samples; ++k)
            sum += mean_beam_factor(beam, bearing_deg, end_s - duration_s * (k + 0.5) / samples, 0);
        ASSERT_NEAR(mean_beam_factor(beam, bearing_deg, end_s, duration_s), sum / samples, 3e-3) << i;
    }
}

TEST(RhythmRotation, NoFrameRateLosesTheBeam) {
    const RotatingBeam beam = narrow(10);  // a flash of 1/36 s in all, of 1/72 s at half of the peak
    for (const double frames_per_s : {24.0, 59.94, 60.0, 37 * std::sqrt(2.0), 144.0, 240.0}) {
        const double dt_s = 1 / frames_per_s;
        double seen_s = 0;
        double t_s = 123.4;
        const auto frames = static_cast<int>(std::ceil(10 * frames_per_s));
        for (int i = 0; i < frames; ++i, t_s += dt_s)
            seen_s += mean_beam_factor(beam, 77, t_s, dt_s) * dt_s;
        // A whole turn, and perhaps a part of the next flash.
        EXPECT_GE(seen_s, 10.0 / 360 - 1e-9) << frames_per_s;
        EXPECT_LE(seen_s, 20.0 / 360 + 1e-9) << frames_per_s;
        EXPECT_NEAR(mean_beam_factor(beam, 77, t_s, frames * dt_s) * frames * dt_s, seen_s, 1e-9);
    }
}

TEST(RhythmRotation, AfterFourMonthsTheBeamPointsWhereItShould) {
    const RotatingBeam beam = narrow(10);
    // 1e7 s are a million turns; a microsecond turns it by 3.6e-5 degrees.
    EXPECT_NEAR(mean_beam_factor(beam, 0, 1e7, 0), 1, 1e-7);
    EXPECT_NEAR(mean_beam_factor(beam, 0, 1e7 + 1e-6, 0), 1 - 3.6e-5, 1e-7);
}

TEST(RhythmRotation, StepsInTheTableAndTablesOfOneSampleHold) {
    const RotatingBeam step{4, {{0, 90, 90, 360}, {1, 1, 0, 0}}};
    EXPECT_NEAR(mean_beam_factor(step, 45, 0, 4), 0.25, 1e-12);
    EXPECT_NEAR(mean_beam_factor({4, {{15}, {0.7}}}, 45, 0.3, 0.05), 0.7, 1e-12);
}

TEST(RhythmRotation, WhatIsNotFiniteCountsAsZero) {
    const double nan = std::nan("");
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {nan, infinity, -infinity}) {
        EXPECT_EQ(mean_beam_factor(narrow(10), bad, 0, 0), 1);
        EXPECT_EQ(mean_beam_factor(narrow(10), 0, bad, 0), 1);
        EXPECT_EQ(mean_beam_factor(narrow(10), 0, 0, bad), 1);
        EXPECT_EQ(mean_beam_factor(narrow(bad), 0, 0, 0), 1);
    }
}

}  // namespace
}  // namespace seaglare::lightdb
