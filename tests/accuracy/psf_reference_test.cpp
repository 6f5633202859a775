// The reference against closed forms, and production against the reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <memory>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "glare/colour/navigation_colours.h"
#include "glare/colour/spectrum.h"
#include "glare/psf/pattern_sources.h"
#include "glare/reference/comparison.h"
#include "glare/reference/reference_pattern.h"

namespace seaglare::reference {
namespace {

constexpr double wavelength_nm = 575;
constexpr double wavelength_mm = wavelength_nm * 1e-6;

glare::EyeModel clear_eye() {
    glare::EyeModel eye;
    eye.cie_tail = false;
    return eye;
}

// Mean over rings one pixel wide, in energy per steradian.
std::vector<double> radial_mean(const Plane& plane, int radius, double pitch) {
    std::vector<double> sum(static_cast<std::size_t>(radius) + 1);
    std::vector<double> count(sum.size());
    std::size_t i = 0;
    for (int b = -radius; b <= radius; ++b) {
        for (int a = -radius; a <= radius; ++a, ++i) {
            const auto ring = static_cast<std::size_t>(std::lround(std::hypot(a, b)));
            if (ring >= sum.size()) continue;
            sum[ring] += plane[i] / (pitch * pitch);
            count[ring] += 1;
        }
    }
    for (std::size_t ring = 0; ring < sum.size(); ++ring)
        sum[ring] /= count[ring];
    return sum;
}

double parabola_offset(double before, double middle, double after) {
    return 0.5 * (before - after) / (before - 2 * middle + after);
}

// Along the u axis, on pixels a fiftieth of the null wide: wider ones would move it.
void expect_airy(double pupil_mm, double null_rad, double fwhm_rad) {
    const double pitch = null_rad / 50;
    constexpr int radius = 75;
    const Diffraction diffraction(aperture_of(clear_eye(), pupil_mm, 0, 1),
                                  (radius + 1) * pitch / wavelength_mm);
    const Plane plane = diffraction.pattern(wavelength_nm, pitch, radius);
    const auto along = [&](int a) {
        return plane[static_cast<std::size_t>(radius) * (2 * radius + 1) +
                     static_cast<std::size_t>(radius + a)];
    };
    int lowest = 25;
    for (int a = 25; a < 75; ++a)
        if (along(a) < along(lowest)) lowest = a;
    const double null =
        (lowest + parabola_offset(along(lowest - 1), along(lowest), along(lowest + 1))) * pitch;
    EXPECT_NEAR(null, null_rad, 0.002 * null_rad);
    int above = 0;
    while (along(above + 1) > along(0) / 2)
        ++above;
    const double half = above + (along(above) - along(0) / 2) / (along(above) - along(above + 1));
    EXPECT_NEAR(2 * half * pitch, fwhm_rad, 0.002 * fwhm_rad);
    double inside = 0;
    std::size_t i = 0;
    for (int b = -radius; b <= radius; ++b)
        for (int a = -radius; a <= radius; ++a, ++i)
            if (std::hypot(a, b) * pitch < null_rad) inside += plane[i];
    EXPECT_NEAR(inside, 0.8378, 0.0015);
}

// 1.2197 and 1.0290 lambda/D; 83.8 % of the energy inside the null (Born & Wolf, Principles of Optics, 8.5.2).
TEST(Reference, CircularPupilsHaveAirysNullWidthAndEnergy) {
    expect_airy(3, 2.338e-4, 1.029 * wavelength_mm / 3);
    expect_airy(7, 1.002e-4, 1.029 * wavelength_mm / 7);
}

// The intensity of a whole Airy pattern at one place, not only its landmarks.
TEST(Reference, FollowsAirysFormulaPixelByPixel) {
    constexpr double pupil_mm = 3;
    constexpr double pitch = 4e-6;
    constexpr int radius = 40;
    const Diffraction diffraction(aperture_of(clear_eye(), pupil_mm, 0, 1),
                                  (radius + 1) * pitch / wavelength_mm);
    const Plane plane = diffraction.pattern(wavelength_nm, pitch, radius);
    const double peak = std::numbers::pi * pupil_mm * pupil_mm / 4 / (wavelength_mm * wavelength_mm);
    std::size_t i = 0;
    for (int b = -radius; b <= radius; ++b) {
        for (int a = -radius; a <= radius; ++a, ++i) {
            double expected = 0;
            for (int j = -1; j <= 1; ++j) {
                for (int k = -1; k <= 1; ++k) {
                    // Simpson's rule over the pixel.
                    const double t = std::numbers::pi * pupil_mm / wavelength_mm *
                                     std::hypot(a + 0.5 * k, b + 0.5 * j) * pitch;
                    const double amplitude = t > 0 ? 2 * std::cyl_bessel_j(1.0, t) / t : 1;
                    expected += (j == 0 ? 4 : 1) * (k == 0 ? 4 : 1) * amplitude * amplitude / 36;
                }
            }
            ASSERT_NEAR(plane[i] / (pitch * pitch) / peak, expected, 2e-4) << a << " " << b;
        }
    }
}

// Where the ring of radial lines between two radii stands: the centre of its energy over what lies under it.
double ring_sine(const Diffraction& diffraction, double nm, double expected, int radius, double pitch) {
    const auto mean = radial_mean(diffraction.pattern(nm, pitch, radius), radius, pitch);
    const auto first = static_cast<std::size_t>(0.8 * expected / pitch);
    const auto last = static_cast<std::size_t>(1.2 * expected / pitch);
    const double base = std::min(mean[first - 1], mean[last]);
    double weight = 0;
    double moment = 0;
    for (std::size_t i = first; i < last; ++i) {
        weight += (mean[i] - base) * static_cast<double>(i);
        moment += (mean[i] - base) * static_cast<double>(i * i) * pitch;
    }
    return moment / weight;
}

// sin(theta) = lambda count/(2 pi r) (the grating equation at the radius of the lines).
TEST(Reference, GratingsRingAtLambdaOverTheirPitch) {
    for (int count : {600, 1000, 1400}) {
        glare::EyeModel eye = clear_eye();
        eye.gratings = {count, 1.4, 1.5, 0.5, 1};
        const double sine = wavelength_mm * count / (2 * std::numbers::pi * 1.45);
        const int radius = 48;
        const double pitch = 1.35 * sine / radius;
        const Diffraction diffraction(aperture_of(eye, 3, 0, 1), (radius + 1) * pitch / wavelength_mm);
        EXPECT_NEAR(ring_sine(diffraction, wavelength_nm, sine, radius, pitch), sine, 0.02 * sine) << count;
    }
}

TEST(Reference, ParticlesHaveTheirNullAtOnePointTwoTwoLambdaOverD) {
    for (double diameter_um : {10.0, 20.0, 40.0}) {
        glare::EyeModel eye = clear_eye();
        // Few enough to overlap little.
        eye.particles = {{static_cast<int>(20000 / diameter_um), diameter_um, diameter_um, 2.5, 1.5}};
        const double expected = 1.2197 * wavelength_mm / (diameter_um / 1000);
        constexpr int radius = 60;
        const double pitch = 1.4 * expected / radius;
        const Diffraction diffraction(aperture_of(eye, 3, 0, 1), (radius + 1) * pitch / wavelength_mm);
        const auto mean = radial_mean(diffraction.pattern(wavelength_nm, pitch, radius), radius, pitch);
        const auto first = static_cast<std::ptrdiff_t>(0.7 * expected / pitch);
        const auto lowest =
            static_cast<std::size_t>(std::min_element(mean.begin() + first, mean.end() - 1) - mean.begin());
        const double null = (static_cast<double>(lowest) +
                             parabola_offset(mean[lowest - 1], mean[lowest], mean[lowest + 1])) *
                            pitch;
        EXPECT_NEAR(null, expected, 0.02 * expected) << diameter_um << " um";
    }
}

// What every wavelength brings, summed over a field that scales with it: no wavelength may win or lose.
TEST(Reference, EveryWavelengthBringsTheSameEnergy) {
    const Aperture aperture = aperture_of(glare::young_eye(), 3, 0, 7);
    constexpr int radius = 30;
    std::vector<double> energies;
    const Diffraction diffraction(aperture, (radius + 1) * 2e-5 / 380e-6);
    for (double nm : {380.0, 480.0, 575.0, 680.0, 780.0}) {
        const Plane plane = diffraction.pattern(nm, 2e-5 * nm / 380, radius);
        double energy = 0;
        for (double value : plane)
            energy += value;
        energies.push_back(energy);
    }
    for (double energy : energies)
        EXPECT_NEAR(energy, energies.front(), 1e-9);
    // And over the whole circle it is what the aperture passes: half-wave scatterers take nothing.
    EXPECT_NEAR(transmitted(aperture, 0.002), 1, 1e-12);
    EXPECT_NEAR(transmitted(aperture_of(glare::young_eye(), 7, 0, 7), 0.002),
                glare::transmitted_fraction(glare::young_eye(), 7), 1e-4);
}

// A blind over half of the pupil takes half of the light, and by Parseval's theorem the pattern has that half; one that
// leaves a slit spreads it across, with its null at lambda/width (Born & Wolf, 8.5.1).
TEST(Reference, BlindsTakeTheLightThatTheyCover) {
    Aperture aperture = aperture_of(clear_eye(), 3, 0, 1);
    aperture.blinds_mm = {{0, -4, 4, -4, 4, 4, 0, 4}};
    EXPECT_NEAR(transmitted(aperture, 0.002), 0.5, 1e-6);
    aperture.blinds_mm = {{0.1, -4, 4, -4, 4, 4, 0.1, 4}, {-4, -4, -0.1, -4, -0.1, 4, -4, 4}};
    constexpr int radius = 40;
    const double null = wavelength_mm / 0.2;
    const double pitch = null / 25;
    const Diffraction diffraction(aperture, (radius + 1) * pitch / wavelength_mm);
    const Plane plane = diffraction.pattern(wavelength_nm, pitch, radius);
    std::vector<double> across(static_cast<std::size_t>(radius) + 1);
    for (int a = 0; a <= radius; ++a)
        for (int b = -radius; b <= radius; ++b)
            across[static_cast<std::size_t>(a)] +=
                plane[static_cast<std::size_t>(b + radius) * (2 * radius + 1) +
                      static_cast<std::size_t>(radius + a)];
    const auto lowest = std::min_element(across.begin() + 10, across.begin() + 38) - across.begin();
    EXPECT_NEAR(static_cast<double>(lowest) * pitch, null, pitch);
    const double inside =
        2 * std::accumulate(across.begin() + 1, across.begin() + 25, 0.0) + across[0] + across[25];
    // 2 Si(2 pi)/pi = 0.9028 of a slit's energy lies between its nulls.
    EXPECT_NEAR(inside / transmitted(aperture, 0.001), 0.9028, 0.008);
}

TEST(Reference, BlueStaysInsideGreenInsideRed) {
    glare::EyeModel eye = clear_eye();
    eye.gratings = {700, 1.4, 1.5, 0.5, 1};
    constexpr int radius = 48;
    constexpr double longest_mm = 650e-6;
    const double pitch = 1.35 * longest_mm * 700 / (2 * std::numbers::pi * 1.45) / radius;
    const Diffraction diffraction(aperture_of(eye, 3, 0, 1), (radius + 1) * pitch / 450e-6);
    for (double nm : {450.0, 550.0, 650.0}) {
        const double expected = nm * 1e-6 * 700 / (2 * std::numbers::pi * 1.45);
        EXPECT_NEAR(ring_sine(diffraction, nm, expected, radius, pitch), expected, 0.02 * expected) << nm;
    }
}

TEST(Reference, DaylightsPatternIntegratesToDaylightsWhite) {
    Rgbv sum{};
    for (const SpectralLine& line : lines_of(glare::d65))
        for (std::size_t c = 0; c < 4; ++c)
            sum[c] += line.rgbv[c];
    const double x = 0.4124 * sum[0] + 0.3576 * sum[1] + 0.1805 * sum[2];
    const double y = 0.2126 * sum[0] + 0.7152 * sum[1] + 0.0722 * sum[2];
    const double z = 0.0193 * sum[0] + 0.1192 * sum[1] + 0.9505 * sum[2];
    EXPECT_NEAR(x / (x + y + z), 0.3127, 5e-4);
    EXPECT_NEAR(y / (x + y + z), 0.3290, 5e-4);
    EXPECT_NEAR(y, 1, 5e-4);
    EXPECT_NEAR(sum[3], 2.464, 0.01);

    // A pupil with nothing in it, over a field that holds all but the far wings: so does the pattern.
    ReferenceRequest request;
    request.eye = clear_eye();
    request.pupil_mm = 3;
    request.pitch = 2e-4;
    request.radius = 20;
    const ReferencePattern pattern = make_reference(request, lines_of(glare::d65));
    Rgbv total{};
    for (const Rgbv& pixel : pattern.pixels)
        for (std::size_t c = 0; c < 4; ++c)
            total[c] += pixel[c] * request.pitch * request.pitch;
    const double px = 0.4124 * total[0] + 0.3576 * total[1] + 0.1805 * total[2];
    const double py = 0.2126 * total[0] + 0.7152 * total[1] + 0.0722 * total[2];
    const double pz = 0.0193 * total[0] + 0.1192 * total[1] + 0.9505 * total[2];
    EXPECT_GT(py, 0.97);
    EXPECT_NEAR(px / (px + py + pz), 0.3127, 1e-3);  // the wings that are missing are a little red
    EXPECT_NEAR(py / (px + py + pz), 0.3290, 1e-3);
}

TEST(Reference, DiscsHaveTheirExactAreaInEveryPixel) {
    EXPECT_NEAR(disc_area_in_rectangle(1, -1, 1, -1, 1), std::numbers::pi, 1e-12);
    EXPECT_NEAR(disc_area_in_rectangle(1, 0, 2, 0, 2), std::numbers::pi / 4, 1e-12);
    EXPECT_NEAR(disc_area_in_rectangle(5, -0.5, 0.5, -0.5, 0.5), 1, 1e-12);
    // A segment of the unit circle beyond x = 1/2: acos(1/2) - (1/2) sqrt(3)/2.
    EXPECT_NEAR(disc_area_in_rectangle(1, 0.5, 1.5, -2, 2), std::acos(0.5) - std::sqrt(3) / 4, 1e-12);
    for (double radius : {0.3, 1.0, 2.5, 7.7}) {
        double sum = 0;
        for (int y = -9; y <= 9; ++y)
            for (int x = -9; x <= 9; ++x)
                sum += disc_area_in_rectangle(radius, x - 0.5, x + 0.5, y - 0.5, y + 0.5);
        EXPECT_NEAR(sum, std::numbers::pi * radius * radius, 1e-10) << radius;
    }
}

TEST(Reference, RefusesWhatIsBeyondItsBand) {
    const Diffraction diffraction(aperture_of(clear_eye(), 3, 0, 1), 10);
    EXPECT_THROW(diffraction.pattern(380, 1e-3, 40), std::invalid_argument);
    EXPECT_THROW(diffraction.pattern(380, 0, 4), std::invalid_argument);
    EXPECT_THROW(lines_of([](double) { return 0.0; }), std::invalid_argument);
}

// FFTW is under the GPL: tests and the report may use it, the plug-in may not hold or need it.
TEST(Reference, TheLibraryNeitherNeedsNorHoldsFftw) {
    std::ifstream file(SEAGLARE_LIBRARY, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    ASSERT_NE(bytes.find("libOpenCL.so"), std::string::npos)
        << "the names of needed libraries are looked for";
    EXPECT_EQ(bytes.find("libfftw"), std::string::npos);
    EXPECT_EQ(bytes.find("fftw_execute"), std::string::npos);
}

// Production against the reference, on a channel of 720 lines over 45 degrees.
struct Case {
    glare::EyeModel eye;
    glare::PatternSettings settings;
    double pupil_mm = 3;
    unsigned lamp = 0;
    int radius = 0;  // of the reference; at least what the pattern reaches
    std::uint64_t seed = 1;
};

enum class Device { opencl, plain };

std::unique_ptr<glare::PatternSource> source_of(const Case& c, Device device) {
    return device == Device::opencl ? glare::make_cl_pattern_source(c.eye, c.settings, c.seed)
                                    : glare::make_cpu_pattern_source(c.eye, c.settings, c.seed);
}

ReferencePattern truth_of(const Case& c, const glare::Pattern& pattern) {
    ReferenceRequest truth;
    truth.eye = c.eye;
    truth.pupil_mm = c.pupil_mm;
    truth.seed = c.seed;
    truth.pitch = pattern.pitch;
    truth.radius = std::max(c.radius, static_cast<int>(std::ceil(pattern.window_outer / pattern.pitch)));
    truth.angular_scale = c.settings.angular_scale;
    return make_reference(truth, lines_of(glare::navigation_spectrum(static_cast<int>(c.lamp))));
}

void expect_close_for_its_seed(const Case& c, const PatternError& most) {
    ReferencePattern reference;
    for (const Device device : {Device::plain, Device::opencl}) {
        const char* const name = device == Device::plain ? "plain" : "OpenCL";
        std::unique_ptr<glare::PatternSource> source;
        try {
            source = source_of(c, device);
        } catch (const std::runtime_error& error) {
            if (device == Device::opencl) GTEST_SKIP() << error.what();
            throw;
        }
        glare::PatternRequest request;
        request.pupil_mm = c.pupil_mm;
        request.pitch = 1 / 869.1;
        request.lamps = 1U << c.lamp;
        request.largest_disc_nodes = 100;
        const glare::Pattern& pattern = source->make(request);
        if (reference.pixels.empty()) reference = truth_of(c, pattern);
        for (std::size_t layer = 0; layer < pattern.layer_radius_nodes.size(); ++layer) {
            const PatternError e = compare(reference, c.eye, pattern, c.settings.core_radius_nodes, 0, layer);
            EXPECT_LT(e.relative_l1, most.relative_l1) << name << " layer " << layer;
            EXPECT_LT(e.skirt_l1, most.skirt_l1) << name << " layer " << layer;
            if (layer == 0) {
                EXPECT_LT(e.total_l1, most.total_l1) << name;
            }
            EXPECT_LT(e.worst_of_peak, most.worst_of_peak) << name << " layer " << layer;
            EXPECT_LT(e.worst_relative, most.worst_relative) << name << " layer " << layer;
            EXPECT_LT(e.core_delta_e, most.core_delta_e) << name << " layer " << layer;
            EXPECT_LT(std::abs(e.core_energy), most.core_energy) << name << " layer " << layer;
            // Made from the same structure, they needed the same correction of its energy.
            EXPECT_NEAR(pattern.structure_scale, e.structure_scale, most.structure_scale) << name;
        }
    }
}

// The error next to the core varies fourfold from seed to seed: one eye shows nothing of the worst.
void expect_close(Case c, const PatternError& most) {
    for (c.seed = 1; c.seed <= 4 && !::testing::Test::IsSkipped(); ++c.seed) {
        SCOPED_TRACE("seed " + std::to_string(c.seed));
        expect_close_for_its_seed(c, most);
    }
}

PatternError most(double l1, double skirt, double total, double of_peak, double relative, double delta_e,
                  double core, double scale) {
    return {l1, skirt, total, of_peak, relative, delta_e, 0, core, scale};
}

glare::PatternSettings quick_settings(double plane_width_mm) {
    glare::PatternSettings settings;
    settings.transform_size = 1024;
    settings.plane_width_mm = plane_width_mm;
    settings.layer_radii_px = {0, 3};
    settings.max_radius_nodes = 30;
    return settings;
}

// The bounds are a fifth above what was measured of the worst of the four eyes. Of the skirt's L1 most is next to the core, where the energy of a
// sample is spread evenly over its square.
TEST(ProductionAgainstReference, AYoungEyesWhiteLight) {
    expect_close({glare::young_eye(), quick_settings(4.5)},
                 most(0.0047, 0.0124, 0.037, 0.071, 0.077, 0.097, 0.0016, 1e-4));
}

TEST(ProductionAgainstReference, AYoungEyesRedLight) {
    expect_close({glare::young_eye(), quick_settings(4.5), 3, 1},
                 most(0.0076, 0.0169, 0.0321, 0.062, 0.116, 0.039, 0.002, 1e-4));
}

TEST(ProductionAgainstReference, AnOldEyesWhiteLight) {
    expect_close({glare::sixty_year_eye(), quick_settings(9), 5},
                 most(0.0016, 0.0036, 0.059, 0.0069, 0.068, 0.039, 0.00041, 1.1e-4));
}

TEST(ProductionAgainstReference, AnEyeBehindLashesHalfShut) {
    Case c{glare::young_eye(), quick_settings(4.5)};
    c.eye.eyelashes.count = 6;
    c.eye.lids.closure = 0.4;
    expect_close(c, most(0.0044, 0.0092, 0.035, 0.0461, 0.065, 0.063, 0.0009, 2.3e-4));
}

TEST(Reference, RefusesAnEyeOutOfFocus) {
    glare::EyeModel eye = clear_eye();
    eye.defocus_dioptre = 0.5;
    EXPECT_THROW(aperture_of(eye, 3, 0, 1), std::invalid_argument);
}

// One sample to a pixel, and the plane hardly wider than the pupil: the power spectrum is sampled at less than its
// Nyquist rate, and the needles are wrong by a fifth. It is a look, not a measurement.
TEST(ProductionAgainstReference, TheThesisLook) {
    Case c{glare::thesis_eye(), glare::thesis_settings(), 6.5};
    c.settings.max_radius_nodes = 60;
    c.settings.layer_radii_px = {0, 3};
    expect_close(c, most(0.134, 0.254, 0.21, 0.33, 5.9, 2.0, 0.0391, 8e-4));
}

TEST(ProductionAgainstReference, TheThesisLookOfAPlaneTwiceAsWide) {
    Case c{glare::thesis_eye(), glare::thesis_settings(), 6.5};
    c.settings.max_radius_nodes = 60;
    c.settings.transform_size = 1024;
    c.settings.plane_width_mm = 18;
    c.settings.layer_radii_px = {0, 3};
    expect_close(c, most(0.0481, 0.063, 0.112, 0.106, 0.99, 0.84, 0.0231, 8e-4));
}

}  // namespace
}  // namespace seaglare::reference
