// The pattern against diffraction's closed forms: circular pupil, random discs, radial gratings.
#include <algorithm>
#include <numbers>

#include "tests/cl/pattern_fixture.h"

namespace seaglare::glare {
namespace {

constexpr double wavelength_mm = 575e-6;

// One node per sample of the transform: nothing is averaged, the null keeps its place.
struct Airy {
    double null_rad = 0;
    double inside_null = 0;  // fraction of the energy
};

Airy measure_airy(PatternSource& source, const PatternSettings& settings, double pupil_mm,
                  double expected_rad) {
    PatternRequest request;
    request.pupil_mm = pupil_mm;
    request.pitch = wavelength_mm / settings.plane_width_mm;
    const Pattern& pattern = source.make(request);
    const auto along_u = [&](int a) { return static_cast<double>(node(pattern, 0, a, 0)[1]); };
    const int expected_node = static_cast<int>(std::lround(expected_rad / pattern.pitch));
    int lowest = std::max(2, expected_node / 2);
    for (int a = lowest; a <= expected_node * 3 / 2; ++a)
        if (along_u(a) < along_u(lowest)) lowest = a;
    Airy airy;
    airy.null_rad =
        (lowest + parabola_offset(along_u(lowest - 1), along_u(lowest), along_u(lowest + 1))) * pattern.pitch;
    double inside = static_cast<double>(pattern.core_energy[0][1]);
    for_each_node(pattern, [&](int a, int b) {
        if (std::hypot(a, b) * pattern.pitch < expected_rad)
            inside += static_cast<double>(node(pattern, 0, a, b)[1]) * pattern.pitch * pattern.pitch;
    });
    airy.inside_null = inside / pattern.structure_scale;
    return airy;
}

PatternSettings fine_settings() {
    PatternSettings settings;
    settings.transform_size = 4096;
    settings.plane_width_mm = 64;
    settings.max_radius_nodes = 200;
    settings.layer_radii_px = {0};
    settings.core_radius_nodes = 0.5;
    return settings;
}

// 1.2197 lambda/D at 575 nm; 83.8 % inside (Born & Wolf, Principles of Optics, 8.5.2).
TEST(ClosedForm, CircularPupilsHaveAirysNullAndEnergy) {
    const PatternSettings settings = fine_settings();
    SEAGLARE_CL_SOURCE(source, clear_eye(), settings, one_wavelength(575));
    const Airy small = measure_airy(*source, settings, 3, 2.338e-4);
    EXPECT_NEAR(small.null_rad, 2.338e-4, 2.338e-6);
    EXPECT_NEAR(small.inside_null, 0.838, 0.004);
    const Airy large = measure_airy(*source, settings, 7, 1.002e-4);
    EXPECT_NEAR(large.null_rad, 1.002e-4, 1.002e-6);
    EXPECT_NEAR(large.inside_null, 0.838, 0.008);
}

PatternSettings wide_settings() {
    PatternSettings settings;
    settings.transform_size = 2048;
    settings.layer_radii_px = {0};
    return settings;
}

// First null of a disc's diffraction: 1.22 lambda/d, whatever its neighbours.
TEST(ClosedForm, ParticlesHaveTheirNullAtOnePointTwoTwoLambdaOverD) {
    for (double diameter_um : {30.0, 40.0}) {
        EyeModel eye = clear_eye();
        eye.particles = {{2000, diameter_um, diameter_um, 2.5}};
        SEAGLARE_CL_SOURCE(source, eye, wide_settings(), one_wavelength(575));
        PatternRequest request;
        request.pupil_mm = 7;
        request.pitch = 4e-4;
        const Pattern& pattern = source->make(request);
        const std::vector<double> mean = radial_mean(pattern, 1);
        const double expected = 1.2197 * wavelength_mm / (diameter_um / 1000);
        const auto middle = static_cast<std::size_t>(std::lround(expected / pattern.pitch));
        const auto lowest = static_cast<std::size_t>(
            std::min_element(mean.begin() + static_cast<std::ptrdiff_t>(middle / 2),
                             mean.begin() + static_cast<std::ptrdiff_t>(std::min(
                                                middle * 3 / 2, static_cast<std::size_t>(
                                                                    pattern.window_inner / pattern.pitch)))) -
            mean.begin());
        const double null = (static_cast<double>(lowest) +
                             parabola_offset(mean[lowest - 1], mean[lowest], mean[lowest + 1])) *
                            pattern.pitch;
        EXPECT_NEAR(null, expected, 0.02 * expected) << diameter_um << " um";
    }
}

struct Ring {
    double sine = 0;
    double energy = 0;  // of the light on the open pupil
};

// `below`: the same pattern without gratings, whose wings are taken off.
Ring measure_ring(const Pattern& pattern, const Pattern& below, std::size_t channel, double expected_sine) {
    const std::vector<double> mean = radial_mean(pattern, channel);
    const std::vector<double> base = radial_mean(below, channel);
    Ring ring;
    double moment = 0;
    const auto first = static_cast<std::size_t>(0.8 * expected_sine / pattern.pitch);
    const auto last = static_cast<std::size_t>(1.2 * expected_sine / pattern.pitch);
    for (std::size_t i = first; i <= last; ++i) {
        const double radius = static_cast<double>(i) * pattern.pitch;
        const double energy = (mean[i] / pattern.structure_scale - base[i] / below.structure_scale) * 2 *
                              std::numbers::pi * radius * pattern.pitch;
        ring.energy += energy;
        moment += energy * radius;
    }
    ring.sine = moment / ring.energy;
    return ring;
}

// sin(theta) = lambda N / (2 pi r), averaged over the annulus; the first orders of a grating of duty d and depth m hold
// 2 (m sin(pi d) / pi)^2 of the light on it.
TEST(ClosedForm, GratingsMakeTheirRingWithItsAngleAndEnergy) {
    for (int count : {500, 800, 1100}) {
        EyeModel eye = clear_eye();
        eye.gratings = {count, 3.0, 3.4, 0.5, 0.35};
        SEAGLARE_CL_SOURCE(source, eye, wide_settings(), one_wavelength(575));
        PatternRequest request;
        request.pupil_mm = 7;
        request.pitch = 1 / 1303.7;
        const Pattern& pattern = source->make(request);
        const double mean_inverse_radius = 2 / (3.0 + 3.4);
        const double expected = wavelength_mm * count / (2 * std::numbers::pi) * mean_inverse_radius;
        SEAGLARE_CL_SOURCE(bare, clear_eye(), wide_settings(), one_wavelength(575));
        const Ring ring = measure_ring(pattern, bare->make(request), 1, expected);
        EXPECT_NEAR(ring.sine, expected, 0.02 * expected) << count;
        const double share = (3.4 * 3.4 - 3.0 * 3.0) / (3.5 * 3.5);
        const double orders = 2 * std::pow(0.35 / std::numbers::pi, 2);
        EXPECT_NEAR(ring.energy, share * orders, 0.05 * share * orders) << count;
    }
}

// PSF_lambda(x) = (575/lambda)^2 PSF_575(575/lambda x): blue inside, red outside, the same energy.
TEST(ClosedForm, BlueLiesInsideRedWithTheSameEnergy) {
    EyeModel eye = clear_eye();
    eye.gratings = {700, 3.0, 3.4, 0.5, 0.35};
    const std::vector<SpectralSample> three = {{450, {1, 0, 0, 0}}, {575, {0, 1, 0, 0}}, {650, {0, 0, 1, 0}}};
    SEAGLARE_CL_SOURCE(source, eye, wide_settings(), three);
    SEAGLARE_CL_SOURCE(bare, clear_eye(), wide_settings(), three);
    PatternRequest request;
    request.pupil_mm = 7;
    request.pitch = 1 / 1303.7;
    const Pattern& pattern = source->make(request);
    const double at_575 = wavelength_mm * 700 / (2 * std::numbers::pi * 3.2);
    const Pattern& below = bare->make(request);
    const Ring blue = measure_ring(pattern, below, 0, at_575 * 450 / 575);
    const Ring red = measure_ring(pattern, below, 2, at_575 * 650 / 575);
    EXPECT_NEAR(red.sine / blue.sine, 650.0 / 450.0, 0.01 * 650 / 450);
    EXPECT_NEAR(red.energy / blue.energy, 1, 0.05);
    EXPECT_EQ(pattern.core_energy[0][3], 0.0F);  // nobody contributed to it

    const auto raw_energy = [&](double wavelength_nm) {
        std::string reason;
        const auto one = cl_source(eye, wide_settings(), one_wavelength(wavelength_nm), reason);
        return 1 / one->make(request).structure_scale;
    };
    const double at_middle = raw_energy(575);
    EXPECT_NEAR(raw_energy(450), at_middle, 0.005 * at_middle);
    EXPECT_NEAR(raw_energy(650), at_middle, 0.005 * at_middle);
}

}  // namespace
}  // namespace seaglare::glare
