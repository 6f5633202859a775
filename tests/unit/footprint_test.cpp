#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "glare/apply/footprint.h"

namespace seaglare::glare {
namespace {

TEST(Footprint, IntegerTranslatesSumToOneEverywhere) {
    for (double offset = -0.5; offset <= 0.5; offset += 0.01) {
        double sum = 0;
        for (int i = -3; i <= 3; ++i)
            sum += kernel(i + offset);
        EXPECT_NEAR(sum, 1, 1e-12);
    }
}

TEST(Footprint, IsNearlyFlatOverAPixelSoThatTheBrightestHardlyVaries) {
    for (double x = -kernel_flat_px; x <= kernel_flat_px; x += 0.05)
        EXPECT_NEAR(kernel(x), 0.5, 1e-12);
    // The light between four pixels: both axes at half a pixel.
    EXPECT_NEAR(4 * kernel(0.5) * kernel(0.5), 0.943, 0.001);
    EXPECT_NEAR(kernel(kernel_reach_px), 0, 1e-15);
    EXPECT_LT(kernel(1.4), kernel(1.0));
}

TEST(Footprint, IntegralAndVarianceAreThoseOfTheKernel) {
    double sum = 0;
    double variance = 0;
    const double step = 1e-4;
    for (double x = -2 + step / 2; x < 2; x += step) {
        EXPECT_NEAR(kernel_integral(x - step / 2), sum, 1e-6);
        sum += kernel(x) * step;
        variance += x * x * kernel(x) * step;
    }
    EXPECT_NEAR(sum, 1, 1e-7);
    EXPECT_NEAR(variance, kernel_variance_px2, 1e-6);
}

TEST(Footprint, RowsOfADiscHaveItsEnergyAndItsMoments) {
    double one = 0;
    double x2 = 0;
    double y2 = 0;
    double y4 = 0;
    for (const DiscRow& row : disc_rows()) {
        EXPECT_NEAR(std::hypot(row.height, row.half_width), 1, 1e-15);
        one += row.weight;
        x2 += row.weight * row.half_width * row.half_width / 3;  // of an even chord
        y2 += row.weight * row.height * row.height;
        y4 += row.weight * std::pow(row.height, 4);
    }
    EXPECT_NEAR(one, 1, 1e-14);
    EXPECT_NEAR(x2, 0.25, 1e-14);  // mean of x^2 over the unit disc
    EXPECT_NEAR(y2, 0.25, 1e-14);
    EXPECT_NEAR(y4, 0.125, 1e-14);  // and of x^4
}

// An apparent disc: a circle, or an ellipse that leans, of the same area.
std::array<double, 4> disc_of(double radius_px, bool leaning) {
    if (!leaning) return {radius_px, 0, 0, radius_px};
    return {1.1 * radius_px, 0.3 * radius_px, 0.2 * radius_px, (1 + 0.06) / 1.1 * radius_px};
}

TEST(Footprint, ACoreOfAnySizeSumsToOneAndKeepsItsApparentSize) {
    for (const bool leaning : {false, true}) {
        for (const double radius_px : {0.0, 0.09, 0.11, 0.5, 1.0, 1.5, 1.79, 1.81, 2.5, 4.0}) {
            const std::array<double, 4> disc = disc_of(radius_px, leaning);
            double variance = 0;  // of the footprint itself: over pixels at all sub-pixel positions
            constexpr int positions = 10;
            for (int position = 0; position < positions; ++position) {
                const double offset = static_cast<double>(position) / positions;
                double sum = 0;
                for (int y = -8; y <= 8; ++y) {
                    for (int x = -8; x <= 8; ++x) {
                        const double weight = core_weight(x + offset, y - 0.6 * offset, disc, radius_px);
                        EXPECT_GE(weight, -1e-12);
                        sum += weight;
                        variance += weight * std::pow(x + offset, 2) / positions;
                    }
                }
                EXPECT_NEAR(sum, 1, 2e-4) << radius_px << " px";
            }
            const double disc_variance =
                radius_px > point_until_px ? (disc[0] * disc[0] + disc[2] * disc[2]) / 4 : 0;
            EXPECT_NEAR(variance, disc_variance + kernel_variance_px2, 1e-3 * variance) << radius_px << " px";
        }
    }
}

TEST(Footprint, TheBrightestPixelOfADiscOfAnySizeVariesByLessThanTenPercent) {
    for (double radius_px = 0.05; radius_px <= 4; radius_px += radius_px < 2.2 ? 0.05 : 0.25) {
        for (const bool leaning : {false, true}) {
            const std::array<double, 4> disc = disc_of(radius_px, leaning);
            double least = 1;
            double most = 0;
            for (double x = 0; x <= 0.5001; x += 0.1) {
                for (double y = 0; y <= 0.5001; y += 0.1) {
                    double peak = 0;
                    for (int i = -1; i <= 1; ++i) {
                        for (int j = -1; j <= 1; ++j)
                            peak = std::max(peak, core_weight(x + i, y + j, disc, radius_px));
                    }
                    least = std::min(least, peak);
                    most = std::max(most, peak);
                }
            }
            EXPECT_LT(most / least - 1, 0.09) << radius_px << " px, " << (leaning ? "leaning" : "upright");
        }
    }
}

TEST(Footprint, TheBrightestPixelFallsAsTheDiscGrows) {
    double last = 1;
    for (double radius_px = 0; radius_px <= 4; radius_px += 0.01) {
        const double now = core_weight(0.2, 0.1, disc_of(radius_px, false), radius_px);
        EXPECT_LE(now, last + 1e-9) << radius_px << " px";
        EXPECT_GT(now, last * 0.98 - (radius_px == 0 ? 1 : 0)) << radius_px << " px: a jump";
        last = now;
    }
}

// Beside the point's footprint there is only what the disc sends there. There the skirt is steep: one part in a thousand of
// the core's light is a code.
TEST(Footprint, ADiscThatGrowsByOnePercentDoesNotFlashBesideThePoint) {
    const auto beside = [](double radius_px) {
        return core_weight(1.9, 0.4, disc_of(radius_px, false), radius_px);
    };
    EXPECT_EQ(beside(point_until_px), 0) << "a point";
    EXPECT_GT(beside(mixed_from_px), 5e-5) << "where it would be seen, were it to come at once";
    double last = 0;
    for (double radius_px = 0.01; radius_px < 0.2; radius_px *= 1.01) {
        const double now = beside(radius_px);
        EXPECT_GE(now, last) << radius_px << " px";
        EXPECT_LE(now, last + 1.5e-5) << radius_px << " px";
        last = now;
    }
}

}  // namespace
}  // namespace seaglare::glare
