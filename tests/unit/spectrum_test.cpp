#include "glare/colour/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <tuple>
#include <vector>

#include "glare/colour/cie_tables.h"
#include "glare/colour/lamp_spectrum.h"
#include "glare/colour/named_spectra.h"

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

TEST(NamedSpectra, AreWhatTheyAreCalled) {
    struct Row {
        const char* name;
        double x, y, within;
    };
    // CIE 015: A (0.4476, 0.4074), E (1/3, 1/3), D65 (0.3127, 0.3290).
    constexpr Row rows[] = {{"a", 0.4476, 0.4074, 2e-4},        {"e", 1.0 / 3, 1.0 / 3, 2e-4},
                            {"d65", 0.3127, 0.3290, 2e-4},      {"planck:2855.5", 0.4476, 0.4074, 2e-4},
                            {"tungsten", 0.4476, 0.4074, 3e-4}, {"led_white_poor", 0.3127, 0.3290, 2e-4}};
    for (const Row& row : rows) {
        const Chromaticity xy = chromaticity_of(unit_luminance_xyz(*named_spectrum(row.name)));
        EXPECT_NEAR(xy.x, row.x, row.within) << row.name;
        EXPECT_NEAR(xy.y, row.y, row.within) << row.name;
    }
    for (const std::string_view name : spectrum_names())
        EXPECT_TRUE(LampSpectrum::from(*named_spectrum(name))) << name;
    EXPECT_FALSE(named_spectrum("planck:999"));
    EXPECT_FALSE(named_spectrum("planck:"));
    EXPECT_FALSE(named_spectrum("d66"));
    EXPECT_EQ((*named_spectrum(planck_name(2712.3)))(600), planck(600, 2712.3));
}

TEST(NamedSpectra, LedsHaveTheirScotopicRatiosAndSignedColours) {
    const auto ratio = [](double peak_nm) {
        return LampSpectrum::from([=](double l) { return gaussian(l, peak_nm, 15); })
            ->colour()
            .scotopic_per_photopic;
    };
    EXPECT_NEAR(ratio(505), 5.4F, 0.25F);  // of a width that the source of the figure does not state
    EXPECT_NEAR(LampSpectrum::from(*named_spectrum("led_red"))->colour().scotopic_per_photopic, 0.046F,
                0.001F);
    EXPECT_NEAR(LampSpectrum::from(*named_spectrum("led_green"))->colour().scotopic_per_photopic, 2.77F,
                0.01F);
    EXPECT_NEAR(LampSpectrum::from(*named_spectrum("led_blue"))->colour().scotopic_per_photopic, 19.0F, 0.5F);
    const auto green = LampSpectrum::from(*named_spectrum("led_green"))->colour().rgb;
    EXPECT_NEAR(green[0], -0.97F, 0.03F);
    EXPECT_NEAR(green[1], 1.69F, 0.02F);
    EXPECT_NEAR(green[2], -0.07F, 0.02F);
}

TEST(NamedSpectra, AnIncandescentLampBehindAGlassIsWithinItsRegionOfColregAnnexI) {
    const std::map<std::string, std::vector<Chromaticity>> regions = {
        {"green", {{.028, .385}, {.009, .723}, {.300, .511}, {.203, .356}}},
        {"red", {{.680, .320}, {.660, .320}, {.721, .259}, {.735, .265}}},
        {"yellow", {{.612, .382}, {.618, .382}, {.575, .425}, {.575, .406}}}};
    for (const auto& [name, corners] : regions) {
        const Spectrum glass = *named_filter(name);
        const Chromaticity xy =
            chromaticity_of(unit_luminance_xyz([&](double l) { return illuminant_a(l) * glass(l); }));
        bool in = false;
        for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
            const Chromaticity a = corners[i];
            const Chromaticity b = corners[j];
            if ((a.y > xy.y) != (b.y > xy.y) && xy.x < (b.x - a.x) * (xy.y - a.y) / (b.y - a.y) + a.x)
                in = !in;
        }
        EXPECT_TRUE(in) << name << " at " << xy.x << ", " << xy.y;
    }
}

