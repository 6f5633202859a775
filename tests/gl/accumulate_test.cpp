// Two ways to add lights up give one picture: whatever the lights, the screen and the pattern, their difference stays within
// a few of the thresholds that each of them may leave out.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "glare/apply/cl_gather.h"
#include "glare/tone/operators.h"
#include "tests/gl/view_fixture.h"

namespace seaglare::test {

namespace {

using glare::Accumulation;
using glare::AccumulationPlan;

constexpr double adaptation_cd_m2 = 0.001;

class Accumulate : public ViewTest {
  protected:
    void SetUp() override {
        ViewTest::SetUp();
        if (renderer_ && !renderer_->enable_gather()) GTEST_SKIP() << "no OpenCL device here";
    }

    std::vector<float> hdr_by(Accumulation method, Frame frame, const Pattern& pattern,
                              const std::vector<PointSource>& sources, double codes = 0.25) {
        const Target target(gl(), frame.viewport_px[2], frame.viewport_px[3]);
        target.fill({0, 0, 0, 255});
        frame.target_fbo = target.fbo();
        frame.adaptation_luminance_cd_m2 = adaptation_cd_m2;
        AccumulationPlan plan;
        plan.method = method;
        plan.skirt_threshold_cd_m2 = glare::threshold_luminance_cd_m2({}, adaptation_cd_m2, codes);
        plan.tail_threshold_cd_m2 = plan.skirt_threshold_cd_m2 / 64;
        plan.structure_codes = structure_codes_;
        stats_ = {};
        renderer_->render(frame, {}, pattern, sources, plan, stats_);
        return read_hdr();
    }

    double structure_codes_ = 0;  // of the next frame's plan
};

// Display code, not rounded, of a channel.
double code_of(float luminance) {
    static const glare::ToneCurve curve = glare::tone_curve({}, adaptation_cd_m2);
    return 255 * glare::srgb_encode(std::min(1.0, glare::tone_map(curve, static_cast<double>(luminance))));
}

double worst_code_difference(const std::vector<float>& a, const std::vector<float>& b) {
    EXPECT_EQ(a.size(), b.size());
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (i % 4 == 3) continue;
        worst = std::max(worst, std::abs(code_of(a[i]) - code_of(b[i])));
    }
    return worst;
}

// Needles and rings: what the mean over the azimuth does not have.
Pattern structured_pattern(double pitch, bool lashes, std::uint64_t seed) {
    SyntheticPattern settings;
    settings.with_tail = true;
    settings.layers = {0.0F, 1.5F, 3.0F};
    Pattern p = make_pattern(pitch, settings);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> phase(0, 2 * pi);
    const double turn = phase(random);
    const int side = 2 * p.radius_nodes + 1;
    for (std::size_t node = 0; node < p.skirt.size() / 4; ++node) {
        const auto x = static_cast<double>(static_cast<int>(node % side) - p.radius_nodes);
        const auto y = static_cast<double>(static_cast<int>(node / side % side) - p.radius_nodes);
        const double needles = 1 + 0.1 * std::cos(24 * std::atan2(y, x) + turn);
        for (std::size_t c = 0; c < 4; ++c)
            p.skirt[node * 4 + c] *= static_cast<float>(needles * (1 + 0.05 * static_cast<double>(c)));
    }
    if (lashes) {
        p.lash_turn_rad = 0.14;
        p.lash_bend_per_rad = 1;
    }
    return p;
}

struct Scene {
    Frame frame;
    std::vector<PointSource> sources;
};

// Faint and bright, points and lamps of many sizes, in the picture, at its edges, beyond them and behind the eye.
Scene random_scene(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    Scene scene;
    const int width = 160 + static_cast<int>(uniform(random) * 200);
    const int height = 120 + static_cast<int>(uniform(random) * 120);
    scene.frame = make_frame(width, height, 12 + 40 * uniform(random));
    if (seed % 3 == 1) {
        const double t = 0.1 + 0.3 * uniform(random);
        scene.frame.clip_from_view = frustum(-0.2 * t, 1.7 * t, -0.4 * t, 0.9 * t);
    }
    const std::size_t count = 1 + static_cast<std::size_t>(uniform(random) * 40);
    for (std::size_t i = 0; i < count; ++i) {
        const double x = (1.4 * uniform(random) - 0.2) * width;
        const double y = (1.4 * uniform(random) - 0.2) * height;
        const double lux = std::pow(10.0, -7 + 4 * uniform(random));
        const double radius_m = uniform(random) < 0.5 ? 0.0 : std::pow(10.0, -1 + 2 * uniform(random));
        const auto channel = [&] { return static_cast<float>(0.2 + uniform(random)); };
        scene.sources.push_back(source_at_px(scene.frame, x, y, lux, 1000, radius_m,
                                             {channel(), channel(), seed % 4 == 0 ? -0.1F : channel()}));
        if (i % 7 == 6)
            for (float& coordinate : scene.sources.back().position_view_m)
                coordinate = -coordinate;
    }
    return scene;
}

}  // namespace

