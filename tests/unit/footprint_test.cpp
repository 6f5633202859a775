#include <gtest/gtest.h>

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

TEST(Footprint, SmallDiscNodesIntegrateFourthPowersExactly) {
    double one = 0;
    double r2 = 0;
    double x4 = 0;
    for (const DiscNode& node : small_disc_nodes()) {
        one += node.weight;
        r2 += node.weight * (node.x * node.x + node.y * node.y);
        x4 += node.weight * std::pow(node.x, 4);
    }
    EXPECT_NEAR(one, 1, 1e-15);
    EXPECT_NEAR(r2, 0.5, 1e-15);    // mean of r^2 over the unit disc
    EXPECT_NEAR(x4, 0.125, 1e-15);  // mean of x^4
}

}  // namespace
}  // namespace seaglare::glare
