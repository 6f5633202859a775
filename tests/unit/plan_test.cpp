// What a plan decides, from the summary of a frame's lights: each omission when it may be, and not when it may not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "glare/plan/plan.h"
#include "glare/plan/quality_savings.h"
#include "glare/plan/sensitivity.h"
#include "glare/psf/pattern_grid.h"

namespace seaglare::glare {
namespace {

Frame picture(double vertical_fov_deg = 45, int height_px = 720) {
    Frame frame;
    frame.viewport_px = {0, 0, 16 * height_px / 9, height_px};
    const double t = std::tan(vertical_fov_deg / 2 * std::numbers::pi / 180);
    frame.clip_from_view = {9 / (16 * t), 0, 0, 0, 0, 1 / t, 0, 0, 0, 0, -1, -1, 0, 0, -0.2, 0};
    return frame;
}

// A scene of lights and all that a plan is made from, with the default quality by starlight.
struct Case {
    Case() {
        pattern.transform_size = 512;
        pattern.wide_field_size = 4096;
        input.geometry = screen_geometry(picture());
        input.has_depth = true;
    }
    void add(double lux, double azimuth_deg = 0, std::uint32_t lamp = 0, double radius_m = 0.01,
             double distance_m = 1000) {
        PointSource s;
        const double a = azimuth_deg * std::numbers::pi / 180;
        s.position_view_m = {static_cast<float>(distance_m * std::sin(a)), 0,
                             static_cast<float>(-distance_m * std::cos(a))};
        s.illuminance_rgb_lx.fill(static_cast<float>(lux));
        s.illuminance_scotopic_lx = static_cast<float>(2.464 * lux);
        s.lamp = lamp;
        s.radius_m = static_cast<float>(radius_m);
        sources.push_back(s);
    }
    Plan plan() {
        const PatternGrid grid = plan_grid(pattern, input.geometry.pitch);
        input.pattern = &pattern;
        input.window_inner = grid.window_inner;
        input.window_outer = grid.window_outer;
        input.radius_nodes = grid.radius;
        summarise(input.geometry, sources, grid.window_outer / input.geometry.pitch, summary);
        input.lights = &summary;
        return make_plan(input, budget, costs);
    }

