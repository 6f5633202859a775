// What a plan predicts of a frame's work is what its lights then cover.
#include "glare/plan/plan_cost.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "glare/apply/fine_reach.h"
#include "glare/apply/light_instance.h"
#include "glare/psf/pattern_grid.h"
#include "glare/psf/pattern_sources.h"

namespace seaglare::glare {
namespace {

// A pattern with finer nodes, which are drawn as far as they show.
const Pattern& of_an_eye(double pitch) {
    static const Pattern pattern = [pitch] {
        PatternSettings settings;
        settings.transform_size = 1024;
        settings.layer_radii_px = {0};
        settings.max_radius_nodes = 32;
        settings.wavelengths = 4;
        PatternRequest request;
        request.pupil_mm = 6;
        request.pitch = pitch;
        return make_cpu_pattern_source(young_eye(), settings, 1)->make(request);
    }();
    return pattern;
}

// Random lights in a picture of 1280 x 720, their plan, and what they cover.
class Crowd {
  public:
    Crowd(int lights, double brightest_lx, double budget_codes) {
        Frame frame;
        frame.viewport_px = {0, 0, 1280, 720};
        const double t = std::tan(22.5 * std::numbers::pi / 180);
        frame.clip_from_view = {9 / (16 * t), 0, 0, 0, 0, 1 / t, 0, 0, 0, 0, -1, -1, 0, 0, -0.2, 0};
        input.geometry = screen_geometry(frame);
        settings_.wide_field_size = 4096;
        std::mt19937 engine(7);
        std::uniform_real_distribution<double> part(0, 1);
        for (int i = 0; i < lights; ++i) {
            PointSource source;
            source.position_view_m = {static_cast<float>((part(engine) - 0.5) * 2000 * t * 16 / 9),
                                      static_cast<float>((part(engine) - 0.5) * 2000 * t), -1000};
            const auto lux = static_cast<float>(brightest_lx * std::pow(10.0, -2 * part(engine)));
            source.illuminance_rgb_lx.fill(lux);
            source.illuminance_scotopic_lx = 2.464F * lux;
            sources_.push_back(source);
        }
        const PatternGrid grid = plan_grid(settings_, input.geometry.pitch);
        input.pattern = &settings_;
        input.window_inner = grid.window_inner;
        input.window_outer = grid.window_outer;
        input.radius_nodes = grid.radius;
        summarise(input.geometry, sources_, grid.window_outer / input.geometry.pitch, summary_);
        input.lights = &summary_;
        input.can_gather = true;
        plan = make_plan(input, {.max_error_codes = budget_codes}, {});
        const GlareBound bound(input.tail_age_years, input.tail_pigmentation);
        predicted = covered_area(input, plan.accumulation, bound, 0);
    }
    Crowd(const Crowd&) = delete;
    Crowd& operator=(const Crowd&) = delete;

    CoveredArea drawn() const {
        Pattern pattern = of_an_eye(input.geometry.pitch);
        pattern.window_inner = input.window_inner;
        pattern.window_outer = input.window_outer;
        pattern.layer_radius_nodes = {0};
        pattern.skirt.resize(4);
        pattern.tail_scale = 1;
        const AccumulationPlan& how = plan.accumulation;
        ReachSettings reach;
        reach.threshold_cd_m2 = how.skirt_threshold_cd_m2;
        reach.tail_threshold_cd_m2 = how.tail_threshold_cd_m2;
        reach.cell_px = std::max(how.tail_cell_px, 1);
        reach.tails = how.tail_cell_px > 0;
        FineReach fine;
        fine.update(pattern);
        reach.fine = &fine;
        std::vector<LightInstance> instances;
        append_instances(input.geometry, pattern, reach, sources_, instances);
        CoveredArea area;
        for (const LightInstance& light : instances) {
            area.skirt_px += area_of(light.skirt_rect);
            area.core_px += area_of(light.core_rect);
            area.tail_cells += area_of(light.tail_rect) / (reach.cell_px * reach.cell_px);
        }
        return area;
    }

    PlanInput input;
    Plan plan;
    CoveredArea predicted;

  private:
    static double area_of(const RectPx& rect) {
        return std::max(static_cast<double>(rect[2] - rect[0]), 0.0) *
               std::max(static_cast<double>(rect[3] - rect[1]), 0.0);
    }
    PatternSettings settings_;
    std::vector<PointSource> sources_;
    LightSummary summary_;
};

constexpr double factor = 2;

TEST(PlanCost, RectanglesCoverWhatWasPredicted) {
    for (const int lights : {1, 20, 500}) {
        for (const double lux : {1e-3, 1e-5}) {
            double before_ns = 1e18;
            for (const double budget : {0.5, 2.0, 8.0}) {
                const Crowd crowd(lights, lux, budget);
                const CoveredArea drawn = crowd.drawn();
                const auto agree = [&](double is, double was, const char* what) {
                    EXPECT_LE(is, factor * was + 1) << what << " of " << lights << " at " << budget;
                    EXPECT_GE(factor * is + 1, was) << what << " of " << lights << " at " << budget;
                };
                agree(drawn.skirt_px, crowd.predicted.skirt_px, "skirts");
                agree(drawn.core_px, crowd.predicted.core_px, "cores");
                // Coarser tails need a wider hand-over: a skirt may grow by it, the work must not.
                const DeviceCosts usual;
                const double ns = usual.of(Work::gl_skirt_px) * drawn.skirt_px +
                                  usual.of(Work::gl_tail_cell) * drawn.tail_cells;
                EXPECT_LT(ns, before_ns) << "more may be left out, less is drawn";
                before_ns = ns;
            }
        }
    }
}

TEST(PlanCost, AGatherIsPredictedFromTheStructureThatItSums) {
    const Crowd few(100, 1e-3, 0.5), many(10000, 1e-3, 0.5), faint(10000, 1e-6, 0.5);
    EXPECT_EQ(many.plan.accumulation.method, Accumulation::cl_tiles);
    const auto ms = [](const Crowd& crowd) {
        for (const PlannedPass& pass : crowd.plan.passes.all())
            if (pass.kind == PassKind::accumulate) return pass.predicted_ms;
        return 0.0;
    };
    EXPECT_LE(ms(many), 100 * ms(few)) << "never more than in proportion";
    EXPECT_LT(ms(faint), ms(many));
    EXPECT_LT(many.predicted.gather_px, many.predicted.skirt_px) << "the rest is on coarse grids";
    // What is not known yet may cost as much again.
    const double unknown_ms =
        many.plan.accumulation.most_unknown_px * DeviceCosts{}.of(Work::gl_skirt_px) / 1e6;
    EXPECT_NEAR(unknown_ms, ms(many), 1e-6 * unknown_ms);
}

}  // namespace
}  // namespace seaglare::glare