TEST(SpectralDistance, IsHowFarTheLightMustBeMoved) {
    const auto at = [](double nm) {
        return *LampSpectrum::from([=](double l) { return gaussian(l, nm, 2); });
    };
    EXPECT_EQ(spectral_distance_nm(at(550), at(550)), 0);
    EXPECT_NEAR(spectral_distance_nm(at(550), at(580)), 30, 0.3);
    EXPECT_NEAR(spectral_distance_nm(at(480), at(620)), 140, 0.6);
    EXPECT_EQ(spectral_distance_nm(at(480), at(620)), spectral_distance_nm(at(620), at(480)));
}

TEST(LampSpectrum, RefusesWhatHasNoLight) {
    EXPECT_FALSE(LampSpectrum::from([](double) { return 0.0; }));
    EXPECT_FALSE(LampSpectrum::from([](double l) { return l < 500 ? -1.0 : 1.0; }));
    EXPECT_FALSE(LampSpectrum::from([](double) { return std::nan(""); }));
    EXPECT_FALSE(LampSpectrum::from(std::vector<double>{800, 900}, std::vector<double>{1, 1}));
    EXPECT_TRUE(LampSpectrum::from([](double) { return 1e300; }));
}

// Sums over few wavelengths against those over every nanometre of the published table.
TEST(Spectrum, PointSamplesOfD65AreOffByTheKnownAmounts) {
    const std::filesystem::path folder = std::filesystem::path(SEAGLARE_SHARED_DIR) / "data" / "cie";
    std::map<int, Xyz> cmf;
    std::map<int, double> power;
    std::ifstream observer(folder / "cie1931_2deg_cmf_1nm.csv");
    std::ifstream daylight(folder / "cie_d65_1nm.csv");
    if (!observer || !daylight) GTEST_SKIP() << "the published tables are not at " << folder;
    std::string line;
    char comma = 0;
    for (std::getline(observer, line); std::getline(observer, line);) {
        std::istringstream fields(line);
        double l = 0;
        Xyz xyz;
        fields >> l >> comma >> xyz.x >> comma >> xyz.y >> comma >> xyz.z;
        cmf[static_cast<int>(l)] = xyz;
    }
    for (std::getline(daylight, line); std::getline(daylight, line);) {
        std::istringstream fields(line);
        double l = 0;
        double value = 0;
        fields >> l >> comma >> value;
        power[static_cast<int>(l)] = value;
    }
    const auto between = [](const auto& table, double l) {
        const int below = std::min(static_cast<int>(l), 779);
        return std::tuple(table.at(below), table.at(below + 1), l - below);
    };
    const auto white = [&](int count, double step_nm) {
        Xyz sum;
        for (int i = 0; i < count; ++i) {
            const double l = 380 + step_nm * i;
            const auto [a, b, t] = between(cmf, l);
            const auto [p, q, u] = between(power, l);
            const double s = p + u * (q - p);
            sum.x += s * (a.x + t * (b.x - a.x));
            sum.y += s * (a.y + t * (b.y - a.y));
            sum.z += s * (a.z + t * (b.z - a.z));
        }
        return chromaticity_of(sum);
    };
    const Chromaticity truth = white(401, 1);
    const auto off = [&](int count, double step_nm) {
        const Chromaticity xy = white(count, step_nm);
        return std::array<double, 2>{xy.x - truth.x, xy.y - truth.y};
    };
    EXPECT_LT(std::max(std::abs(off(81, 5)[0]), std::abs(off(81, 5)[1])), 2.2e-5);
    EXPECT_LT(std::max(std::abs(off(41, 10)[0]), std::abs(off(41, 10)[1])), 1.2e-4);
    EXPECT_NEAR(off(30, 400.0 / 29)[0], -2.5e-4, 3e-5);
    EXPECT_NEAR(off(30, 400.0 / 29)[1], -3.5e-4, 4e-5);
    EXPECT_NEAR(off(8, 400.0 / 7)[0], 6e-3, 1e-3);
    EXPECT_NEAR(off(8, 400.0 / 7)[1], -1.2e-2, 1e-3);
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
