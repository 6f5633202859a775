// Each thing that a plan leaves out, alone, on random scenes with a simulated eye's pattern: no pixel is off by more codes
// than the omission's bound. And the work that is left out is not done.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "glare/plan/filter_blend.h"
#include "glare/plan/plan.h"
#include "glare/plan/quality_control.h"
#include "glare/psf/pattern_grid.h"
#include "glare/tone/operators.h"
#include "tests/gl/view_fixture.h"

namespace seaglare::test {
namespace {

using glare::Omission;
using glare::Omitted;
using glare::Plan;

constexpr int width_px = 240;
constexpr int height_px = 136;
constexpr double fov_deg = 8;

// A scene of random lights and the plan for it, with a simulated pattern of one instant.
class Scene {
  public:
    Scene(unsigned seed, int lights, double most_lux, double largest_px = 3)
        : frame(make_frame(width_px, height_px, fov_deg)) {
        settings.transform_size = 1024;
        settings.plane_width_mm = 4.5;  // a skirt of 41 px
        settings.wavelengths = 20;
        input.geometry = glare::screen_geometry(frame);
        std::mt19937 engine(seed);
        std::uniform_real_distribution<double> part(0, 1);
        static constexpr std::array<std::array<float, 3>, 3> colours = {
            {{1, 1, 1}, {4.703F, 0, 0}, {0.016F, 1.37F, 0.233F}}};
        for (int i = 0; i < lights; ++i) {
            const auto lamp = static_cast<std::uint32_t>(part(engine) * 2.999);
            const double lux = most_lux * std::pow(10.0, -3 * part(engine));
            const double radius_m =
                part(engine) < 0.5 ? 0 : 1000 * input.geometry.pitch * largest_px * part(engine);
            sources.push_back(source_at_px(frame, width_px * (1.2 * part(engine) - 0.1),
                                           height_px * (1.2 * part(engine) - 0.1), lux, 1000, radius_m,
                                           colours[lamp]));
            sources.back().lamp = lamp;
        }
        input.adaptation_cd_m2 = 0.001;
    }

    Plan plan(double budget_codes, const glare::QualityLoss& loss = {}) {
        const glare::PatternGrid grid = glare::plan_grid(settings, input.geometry.pitch);
        input.pattern = &settings;
        input.window_inner = grid.window_inner;
        input.window_outer = grid.window_outer;
        input.radius_nodes = grid.radius;
        input.given_up = loss;
        glare::summarise(input.geometry, sources, grid.window_outer / input.geometry.pitch, summary_);
        input.lights = &summary_;
        frame.adaptation_luminance_cd_m2 = input.adaptation_cd_m2;
        return glare::make_plan(input, {.max_error_codes = budget_codes, .time_ms = loss.any() ? 8.0 : 0},
                                {});
    }

    // The pattern that a plan asks for.
    const Pattern& pattern(const Plan& plan) {
        if (!source_) source_ = glare::make_cl_pattern_source(glare::young_eye(), settings, 5);
        glare::PatternRequest request;
        request.pupil_mm = 3.5;
        request.pitch = input.geometry.pitch;
        request.lamps = plan.lamps_with_pattern;
        request.largest_disc_nodes = static_cast<float>(plan.largest_disc_nodes);
        source_->make_into(request, pattern_);
        if (!(plan.filter_blend > 0)) return pattern_;
        glare::blend_towards_first_lamp(pattern_, plan.filter_blend, blended_);
        return blended_;
    }

    Frame frame;
    glare::PatternSettings settings;
    glare::PlanInput input;
    std::vector<PointSource> sources;

