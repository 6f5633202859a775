// Two implementations of one pattern: OpenCL, and plain C++ with its own drawing, FFT, sums and discs.
#include "tests/cl/pattern_fixture.h"

namespace seaglare::glare {
namespace {

struct Difference {
    double mean = 0;   // sum |a - b| over sum |a|
    double worst = 0;  // |a - b| over (the node's brightest channel + the layer's mean), of any node
};

Difference difference(const Pattern& a, const Pattern& b, std::size_t layer) {
    double sum = 0;
    double apart = 0;
    double count = 0;
    for_each_node(a, [&](int x, int y) {
        for (std::size_t c = 0; c < 4; ++c) {
            const auto p = static_cast<double>(node(a, layer, x, y)[c]);
            sum += std::abs(p);
            apart += std::abs(p - static_cast<double>(node(b, layer, x, y)[c]));
            count += 1;
        }
    });
    Difference result;
    result.mean = apart / sum;
    for_each_node(a, [&](int x, int y) {
        const Rgbv p = node(a, layer, x, y);
        const Rgbv q = node(b, layer, x, y);
        double brightest = 0;
        double apart_here = 0;
        for (std::size_t c = 0; c < 4; ++c) {
            brightest = std::max(brightest, static_cast<double>(std::abs(p[c])));
            apart_here = std::max(apart_here, static_cast<double>(std::abs(p[c] - q[c])));
        }
        result.worst = std::max(result.worst, apart_here / (brightest + sum / count));
    });
    return result;
}

void expect_agreement(const EyeModel& eye, const PatternSettings& settings, double pupil_mm) {
    SEAGLARE_CL_SOURCE(device, eye, settings, sample_d65(settings.wavelengths));
    const auto plain = make_cpu_pattern_source(eye, settings, 7);
    PatternRequest request;
    request.pupil_mm = pupil_mm;
    request.pitch = 1 / 869.1;
    request.largest_disc_nodes = 100;
    const Pattern& a = device->make(request);
    const Pattern& b = plain->make(request);
    ASSERT_EQ(a.radius_nodes, b.radius_nodes);
    ASSERT_EQ(a.layer_radius_nodes, b.layer_radius_nodes);
    ASSERT_EQ(a.skirt.size(), b.skirt.size());
    EXPECT_NEAR(a.structure_scale, b.structure_scale, 1e-3);
    for (std::size_t c = 0; c < 4; ++c)
        EXPECT_NEAR(a.core_energy[0][c], b.core_energy[0][c], 1e-3F);
    for (std::size_t layer = 0; layer < a.layer_radius_nodes.size(); ++layer) {
        const Difference d = difference(a, b, layer);
        // They draw the edges of discs and lines by different rules; everything after is the same to rounding.
        EXPECT_LT(d.mean, 0.005) << layer;
        EXPECT_LT(d.worst, 0.03) << layer;
    }
}

TEST(TwoSources, AgreeOnThePhysicalPattern) {
    PatternSettings settings;
    settings.transform_size = 512;
    expect_agreement(young_eye(), settings, 6.5);
}

TEST(TwoSources, AgreeOnTheThesisPattern) {
    expect_agreement(thesis_eye(), thesis_settings(), 6.5);
}

TEST(TwoSources, ThePlainOneStandsStillWhileTheEyeDoes) {
    PatternSettings settings;
    settings.transform_size = 4096;
    settings.wavelengths = 5;
    const auto plain = make_cpu_pattern_source(young_eye(), settings, 7);
    PatternRequest request;
    request.pitch = 1 / 869.1;
    request.pupil_mm = 6;
    const auto first = plain->make(request).generation;
    EXPECT_EQ(plain->make(request).transform_size, 1024);
    request.time_s = 100;
    EXPECT_EQ(plain->make(request).generation, first) << "time does not move it";
    // What it is depends on what is asked for and not on what was asked before: channels agree.
    const std::vector<float> at_6_mm = plain->make(request).skirt;
    request.pupil_mm = 6.1;
    EXPECT_GT(plain->make(request).generation, first);
    EXPECT_NE(plain->make(request).skirt, at_6_mm);
    request.pupil_mm = 6;
    EXPECT_EQ(plain->make(request).skirt, at_6_mm);
    EXPECT_EQ(plain->device_name(), "CPU, without OpenCL");
}

// The plain source dims the open eye's pattern by the light that the lid takes; OpenCL draws the lid.
TEST(TwoSources, ABlinkTakesAsMuchLightFromBoth) {
    PatternSettings settings;
    settings.transform_size = 512;
    settings.wavelengths = 5;
    for (const EyeModel& eye : {no_lash_eye(), young_eye_with_lashes()}) {
        SEAGLARE_CL_SOURCE(device, eye, settings, sample_d65(settings.wavelengths));
        const auto plain = make_cpu_pattern_source(eye, settings, 7);
        const auto energy = [](const Pattern& p) {
            return static_cast<double>(p.core_energy[0][1]) + skirt_energy(p, 0)[1];
        };
        PatternRequest request;
        request.pitch = 1 / 869.1;
        request.pupil_mm = 6;
        const double open = energy(plain->make(request));
        const std::uint64_t generation = plain->make(request).generation;
        double before = open;
        for (const double blink : {0.2, 0.4, 0.6, 0.8, 1.0}) {
            request.lids.blink = blink;
            const Pattern& shut = plain->make(request);
            EXPECT_NE(shut.generation, generation);
            EXPECT_NEAR(energy(shut), energy(device->make(request)), 0.005 * open) << blink;
            EXPECT_LE(energy(shut), before) << blink;
            before = energy(shut);
        }
        EXPECT_EQ(before, 0);
        // Into the caller's memory the same; and afterwards the open eye's, which was not made again.
        request.lids.blink = 0.4;
        Pattern mine;
        plain->make_into(request, mine);
        EXPECT_EQ(mine.skirt, plain->make(request).skirt);
        request.lids.blink = 0;
        EXPECT_EQ(plain->make(request).generation, generation);
    }
}

}  // namespace
}  // namespace seaglare::glare
