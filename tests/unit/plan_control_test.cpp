// The time budget's controller, with a simulated load: under budget in the end, at any frame rate the same, never a jump.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "glare/plan/plan.h"
#include "glare/plan/quality_control.h"

namespace seaglare::glare {
namespace {

constexpr Budget eight_ms{.max_error_codes = 0.5, .time_ms = 8};

// Every kind saves a part of the frame, some for more codes than others.
constexpr QualitySavings all_save = {
    {{.ms = 4, .part = 0.2, .codes = 4}, {2, 0.1, 8}, {6, 0.3, 90}, {3, 0.15, 58}}};

// Frames whose time falls with the quality given up: to a tenth at the most.
double time_at(double full_ms, double loss) {
    return full_ms * std::pow(0.1, loss);
}

QualityControl after(double seconds, double rate_hz, const std::function<double(double)>& full_ms_at,
                     QualityControl control = {}) {
    const int frames = static_cast<int>(std::lround(seconds * rate_hz));
    for (int i = 0; i < frames; ++i)
        control = advanced(control, eight_ms, time_at(full_ms_at(i / rate_hz), control.loss.mean()),
                           1 / rate_hz, all_save);
    return control;
}

TEST(QualityControl, FramesComeUnderTheirBudgetAndStayThere) {
    const auto load = [](double) { return 20.0; };
    QualityControl control = after(10, 60, load);
    EXPECT_LE(time_at(20, control.loss.mean()), 8 * 1.01);
    EXPECT_GE(time_at(20, control.loss.mean()), 8 * comfortable_part * 0.9)
        << "no more is given up than needed";
    const double settled = control.loss.mean();
    for (int i = 0; i < 600; ++i) {
        control = advanced(control, eight_ms, time_at(20, control.loss.mean()), 1.0 / 60, all_save);
        ASSERT_NEAR(control.loss.mean(), settled, 0.01) << "it does not swing";
    }
}

TEST(QualityControl, NothingIsGivenUpWhileThereIsTime) {
    EXPECT_FALSE(after(5, 60, [](double) { return 7.9; }).loss.any());
    EXPECT_FALSE(after(5, 60, [](double) { return 0.0; }).loss.any());
}

TEST(QualityControl, QualityComesBackWhenTheLoadHasGone) {
    const QualityControl heavy = after(10, 60, [](double) { return 40.0; });
    EXPECT_GT(heavy.loss.mean(), 0.5);
    EXPECT_FALSE(after(
                     20, 60, [](double) { return 3.0; }, heavy)
                     .loss.any());
}

TEST(QualityControl, BetweenComfortAndBudgetItStands) {
    const QualityControl settled = after(10, 60, [](double) { return 20.0; });
    // A load that goes up and down within the band changes nothing: hysteresis.
    QualityControl control = settled;
    for (int i = 0; i < 600; ++i) {
        const double taken = 8 * (i % 60 < 30 ? 0.8 : 0.95);
        control = advanced(control, eight_ms, taken, 1.0 / 60, all_save);
    }
    EXPECT_NEAR(control.loss.mean(), settled.loss.mean(), 0.01);
}

TEST(QualityControl, FrameRatesAgree) {
    // A load that knows nothing of the quality: the same measured times at every rate.
    const auto loss_after = [](double rate_hz) {
        QualityControl control;
        const int frames = static_cast<int>(std::lround(3 * rate_hz));
        for (int i = 0; i < frames; ++i) {
            const double t = i / rate_hz;
            control = advanced(control, eight_ms, t < 1.6 - 1e-9 ? 12 : 5, 1 / rate_hz, all_save);
        }
        return control.loss.of(Quality::error);  // which goes first
    };
    const double at_240 = loss_after(240);
    EXPECT_GT(at_240, 0.1);
    for (const double rate_hz : {15.0, 30.0, 60.0, 120.0})
        EXPECT_NEAR(loss_after(rate_hz), at_240, 0.005) << rate_hz;
}

TEST(QualityControl, ItNeverJumps) {
    QualityControl control;
    QualityLoss before;
    for (int i = 0; i < 3000; ++i) {
        const double taken = i % 700 < 350 ? 400 : 0.1;
        // What is predicted to be saved changes, too, from frame to frame.
        QualitySavings savings = all_save;
        savings[static_cast<std::size_t>(i) % quality_kinds].part *= i % 3;
        control = advanced(control, eight_ms, taken, 1.0 / 60, savings);
        for (std::size_t k = 0; k < quality_kinds; ++k) {
            ASSERT_LE(std::abs(control.loss.level[k] - before.level[k]),
                      loss_per_s / 60 + 1.0 / 240 * loss_per_s + 1e-12);
            ASSERT_GE(control.loss.level[k], 0);
            ASSERT_LE(control.loss.level[k], 1);
        }
        // The error that a frame is allowed changes by less than a fiftieth from frame to frame.
        const double codes = error_allowed_codes(eight_ms, control.loss.of(Quality::error));
        ASSERT_LT(std::abs(codes / error_allowed_codes(eight_ms, before.of(Quality::error)) - 1), 0.025);
        before = control.loss;
    }
}

TEST(QualityControl, OneHitchChangesLittle) {
    QualityControl control = after(1, 60, [](double) { return 5.0; });
    control = advanced(control, eight_ms, 2000, 1.0 / 60, all_save);
    for (int i = 0; i < 60; ++i)
        control = advanced(control, eight_ms, 5, 1.0 / 60, all_save);
    EXPECT_LT(control.loss.mean(), 0.02);
}

TEST(QualityControl, TheSameTimesGiveTheSameQuality) {
    std::vector<double> times;
    for (int i = 0; i < 500; ++i)
        times.push_back(8 + 6 * std::sin(i * 0.05) + (i % 7));
    QualityControl a, b;
    for (const double ms : times)
        a = advanced(a, eight_ms, ms, 1.0 / 60, all_save);
    for (const double ms : times)
        b = advanced(b, eight_ms, ms, 1.0 / 60, all_save);
    EXPECT_EQ(a, b);
    EXPECT_TRUE(a.loss.any());
}

TEST(QualityControl, OddTimesAreHarmless) {
    QualityControl control = after(2, 60, [](double) { return 40.0; });
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (const double taken : {nan, infinite, -1.0, 0.0, 1e300})
        for (const double interval : {nan, infinite, -1.0, 0.0, 1e-9, 10.0})
            control = advanced(control, eight_ms, taken, interval, all_save);
    EXPECT_TRUE(std::isfinite(control.loss.mean()));
    EXPECT_EQ(advanced(control, Budget{}, 100, 1.0 / 60, all_save), QualityControl{})
        << "no time budget, no loss";
}

QualityControl overloaded(const QualitySavings& savings, double seconds, QualityControl control = {}) {
    for (int i = 0; i < static_cast<int>(60 * seconds); ++i)
        control = advanced(control, eight_ms, 400, 1.0 / 60, savings);
    return control;
}

TEST(QualityControl, WhatSavesNothingIsNotGivenUpHoweverShortTimeIs) {
    EXPECT_FALSE(overloaded({}, 20).loss.any());
    QualitySavings next_to_nothing = all_save;
    for (Saving& saving : next_to_nothing)
        saving.part = 0.99 * least_saving_part;
    EXPECT_FALSE(overloaded(next_to_nothing, 20).loss.any());
    EXPECT_EQ(could_save_ms({}, next_to_nothing), 0) << "the budget cannot be kept, and that is said";
    QualitySavings one = next_to_nothing;
    one[2].part = 1.01 * needed_part(one[2]);
    EXPECT_EQ(overloaded(one, 20).loss.level, (std::array<double, quality_kinds>{0, 0, 1, 0}));
}

TEST(QualityControl, WhatSavesMostForACodeGoesFirstAndComesBackLast) {
    QualityControl control;
    std::vector<std::size_t> went, came;
    const auto note = [](std::vector<std::size_t>& list, const QualityLoss& from, const QualityLoss& to) {
        for (std::size_t k = 0; k < quality_kinds; ++k)
            if (from.level[k] != to.level[k] && std::find(list.begin(), list.end(), k) == list.end())
                list.push_back(k);
    };
    for (int i = 0; i < 1200; ++i) {
        const QualityLoss before = control.loss;
        control = advanced(control, eight_ms, 400, 1.0 / 60, all_save);
        note(went, before, control.loss);
    }
    // 1, 0.25, 0.067 and 0.052 ms for a code.
    EXPECT_EQ(went, (std::vector<std::size_t>{0, 1, 2, 3}));
    EXPECT_EQ(control.loss.mean(), 1);
    EXPECT_EQ(could_save_ms(control.loss, all_save), 0);
    EXPECT_EQ(saved_ms(control.loss, all_save), 15);
    for (int i = 0; i < 3000; ++i) {
        const QualityLoss before = control.loss;
        control = advanced(control, eight_ms, 1, 1.0 / 60, all_save);
        note(came, before, control.loss);
    }
    EXPECT_EQ(came, (std::vector<std::size_t>{3, 2, 1, 0}));
}

TEST(QualityControl, WhatSavesNothingAnyMoreComesBackThoughTimeIsShort) {
    const QualityControl all = overloaded(all_save, 20);
    QualitySavings later = all_save;
    later[0].part = 0.4 * needed_part(all_save[0]);
    later[1].part = 0.6 * needed_part(all_save[1]);
    const QualityControl rest = overloaded(later, 10, all);
    EXPECT_EQ(rest.loss.level, (std::array<double, quality_kinds>{0, 1, 1, 1}))
        << "and what lies between the two limits stands";
}

TEST(ErrorAllowed, GrowsFromTheConfiguredToTheMost) {
    EXPECT_EQ(error_allowed_codes(eight_ms, 0), 0.5);
    EXPECT_NEAR(error_allowed_codes(eight_ms, 0.5), std::sqrt(0.5 * 4), 1e-12) << "by equal factors";
    EXPECT_NEAR(error_allowed_codes(eight_ms, 1), 4, 1e-12);
    EXPECT_EQ(error_allowed_codes(Budget{.max_error_codes = 0.5}, 0.7), 0.5) << "without a time budget";
    EXPECT_EQ(error_allowed_codes(Budget{.max_error_codes = 0}, 0), 0);
    const Budget small{.max_error_codes = 8, .time_ms = 8, .most_error_codes = 4};
    EXPECT_EQ(error_allowed_codes(small, 1), 8) << "never less than configured";
}

}  // namespace
}  // namespace seaglare::glare