TEST_F(Accumulate, TilesAndBillboardsAgreeOnRandomScenes) {
    for (std::uint64_t seed = 1; seed <= 24; ++seed) {
        const Scene scene = random_scene(seed);
        const Pattern pattern =
            structured_pattern(glare::screen_geometry(scene.frame).pitch, seed % 4 == 3, seed);
        const auto drawn = hdr_by(Accumulation::gl_billboards, scene.frame, pattern, scene.sources);
        const auto gathered = hdr_by(Accumulation::cl_tiles, scene.frame, pattern, scene.sources);
        // Each way may leave out a quarter of a code for every light; what they leave out has either sign.
        EXPECT_LT(worst_code_difference(drawn, gathered), 1.0) << "seed " << seed;
    }
}

// A few bright lights, many faint ones, half of them in knots a pixel or two wide, at every place under the pixels.
TEST_F(Accumulate, CrowdsOfTenToTenThousandLightsAgree) {
    struct Crowd {
        int lights, width, height;
    };
    for (const Crowd& crowd : {Crowd{10, 200, 150}, {100, 200, 150}, {1000, 100, 75}, {10000, 40, 30}}) {
        std::mt19937_64 random(static_cast<std::uint64_t>(crowd.lights));
        std::uniform_real_distribution<double> uniform(0, 1);
        const Frame frame = make_frame(crowd.width, crowd.height, 20);
        const Pattern pattern = structured_pattern(glare::screen_geometry(frame).pitch, false, 7);
        std::vector<PointSource> sources;
        std::array<double, 2> knot{};
        for (int i = 0; i < crowd.lights; ++i) {
            const std::array<double, 2> place = {(1.2 * uniform(random) - 0.1) * crowd.width,
                                                 (1.2 * uniform(random) - 0.1) * crowd.height};
            if (i % 20 == 0) knot = place;
            const bool knotted = i % 2 == 1;
            const double lux = std::pow(10.0, -7 + 4 * std::pow(uniform(random), 3));
            sources.push_back(source_at_px(frame, knotted ? knot[0] + 2 * uniform(random) : place[0],
                                           knotted ? knot[1] + 2 * uniform(random) : place[1], lux, 1000, 0,
                                           {static_cast<float>(0.2 + uniform(random)), 1, 0.5F}));
        }
        // Shares so small that all lights together may leave out a quarter of a code.
        const auto drawn = hdr_by(Accumulation::gl_billboards, frame, pattern, sources, 0.25 / crowd.lights);
        structure_codes_ = 0.5;
        const auto gathered = hdr_by(Accumulation::cl_tiles, frame, pattern, sources, 0.25 / crowd.lights);
        structure_codes_ = 0;
        EXPECT_EQ(stats_.lights_gathered, stats_.lights_drawn);
        EXPECT_LT(worst_code_difference(drawn, gathered), 1.0) << crowd.lights << " lights";
    }
}

TEST_F(Accumulate, OneLightDiffersByNoMoreThanItsShare) {
    const Frame frame = make_frame(320, 240, 30);
    const Pattern pattern = structured_pattern(glare::screen_geometry(frame).pitch, false, 1);
    for (const double lux : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
        const std::vector<PointSource> one = {source_at_px(frame, 130.3, 101.7, lux)};
        const auto drawn = hdr_by(Accumulation::gl_billboards, frame, pattern, one);
        const auto gathered = hdr_by(Accumulation::cl_tiles, frame, pattern, one);
        EXPECT_LT(worst_code_difference(drawn, gathered), 0.6) << lux << " lx";
    }
}

