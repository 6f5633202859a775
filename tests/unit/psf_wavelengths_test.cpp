// How finely a pattern's wavelengths are divided, and what that may not change.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "glare/colour/cie_tables.h"
#include "glare/colour/navigation_colours.h"
#include "glare/psf/wavelength_steps.h"

namespace seaglare::glare {
namespace {

std::array<double, 4> total(const std::vector<SpectralSample>& samples) {
    std::array<double, 4> sum{};
    for (const SpectralSample& sample : samples)
        for (std::size_t c = 0; c < 4; ++c)
            sum[c] += sample.weight[c];
    return sum;
}

// Thirty wavelengths are 13.3 nm apart: at 555 nm that is 2.4 % of the distance.
TEST(WavelengthParts, BringNeighboursToAPixelHalfWayToTheRim) {
    const auto thirty = sample_d65(30);
    EXPECT_EQ(wavelength_parts(thirty, 74, 1), 1);   // 45 degrees over 720 lines
    EXPECT_EQ(wavelength_parts(thirty, 343, 1), 5);  // 30 degrees over 2160
    for (const double radius : {10.0, 100.0, 300.0, 1000.0}) {
        const int parts = wavelength_parts(thirty, radius, 1);
        const double apart = radius / 2 * (400.0 / 30) / 555;
        EXPECT_LE(apart / parts, 1 + 1e-12) << radius;
        if (parts > 1) {
            EXPECT_GT(apart / (parts - 1), 1) << radius;
        }
    }
    EXPECT_EQ(wavelength_parts(thirty, 1e9, 1), 16);
    EXPECT_EQ(wavelength_parts(thirty, 1e9, 0), 1);
    EXPECT_EQ(wavelength_parts({{575, {1, 1, 1, 1}}}, 1e9, 1), 1);
    EXPECT_EQ(wavelength_parts({}, 1e9, 1), 1);
}

TEST(DividedSpectrum, HasTheSameSumAndTheBandsMiddles) {
    const auto samples = sample_d65(30);
    const auto finer = divided(samples, 5);
    ASSERT_EQ(finer.size(), 5 * samples.size());
    for (std::size_t c = 0; c < 4; ++c)
        EXPECT_NEAR(total(finer)[c], total(samples)[c], 1e-12);
    for (std::size_t k = 0; k < samples.size(); ++k) {
        double mean = 0;
        for (std::size_t part = 0; part < 5; ++part)
            mean += finer[5 * k + part].wavelength_nm / 5;
        EXPECT_NEAR(mean, samples[k].wavelength_nm, 1e-9);
    }
    for (std::size_t k = 1; k < finer.size(); ++k)
        EXPECT_NEAR(finer[k].wavelength_nm - finer[k - 1].wavelength_nm, 400.0 / 150, 1e-9);
    EXPECT_EQ(divided({}, 3).size(), 0U);
}

TEST(SharedColours, KeepEverySumAndTheMeanWavelength) {
    for (int lamp = 0; lamp < lamp_count; ++lamp) {
        const auto samples = sample_spectrum(navigation_spectrum(lamp), 120);
        const auto shared = shared_colours(samples);
        ASSERT_EQ(shared.size(), samples.size());
        for (std::size_t c = 0; c < 4; ++c) {
            EXPECT_NEAR(total(shared)[c], total(samples)[c], 1e-12) << lamp;
        }
        double moment = 0;
        double moved = 0;
        for (std::size_t k = 0; k < samples.size(); ++k) {
            const auto& a = samples[k].weight;
            const auto& b = shared[k].weight;
            moment += (0.2126 * a[0] + 0.7152 * a[1] + 0.0722 * a[2]) * samples[k].wavelength_nm;
            moved += (0.2126 * b[0] + 0.7152 * b[1] + 0.0722 * b[2]) * shared[k].wavelength_nm;
            EXPECT_NEAR(shared[k].wavelength_nm, samples[k].wavelength_nm, 400.0 / 120 / 2 + 1e-9);
        }
        // The clamped shift of the spectrum's dark ends is what is left.
        EXPECT_NEAR(moved, moment, 0.02) << lamp;
    }
}

TEST(SharedColours, LeaveFewSamplesAloneAndMakeThirtyColoursOfMany) {
    const auto few = sample_d65(59);
    const auto same = shared_colours(few);
    for (std::size_t k = 0; k < few.size(); ++k)
        EXPECT_EQ(same[k].weight, few[k].weight);
    const auto many = shared_colours(sample_d65(240));
    std::size_t colours = 1;
    for (std::size_t k = 1; k < many.size(); ++k)
        colours += many[k].weight == many[k - 1].weight ? 0 : 1;
    EXPECT_EQ(colours, 30U);
}

}  // namespace
}  // namespace seaglare::glare