    PlanInput input;
    PatternSettings pattern;
    Budget budget;
    DeviceCosts costs;
    std::vector<PointSource> sources;
    LightSummary summary;
};

const Omission* find(const Plan& plan, Omitted what) {
    for (const Omission& omission : plan.left_out.all())
        if (omission.what == what) return &omission;
    return nullptr;
}
const PlannedPass* find(const Plan& plan, PassKind kind) {
    for (const PlannedPass& pass : plan.passes.all())
        if (pass.kind == kind) return &pass;
    return nullptr;
}

TEST(Plan, WithoutLightsThereIsNoFrame) {
    Case empty;
    const Plan plan = empty.plan();
    EXPECT_FALSE(plan.draw);
    EXPECT_NE(find(plan, Omitted::frame), nullptr);
    EXPECT_EQ(find(plan, PassKind::composite), nullptr);
    EXPECT_EQ(plan.pattern, PatternAction::none);
    EXPECT_EQ(plan.error_bound_codes, 0);
}

TEST(Plan, EveryPassAndOmissionSaysWhy) {
    Case some;
    for (int i = 0; i < 40; ++i)
        some.add(1e-5 * (i + 1), i - 20, static_cast<std::uint32_t>(i) % 7);
    some.input.left_out = {1, 2, 3, 4, 5, 6};
    const Plan plan = some.plan();
    EXPECT_TRUE(plan.draw);
    double bound = 0, predicted = 0;
    for (const Omission& omission : plan.left_out.all()) {
        EXPECT_FALSE(omission.reason.empty());
        EXPECT_FALSE(name_of(omission.what).empty());
        EXPECT_GT(omission.count, 0);
        EXPECT_GE(omission.bound_codes, 0);
        bound += omission.bound_codes;
    }
    for (const PlannedPass& pass : plan.passes.all()) {
        EXPECT_FALSE(pass.reason.empty());
        EXPECT_FALSE(name_of(pass.kind).empty());
        EXPECT_TRUE(std::isfinite(pass.predicted_ms) && pass.predicted_ms >= 0);
        predicted += pass.predicted_ms;
    }
    EXPECT_NEAR(plan.error_bound_codes, bound, 1e-12);
    EXPECT_NEAR(plan.predicted_ms, predicted, 1e-9);
    EXPECT_GT(predicted, 0);
}

TEST(Plan, BoundsTogetherStayUnderTheBudget) {
    for (const double budget : {0.25, 0.5, 1.0, 2.0, 4.0}) {
        for (const int lights : {1, 3, 50, 2000}) {
            for (const double adaptation : {0.001, 0.1, 10.0, 3000.0}) {
                Case some;
                some.budget.max_error_codes = budget;
                some.input.adaptation_cd_m2 = adaptation;
                some.input.left_out = {1, 2, 3, 4, 5, 6};
                some.input.pattern_usable = true;
                some.input.pattern_motion_codes = 0.05;
                for (int i = 0; i < lights; ++i)
                    some.add(std::pow(10.0, -6 + i % 5), 0.03 * (i % 1000) - 15,
                             static_cast<std::uint32_t>(i) % 3);
                const Plan plan = some.plan();
                EXPECT_LE(plan.error_bound_codes, budget * 1.0000001) << lights << " " << adaptation;
                EXPECT_EQ(plan.max_error_codes, budget);
            }
        }
    }
}

TEST(Plan, ABudgetOfNothingLeavesNothingOutThatShows) {
    Case some;
    some.budget.max_error_codes = 0;
    some.input.adaptation_cd_m2 = 5000;
    some.input.pattern_usable = true;
    some.input.pattern_motion_codes = 1e-3;
    for (int i = 0; i < 10; ++i)
        some.add(1e-3, i, static_cast<std::uint32_t>(i) % 3);
    const Plan plan = some.plan();
    EXPECT_EQ(plan.error_bound_codes, 0);
    EXPECT_EQ(plan.accumulation.skirt_threshold_cd_m2, 0);
    EXPECT_EQ(plan.accumulation.tail_threshold_cd_m2, 0);
    EXPECT_EQ(plan.accumulation.tail_cell_px, 1);
    EXPECT_EQ(plan.accumulation.disc_scale, 1);
    EXPECT_TRUE(plan.rod_hue);
    EXPECT_EQ(plan.pattern, PatternAction::make);
    EXPECT_EQ(plan.lamps_with_pattern, 0b111U);
}

TEST(Plan, ShareOfEachLightAddsUpToTheBudgetAtMost) {
    Case one, many;
    one.add(1e-3);
    for (int i = 0; i < 1000; ++i)
        many.add(1e-3, 0.01 * i - 5);
    const Plan a = one.plan(), b = many.plan();
    EXPECT_GT(b.accumulation.skirt_threshold_cd_m2, 0);
    const double together = 1000 * b.accumulation.skirt_threshold_cd_m2;
    EXPECT_LE(together, a.accumulation.skirt_threshold_cd_m2 * 4.2)
        << "lights that lie in one neighbourhood share";
    EXPECT_LT(b.accumulation.tail_threshold_cd_m2, a.accumulation.tail_threshold_cd_m2 / 900);
}

TEST(Plan, LightsFarFromEachOtherDoNotShareTheSkirtsBudget) {
    Case near, spread;
    for (int i = 0; i < 8; ++i) {
        near.add(1e-3, 0.1 * i);
        spread.add(1e-3, 8.0 * i - 28);
    }
    EXPECT_GT(spread.plan().accumulation.skirt_threshold_cd_m2,
              2 * near.plan().accumulation.skirt_threshold_cd_m2);
}

TEST(Plan, RodHueIsLeftOutByDayAndNotByNight) {
    Case night, day;
    night.add(1e-3);
    day.add(1);
    day.input.adaptation_cd_m2 = 5000;
    EXPECT_TRUE(night.plan().rod_hue);
    const Plan plan = day.plan();
    EXPECT_FALSE(plan.rod_hue);
    ASSERT_NE(find(plan, Omitted::rod_hue), nullptr);
    EXPECT_GT(find(plan, Omitted::rod_hue)->bound_codes, 0);
}

TEST(Plan, LayersGoAsFarAsTheLargestLamp) {
    Case points, small, large;
    points.add(1e-3, 0, 0, 0);
    small.add(1e-3, 0, 0, 0.01, 5000);
    large.add(1e-3, 0, 0, 3, 1000);  // 2.6 px
    EXPECT_EQ(points.plan().largest_disc_nodes, 0);
    const Plan s = small.plan();
    EXPECT_EQ(s.largest_disc_nodes, 0) << "too small to show";
    ASSERT_NE(find(s, Omitted::discs), nullptr);
    EXPECT_EQ(s.accumulation.disc_scale, 0);
    EXPECT_EQ(find(s, Omitted::disc_layers)->count, 4);
    const Plan l = large.plan();
    EXPECT_NEAR(l.largest_disc_nodes, 2.6, 0.05);
    EXPECT_EQ(find(l, Omitted::discs), nullptr);
    EXPECT_EQ(find(l, Omitted::disc_layers)->count, 2) << "0, 1.5 and 3 are needed of 0, 1.5, 3, 6, 12";
}

TEST(Plan, APatternServesAgainWhileItsMotionDoesNotShow) {
    Case some;
    some.add(1e-3);
    EXPECT_EQ(some.plan().pattern, PatternAction::make) << "there is none yet";
    some.input.pattern_usable = true;
    some.input.pattern_motion_codes = 1;
    EXPECT_EQ(some.plan().pattern, PatternAction::make);
    some.input.pattern_motion_codes = 0.05;
    const Plan plan = some.plan();
    EXPECT_EQ(plan.pattern, PatternAction::reuse);
    EXPECT_EQ(find(plan, Omitted::new_pattern)->bound_codes, 0.05);
    EXPECT_EQ(find(plan, PassKind::pattern)->predicted_ms, 0);
    some.input.pattern_motion_codes = 1;
    some.input.same_instant = true;
    EXPECT_EQ(some.plan().pattern, PatternAction::reuse);
}

TEST(Plan, ALampGoesWithoutItsOwnPatternOnlyWhenAllItsLightsAreTooFaint) {
    Case bright, faint;
    for (Case* some : {&bright, &faint}) {
        some->budget.max_error_codes = 1;
        some->add(1e-3, 0, 0);
    }
    bright.add(1e-4, 3, 2);
    faint.add(1e-10, 3, 2);
    EXPECT_EQ(bright.plan().lamps_with_pattern, 0b101U);
    const Plan plan = faint.plan();
    EXPECT_EQ(plan.lamps_with_pattern, 0b001U);
    ASSERT_NE(find(plan, Omitted::own_patterns), nullptr);
    EXPECT_LE(find(plan, Omitted::own_patterns)->bound_codes, 0.2);
}

TEST(Plan, FilterAndMoreLampsThanAllowedAreSaid) {
    Case filter, crowd;
    filter.pattern.spectra = SpectraMode::filter;
    crowd.pattern.max_lamps_in_view = 3;
    for (std::uint32_t lamp = 0; lamp < 6; ++lamp) {
        filter.add(1e-3, lamp, lamp);
        crowd.add(1e-3, lamp, lamp);
    }
    const Plan f = filter.plan();
    EXPECT_EQ(find(f, Omitted::own_patterns)->count, 5);
    EXPECT_EQ(find(f, Omitted::own_patterns)->bound_codes, 58);
    EXPECT_EQ(find(crowd.plan(), Omitted::own_patterns)->count, 3);
}

TEST(Plan, FaintLightsNeedNoTailAndBrightOnesAFinerGrid) {
    Case faint, bright;
    faint.add(1e-8);
    bright.add(10);
    EXPECT_EQ(faint.plan().accumulation.tail_cell_px, 0);
    const Plan plan = bright.plan();
    EXPECT_GE(plan.accumulation.tail_cell_px, 1);
    bright.budget.max_error_codes = 4;
    EXPECT_GT(bright.plan().accumulation.tail_cell_px, plan.accumulation.tail_cell_px);
    Case thesis;
    thesis.add(1e-3);
    thesis.input.has_tail = false;
    EXPECT_EQ(thesis.plan().accumulation.tail_cell_px, 0);
    EXPECT_EQ(find(thesis.plan(), Omitted::tails), nullptr);
}

TEST(Plan, TheCheapestMethodIsChosenAndKeptUntilAnotherIsClearlyCheaper) {
    Case crowd;
    for (int i = 0; i < 3000; ++i)
        crowd.add(1e-4, 0.02 * i - 30);
    EXPECT_EQ(crowd.plan().accumulation.method, Accumulation::gl_billboards) << "nothing else can";
    crowd.input.can_gather = true;
    EXPECT_EQ(crowd.plan().accumulation.method, Accumulation::cl_tiles);
    // Ten per cent are no reason to change.
    const double tiles_ms = find(crowd.plan(), PassKind::accumulate)->predicted_ms;
    crowd.input.last_method = Accumulation::cl_tiles;
    crowd.input.can_gather = false;
    const double billboards_ms = find(crowd.plan(), PassKind::accumulate)->predicted_ms;
    crowd.input.can_gather = true;
    for (const Work work : {Work::cl_pass, Work::cl_screen_px, Work::cl_light, Work::cl_light_px})
        crowd.costs.of(work) *= 1.1 * billboards_ms / tiles_ms;
    EXPECT_EQ(crowd.plan().accumulation.method, Accumulation::cl_tiles);
    crowd.input.last_method = Accumulation::gl_billboards;
    EXPECT_EQ(crowd.plan().accumulation.method, Accumulation::gl_billboards);
}

TEST(Plan, PredictedTimeFallsAsTheBudgetGrows) {
    double before = 1e9;
    for (const double budget : {0.0, 0.25, 0.5, 1.0, 2.0, 4.0}) {
        Case crowd;
        crowd.budget.max_error_codes = budget;
        for (int i = 0; i < 300; ++i)
            crowd.add(1e-6 * (1 + i % 30), 0.2 * i - 30);
        const double ms = find(crowd.plan(), PassKind::accumulate)->predicted_ms;
        EXPECT_LT(ms, before) << budget;
        before = ms;
    }
}

TEST(Plan, WhatATimeBudgetGivesUpIsSaidAndComesGradually) {
    Case some;
    some.budget.time_ms = 8;
    some.add(1e-2, 0, 0, 3, 1000);
    some.add(1e-3, 4, 2);
    double codes = 0, disc = 1e9, blend = -1;
    for (double loss = 0; loss <= 1.0001; loss += 0.01) {
        some.input.given_up.level = {loss, 0, loss, loss};
        const Plan plan = some.plan();
        EXPECT_GE(plan.max_error_codes, codes);
        EXPECT_LE(plan.accumulation.disc_scale, disc);
        EXPECT_GE(plan.filter_blend, blend);
        EXPECT_LE(plan.filter_blend - std::max(blend, 0.0), 0.06);
        if (disc < 1e8) {
            EXPECT_LE(disc - plan.accumulation.disc_scale, 0.07);
        }
        codes = plan.max_error_codes;
        disc = plan.accumulation.disc_scale;
        blend = plan.filter_blend;
        EXPECT_EQ(find(plan, Omitted::quality) != nullptr, disc < 1 || blend > 0);
    }
    EXPECT_EQ(codes, 4);
    EXPECT_EQ(disc, 0);
    EXPECT_EQ(blend, 1);
    some.input.given_up.level = {1, 0, 1, 1};
    EXPECT_EQ(some.plan().lamps_with_pattern, 1U);
    EXPECT_EQ(some.plan().largest_disc_nodes, 0);
}

TEST(Plan, EachKindOfQualityIsGivenUpByItself) {
    Case some;
    some.budget.time_ms = 8;
    some.add(1e-2, 0, 0, 3, 1000);
    some.add(1e-3, 4, 2);
    const Plan best = some.plan();
    for (std::size_t k = 0; k < quality_kinds; ++k) {
        some.input.given_up = {};
        some.input.given_up.level[k] = 1;
        const Plan plan = some.plan();
        const auto kind = static_cast<Quality>(k);
        EXPECT_FALSE(name_of(kind).empty());
        EXPECT_EQ(plan.max_error_codes > best.max_error_codes, kind == Quality::error);
        EXPECT_EQ(plan.pattern_step_s > 0, kind == Quality::motion);
        EXPECT_EQ(plan.accumulation.disc_scale < 1, kind == Quality::discs);
        EXPECT_EQ(plan.filter_blend > 0, kind == Quality::lamps);
        EXPECT_EQ(find(plan, Omitted::quality) != nullptr, kind != Quality::error);
        EXPECT_GE(plan.error_bound_codes, best.error_bound_codes);
    }
}

TEST(Plan, ThePatternFollowsTheEyeInStepsOfWhichTheLongerAreAmongTheShorter) {
    EXPECT_EQ(pattern_step_s(0), 0);
    double before = 0;
    for (double level = 0; level <= 1; level += 0.01) {
        const double step = pattern_step_s(level);
        EXPECT_GE(step, before);
        if (before > 0) {
            EXPECT_EQ(std::fmod(step, before), 0);
        }
        before = step;
    }
    EXPECT_EQ(before, 1.0 / 16);
    Case some;
    some.add(1e-3);
    const double every_frame_ms = find(some.plan(), PassKind::upload)->predicted_ms;
    some.input.given_up.of(Quality::motion) = 1;
    const Plan plan = some.plan();
    const double table_ms = plan.pattern_taken_ms;
    EXPECT_GT(table_ms, 0);
    EXPECT_NEAR(every_frame_ms - find(plan, PassKind::upload)->predicted_ms, table_ms * (1 - 16.0 / 60), 1e-9)
        << "it is uploaded 16 times a second, not 60";
}

TEST(Savings, AreWhatThePlanSaysWithAndWithout) {
    Case some;
    some.budget.time_ms = 8;
    for (int i = 0; i < 50; ++i)
        some.add(1e-4 * (1 + i % 7), 0.5 * i - 12, static_cast<std::uint32_t>(i) % 3, 3);
    some.input.pattern_motion_codes = 5;
    const double before_ms = counted_ms(some.plan());
    for (std::size_t k = 0; k < quality_kinds; ++k) {
        const auto kind = static_cast<Quality>(k);
        const Saving saving = saving_of(kind, some.input, some.budget, some.costs);
        some.input.given_up = {};
        some.input.given_up.of(kind) = 1;
        const Plan without = some.plan();
        EXPECT_NEAR(saving.ms, before_ms - counted_ms(without), 1e-9) << name_of(kind);
        EXPECT_NEAR(saving.part, saving.ms / before_ms, 1e-12) << name_of(kind);
        EXPECT_GT(saving.ms, 0) << name_of(kind);
        EXPECT_GT(saving.codes, 0) << name_of(kind);
        // How much is given up already does not change what all of it is worth.
        some.input.given_up.of(kind) = 0.6;
        EXPECT_EQ(saving_of(kind, some.input, some.budget, some.costs), saving) << name_of(kind);
        some.input.given_up = {};
    }
}

TEST(Savings, AreNoneWhereThereIsNothingToGiveUp) {
    Case white;
    white.budget.time_ms = 8;
    white.add(1e-4, 0, 0, 0);
    const auto saving = [&](Quality kind) { return saving_of(kind, white.input, white.budget, white.costs); };
    static_cast<void>(white.plan());
    EXPECT_EQ(saving(Quality::discs).ms, 0) << "a point";
    EXPECT_EQ(saving(Quality::lamps).ms, 0) << "one lamp, the white one";
    EXPECT_GT(saving(Quality::motion).part, least_saving_part);
    white.input.same_instant = white.input.pattern_usable = true;
    EXPECT_EQ(saving(Quality::motion).ms, 0) << "no pattern is made";
    // Where one pass takes all the time, what does not touch it is not worth giving up.
    white.input.same_instant = white.input.pattern_usable = false;
    white.costs.of(Work::gl_draw) = 1e9;
    for (std::size_t k = 0; k < quality_kinds; ++k)
        EXPECT_LT(saving(static_cast<Quality>(k)).part, least_saving_part / 2);
}

TEST(Plan, EqualInputsAndPinnedCostsGiveEqualPlans) {
    Case a, b;
    for (Case* some : {&a, &b}) {
        some->costs.pinned = true;
        for (int i = 0; i < 100; ++i)
            some->add(1e-5 * (i + 1), 0.3 * i - 15, static_cast<std::uint32_t>(i) % 5);
    }
    // What one of them measured does not count.
    for (int i = 0; i < 50; ++i)
        learn(b.costs, {Work::gl_skirt_px, Work::composite_px}, 1, 100);
    const Plan x = a.plan(), y = b.plan();
    EXPECT_EQ(x.predicted_ms, y.predicted_ms);
    EXPECT_EQ(x.accumulation.method, y.accumulation.method);
    EXPECT_EQ(x.accumulation.skirt_threshold_cd_m2, y.accumulation.skirt_threshold_cd_m2);
    EXPECT_EQ(x.error_bound_codes, y.error_bound_codes);
    EXPECT_EQ(x.lamps_with_pattern, y.lamps_with_pattern);
}

}  // namespace
}  // namespace seaglare::glare
