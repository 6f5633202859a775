// Rhythms in a running simulation: no flash is lost at any frame rate, the phase is right after four months, groups stay in step.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

#include "lightdb/character.h"
#include "lightdb/emission.h"
#include "lightdb/rhythm.h"

namespace seaglare::lightdb {
namespace {

constexpr std::size_t white = static_cast<std::size_t>(Colour::white);

const char* const characters[] = {"Fl W 3s",         "Fl(2+1)W 12s", "Q W",
                                  "VQ(6)+LFl W 10s", "UQ W",         "Oc(2)W 8s",
                                  "Mo(A)W 8s",       "Iso W 2s",     "IVQ W 7s",
                                  "FFl W 7.3s",      "LFl W 9.7s",   "Fl W 2.9s fl. 0.005s, ec. 2.895s"};

// Sum over frames of mean times length is the integral: whatever the rate, also one that never meets the period again.
TEST(RhythmProperty, NoFlashIsLostAtAnyFrameRate) {
    std::mt19937_64 random(21);
    std::uniform_real_distribution<double> rate(24, 240);
    std::vector<double> rates{24,  25, 30, 48, 50, 60, 60 / 1.001, 24 * std::sqrt(2.0), 100 / std::sqrt(3.0),
                              144, 240};
    for (int i = 0; i < 20; ++i)
        rates.push_back(rate(random));
    for (const char* text : characters) {
        Rhythm rhythm = parse_character(text).rhythm;
        for (const double slowness_s : {0.0, 0.2}) {
            rhythm.rise_s = slowness_s;
            rhythm.fall_s = slowness_s / 2;
            for (const double frames_per_s : rates) {
                const double dt_s = 1 / frames_per_s;
                const double start_s = 1000.003;
                const auto frames = static_cast<int>(std::ceil(2 * rhythm.period_s * frames_per_s));
                double sum_s = 0;
                double brightest = 0;
                for (int k = 1; k <= frames; ++k) {
                    const double fraction = exposed_lit(rhythm, start_s + k * dt_s, dt_s)[white];
                    sum_s += fraction * dt_s;
                    brightest = std::max(brightest, fraction);
                }
                const double whole_s = frames * dt_s;
                ASSERT_NEAR(sum_s, mean_lit(rhythm, start_s + whole_s, whole_s)[white] * whole_s, 1e-9)
                    << text << " at " << frames_per_s;
                ASSERT_GT(brightest, 0) << text << " at " << frames_per_s;
            }
        }
    }
}

// Rates below 20 expose 50 ms of a longer frame: bounded, and never a hitch's mean.
TEST(RhythmProperty, TheExposureIsTheNominalIntervalAndAtMost50Milliseconds) {
    EXPECT_EQ(exposure_used_s(1.0 / 60), 1.0 / 60);
    EXPECT_EQ(exposure_used_s(0.05), 0.05);
    EXPECT_EQ(exposure_used_s(10), 0.05);
    EXPECT_EQ(exposure_used_s(0), 0);
    EXPECT_EQ(exposure_used_s(-1), 0);
    EXPECT_EQ(exposure_used_s(std::nan("")), 0);
}

// Periods of whole milliseconds, so that integers say where in the period an instant lies; begun anywhere in four months.
TEST(RhythmProperty, AfterFourMonthsThePhaseIsExactToAMicrosecond) {
    std::mt19937_64 random(22);
    std::uniform_int_distribution<std::int64_t> milliseconds(100, 30000);
    for (int i = 0; i < 2000; ++i) {
        const std::int64_t lit_ms = milliseconds(random);
        const std::int64_t dark_ms = milliseconds(random);
        Rhythm rhythm;
        rhythm.phases = {{static_cast<double>(lit_ms) / 1000, true},
                         {static_cast<double>(dark_ms) / 1000, false}};
        rhythm.period_s = rhythm.phases[0].duration_s + rhythm.phases[1].duration_s;
        const std::int64_t period_ms = lit_ms + dark_ms;
        const std::int64_t begin_ms =
            10000000000 / period_ms * period_ms;  // the last period before t = 1e7 s
        const auto at_us = [&](std::int64_t offset_us) {
            const double t_s = static_cast<double>(begin_ms * 1000 + offset_us) / 1e6;
            return mean_lit(rhythm, t_s, 0)[white];
        };
        ASSERT_EQ(at_us(1), 1) << period_ms;
        ASSERT_EQ(at_us(-1), 0) << period_ms;
        ASSERT_EQ(at_us(lit_ms * 1000 - 1), 1) << period_ms;
        ASSERT_EQ(at_us(lit_ms * 1000 + 1), 0) << period_ms;
        // A frame astride the edge is lit for its first half.
        const double edge_s = static_cast<double>(begin_ms + lit_ms) / 1000;
        ASSERT_NEAR(exposed_lit(rhythm, edge_s + 0.01, 0.02)[white] * 0.02, 0.01, 1e-7);
    }
}

TEST(RhythmProperty, ALightOfAGroupBeginsLaterByItsDelay) {
    Light front;
    front.rhythm = parse_character("Fl W 4s").rhythm;
    front.rhythm.sync_group = "leading line";
    front.stable_key = 1;
    Light rear = front;
    rear.stable_key = 99;
    Light late = rear;
    late.rhythm.delay_s = 1.5;
    for (double t_s = 0; t_s < 30; t_s += 0.11) {
        const Exposure now{t_s, 0.02, 5};
        EXPECT_EQ(lit_during(front, now), lit_during(rear, now));
        const double before = lit_during(front, {t_s - 1.5, 0.02, 5})[white];
        EXPECT_NEAR(lit_during(late, now)[white], before, 1e-9) << t_s;
    }
    EXPECT_NE(phase_offset_s(front.rhythm, 1, 5), phase_offset_s(late.rhythm, 99, 5));
}

TEST(RhythmProperty, DutyCyclesOfTheClassesAreTheirPhases) {
    for (const char* text : characters) {
        const Rhythm rhythm = parse_character(text).rhythm;
        double lit_s = 0;
        for (const Phase& phase : rhythm.phases)
            if (phase.lit) lit_s += phase.duration_s * phase.level;
        for (const int periods : {1, 3, 1000})
            EXPECT_NEAR(mean_lit(rhythm, 4711.25, periods * rhythm.period_s)[white], lit_s / rhythm.period_s,
                        1e-12)
                << text;
    }
}

TEST(RhythmProperty, AGlowTooFaintForAnyEyeIsDark) {
    EXPECT_TRUE(is_dark({}));
    LitFractions lit{};
    lit[white] = 1e-16;
    EXPECT_TRUE(is_dark(lit));
    lit[white] = 1e-9;
    EXPECT_FALSE(is_dark(lit));
}

}  // namespace
}  // namespace seaglare::lightdb
