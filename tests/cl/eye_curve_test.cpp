// The simulated eye against the CIE 135/1-1999 curve: the ratio of its radial average to the curve, as an independent
// experiment with the same parameters found it (one other seed, double precision).
#include <numbers>

#include "glare/psf/cie_curve.h"
#include "tests/cl/pattern_fixture.h"

namespace seaglare::glare {
namespace {

// The mean of photopic luminance over +-6 % of the angle, before the energy is balanced, divided by the curve.
double ratio_to_curve(const Pattern& pattern, double angle_deg, const EyeModel& eye) {
    const double degree = std::numbers::pi / 180;
    double sum = 0;
    double count = 0;
    for_each_node(pattern, [&](int a, int b) {
        const double angle = std::asin(std::min(1.0, std::hypot(a, b) * pattern.pitch)) / degree;
        if (std::abs(angle - angle_deg) > 0.06 * angle_deg) return;
        const Rgbv v = node(pattern, 0, a, b);
        sum += 0.2126 * static_cast<double>(v[0]) + 0.7152 * static_cast<double>(v[1]) +
               0.0722 * static_cast<double>(v[2]);
        count += 1;
    });
    return sum / count / pattern.structure_scale /
           cie_total_glare_sr(angle_deg, eye.age_years, eye.pigmentation);
}

struct Row {
    const char* name;
    EyeModel eye;
    double pupil_mm;
    std::vector<std::pair<double, double>> ratios;  // degrees, ratio
};

TEST(EyeCurve, RadialAveragesFollowTheCurveAsTheExperimentFound) {
    EyeModel plain = young_eye();
    plain.gratings.count = 0;
    const std::vector<Row> rows = {
        {"young 7 mm", plain, 7, {{0.3, .73}, {1, 1.03}, {2, 1.17}, {3, 1.10}}},
        {"young 7 mm, ring", young_eye(), 7, {{0.3, .67}, {1, .96}, {2, 1.09}}},
        {"young 3 mm", young_eye(), 3, {{0.3, .56}, {1, 1.03}, {2, 1.15}, {3, 1.07}}},
        {"60 years 5 mm", sixty_year_eye(), 5, {{0.3, .70}, {1, 1.16}, {2, 1.22}, {3, 1.09}}},
    };
    for (const Row& row : rows) {
        SEAGLARE_CL_SOURCE(source, row.eye, PatternSettings{}, sample_d65(30));
        PatternRequest request;
        request.pupil_mm = row.pupil_mm;
        request.pitch = 1 / 869.1;
        const Pattern& pattern = source->make(request);
        EXPECT_NEAR(pattern.structure_scale, 1, 0.1) << row.name;
        for (const auto& [angle_deg, expected] : row.ratios)
            EXPECT_NEAR(ratio_to_curve(pattern, angle_deg, row.eye), expected, 0.25 * expected)
                << row.name << " at " << angle_deg << " degrees";
    }
}

// The halo is there with a wide pupil: at 3.03 degrees about twice what is there without it, and nothing at 5 mm.
TEST(EyeCurve, TheHaloStandsAtThreeDegreesAndOnlyInAWidePupil) {
    SEAGLARE_CL_SOURCE(source, young_eye(), PatternSettings{}, sample_d65(30));
    PatternRequest request;
    request.pitch = 1 / 869.1;
    request.pupil_mm = 7;
    const double wide = ratio_to_curve(source->make(request), 3.03, young_eye());
    request.pupil_mm = 5;
    const double narrow = ratio_to_curve(source->make(request), 3.03, young_eye());
    EXPECT_GT(wide, 1.8);
    EXPECT_LT(wide, 3.2);
    EXPECT_NEAR(narrow, 1.1, 0.2);
}

}  // namespace
}  // namespace seaglare::glare
