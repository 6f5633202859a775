// Rhythms: exact over any exposure, at any time of a long run, with one phase for all who compute it.
#include "lightdb/rhythm.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace seaglare::lightdb {
namespace {

constexpr std::size_t white = static_cast<std::size_t>(Colour::white);
constexpr std::size_t red = static_cast<std::size_t>(Colour::red);

Rhythm make(std::vector<Phase> phases) {
    Rhythm rhythm;
    rhythm.phases = std::move(phases);
    for (const Phase& phase : rhythm.phases)
        rhythm.period_s += phase.duration_s;
    return rhythm;
}

double total(const LitFractions& lit) {
    return std::accumulate(lit.begin(), lit.end(), 0.0);
}

const Rhythm fl2 = make({{0.5, true}, {1.5, false}, {0.5, true}, {7.5, false}});
const Rhythm al_wr = make({{2, true, Colour::white}, {2, true, Colour::red}});

TEST(Rhythm, AWholeNumberOfPeriodsGivesExactlyTheDutyCycle) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> seconds(0.001, 9);
    for (int i = 0; i < 500; ++i) {
        std::vector<Phase> phases;
        double lit_s = 0;
        for (int k = 0; k < 1 + i % 7; ++k) {
            phases.push_back({seconds(random), k % 2 == 0});
            if (k % 2 == 0) lit_s += phases.back().duration_s;
        }
        const Rhythm rhythm = make(phases);
        const double duty = lit_s / rhythm.period_s;
        const double start_s = seconds(random) * 1e6;
        for (const int periods : {1, 2, 17}) {
            const double mean = total(mean_lit(rhythm, start_s, periods * rhythm.period_s));
            ASSERT_NEAR(mean, duty, 1e-12) << i;
        }
    }
}

TEST(Rhythm, NoFlashIsLostAtAnyFrameRate) {
    const Rhythm flash = make({{0.005, true}, {0.995, false}});
    for (const double frames_per_s : {20.0, 24.0, 30.0, 59.94, 60.0, 61.7, 144.0, 240.0}) {
        const double dt_s = 1 / frames_per_s;
        double lit_s = 0;
        double brightest = 0;
        for (double t_s = 1000.003; t_s < 1010.003 - dt_s / 2; t_s += dt_s) {
            const double fraction = exposed_lit(flash, t_s + dt_s, dt_s)[white];
            lit_s += fraction * dt_s;
            brightest = std::max(brightest, fraction);
        }
        EXPECT_NEAR(lit_s, 0.05, 0.0051)
            << frames_per_s;  // ten flashes, and perhaps a part of one at the end
        EXPECT_GE(brightest * dt_s, 0.0024) << frames_per_s;  // at worst split evenly between two frames
    }
}

TEST(Rhythm, NeighbouringExposuresAddUp) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> seconds(0, 40);
    for (int i = 0; i < 2000; ++i) {
        const double a = seconds(random);
        const double b = a + seconds(random);
        const double c = b + seconds(random);
        const double whole = mean_lit(fl2, c, c - a)[white] * (c - a);
        const double parts =
            mean_lit(fl2, b, b - a)[white] * (b - a) + mean_lit(fl2, c, c - b)[white] * (c - b);
        ASSERT_NEAR(whole, parts, 1e-12);
    }
}

TEST(Rhythm, AMeanIsTheSumOfSamples) {
    const double dt_s = 0.05;
    for (double t_s = -3; t_s < 14; t_s += 0.013) {
        double sum = 0;
        constexpr int samples = 2000;
        for (int i = 0; i < samples; ++i)
            sum += mean_lit(fl2, t_s - dt_s * (i + 0.5) / samples, 0)[white];
        ASSERT_NEAR(exposed_lit(fl2, t_s, dt_s)[white], sum / samples, 1.5 / samples) << t_s;
    }
}

TEST(Rhythm, AZeroExposureSamples) {
    EXPECT_EQ(exposed_lit(fl2, 0.25, 0)[white], 1);
    EXPECT_EQ(exposed_lit(fl2, 0.5, 0)[white], 0);  // a phase holds its beginning and not its end
    EXPECT_EQ(exposed_lit(fl2, 2.0, 0)[white], 1);
    EXPECT_EQ(exposed_lit(fl2, 10.25, -1)[white], 1);
    EXPECT_EQ(exposed_lit(fl2, -7.75, 0)[white], 1);  // before the clock's zero
}

TEST(Rhythm, AHitchIsNotAveragedOver) {
    EXPECT_EQ(exposed_lit(fl2, 0.4, 10)[white], exposed_lit(fl2, 0.4, longest_exposure_s)[white]);
    EXPECT_NEAR(exposed_lit(fl2, 0.4, 10)[white], 1, 1e-12);
    EXPECT_EQ(exposed_lit(fl2, 5, std::numeric_limits<double>::infinity())[white], 0);
}

