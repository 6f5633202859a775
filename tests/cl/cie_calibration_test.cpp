// A calibrated eye against the CIE 135/1-1999 curve. (Uncalibrated ones: eye_curve_test.cpp.)
#include <memory>
#include <numbers>

#include "glare/psf/cie_curve.h"
#include "glare/psf/pattern.h"
#include "tests/cl/pattern_fixture.h"

namespace seaglare::glare {
namespace {

constexpr double degree = std::numbers::pi / 180;

double luminance_of(const Rgbv& v) {
    return 0.2126 * static_cast<double>(v[0]) + 0.7152 * static_cast<double>(v[1]) +
           0.0722 * static_cast<double>(v[2]);
}

// Mean of skirt and tail, as they are drawn, over +-6 % of an angle.
double mean_luminance(const Pattern& pattern, double angle_deg) {
    double sum = 0;
    double weights = 0;
    // Fine steps of both radius and azimuth: the tail has no nodes.
    for (double factor = 0.94; factor <= 1.0601; factor += 0.01) {
        const double sine = std::sin(factor * angle_deg * degree);
        const double distance = sine / pattern.pitch;
        const int steps = std::max(64, static_cast<int>(8 * distance));
        for (int i = 0; i < steps; ++i) {
            const double azimuth = 2 * std::numbers::pi * i / steps;
            const int a = static_cast<int>(std::lround(distance * std::cos(azimuth)));
            const int b = static_cast<int>(std::lround(distance * std::sin(azimuth)));
            double value = 0;
            if (std::max(std::abs(a), std::abs(b)) <= pattern.radius_nodes)
                value = luminance_of(node(pattern, 0, a, b));
            value +=
                pattern.tail_scale *
                cie_total_glare_sr(factor * angle_deg, pattern.tail_age_years, pattern.tail_pigmentation) *
                (1 - fade_window(sine, pattern.window_inner, pattern.window_outer));
            sum += factor * value / steps;
        }
        weights += factor;  // a ring's area grows with its radius
    }
    return sum / weights;
}

double total_energy(const Pattern& p) {
    double sum =
        luminance_of(p.core_energy[0]) +
        p.tail_scale * cie_tail_energy(p.tail_age_years, p.tail_pigmentation, p.window_inner, p.window_outer);
    const auto skirt = skirt_energy(p, 0);
    sum += 0.2126 * skirt[0] + 0.7152 * skirt[1] + 0.0722 * skirt[2];
    return sum;
}

struct Row {
    const char* name;
    EyeModel eye;
    double pupil_mm;
};

EyeModel without_ring(EyeModel eye) {
    eye.gratings.count = 0;
    return eye;
}

PatternRequest request_of(double pupil_mm, double pitch) {
    PatternRequest request;
    request.pupil_mm = pupil_mm;
    request.pitch = pitch;
    return request;
}

TEST(CieCalibration, TheRadialAverageFollowsTheCurveFromATenthOfADegreeToTen) {
    std::vector<Row> rows = {{"young", without_ring(young_eye()), 7},
                             {"young, ring", young_eye(), 7},
                             {"60 years", sixty_year_eye(), 5}};
    for (Row& row : rows) {
        row.eye.cie_calibrated = true;
        for (const double pitch : {1 / 869.1, 1 / 4030.6}) {
            SEAGLARE_CL_SOURCE(source, row.eye, PatternSettings{}, sample_d65(30));
            const Pattern& pattern = source->make(request_of(row.pupil_mm, pitch));
            const double passed = transmitted_fraction(row.eye, row.pupil_mm);
            for (const double angle_deg :
                 {0.1, 0.2, 0.3, 0.6, 1.0, 1.5, 2.0, 2.6, 3.0, 3.4, 4.0, 5.0, 6.0, 8.0, 10.0}) {
                // Nearer than the core's radius the light is the core's.
                if (angle_deg * degree < 3 * pitch) continue;
                EXPECT_NEAR(mean_luminance(pattern, angle_deg) / passed /
                                cie_total_glare_sr(angle_deg, row.eye.age_years, row.eye.pigmentation),
                            1, 0.1)
                    << row.name << " at " << angle_deg << " degrees, pitch 1/" << 1 / pitch;
            }
            // The curve's own integral is 1.0102.
            EXPECT_NEAR(total_energy(pattern) / (1.0102 * passed), 1, 0.02) << row.name;
            EXPECT_NEAR(total_energy(pattern), passed, 1e-3) << row.name;
            // The core has what the curve has there, less the curve's hundredth too much.
            double curve = 0;
            constexpr int steps = 2000;
            const double reach = 2 * pitch;
            for (int i = 0; i < steps; ++i) {
                const double sine = (i + 0.5) / steps * reach;
                curve += cie_total_glare_sr(sine / degree, row.eye.age_years, row.eye.pigmentation) *
                         std::pow(std::cos(std::numbers::pi / 2 * sine / reach), 2) * 2 * std::numbers::pi *
                         sine * reach / steps;
            }
            EXPECT_NEAR(static_cast<double>(pattern.core_energy[0][1]), passed * curve, 0.06) << row.name;
        }
    }
}

TEST(CieCalibration, StructureAndColourStay) {
    EyeModel eye = young_eye();
    SEAGLARE_CL_SOURCE(plain, eye, PatternSettings{}, sample_d65(30));
    eye.cie_calibrated = true;
    SEAGLARE_CL_SOURCE(calibrated, eye, PatternSettings{}, sample_d65(30));
    const Pattern& a = plain->make(request_of(7, 1 / 869.1));
    const Pattern& b = calibrated->make(request_of(7, 1 / 869.1));
    // One gain for all nodes of a ring.
    for (const auto& [x, y] : {std::pair{20, 0}, {12, 16}, {-16, 12}}) {
        const Rgbv p = node(a, 0, x, y);
        const Rgbv q = node(b, 0, x, y);
        const Rgbv r = node(a, 0, 0, 20);
        const Rgbv s = node(b, 0, 0, 20);
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(q[c] / p[c], s[c] / r[c], 1e-4F * q[c] / p[c]) << x << ", " << y << ": " << c;
    }
    EXPECT_NE(node(a, 0, 20, 0)[1], node(b, 0, 20, 0)[1]);
}

TEST(CieCalibration, BothSourcesCalibrateAlike) {
    EyeModel eye = young_eye();
    eye.cie_calibrated = true;
    PatternSettings settings;
    settings.transform_size = 512;
    SEAGLARE_CL_SOURCE(device, eye, settings, sample_d65(30));
    const auto plain = make_cpu_pattern_source(eye, settings, 7);
    const Pattern& a = device->make(request_of(6.5, 1 / 1303.7));
    const Pattern& b = plain->make(request_of(6.5, 1 / 1303.7));
    ASSERT_EQ(a.radius_nodes, b.radius_nodes);
    EXPECT_NEAR(a.core_energy[0][1], b.core_energy[0][1], 1e-3F);
    const std::vector<double> p = radial_mean(a, 1);
    const std::vector<double> q = radial_mean(b, 1);
    for (std::size_t r = 2; r + 4 < p.size(); ++r)
        EXPECT_NEAR(p[r], q[r], 0.005 * q[r]) << r;
}

// Without a tail, or with angles that are not physical, there is no curve to follow.
TEST(CieCalibration, OnlyPhysicalPatternsWithATailAreCalibrated) {
    EyeModel eye = young_eye();
    PatternSettings settings;
    settings.transform_size = 512;
    settings.angular_scale = 4;
    SEAGLARE_CL_SOURCE(plain, eye, settings, sample_d65(10));
    eye.cie_calibrated = true;
    SEAGLARE_CL_SOURCE(wanted, eye, settings, sample_d65(10));
    EXPECT_EQ(plain->make(request_of(6, 1 / 869.1)).skirt, wanted->make(request_of(6, 1 / 869.1)).skirt);
}

}  // namespace
}  // namespace seaglare::glare