  private:
    glare::LightSummary summary_;
    std::unique_ptr<glare::PatternSource> source_;
    Pattern pattern_, blended_;
};

class PlanOmissions : public ViewTest {
  protected:
    void SetUp() override {
        ViewTest::SetUp();
        glare::PatternSettings small;
        small.transform_size = 256;
        try {
            glare::make_cl_pattern_source(glare::young_eye(), small, 1);
        } catch (const std::exception& error) {
            GTEST_SKIP() << error.what();
        }
    }
    // Display codes of every channel of every pixel over a black picture, before rounding.
    std::vector<double> codes_of(Scene& scene, const Plan& plan) {
        const Target target(gl(), width_px, height_px);
        target.fill({0, 0, 0, 255});
        Frame frame = scene.frame;
        frame.target_fbo = target.fbo();
        ToneSettings tone = scene.input.tone;
        tone.blue_shift = plan.rod_hue;
        stats_ = {};
        renderer_->render(frame, tone, scene.pattern(plan), scene.sources, plan.accumulation, stats_);
        const std::vector<float> hdr = read_hdr();
        std::vector<double> codes;
        for (std::size_t i = 0; i < hdr.size(); i += 4) {
            const glare::Rgb glare = {hdr[i], hdr[i + 1], hdr[i + 2]};
            for (const double shown :
                 glare::display_delta(tone, scene.input.adaptation_cd_m2, 0, {}, glare, hdr[i + 3]))
                codes.push_back(255 * glare::srgb_encode(shown));
        }
        return codes;
    }
    static double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
        EXPECT_EQ(a.size(), b.size());
        double largest = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            largest = std::max(largest, std::abs(a[i] - b[i]));
        return largest;
    }
    static double bound_of(const Plan& plan, Omitted what) {
        double codes = 0;
        for (const Omission& omission : plan.left_out.all())
            codes += omission.what == what ? omission.bound_codes : 0;
        return codes;
    }
    static bool leaves_out(const Plan& plan, Omitted what) {
        const auto all = plan.left_out.all();
        return std::any_of(all.begin(), all.end(), [what](const Omission& o) { return o.what == what; });
    }
    // Half floats of the pattern texture and sums of floats.
    static constexpr double rounding_codes = 0.06;
    struct Load {
        int lights;
        double lux;
    };
    static constexpr std::array<Load, 3> loads = {{{1, 1e-2}, {12, 1e-3}, {150, 1e-4}}};
    static constexpr std::array<double, 2> budgets = {0.5, 4};
};

TEST_F(PlanOmissions, OutskirtsLeftToTheSmoothTail) {
    unsigned seed = 1;
    bool any = false;
    for (const Load load : loads) {
        Scene scene(seed++, load.lights, load.lux);
        Plan whole = scene.plan(0);
        const std::vector<double> everything = codes_of(scene, whole);
        double share_cd_m2 = 0;
        for (const double budget : budgets) {
            const Plan plan = scene.plan(budget);
            Plan only = whole;
            only.accumulation.skirt_threshold_cd_m2 = plan.accumulation.skirt_threshold_cd_m2;
            const double off = largest_difference(everything, codes_of(scene, only));
            EXPECT_LE(off, bound_of(plan, Omitted::skirts) + rounding_codes)
                << load.lights << " at " << budget;
            any = any || off > 0;
            EXPECT_GT(plan.accumulation.skirt_threshold_cd_m2, share_cd_m2)
                << "more budget, more is left out";
            share_cd_m2 = plan.accumulation.skirt_threshold_cd_m2;
        }
    }
    EXPECT_TRUE(any) << "nothing was left out";
}

TEST_F(PlanOmissions, EndsOfTails) {
    unsigned seed = 11;
    bool any = false;
    for (const Load load : loads) {
        Scene scene(seed++, load.lights, load.lux);
        const Plan whole = scene.plan(0);
        const std::vector<double> everything = codes_of(scene, whole);
        for (const double budget : budgets) {
            const Plan plan = scene.plan(budget);
            Plan only = whole;
            only.accumulation.tail_threshold_cd_m2 = plan.accumulation.tail_threshold_cd_m2;
            if (plan.accumulation.tail_cell_px == 0) only.accumulation.tail_cell_px = 0;
            const double off = largest_difference(everything, codes_of(scene, only));
            EXPECT_LE(off, bound_of(plan, Omitted::tails) + rounding_codes)
                << load.lights << " at " << budget;
            any = any || off > 0;
        }
    }
    EXPECT_TRUE(any) << "nothing was left out";
}

TEST_F(PlanOmissions, TheCoarseGridOfTheTails) {
    unsigned seed = 21;
    bool any = false;
    for (const Load load : {Load{1, 1e-2}, Load{1, 1}, Load{12, 1e-2}, Load{150, 1e-4}}) {
        Scene scene(seed++, load.lights, load.lux);
        const Plan whole = scene.plan(0);
        EXPECT_EQ(whole.accumulation.tail_cell_px, 1);
        const std::vector<double> everything = codes_of(scene, whole);
        for (const double budget : budgets) {
            const Plan plan = scene.plan(budget);
            if (plan.accumulation.tail_cell_px == 0) continue;
            Plan only = whole;
            only.accumulation.tail_cell_px = plan.accumulation.tail_cell_px;
            const double off = largest_difference(everything, codes_of(scene, only));
            EXPECT_LE(off, bound_of(plan, Omitted::fine_tails) + rounding_codes)
                << load.lights << " at " << budget << ", cell " << plan.accumulation.tail_cell_px;
            any = any || plan.accumulation.tail_cell_px > 1;
        }
    }
    EXPECT_TRUE(any) << "no grid was coarse";
}

TEST_F(PlanOmissions, DiscsTooSmallToShow) {
    unsigned seed = 31;
    int left_out = 0;
    for (const double largest_px : {0.02, 0.05, 0.1, 0.2}) {
        Scene scene(seed++, 12, 1e-3, largest_px);
        const Plan whole = scene.plan(0);
        EXPECT_GT(whole.largest_disc_nodes, 0);
        const std::vector<double> everything = codes_of(scene, whole);
        for (const double budget : budgets) {
            const Plan plan = scene.plan(budget);
            if (!leaves_out(plan, Omitted::discs)) continue;
            ++left_out;
            Plan only = whole;
            only.largest_disc_nodes = 0;
            only.accumulation.disc_scale = 0;
            EXPECT_LE(largest_difference(everything, codes_of(scene, only)),
                      bound_of(plan, Omitted::discs) + rounding_codes)
                << largest_px << " px at " << budget;
            EXPECT_EQ(scene.pattern(plan).layer_radius_nodes.size(), 1U) << "its layers are not made";
        }
    }
    EXPECT_GT(left_out, 2);
}

TEST_F(PlanOmissions, LayersThatNoLightNeeds) {
    Scene scene(41, 20, 1e-3, 1);
    Plan plan = scene.plan(0);
    const std::vector<double> as_needed = codes_of(scene, plan);
    EXPECT_LT(scene.pattern(plan).layer_radius_nodes.size(), scene.settings.layer_radii_px.size());
    plan.largest_disc_nodes = 100;
    EXPECT_EQ(scene.pattern(plan).layer_radius_nodes.size(), scene.settings.layer_radii_px.size());
    EXPECT_LE(largest_difference(as_needed, codes_of(scene, plan)), rounding_codes);
}

TEST_F(PlanOmissions, RodHueByDay) {
    int left_out = 0;
    for (const double adaptation : {300.0, 3000.0, 20000.0}) {
        Scene scene(51, 12, adaptation * 1e-2);
        scene.input.adaptation_cd_m2 = adaptation;
        const Plan whole = scene.plan(0);
        EXPECT_TRUE(whole.rod_hue);
        const std::vector<double> everything = codes_of(scene, whole);
        for (const double budget : budgets) {
            const Plan plan = scene.plan(budget);
            if (plan.rod_hue) continue;
            ++left_out;
            Plan only = whole;
            only.rod_hue = false;
            EXPECT_LE(largest_difference(everything, codes_of(scene, only)),
                      bound_of(plan, Omitted::rod_hue) + rounding_codes);
        }
    }
    EXPECT_GT(left_out, 1);
}

TEST_F(PlanOmissions, PatternsOfLampsTooFaintToShow) {
    Scene scene(61, 12, 1e-3, 0);
    for (PointSource& source : scene.sources) {
        if (source.lamp != 2) continue;
        for (float& channel : source.illuminance_rgb_lx)
            channel *= 1e-9F;
        source.illuminance_scotopic_lx *= 1e-9F;
    }
    const Plan whole = scene.plan(0), plan = scene.plan(1);
    EXPECT_EQ(whole.lamps_with_pattern, 0b111U);
    ASSERT_EQ(plan.lamps_with_pattern, 0b011U);
    const std::vector<double> everything = codes_of(scene, whole);
    Plan only = whole;
    only.lamps_with_pattern = plan.lamps_with_pattern;
    EXPECT_LE(largest_difference(everything, codes_of(scene, only)),
              bound_of(plan, Omitted::own_patterns) + rounding_codes);
    EXPECT_EQ(scene.pattern(plan).lamps.size(), 2U) << "two patterns are made and uploaded, not three";
}

TEST_F(PlanOmissions, TheWholePlanKeepsTheBudget) {
    for (unsigned seed = 71; seed < 77; ++seed) {
        const Load load = loads[seed % 3];
        Scene scene(seed, load.lights, load.lux * (seed < 74 ? 1 : 10), seed % 2 == 0 ? 3 : 0.05);
        const std::vector<double> everything = codes_of(scene, scene.plan(0));
        for (const double budget : budgets) {
            const double off = largest_difference(everything, codes_of(scene, scene.plan(budget)));
            EXPECT_LE(off, budget) << "seed " << seed;
        }
    }
}

// From full quality to none and back, a step of the controller at a time: no pixel changes by more than is said in
// plan/quality_control.h at 60 frames a second, but for the error budget's own steps.
TEST_F(PlanOmissions, GivingUpQualityNeverJumps) {
    Scene scene(81, 10, 3e-3);
    double largest = 0, most = 0;
    constexpr double step = glare::loss_per_s / 60;
    // Each of the fades at its ends, where it is steepest, and where layers leave the pattern; what comes before it in the
    // usual order is gone.
    for (std::size_t kind = 0; kind < glare::quality_kinds; ++kind) {
        for (const double from : {0.0, 0.4, 0.48, 0.5, 0.69, 0.79, 0.9, 1 - step}) {
            glare::QualityLoss before, after;
            std::fill_n(before.level.begin(), kind, 1.0);
            before.level[kind] = std::max(from, 1e-6);
            after = before;
            after.level[kind] = from + step;
            const Plan a = scene.plan(0.5, before), b = scene.plan(0.5, after);
            const double jump = largest_difference(codes_of(scene, a), codes_of(scene, b));
            EXPECT_LE(jump, 1.5) << glare::name_of(static_cast<glare::Quality>(kind)) << " from " << from;
            largest = std::max(largest, jump);
        }
    }
    most = largest_difference(codes_of(scene, scene.plan(0.5, {{1e-6, 0, 0, 0}})),
                              codes_of(scene, scene.plan(0.5, {{1, 1, 1, 1}})));
    EXPECT_GT(most, 5 * largest) << "the whole way is many steps";
}

}  // namespace
}  // namespace seaglare::test
