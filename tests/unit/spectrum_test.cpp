#include "glare/colour/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "glare/colour/cie_tables.h"

namespace seaglare::glare {
namespace {

// CIE 015:2018: chromaticities of the standard illuminants for the 1931 2-degree observer.
TEST(Spectrum, IlluminantsHaveTheirChromaticity) {
    const Chromaticity white = chromaticity_of(unit_luminance_xyz(d65));
    EXPECT_NEAR(white.x, 0.31272, 1e-4);
    EXPECT_NEAR(white.y, 0.32903, 1e-4);
    const Chromaticity a = chromaticity_of(unit_luminance_xyz(illuminant_a));
    EXPECT_NEAR(a.x, 0.44758, 1e-4);
    EXPECT_NEAR(a.y, 0.40745, 1e-4);
}

// CIE 018:2019: V peaks at 555 nm with 1, V' near 507 nm with 1; scotopic over photopic of D65 is 2.47.
TEST(Spectrum, ObserversPeakWhereTheyShouldAndGiveKnownRatios) {
    EXPECT_NEAR(colour_matching(555).y, 1, 1e-4);
    EXPECT_LT(colour_matching(550).y, 1);
    EXPECT_LT(colour_matching(560).y, 1);
    EXPECT_NEAR(scotopic_efficiency(505), 0.998, 1e-3);
    EXPECT_NEAR(scotopic_per_photopic(d65), 2.47, 0.02);
    EXPECT_NEAR(scotopic_per_photopic(illuminant_a), 1.41, 0.01);
    EXPECT_EQ(colour_matching(379).y, 0);
    EXPECT_EQ(d65(781), 0);
    EXPECT_EQ(scotopic_efficiency(std::nan("")), 0);
    EXPECT_EQ(scotopic_per_photopic([](double) { return 0.0; }), 0);
}

// A 525 nm LED lies far outside sRGB.
TEST(Spectrum, ANarrowGreenLeavesTheSrgbGamut) {
    const auto rgb = srgb_from_xyz(unit_luminance_xyz([](double l) { return gaussian(l, 525, 15); }));
    EXPECT_LT(rgb[0], -0.5);
    EXPECT_NEAR(luminance(rgb), 1, 1e-6);
}

TEST(Spectrum, TheWhiteLedOfTheThesisIsCoolWhiteAndHasItsTwoHumps) {
    EXPECT_NEAR(thesis_white_led(450), 0.9 + 0.5 * std::exp(-110.0 * 110.0 / 7200), 1e-12);
    EXPECT_NEAR(thesis_white_led(560), 0.5, 1e-6);
    const Chromaticity xy = chromaticity_of(unit_luminance_xyz(thesis_white_led));
    EXPECT_GT(xy.x, 0.28);
    EXPECT_LT(xy.x, 0.40);
    EXPECT_GT(xy.y, 0.28);
    EXPECT_LT(xy.y, 0.42);
}

TEST(Spectrum, SamplesOfD65AreWhiteHoweverFew) {
    for (int count : {1, 3, 8, 30, 120}) {
        const auto samples = sample_d65(count);
        ASSERT_EQ(samples.size(), static_cast<std::size_t>(count));
        std::array<double, 4> sum{};
        for (const SpectralSample& sample : samples) {
            EXPECT_GT(sample.wavelength_nm, 380);
            EXPECT_LT(sample.wavelength_nm, 780);
            for (std::size_t c = 0; c < 4; ++c)
                sum[c] += sample.weight[c];
        }
        for (double s : sum)
            EXPECT_NEAR(s, 1, 1e-12) << count;
    }
    // Blue light weighs in blue, red in red; cyan takes red away.
    const auto samples = sample_d65(40);
    EXPECT_GT(samples[7].weight[2], samples[7].weight[1]);
    EXPECT_GT(samples[25].weight[0], samples[25].weight[2]);
    EXPECT_LT(samples[12].weight[0], 0);
}

// Our table against the published files, where they are at hand.
TEST(Spectrum, TheTableEqualsThePublishedOne) {
    const std::filesystem::path folder = std::filesystem::path(SEAGLARE_SHARED_DIR) / "data" / "cie";
    std::ifstream file(folder / "cie1931_2deg_cmf_1nm.csv");
    if (!file) GTEST_SKIP() << "the published tables are not at " << folder;
    std::string line;
    std::getline(file, line);
    int compared = 0;
    while (std::getline(file, line)) {
        std::istringstream fields(line);
        double wavelength = 0;
        Xyz xyz;
        char comma = 0;
        fields >> wavelength >> comma >> xyz.x >> comma >> xyz.y >> comma >> xyz.z;
        if (wavelength < 380 || wavelength > 780 || std::fmod(wavelength, 5) != 0) continue;
        const auto& row = cie_table[static_cast<std::size_t>((wavelength - 380) / 5)];
        EXPECT_NEAR(row.x_bar, xyz.x, 1e-7) << wavelength;
        EXPECT_NEAR(row.y_bar, xyz.y, 1e-7) << wavelength;
        EXPECT_NEAR(row.z_bar, xyz.z, 1e-7) << wavelength;
        ++compared;
    }
    EXPECT_EQ(compared, cie_samples);
}

}  // namespace
}  // namespace seaglare::glare