TEST_F(Accumulate, ASmallerThresholdBringsThemTogether) {
    const Scene scene = random_scene(5);
    const Pattern pattern = structured_pattern(glare::screen_geometry(scene.frame).pitch, false, 5);
    const auto difference = [&](double codes) {
        return worst_code_difference(
            hdr_by(Accumulation::gl_billboards, scene.frame, pattern, scene.sources, codes),
            hdr_by(Accumulation::cl_tiles, scene.frame, pattern, scene.sources, codes));
    };
    EXPECT_LT(difference(0.02), 0.35);
}

TEST_F(Accumulate, AGatherKeepsTheEnergyOfALight) {
    const Frame frame = make_frame(480, 360, 40);
    SyntheticPattern settings;
    settings.with_tail = true;
    const Pattern pattern = make_pattern(glare::screen_geometry(frame).pitch, settings);
    const std::vector<PointSource> one = {source_at_px(frame, 240.2, 180.4, 1e-4)};
    const double drawn = energy_lx(frame, hdr_by(Accumulation::gl_billboards, frame, pattern, one, 0.001));
    const double gathered = energy_lx(frame, hdr_by(Accumulation::cl_tiles, frame, pattern, one, 0.001));
    EXPECT_NEAR(gathered / drawn, 1, 1e-3);
}

TEST_F(Accumulate, AGatherLaunchesOneKernelForEachGridAndBandWhateverTheNumberOfLights) {
    const Frame frame = make_frame(320, 240, 30);
    const Pattern pattern = structured_pattern(glare::screen_geometry(frame).pitch, false, 1);
    std::vector<PointSource> sources;
    std::uint32_t first = 0;
    for (int i = 0; i < 60; ++i) {
        sources.push_back(source_at_px(frame, 5.0 * i + 7, 4.0 * i + 2, 1e-4));
        if (i == 0) {
            hdr_by(Accumulation::cl_tiles, frame, pattern, sources);
            first = stats_.kernel_launches;
        }
    }
    hdr_by(Accumulation::cl_tiles, frame, pattern, sources);
    EXPECT_EQ(stats_.kernel_launches, first);
    EXPECT_GE(first, 2U);
    constexpr int bands = (240 + glare::band_rows - 1) / glare::band_rows;
    EXPECT_LE(first, static_cast<std::uint32_t>(glare::most_levels - 1 + bands));
    hdr_by(Accumulation::gl_billboards, frame, pattern, sources);
    EXPECT_EQ(stats_.kernel_launches, 0U);
}

TEST_F(Accumulate, AGridOfOnePixelReachesTheLastColumnAndRow) {
    const Frame frame = make_frame(160, 120, 12);
    SyntheticPattern settings;
    settings.with_tail = true;
    settings.radius_nodes = 8;  // so near that the coarse grid is not coarse
    const Pattern pattern = make_pattern(glare::screen_geometry(frame).pitch, settings);
    const std::vector<PointSource> one = {source_at_px(frame, 130.5, 95.5, 1e-3)};
    const auto drawn = hdr_by(Accumulation::gl_billboards, frame, pattern, one);
    const auto gathered = hdr_by(Accumulation::cl_tiles, frame, pattern, one);
    for (const std::array<std::size_t, 2> at :
         {std::array<std::size_t, 2>{159, 95}, {159, 119}, {130, 119}, {0, 0}}) {
        const std::size_t node = (at[1] * 160 + at[0]) * 4 + 1;
        EXPECT_GT(code_of(drawn[node]), 0.1);
        EXPECT_NEAR(code_of(drawn[node]), code_of(gathered[node]), 0.3) << at[0] << ", " << at[1];
    }
}

TEST_F(Accumulate, AFrameWithoutTailsHasNoneInEitherWay) {
    const Frame frame = make_frame(200, 160, 20);
    const Pattern pattern = make_pattern(glare::screen_geometry(frame).pitch, {});
    const std::vector<PointSource> one = {source_at_px(frame, 60.5, 70.5, 1e-3)};
    const auto drawn = hdr_by(Accumulation::gl_billboards, frame, pattern, one);
    const auto gathered = hdr_by(Accumulation::cl_tiles, frame, pattern, one);
    EXPECT_LT(worst_code_difference(drawn, gathered), 0.6);
    EXPECT_EQ(gathered[(static_cast<std::size_t>(150) * 200 + 190) * 4 + 1], 0.0F);
}

}  // namespace seaglare::test
