// Two scales of one pattern against the one transform that they stand for.
#include <numbers>

#include "tests/cl/pattern_fixture.h"

namespace seaglare::glare {
namespace {

// A small pupil and plane: 2048 samples are then as good as 4096 on the whole plane, and quick.
PatternSettings one_transform() {
    PatternSettings settings;
    settings.transform_size = 2048;
    settings.plane_width_mm = 4.5;
    settings.layer_radii_px = {0, 3};
    return settings;
}
PatternSettings two_scales() {
    PatternSettings settings = one_transform();
    settings.transform_size = 512;
    settings.wide_field_size = 2048;
    settings.wide_field_interval_s = 2;
    return settings;
}

EyeModel drifting_eye() {
    EyeModel eye = young_eye();
    eye.gratings.count = 0;
    for (ParticleFamily& family : eye.particles)
        family.drift_um = 40;
    return eye;
}
EyeModel still_eye() {
    EyeModel eye = drifting_eye();
    for (ParticleFamily& family : eye.particles)
        family.drift_um = 0;
    return eye;
}

PatternRequest request_at(double time_s, double pupil_mm = 3) {
    PatternRequest request;
    request.pupil_mm = pupil_mm;
    request.time_s = time_s;
    request.pitch = 1 / 869.1;
    return request;
}

struct Ring {
    double mean = 0;
    double contrast = 0;  // standard deviation over mean
};
Ring ring(const Pattern& pattern, double angle_deg) {
    double sum = 0;
    double squares = 0;
    double count = 0;
    for_each_node(pattern, [&](int a, int b) {
        const double angle = std::hypot(a, b) * pattern.pitch * 180 / std::numbers::pi;
        if (std::abs(angle - angle_deg) > 0.08 * angle_deg) return;
        const double value = static_cast<double>(node(pattern, 0, a, b)[1]) * angle * angle;
        sum += value;
        squares += value * value;
        count += 1;
    });
    const double mean = sum / count;
    return {mean, std::sqrt(squares / count - mean * mean) / mean};
}

// The core hands over between 0.5 and 0.9 degrees here.
TEST(TwoScales, JoinWithoutASeam) {
    SEAGLARE_CL_SOURCE(one, still_eye(), one_transform(), sample_d65(30));
    SEAGLARE_CL_SOURCE(two, still_eye(), two_scales(), sample_d65(30));
    const Pattern& exact = one->make(request_at(0));
    const Pattern& joined = two->make(request_at(0));
    ASSERT_EQ(joined.radius_nodes, exact.radius_nodes);
    EXPECT_EQ(joined.transform_size, 2048);
    EXPECT_NEAR(joined.structure_scale, exact.structure_scale, 0.003);
    EXPECT_NEAR(joined.core_energy[0][1], exact.core_energy[0][1], 0.001F);
    for (double angle_deg = 0.3; angle_deg < 3.5; angle_deg *= 1.15) {
        const Ring a = ring(exact, angle_deg);
        const Ring b = ring(joined, angle_deg);
        EXPECT_NEAR(b.mean / a.mean, 1, 0.015) << angle_deg;
        EXPECT_NEAR(b.contrast / a.contrast, 1, 0.15) << angle_deg;
    }
}

// At a pupil of the wide field's own steps and a whole interval nothing is mixed: node by node it is the same pattern.
TEST(TwoScales, AtItsOwnInstantsTheNeedlesCarryOn) {
    SEAGLARE_CL_SOURCE(one, drifting_eye(), one_transform(), sample_d65(30));
    SEAGLARE_CL_SOURCE(two, drifting_eye(), two_scales(), sample_d65(30));
    const Pattern& exact = one->make(request_at(4));
    const Pattern& joined = two->make(request_at(4));
    double apart = 0;
    double all = 0;
    for_each_node(exact, [&](int a, int b) {
        const auto value = static_cast<double>(node(exact, 0, a, b)[1]);
        apart += std::abs(value - static_cast<double>(node(joined, 0, a, b)[1]));
        all += value;
    });
    EXPECT_LT(apart / all, 0.01);
}

TEST(TwoScales, KeepTheEnergyWhateverTheyMix) {
    SEAGLARE_CL_SOURCE(two, drifting_eye(), two_scales(), sample_d65(30));
    const auto energy_at = [&](double time_s, double pupil_mm) {
        const Pattern& pattern = two->make(request_at(time_s, pupil_mm));
        auto sum = skirt_energy(pattern, 0);
        for (std::size_t c = 0; c < 4; ++c)
            sum[c] += static_cast<double>(pattern.core_energy[0][c]);
        EXPECT_NEAR(pattern.structure_scale, 0.97, 0.03) << time_s;
        return sum;
    };
    const auto first = energy_at(0, 2.9);
    for (const double time_s : {0.7, 1.999, 2.0, 3.3}) {
        const auto later = energy_at(time_s, 2.9 + 0.03 * time_s);
        for (std::size_t c = 0; c < 4; ++c)
            EXPECT_NEAR(later[c], first[c], 1e-4) << time_s;
    }
}

// Channels have frame times of their own: what was asked for before must not matter.
TEST(TwoScales, ThePatternIsAPureFunctionOfTheInstant) {
    SEAGLARE_CL_SOURCE(steady, drifting_eye(), two_scales(), sample_d65(10));
    SEAGLARE_CL_SOURCE(hasty, drifting_eye(), two_scales(), sample_d65(10));
    for (int frame = 0; frame <= 50; ++frame)
        steady->make(request_at(frame / 10.0));
    hasty->make(request_at(100));
    const std::vector<float> jumped = hasty->make(request_at(5)).skirt;
    EXPECT_EQ(steady->make(request_at(5)).skirt, jumped);
    const std::vector<float> later = steady->make(request_at(5.5)).skirt;
    EXPECT_NE(later, jumped);
    EXPECT_EQ(hasty->make(request_at(5.5)).skirt, later);
}

TEST(TwoScales, NothingPopsWhereAnIntervalOrAStepOfThePupilEnds) {
    SEAGLARE_CL_SOURCE(two, drifting_eye(), two_scales(), sample_d65(10));
    const auto change = [&](const PatternRequest& from, const PatternRequest& to) {
        const std::vector<float> before = two->make(from).skirt;
        const std::vector<float>& after = two->make(to).skirt;
        double apart = 0;
        double all = 0;
        for (std::size_t i = 0; i < before.size(); ++i) {
            apart += static_cast<double>(std::abs(after[i] - before[i]));
            all += static_cast<double>(std::abs(before[i]));
        }
        return apart / all;
    };
    EXPECT_LT(change(request_at(1.9999), request_at(2.0001)), 2e-3);
    EXPECT_LT(change(request_at(1, 2.9999), request_at(1, 3.0001)), 2e-3);
    EXPECT_GT(change(request_at(0.5), request_at(1.5)), 5e-3);  // it does move
}

// Work is spread over the frames of an interval: none does half of it.
TEST(TwoScales, EveryFrameDoesItsShare) {
    SEAGLARE_CL_SOURCE(two, drifting_eye(), two_scales(), sample_d65(10));
    two->make(request_at(0));
    int most = 0;
    int sum = 0;
    for (int frame = 1; frame < 80; ++frame) {
        const int launches = two->make(request_at(frame / 20.0)).kernel_launches;
        most = std::max(most, launches);
        sum += launches;
    }
    EXPECT_LT(most, 4 * sum / 79);
}

TEST(TwoScales, SettingsThatMakeNoSenseAreRefused) {
    PatternSettings settings = two_scales();
    settings.wide_field_size = 512;
    EXPECT_THROW(make_cl_pattern_source(young_eye(), settings, 7), std::invalid_argument);
    settings.wide_field_size = 3000;
    EXPECT_THROW(make_cl_pattern_source(young_eye(), settings, 7), std::invalid_argument);
    settings = two_scales();
    settings.wide_field_interval_s = 0;
    EXPECT_THROW(make_cl_pattern_source(young_eye(), settings, 7), std::invalid_argument);
}

}  // namespace
}  // namespace seaglare::glare