TEST(Rhythm, AlternatingLightsShowEachColourInItsTurn) {
    EXPECT_NEAR(exposed_lit(al_wr, 1, 0.02)[white], 1, 1e-12);
    EXPECT_EQ(exposed_lit(al_wr, 1, 0.02)[red], 0);
    EXPECT_NEAR(exposed_lit(al_wr, 3, 0.02)[red], 1, 1e-12);
    const LitFractions change = exposed_lit(al_wr, 2.01, 0.02);
    EXPECT_NEAR(change[white], 0.5, 1e-12);
    EXPECT_NEAR(change[red], 0.5, 1e-12);
}

TEST(Rhythm, AFixedAndFlashingLightKeepsItsSteadyPart) {
    const Rhythm ffl = make({{0.5, true, Colour::white, 1}, {9.5, true, Colour::white, 0.1}});
    EXPECT_NEAR(mean_lit(ffl, 5, 0)[white], 0.1, 1e-15);
    EXPECT_NEAR(mean_lit(ffl, 5, 10)[white], (0.5 + 0.95) / 10, 1e-15);
}

TEST(Rhythm, AfterFourMonthsItIsStillExactToAMicrosecond) {
    // The flash begins at t = 1e7 s, a whole number of periods from 0.
    const double start_s = 1e7;
    EXPECT_NEAR(exposed_lit(fl2, start_s + 0.01, 0.02)[white] * 0.02, 0.01, 1e-8);
    EXPECT_EQ(mean_lit(fl2, start_s + 0.5 - 1e-6, 0)[white], 1);
    EXPECT_EQ(mean_lit(fl2, start_s + 0.5 + 1e-6, 0)[white], 0);
    EXPECT_EQ(mean_lit(fl2, start_s - 1e-6, 0)[white], 0);
    EXPECT_EQ(mean_lit(fl2, start_s + 1e-6, 0)[white], 1);
}

TEST(Rhythm, FixedLightsAndPeriodsOfZeroAreSteady) {
    EXPECT_EQ(exposed_lit({}, 5, 0.02)[white], 1);
    EXPECT_FALSE(has_colours({}));
    Rhythm still;
    still.phases = {{0, true, Colour::red}};
    EXPECT_EQ(exposed_lit(still, 5, 0.02)[red], 1);
    EXPECT_EQ(exposed_lit(make({{3, true, Colour::red}}), 5, 0.02)[red], 1);
    EXPECT_EQ(total(exposed_lit(make({{3, false}}), 5, 0.02)), 0);
    still.phases = {{0, false}};
    EXPECT_EQ(total(exposed_lit(still, 5, 0.02)), 0);
}

TEST(Rhythm, TimesThatAreNoneCountAsZero) {
    for (const double t_s : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        EXPECT_EQ(exposed_lit(fl2, t_s, 0)[white], 1);
        EXPECT_TRUE(std::isfinite(exposed_lit(fl2, t_s, t_s)[white]));
    }
}

TEST(Rhythm, FractionsStayBetweenNothingAndAll) {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> seconds(-1e7, 1e7);
    std::uniform_real_distribution<double> exposure(0, 0.06);
    for (int i = 0; i < 20000; ++i) {
        const double lit = total(exposed_lit(i % 2 == 0 ? fl2 : al_wr, seconds(random), exposure(random)));
        ASSERT_GE(lit, 0);
        ASSERT_LE(lit, 1 + 1e-12);
    }
}

TEST(Rhythm, PhaseIsAFunctionOfKeyGroupAndSeedAlone) {
    Rhythm alone = fl2;
    EXPECT_EQ(phase_offset_s(alone, 1, 2), phase_offset_s(alone, 1, 2));
    EXPECT_NE(phase_offset_s(alone, 1, 2), phase_offset_s(alone, 3, 2));
    EXPECT_NE(phase_offset_s(alone, 1, 2), phase_offset_s(alone, 1, 4));
    Rhythm front = fl2;
    front.sync_group = "leading line";
    Rhythm rear = al_wr;
    rear.sync_group = "leading line";
    EXPECT_EQ(phase_offset_s(front, 1, 2), phase_offset_s(rear, 3, 2));
    rear.sync_group = "another";
    EXPECT_NE(phase_offset_s(front, 1, 2), phase_offset_s(rear, 1, 2));
}

TEST(Rhythm, PhasesSpreadEvenlyOverThePeriod) {
    std::array<int, 10> count{};
    for (std::uint64_t key = 0; key < 10000; ++key) {
        const double offset_s = phase_offset_s(fl2, key, 0);
        ASSERT_GE(offset_s, 0);
        ++count[static_cast<std::size_t>(std::fmod(offset_s, 10))];
    }
    for (const int in_bin : count)
        EXPECT_NEAR(in_bin, 1000, 150);  // five standard deviations
}

// Test vectors of the FNV authors' draft.
TEST(Rhythm, FnvHasItsPublishedValues) {
    EXPECT_EQ(fnv1a(""), 0xCBF29CE484222325U);
    EXPECT_EQ(fnv1a("a"), 0xAF63DC4C8601EC8CU);
    EXPECT_EQ(fnv1a("foobar"), 0x85944171F73967E8U);
    EXPECT_EQ(fnv1a("bar", fnv1a("foo")), fnv1a("foobar"));
}

}  // namespace
}  // namespace seaglare::lightdb
