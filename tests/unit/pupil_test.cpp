#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "glare/eye/eye_model.h"
#include "glare/eye/noise.h"

namespace seaglare::glare {
namespace {

// p = 4.9 - 3 tanh(0.4 (log10 L + 1)), Moon & Spencer 1944.
TEST(Pupil, TheMeanFollowsMoonAndSpencer) {
    const std::array<std::array<double, 2>, 7> values = {
        {{1e-6, 7.79}, {1e-4, 7.40}, {1e-2, 6.04}, {0.1, 4.90}, {1, 3.76}, {100, 2.40}, {1e6, 1.92}}};
    for (const auto& [luminance_cd_m2, pupil_mm] : values)
        EXPECT_NEAR(mean_pupil_diameter_mm(luminance_cd_m2), pupil_mm, 0.006) << luminance_cd_m2;
}

TEST(Pupil, EveryLuminanceGivesAPupil) {
    EXPECT_EQ(mean_pupil_diameter_mm(0), mean_pupil_diameter_mm(1e-6));
    EXPECT_EQ(mean_pupil_diameter_mm(-5), mean_pupil_diameter_mm(1e-6));
    EXPECT_EQ(mean_pupil_diameter_mm(std::nan("")), mean_pupil_diameter_mm(1e-6));
    EXPECT_EQ(mean_pupil_diameter_mm(std::numeric_limits<double>::infinity()), mean_pupil_diameter_mm(1e6));
    double last = 9;
    for (double l = -7; l < 7; l += 0.25) {
        const double p = mean_pupil_diameter_mm(std::pow(10.0, l));
        EXPECT_LE(p, last);
        last = p;
    }
}

TEST(Pupil, HippusStaysWithinItsBoundsAndAroundTheMean) {
    EyeModel eye = young_eye();
    for (double luminance_cd_m2 : {1e-4, 0.001, 1.0, 1e5}) {
        const double mean = mean_pupil_diameter_mm(luminance_cd_m2);
        const double limit = eye.hippus_amplitude_mm * 9 / mean * std::sqrt(1 - mean / 9);
        double sum = 0;
        double spread = 0;
        constexpr int frames = 5000;
        for (int i = 0; i < frames; ++i) {
            const double p = pupil_diameter_mm(eye, luminance_cd_m2, i * 0.1, 3);
            EXPECT_LE(std::abs(p - mean), limit + 1e-12);
            sum += p - mean;
            spread = std::max(spread, std::abs(p - mean));
        }
        EXPECT_LT(std::abs(sum / frames), 0.1 * limit);
        EXPECT_GT(spread, 0.5 * limit);  // it does move
    }
    eye.hippus_amplitude_mm = 1;
    for (double t = 0; t < 100; t += 0.3) {
        const double p = pupil_diameter_mm(eye, 1e6, t, 3);
        EXPECT_GE(p, 1.5);
        EXPECT_LE(p, 8.5);
    }
}

TEST(Pupil, AnInstantHasOnePupilHoweverLate) {
    const EyeModel eye = young_eye();
    const double late = pupil_diameter_mm(eye, 0.001, 1e7, 11);
    for (int i = 0; i < 10; ++i)
        pupil_diameter_mm(eye, 0.001, i, 11);
    EXPECT_EQ(pupil_diameter_mm(eye, 0.001, 1e7, 11), late);
    EXPECT_NE(pupil_diameter_mm(eye, 0.001, 1e7, 12), late);
    EXPECT_TRUE(std::isfinite(pupil_diameter_mm(eye, std::nan(""), std::nan(""), 1)));
    EXPECT_TRUE(std::isfinite(pupil_diameter_mm(eye, 0, std::numeric_limits<double>::infinity(), 1)));
    EXPECT_TRUE(std::isfinite(pupil_diameter_mm(eye, 0, -1e300, 1)));
}

TEST(Pupil, AFixedPupilKeepsItsWidthBesidesHippus) {
    EyeModel eye = sixty_year_eye();
    eye.hippus_amplitude_mm = 0;
    EXPECT_EQ(pupil_diameter_mm(eye, 1e-6, 4, 1), 5);
    eye.fixed_pupil_mm = 20;
    EXPECT_EQ(pupil_diameter_mm(eye, 1e-6, 4, 1), 8.5);
}

TEST(Noise, IsBoundedContinuousAndChangesWithItsSeed) {
    double last = smooth_noise(5, 0);
    double lowest = 1;
    double highest = -1;
    for (double phase = 0; phase < 400; phase += 0.01) {
        const double value = smooth_noise(5, phase);
        EXPECT_LE(std::abs(value), 1);
        EXPECT_LT(std::abs(value - last), 0.06) << phase;
        last = value;
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
    }
    EXPECT_LT(lowest, -0.7);
    EXPECT_GT(highest, 0.7);
    EXPECT_NE(smooth_noise(5, 0.5), smooth_noise(6, 0.5));
    EXPECT_TRUE(std::isfinite(smooth_noise(5, -1e18)));
}

TEST(Noise, UniformNumbersFillTheUnitInterval) {
    double sum = 0;
    double squares = 0;
    constexpr int count = 20000;
    for (std::uint64_t i = 0; i < count; ++i) {
        const double u = uniform(9, 1, i);
        EXPECT_GE(u, 0);
        EXPECT_LT(u, 1);
        sum += u;
        squares += u * u;
    }
    EXPECT_NEAR(sum / count, 0.5, 0.01);
    EXPECT_NEAR(squares / count, 1.0 / 3, 0.01);
}

}  // namespace
}  // namespace seaglare::glare
