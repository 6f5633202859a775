// The time budget's controller, with a simulated load: under budget in the end, at any frame rate the same, never a jump.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "glare/plan/plan.h"
#include "glare/plan/quality_control.h"

namespace seaglare::glare {
namespace {

constexpr Budget eight_ms{.max_error_codes = 0.5, .time_ms = 8};

// Frames whose time falls with the quality given up: to a tenth at the most.
double time_at(double full_ms, double loss) {
    return full_ms * std::pow(0.1, loss);
}

QualityControl after(double seconds, double rate_hz, const std::function<double(double)>& full_ms_at,
                     QualityControl control = {}) {
    const int frames = static_cast<int>(std::lround(seconds * rate_hz));
    for (int i = 0; i < frames; ++i)
        control = advanced(control, eight_ms, time_at(full_ms_at(i / rate_hz), control.loss), 1 / rate_hz);
    return control;
}

TEST(QualityControl, FramesComeUnderTheirBudgetAndStayThere) {
    const auto load = [](double) { return 20.0; };
    QualityControl control = after(10, 60, load);
    EXPECT_LE(time_at(20, control.loss), 8 * 1.01);
    EXPECT_GE(time_at(20, control.loss), 8 * comfortable_part * 0.9) << "no more is given up than needed";
    const double settled = control.loss;
    for (int i = 0; i < 600; ++i) {
        control = advanced(control, eight_ms, time_at(20, control.loss), 1.0 / 60);
        ASSERT_NEAR(control.loss, settled, 0.01) << "it does not swing";
    }
}

TEST(QualityControl, NothingIsGivenUpWhileThereIsTime) {
    EXPECT_EQ(after(5, 60, [](double) { return 7.9; }).loss, 0);
    EXPECT_EQ(after(5, 60, [](double) { return 0.0; }).loss, 0);
}

TEST(QualityControl, QualityComesBackWhenTheLoadHasGone) {
    const QualityControl heavy = after(10, 60, [](double) { return 40.0; });
    EXPECT_GT(heavy.loss, 0.5);
    EXPECT_EQ(after(
                  20, 60, [](double) { return 3.0; }, heavy)
                  .loss,
              0);
}

TEST(QualityControl, BetweenComfortAndBudgetItStands) {
    const QualityControl settled = after(10, 60, [](double) { return 20.0; });
    // A load that goes up and down within the band changes nothing: hysteresis.
    QualityControl control = settled;
    for (int i = 0; i < 600; ++i) {
        const double taken = 8 * (i % 60 < 30 ? 0.8 : 0.95);
        control = advanced(control, eight_ms, taken, 1.0 / 60);
    }
    EXPECT_NEAR(control.loss, settled.loss, 0.01);
}

TEST(QualityControl, FrameRatesAgree) {
    // A load that knows nothing of the quality: the same measured times at every rate.
    const auto loss_after = [](double rate_hz) {
        QualityControl control;
        const int frames = static_cast<int>(std::lround(3 * rate_hz));
        for (int i = 0; i < frames; ++i) {
            const double t = i / rate_hz;
            control = advanced(control, eight_ms, t < 1.6 - 1e-9 ? 12 : 5, 1 / rate_hz);
        }
        return control.loss;
    };
    const double at_240 = loss_after(240);
    EXPECT_GT(at_240, 0.1);
    for (const double rate_hz : {15.0, 30.0, 60.0, 120.0})
        EXPECT_NEAR(loss_after(rate_hz), at_240, 0.005) << rate_hz;
}

TEST(QualityControl, ItNeverJumps) {
    QualityControl control;
    double before = 0;
    for (int i = 0; i < 3000; ++i) {
        const double taken = i % 700 < 350 ? 400 : 0.1;
        control = advanced(control, eight_ms, taken, 1.0 / 60);
        ASSERT_LE(std::abs(control.loss - before), loss_per_s / 60 + 1.0 / 240 * loss_per_s + 1e-12);
        // The error that a frame is allowed changes by less than a fiftieth from frame to frame.
        const double codes = error_allowed_codes(eight_ms, control.loss);
        ASSERT_LT(std::abs(codes / error_allowed_codes(eight_ms, before) - 1), 0.025);
        before = control.loss;
    }
    EXPECT_GE(control.loss, 0);
    EXPECT_LE(control.loss, 1);
}

TEST(QualityControl, OneHitchChangesLittle) {
    QualityControl control = after(1, 60, [](double) { return 5.0; });
    control = advanced(control, eight_ms, 2000, 1.0 / 60);
    for (int i = 0; i < 60; ++i)
        control = advanced(control, eight_ms, 5, 1.0 / 60);
    EXPECT_LT(control.loss, 0.02);
}

TEST(QualityControl, TheSameTimesGiveTheSameQuality) {
    std::vector<double> times;
    for (int i = 0; i < 500; ++i)
        times.push_back(8 + 6 * std::sin(i * 0.05) + (i % 7));
    QualityControl a, b;
    for (const double ms : times)
        a = advanced(a, eight_ms, ms, 1.0 / 60);
    for (const double ms : times)
        b = advanced(b, eight_ms, ms, 1.0 / 60);
    EXPECT_EQ(a, b);
    EXPECT_GT(a.loss, 0);
}

TEST(QualityControl, OddTimesAreHarmless) {
    QualityControl control = after(2, 60, [](double) { return 40.0; });
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (const double taken : {nan, infinite, -1.0, 0.0, 1e300})
        for (const double interval : {nan, infinite, -1.0, 0.0, 1e-9, 10.0})
            control = advanced(control, eight_ms, taken, interval);
    EXPECT_TRUE(std::isfinite(control.loss));
    EXPECT_EQ(advanced(control, Budget{}, 100, 1.0 / 60), QualityControl{}) << "no time budget, no loss";
}

TEST(ErrorAllowed, GrowsFromTheConfiguredToTheMost) {
    EXPECT_EQ(error_allowed_codes(eight_ms, 0), 0.5);
    EXPECT_NEAR(error_allowed_codes(eight_ms, 0.5), 4, 1e-12);
    EXPECT_NEAR(error_allowed_codes(eight_ms, 1), 4, 1e-12);
    EXPECT_EQ(error_allowed_codes(Budget{.max_error_codes = 0.5}, 0.7), 0.5) << "without a time budget";
    EXPECT_EQ(error_allowed_codes(Budget{.max_error_codes = 0}, 0), 0);
    const Budget small{.max_error_codes = 8, .time_ms = 8, .most_error_codes = 4};
    EXPECT_EQ(error_allowed_codes(small, 1), 8) << "never less than configured";
}

}  // namespace
}  // namespace seaglare::glare
