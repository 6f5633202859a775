// Lamps that warm up and cool down: the state that repeats every period, in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "lightdb/lamp_glow.h"

namespace seaglare::lightdb {
namespace {

constexpr std::size_t white = static_cast<std::size_t>(Colour::white);
constexpr std::size_t red = static_cast<std::size_t>(Colour::red);

Rhythm make(std::vector<Phase> phases, double rise_s, double fall_s) {
    Rhythm rhythm;
    rhythm.phases = std::move(phases);
    for (const Phase& phase : rhythm.phases)
        rhythm.period_s += phase.duration_s;
    rhythm.rise_s = rise_s;
    rhythm.fall_s = fall_s;
    return rhythm;
}

double total(const LitFractions& lit) {
    return std::accumulate(lit.begin(), lit.end(), 0.0);
}

TEST(RhythmLamp, NinetyPerCentIsReachedAfterTheRiseAndLostAfterTheFall) {
    const Rhythm lamp = make({{20, true}, {20, false}}, 0.6, 0.3);
    EXPECT_NEAR(mean_lit(lamp, 0.6, 0)[white], 0.9, 1e-9);
    EXPECT_NEAR(mean_lit(lamp, 1.2, 0)[white], 0.99, 1e-9);
    EXPECT_NEAR(mean_lit(lamp, 20.3, 0)[white], 0.1, 1e-9);
    EXPECT_NEAR(mean_lit(lamp, 20.6, 0)[white], 0.01, 1e-9);
}

// On for a, off for b, from one y0 to the next: y1 = 1 - (1 - y0) e^-a/r, y0 = y1 e^-b/f.
TEST(RhythmLamp, AFlashRepeatsItsClosedForm) {
    const double rise_s = 0.8;
    const double fall_s = 0.5;
    const double r = rise_s / std::numbers::ln10;
    const double f = fall_s / std::numbers::ln10;
    const double a = 0.5;
    const double b = 1.0;
    const Rhythm lamp = make({{a, true}, {b, false}}, rise_s, fall_s);
    const double start = (1 - std::exp(-a / r)) * std::exp(-b / f) / (1 - std::exp(-a / r - b / f));
    const double top = 1 - (1 - start) * std::exp(-a / r);
    EXPECT_NEAR(mean_lit(lamp, 0, 0)[white], start, 1e-14);
    EXPECT_NEAR(mean_lit(lamp, a, 0)[white], top, 1e-14);
    const double integral_s = a - (1 - start) * r * (1 - std::exp(-a / r)) + top * f * (1 - std::exp(-b / f));
    EXPECT_NEAR(mean_lit(lamp, 7.7, a + b)[white], integral_s / (a + b), 1e-13);
    EXPECT_NEAR(mean_lit(lamp, 123.4, 7 * (a + b))[white], integral_s / (a + b), 1e-13);
}

// A linear filter keeps the mean: with one time constant the duty cycle stands, however slow the lamp.
TEST(RhythmLamp, EqualRiseAndFallKeepTheDutyCycle) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> seconds(0.05, 4);
    for (int i = 0; i < 400; ++i) {
        std::vector<Phase> phases;
        double lit_s = 0;
        for (int k = 0; k < 2 + i % 6; ++k) {
            const double level = i % 3 == 0 ? 0.1 + 0.2 * (k % 4) : 1;
            phases.push_back({seconds(random), k % 2 == 0 || i % 3 == 0, Colour::white, level});
            if (phases.back().lit) lit_s += phases.back().duration_s * level;
        }
        const double slowness_s = std::pow(10, seconds(random) - 2);
        const Rhythm lamp = make(phases, slowness_s, slowness_s);
        ASSERT_NEAR(total(mean_lit(lamp, seconds(random), lamp.period_s)), lit_s / lamp.period_s, 1e-12) << i;
    }
}

// Against the differential equation, from cold, in small exact steps until it repeats.
TEST(RhythmLamp, TheRepeatingStateIsWhereTheLampSettles) {
    std::mt19937_64 random(12);
    std::uniform_real_distribution<double> seconds(0.1, 2);
    for (int i = 0; i < 60; ++i) {
        std::vector<Phase> phases;
        for (int k = 0; k < 2 + i % 5; ++k)
            phases.push_back({seconds(random), true, Colour::white, seconds(random) / 2});
        const Rhythm lamp = make(phases, seconds(random) * 3, seconds(random) * 3);
        double glow = 0;
        for (int turn = 0; turn < 400; ++turn) {
            for (const Phase& phase : phases) {
                const double constant_s =
                    (glow < phase.level ? lamp.rise_s : lamp.fall_s) / std::numbers::ln10;
                glow = phase.level + (glow - phase.level) * std::exp(-phase.duration_s / constant_s);
            }
        }
        ASSERT_NEAR(mean_lit(lamp, 0, 0)[white], glow, 1e-12) << i;
    }
}

TEST(RhythmLamp, AMeanIsTheSumOfSamplesAndExposuresAddUp) {
    const Rhythm lamp = make({{0.3, true}, {0.7, false}, {0.3, true}, {1.7, false}}, 0.25, 0.4);
    std::mt19937_64 random(13);
    std::uniform_real_distribution<double> seconds(0, 8);
    for (int i = 0; i < 200; ++i) {
        const double a = seconds(random);
        const double b = a + seconds(random);
        const double c = b + seconds(random) / 100;
        const double parts =
            mean_lit(lamp, b, b - a)[white] * (b - a) + mean_lit(lamp, c, c - b)[white] * (c - b);
        ASSERT_NEAR(mean_lit(lamp, c, c - a)[white] * (c - a), parts, 1e-12);
        double sum = 0;
        constexpr int samples = 500;
        for (int k = 0; k < samples; ++k)
            sum += mean_lit(lamp, c - (c - b) * (k + 0.5) / samples, 0)[white];
        ASSERT_NEAR(mean_lit(lamp, c, c - b)[white], sum / samples, 1e-6);
    }
}

TEST(RhythmLamp, AFastLampIsASharpOne) {
    const std::vector<Phase> phases{{0.5, true}, {1.5, false}, {0.5, true, Colour::red}, {2.5, false}};
    const Rhythm sharp = make(phases, 0, 0);
    for (const auto& [rise_s, fall_s] : {std::pair{1e-9, 1e-9}, {1e-9, 0.0}, {0.0, 1e-9}}) {
        const Rhythm fast = make(phases, rise_s, fall_s);
        for (double t_s = 0.01; t_s < 10; t_s += 0.037) {
            const LitFractions a = exposed_lit(sharp, t_s, 0.02);
            const LitFractions b = exposed_lit(fast, t_s, 0.02);
            ASSERT_NEAR(a[white], b[white], 1e-6) << t_s;
            ASSERT_NEAR(a[red], b[red], 1e-6) << t_s;
        }
    }
}

TEST(RhythmLamp, EachColourOfAnAlternatingLightHasItsOwnLamp) {
    const Rhythm lamps = make({{10, true, Colour::white}, {10, true, Colour::red}}, 0.4, 0.4);
    const LitFractions change = mean_lit(lamps, 10.4, 0);
    EXPECT_NEAR(change[white], 0.1, 1e-9) << "the white one cools";
    EXPECT_NEAR(change[red], 0.9, 1e-9) << "while the red one heats";
}

TEST(RhythmLamp, TheGlowStaysBetweenNothingAndAll) {
    std::mt19937_64 random(14);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < 20000; ++i) {
        std::vector<Phase> phases;
        for (int k = 0; k < 1 + i % 5; ++k)
            phases.push_back({unit(random) * 3 + 1e-3, unit(random) < 0.5, Colour::white, unit(random)});
        const Rhythm lamp =
            make(phases, std::pow(10, unit(random) * 12 - 6), std::pow(10, unit(random) * 12 - 6));
        const double glow = exposed_lit(lamp, (unit(random) - 0.5) * 2e7, unit(random) * 0.06)[white];
        ASSERT_GE(glow, 0);
        ASSERT_LE(glow, 1);
    }
}

TEST(RhythmLamp, ExtremesOfSlownessStayFinite) {
    for (const double rise_s : {0.0, 1e-300, 1e300}) {
        for (const double fall_s : {0.0, 1e-300, 1e300}) {
            const Rhythm lamp = make({{1, true}, {2, false}}, rise_s, fall_s);
            const double glow = exposed_lit(lamp, 0.7, 0.02)[white];
            EXPECT_TRUE(glow >= 0 && glow <= 1) << rise_s << " " << fall_s << " " << glow;
        }
    }
}

}  // namespace
}  // namespace seaglare::lightdb
