// Lids, lashes and defocus on the device, against the plain source and against what the aperture passes.
#include <algorithm>
#include <numbers>

#include "glare/eye/veil.h"
#include "glare/psf/cpu_aperture.h"
#include "tests/cl/pattern_fixture.h"

namespace seaglare::glare {
namespace {

constexpr std::uint64_t seed = 7;  // of the fixture

PatternSettings settings_of(int n) {
    PatternSettings settings;
    settings.transform_size = n;
    settings.wavelengths = 10;
    return settings;
}

PatternRequest request_of(double pupil_mm) {
    PatternRequest request;
    request.pupil_mm = pupil_mm;
    request.pitch = 1 / 869.1;
    return request;
}

double energy(const Pattern& pattern) {
    return static_cast<double>(pattern.core_energy[0][1]) + skirt_energy(pattern, 0)[1];
}

EyeModel lashed_eye() {
    EyeModel eye = circular_pupil_eye();
    eye.eyelashes.count = 8;
    return eye;
}

double open_fraction(const EyeModel& eye, double pupil_mm, const LidPose& lids) {
    const EyeInstant instant = eye_instant(eye, pupil_mm, 0, lids, 0, seed);
    std::vector<Quad> quads;
    Veil(eye, seed).place(instant, quads);
    return transmitted_fraction(eye, instant, quads);
}

// structure_scale is what the energy of the transform had to be multiplied by: were the drawn aperture not the counted
// one, it would differ from the open pupil's.
TEST(EyeVeilOnDevice, LashesTakeTheLightThatTheyCover) {
    const EyeModel bare = circular_pupil_eye();
    const EyeModel eye = lashed_eye();
    SEAGLARE_CL_SOURCE(open, bare, settings_of(1024), sample_d65(10));
    SEAGLARE_CL_SOURCE(device, eye, settings_of(1024), sample_d65(10));
    const double scale = open->make(request_of(7)).structure_scale;
    EXPECT_NEAR(energy(open->make(request_of(7))), 1, 1e-3);
    const Pattern& pattern = device->make(request_of(7));
    const double passed = open_fraction(eye, 7, {});
    EXPECT_LT(passed, 0.99);
    EXPECT_NEAR(energy(pattern) / passed, 1, 0.005);
    EXPECT_NEAR(pattern.structure_scale / scale, 1, 0.005);
    const auto plain = make_cpu_pattern_source(eye, settings_of(1024), seed);
    const Pattern& same = plain->make(request_of(7));
    EXPECT_NEAR(energy(same) / passed, 1, 0.005);
    EXPECT_NEAR(same.structure_scale / scale, 1, 0.005);
}

TEST(EyeVeilOnDevice, AHalfShutLidTakesAboutHalfAndAShutOneAll) {
    const EyeModel eye = circular_pupil_eye();
    SEAGLARE_CL_SOURCE(device, eye, settings_of(1024), sample_d65(10));
    PatternRequest request = request_of(6);
    const double scale = device->make(request).structure_scale;
    request.lids.blink = 0.5;
    const Pattern& half = device->make(request);
    EXPECT_NEAR(energy(half) / open_fraction(eye, 6, request.lids), 1, 0.005);
    EXPECT_NEAR(energy(half), 0.45, 0.06);
    EXPECT_NEAR(half.structure_scale / scale, 1, 0.005);
    // The edge is straight and level: a streak straight up and down.
    double upright = 0;
    double level = 0;
    for (int i = 10; i < half.radius_nodes; ++i) {
        upright += static_cast<double>(node(half, 0, 0, i)[1]);
        level += static_cast<double>(node(half, 0, i, 0)[1]);
    }
    EXPECT_GT(upright, 5 * level);
    request.lids.blink = 1;
    const Pattern& shut = device->make(request);
    EXPECT_EQ(energy(shut), 0);
    for (float value : shut.skirt)
        ASSERT_EQ(value, 0);
}

TEST(EyeVeilOnDevice, TheTailIsVeiledWithTheRest) {
    EyeModel eye = young_eye();
    eye.lids.closure = 0.5;
    SEAGLARE_CL_SOURCE(device, eye, settings_of(512), sample_d65(3));
    const Pattern& pattern = device->make(request_of(5));
    EXPECT_NEAR(pattern.tail_scale, open_fraction(eye, 5, {}), 1e-6);
}

void expect_agreement(const EyeModel& eye, PatternRequest request, double most_mean) {
    SEAGLARE_CL_SOURCE(device, eye, settings_of(512), sample_d65(10));
    const auto plain = make_cpu_pattern_source(eye, settings_of(512), seed);
    request.largest_disc_nodes = 100;
    const Pattern& a = device->make(request);
    const Pattern& b = plain->make(request);
    ASSERT_EQ(a.skirt.size(), b.skirt.size());
    double sum = 0;
    double apart = 0;
    for (std::size_t i = 0; i < a.skirt.size(); ++i) {
        sum += static_cast<double>(std::abs(a.skirt[i]));
        apart += static_cast<double>(std::abs(a.skirt[i] - b.skirt[i]));
    }
    EXPECT_LT(apart / sum, most_mean);
    for (std::size_t c = 0; c < 4; ++c)
        EXPECT_NEAR(a.core_energy[0][c], b.core_energy[0][c], 2e-3F);
}

TEST(EyeVeilOnDevice, BothSourcesDrawTheSameLashesAndLids) {
    EyeModel eye = young_eye();
    eye.eyelashes.count = 6;
    expect_agreement(eye, request_of(7), 0.01);
    eye.lids.closure = 0.4;
    expect_agreement(eye, request_of(7), 0.01);
}

// Two real transforms against one complex one, whose energy at k and at -k the plain source takes the mean of.
TEST(EyeVeilOnDevice, BothSourcesAgreeOnAnEyeOutOfFocus) {
    EyeModel eye = young_eye();
    eye.defocus_dioptre = 0.5;
    eye.lids.closure = 0.3;
    expect_agreement(eye, request_of(7), 0.01);
}

// Far from diffraction the blur of a point is the pupil itself, D times its radius wide: 7 mm and 2 dioptres give a disc of
// 0.007 rad.
TEST(EyeVeilOnDevice, DefocusBlursAPointToADiscOfDTimesTheRadius) {
    EyeModel eye = circular_pupil_eye();
    eye.defocus_dioptre = 2;
    SEAGLARE_CL_SOURCE(device, eye, settings_of(2048), one_wavelength(575));
    PatternRequest request = request_of(7);
    const Pattern& pattern = device->make(request);
    const std::vector<double> mean = radial_mean(pattern, 1);
    const double edge = 2 * 3.5e-3 * 869.1;  // nodes
    const double inside = mean[4];
    EXPECT_NEAR(inside, 1 / (std::numbers::pi * 0.007 * 0.007), 0.1 * inside);
    EXPECT_GT(mean[static_cast<std::size_t>(edge) - 1], 0.5 * inside);
    EXPECT_LT(mean[static_cast<std::size_t>(edge) + 2], 0.1 * inside);
    EXPECT_NEAR(energy(pattern), 1, 1e-3);
}

// What does not hang, move or blur must not cost anything.
TEST(EyeVeilOnDevice, OnlyAnEyeOutOfFocusTakesASecondTransform) {
    EyeModel eye = young_eye();
    SEAGLARE_CL_SOURCE(plain, eye, settings_of(512), sample_d65(3));
    eye.eyelashes.count = 6;
    eye.lids.closure = 0.4;
    SEAGLARE_CL_SOURCE(veiled, eye, settings_of(512), sample_d65(3));
    eye.defocus_dioptre = 0.25;
    SEAGLARE_CL_SOURCE(blurred, eye, settings_of(512), sample_d65(3));
    const int launches = plain->make(request_of(6)).kernel_launches;
    EXPECT_EQ(veiled->make(request_of(6)).kernel_launches, launches);
    EXPECT_GT(blurred->make(request_of(6)).kernel_launches, launches);
    EXPECT_GT(veiled->device_memory_bytes(), plain->device_memory_bytes());
    // The eye at rest keeps its table whatever the time.
    PatternRequest later = request_of(6);
    later.time_s = 1;
    EXPECT_LT(plain->make(later).kernel_launches, launches);
}

// The phase belongs to one wavelength, 575 nm. At another it would be that of 575/lambda times the dioptres: the exact
// pattern of many wavelengths, one by one, against the table that serves them all.
TEST(EyeVeilOnDevice, OnePhaseForAllWavelengthsIsRightInTheMeanButForItsRim) {
    EyeModel eye = young_eye();
    eye.cie_tail = false;
    eye.defocus_dioptre = 0.5;
    const PatternSettings settings = settings_of(1024);
    SEAGLARE_CL_SOURCE(shared, eye, settings, sample_d65(10));
    PatternRequest request = request_of(7);
    request.pitch = 1 / 4030.0;  // 30 degrees over 2160 lines, where it shows most
    const Pattern& pattern = shared->make(request);
    std::vector<double> exact;
    double exact_core = 0;
    const auto spectrum = sample_d65(10);
    for (const SpectralSample& sample : spectrum) {
        EyeModel at = eye;
        at.defocus_dioptre *= 575 / sample.wavelength_nm;
        SEAGLARE_CL_SOURCE(one, at, settings, one_wavelength(sample.wavelength_nm));
        const Pattern& p = one->make(request);
        const double weight = sample.weight[1];
        exact.resize(p.skirt.size() / 4);
        for (std::size_t i = 0; i < exact.size(); ++i)
            exact[i] += weight * static_cast<double>(p.skirt[4 * i + 1]);
        exact_core += weight * static_cast<double>(p.core_energy[0][1]);
    }
    double sum = 0;
    double apart = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        sum += std::abs(exact[i]);
        apart += std::abs(exact[i] - static_cast<double>(pattern.skirt[4 * i + 1]));
    }
    RecordProperty("relative_l1", std::to_string(apart / sum));
    RecordProperty("core", std::to_string(pattern.core_energy[0][1]));
    RecordProperty("exact_core", std::to_string(exact_core));
    EXPECT_LT(apart / sum, 0.17);  // 0.14 was measured
}

}  // namespace
}  // namespace seaglare::glare
