// Conservation: what the pattern of a white light adds up to, layer by layer.
#include "glare/colour/chromaticity.h"
#include "glare/psf/cie_curve.h"
#include "tests/cl/pattern_fixture.h"

namespace seaglare::glare {
namespace {

PatternSettings settings_1024() {
    PatternSettings settings;
    settings.transform_size = 1024;
    return settings;
}

double tail_energy(const Pattern& p) {
    return p.tail_scale *
           cie_tail_energy(p.tail_age_years, p.tail_pigmentation, p.window_inner, p.window_outer);
}

TEST(PatternEnergy, CoreSkirtAndTailOfEveryLayerAreWhatThePupilPasses) {
    const EyeModel eye = young_eye();
    SEAGLARE_CL_SOURCE(source, eye, settings_1024(), sample_d65(30));
    for (double pupil_mm : {2.5, 5.0, 7.4}) {
        PatternRequest request;
        request.pupil_mm = pupil_mm;
        request.pitch = 1 / 869.1;
        request.largest_disc_nodes = 12;
        const Pattern& pattern = source->make(request);
        ASSERT_EQ(pattern.layer_radius_nodes.size(), 5U);
        EXPECT_NEAR(pattern.structure_scale, 1, 0.1) << pupil_mm;
        const double passed = transmitted_fraction(eye, pupil_mm);
        for (std::size_t layer = 0; layer < 5; ++layer) {
            const auto skirt = skirt_energy(pattern, layer);
            for (std::size_t c = 0; c < 4; ++c)
                EXPECT_NEAR(static_cast<double>(pattern.core_energy[0][c]) + skirt[c] + tail_energy(pattern),
                            passed, 0.001 * passed)
                    << "pupil " << pupil_mm << " layer " << layer << " channel " << c;
        }
    }
}

// What a grating line of amplitude 1 - m lets pass, over the annulus inside the pupil.
TEST(PatternEnergy, OnlyGratingsAbsorb) {
    EyeModel eye = young_eye();
    EXPECT_DOUBLE_EQ(transmitted_fraction(eye, 5), 1);
    EXPECT_NEAR(transmitted_fraction(eye, 7), 1 - 2.56 / 12.25 * 0.5 * (1 - 0.65 * 0.65), 1e-12);
    eye.gratings.count = 0;
    EXPECT_DOUBLE_EQ(transmitted_fraction(eye, 7), 1);
}

TEST(PatternEnergy, IntegratesToTheWhiteOfD65) {
    SEAGLARE_CL_SOURCE(source, young_eye(), settings_1024(), sample_d65(30));
    PatternRequest request;
    request.pupil_mm = 6;
    request.pitch = 1 / 1303.7;
    const Pattern& pattern = source->make(request);
    const auto skirt = skirt_energy(pattern, 0);
    std::array<double, 3> rgb{};
    for (std::size_t c = 0; c < 3; ++c)
        rgb[c] = static_cast<double>(pattern.core_energy[0][c]) + skirt[c] + tail_energy(pattern);
    const Chromaticity xy = chromaticity_of(xyz_from_srgb(rgb));
    EXPECT_NEAR(xy.x, 0.3127, 5e-4);
    EXPECT_NEAR(xy.y, 0.3290, 5e-4);
}

TEST(PatternEnergy, ThePatternIsPointSymmetricAndFinite) {
    SEAGLARE_CL_SOURCE(source, young_eye(), settings_1024(), sample_d65(30));
    PatternRequest request;
    request.pupil_mm = 6;
    request.pitch = 1 / 869.1;
    request.largest_disc_nodes = 3;
    const Pattern& pattern = source->make(request);
    for (std::size_t layer = 0; layer < pattern.layer_radius_nodes.size(); ++layer) {
        for_each_node(pattern, [&](int a, int b) {
            const Rgbv here = node(pattern, layer, a, b);
            const Rgbv there = node(pattern, layer, -a, -b);
            for (std::size_t c = 0; c < 4; ++c) {
                ASSERT_TRUE(std::isfinite(here[c]));
                ASSERT_EQ(here[c], there[c]) << layer << ": " << a << ", " << b;
            }
        });
    }
}

TEST(PatternEnergy, OnlyTheLayersThatAreNeededAreMade) {
    SEAGLARE_CL_SOURCE(source, young_eye(), settings_1024(), sample_d65(3));
    PatternRequest request;
    request.pupil_mm = 6;
    request.pitch = 1 / 869.1;
    EXPECT_EQ(source->make(request).layer_radius_nodes, (std::vector<float>{0}));
    request.largest_disc_nodes = 1;
    EXPECT_EQ(source->make(request).layer_radius_nodes, (std::vector<float>{0, 1.5F}));
    request.largest_disc_nodes = 2.5F;
    EXPECT_EQ(source->make(request).layer_radius_nodes, (std::vector<float>{0, 1.5F, 3}));
    request.largest_disc_nodes = 1000;
    EXPECT_EQ(source->make(request).layer_radius_nodes.size(), 5U);
}

// The same instant gives the same pattern to the last bit, whatever was made in between; another instant another one.
TEST(PatternEnergy, ThePatternIsAPureFunctionOfItsRequest) {
    EyeModel eye = young_eye();
    eye.particles[2].drift_um = 80;
    SEAGLARE_CL_SOURCE(source, eye, settings_1024(), sample_d65(10));
    PatternRequest request;
    request.pupil_mm = 6;
    request.pitch = 1 / 869.1;
    request.time_s = 1e7;
    const std::vector<float> first = source->make(request).skirt;
    request.time_s = 1e7 + 3;
    const std::vector<float> later = source->make(request).skirt;
    request.time_s = 1e7;
    EXPECT_EQ(source->make(request).skirt, first);
    EXPECT_NE(later, first);
}

TEST(PatternEnergy, RequestsAtTheEdgesAreAnsweredOrRefused) {
    SEAGLARE_CL_SOURCE(source, young_eye(), settings_1024(), sample_d65(3));
    PatternRequest request;
    request.pitch = 0;
    request.pupil_mm = 6;
    EXPECT_THROW(source->make(request), std::invalid_argument);
    request.pitch = std::nan("");
    EXPECT_THROW(source->make(request), std::invalid_argument);
    for (double pitch : {1e-6, 1.0, 50.0}) {
        for (double pupil_mm : {0.0, 100.0, std::nan("")}) {
            request.pitch = pitch;
            request.pupil_mm = pupil_mm;
            const Pattern& pattern = source->make(request);
            for (float value : pattern.skirt)
                ASSERT_TRUE(std::isfinite(value)) << pitch << ", " << pupil_mm;
            for (float value : pattern.core_energy[0])
                ASSERT_TRUE(std::isfinite(value)) << pitch << ", " << pupil_mm;
        }
    }
}

}  // namespace
}  // namespace seaglare::glare
