#include "glare/plan/plan.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "glare/plan/plan_cost.h"
#include "glare/plan/sensitivity.h"
#include "glare/psf/pattern_grid.h"

namespace seaglare::glare {

namespace {

// The largest that a lamp's own pattern and the white one, tinted, were found to differ by: glare/colour/README.md.
constexpr double other_lamp_codes = 58;
// The same as a part of the light's own glare: energy of the core 2.8 %, of single nodes of the skirt less than all.
constexpr double other_lamp_core_ratio = 0.03;
// A method takes the place of the one of the frame before when it costs less than this part of it.
constexpr double clear_gain = 0.8;
// Near a light its glare is the core's, which knows neither discs of a layer nor lamps: from here on it is the pattern's.
constexpr double skirt_starts_px = 2;

double smooth(double t) {
    return t * t * (3 - 2 * t);
}

class Planner {
  public:
    Planner(const PlanInput& input, const Budget& budget, const DeviceCosts& costs)
        : in_(input),
          costs_(costs),
          lights_(*input.lights),
          bound_(input.tail_age_years, input.tail_pigmentation, input.pattern->angular_scale),
          sensitivity_(sensitivity(input.tone, input.adaptation_cd_m2, lights_.largest_channel_ratio)) {
        plan_.given_up = input.given_up;
        plan_.max_error_codes = error_allowed_codes(budget, given_up(Quality::error));
    }

    Plan make() {
        count_lights();
        pass(PassKind::evaluate, "the lights of the database for this eye and instant",
             (costs_.of(Work::frame_planned) + costs_.of(Work::light_evaluated) * in_.lights_total) / 1e6);
        if (in_.asks_visibility)
            pass(PassKind::visibility,
                 "the frame has a visibility callback: other channels' depth is unknown", 0);
        else
            leave_out(Omitted::visibility_callback, "the frame has none", 1, 0);
        plan_.draw = lights_.lights > 0;
        if (!plan_.draw) {
            leave_out(Omitted::frame, "no light is visible: no GL call is made", 1, 0);
            return finished();
        }
        choose_pattern();
        choose_thresholds();
        choose_method();
        plan_passes();
        return finished();
    }

  private:
    void pass(PassKind kind, std::string_view reason, double predicted_ms) {
        plan_.passes.push_back({kind, reason, predicted_ms});
        plan_.predicted_ms += predicted_ms;
    }
    void leave_out(Omitted what, std::string_view reason, double count, double bound_codes) {
        if (!(count > 0)) return;
        plan_.left_out.push_back({what, reason, count, bound_codes});
        plan_.error_bound_codes += bound_codes;
    }
    Plan finished() { return plan_; }
    double part_codes(double part) const { return part * plan_.max_error_codes; }
    double given_up(Quality kind) const { return std::clamp(in_.given_up.of(kind), 0.0, 1.0); }

    void count_lights() {
        const LightsLeftOut& n = in_.left_out;
        leave_out(Omitted::dark_lights, "dark: off, eclipsed, outside its sectors or profile", n.dark, 0);
        leave_out(Omitted::lights_below_horizon, "below the geographical horizon", n.horizon, 0);
        leave_out(Omitted::hidden_lights, "hidden: the visibility callback says 0", n.hidden, 0);
        // One sum over all of these is kept under the threshold: apply/cull.cpp.
        double codes = part_codes(budget_part::lights);
        const auto faint = [&](Omitted what, std::string_view reason, double count) {
            leave_out(what, reason, count, codes);
            if (count > 0) codes = 0;
        };
        faint(Omitted::lights_outside, "behind the eye, or its glare does not reach into the picture",
              n.outside);
        faint(Omitted::lights_too_far, "too far: at its brightest it would change no display code",
              n.too_far);
        faint(Omitted::lights_too_faint, "changes no display code", n.too_faint);
    }

    // Glare of every light is wrong by at most this part of itself, from the skirt's start on.
    double codes_of_ratio(double ratio) const {
        double most_cd_m2 = 0;
        for (const BrightnessHistogram& cell : lights_.neighbourhoods)
            most_cd_m2 = std::max(most_cd_m2, cell.total_lux());
        most_cd_m2 *= bound_.psf_sr(skirt_starts_px * in_.geometry.pitch) * ratio;
        return std::min(sensitivity_.codes_per_unit_ratio * ratio, sensitivity_.codes_per_cd_m2 * most_cd_m2);
    }

    void choose_pattern() {
        double room_codes = part_codes(budget_part::pattern);
        const auto affords = [&](double codes) {
            if (codes > room_codes) return false;
            room_codes -= codes;
            return true;
        };
        choose_rod_hue(affords);
        choose_discs(affords);
        choose_lamps(affords);
        leave_out(Omitted::spectra,
                  "more than 25 named spectra in the database: the pattern of the nearest lamp",
                  in_.spectra_without_pattern, other_lamp_codes);
        if (in_.eye_focused)
            leave_out(Omitted::complex_half, "the eye is focused: the aperture is real", 1, 0);
        plan_.pattern = PatternAction::make;
        if (in_.pattern_usable && in_.same_instant) {
            plan_.pattern = PatternAction::reuse;
            leave_out(Omitted::new_pattern, "already made for this instant and pitch", 1, 0);
        } else if (in_.pattern_usable && affords(in_.pattern_motion_codes)) {
            plan_.pattern = PatternAction::reuse;
            leave_out(Omitted::new_pattern, "no light is bright enough for the eye's motion to show", 1,
                      in_.pattern_motion_codes);
        }
        if (plan_.pattern != PatternAction::make) return;
        plan_.pattern_step_s = pattern_step_s(given_up(Quality::motion));
        // Both what is shown and what is not are as far from the eye at rest as its motion takes them.
        leave_out(Omitted::quality, "time is short: the pattern follows the eye less often",
                  plan_.pattern_step_s > 0 ? 1 : 0, 2 * in_.pattern_motion_codes);
    }

    template <class Affords>
    void choose_rod_hue(const Affords& affords) {
        plan_.rod_hue = in_.tone.blue_shift;
        if (!plan_.rod_hue) return;
        const double codes = rod_hue_codes(in_.tone, in_.adaptation_cd_m2, lights_.largest_channel_ratio,
                                           lights_.largest_scotopic_ratio);
        if (!affords(codes)) return;
        plan_.rod_hue = false;
        leave_out(Omitted::rod_hue, "by day the rods take no part", 1, codes);
    }

    template <class Affords>
    void choose_discs(const Affords& affords) {
        const PatternSettings& settings = *in_.pattern;
        const double configured = static_cast<double>(settings.layer_radii_px.size());
        const double nodes = std::sin(lights_.largest_disc_rad) / in_.geometry.pitch;
        plan_.accumulation.disc_scale = 1 - smooth(given_up(Quality::discs));
        if (plan_.accumulation.disc_scale < 1 && nodes > 0) {
            leave_out(Omitted::quality, "time is short: the skirts of large lamps draw nearer to a point's",
                      1, codes_of_ratio(1 - plan_.accumulation.disc_scale));
        }
        plan_.largest_disc_nodes = nodes * plan_.accumulation.disc_scale;
        // Between the point's layer and the next the skirt is mixed in proportion to the square of the radius, and no layer
        // differs from the point's by more than itself.
        const double first = configured > 1 ? static_cast<double>(settings.layer_radii_px[1]) : 1;
        const double ratio =
            std::min(1.0, plan_.largest_disc_nodes * plan_.largest_disc_nodes / (first * first));
        const double codes = codes_of_ratio(ratio);
        if (plan_.largest_disc_nodes > 0 && affords(codes)) {
            plan_.largest_disc_nodes = 0;
            plan_.accumulation.disc_scale = 0;
            leave_out(Omitted::discs,
                      "no light is larger than a small part of a pixel: a point's pattern serves",
                      std::max(lights_.disc_lights, 1U), codes);
        }
        PatternGrid grid;
        grid.margin = 1 << 16;
        layers_ =
            static_cast<int>(layer_plan(settings, grid, static_cast<float>(plan_.largest_disc_nodes)).count);
        leave_out(Omitted::disc_layers, "no light in view is that large", configured - layers_, 0);
    }

    // A lamp is drawn with another's pattern when all its lights together are too faint for the difference to show.
    template <class Affords>
    void choose_lamps(const Affords& affords) {
        const PatternSettings& settings = *in_.pattern;
        plan_.filter_blend = smooth(given_up(Quality::lamps));
        std::uint32_t own = lights_.lamps;
        if (settings.spectra == SpectraMode::filter) {
            own = 1;
            const int others = std::popcount(lights_.lamps & ~1U);
            leave_out(Omitted::own_patterns, "spectra is \"filter\": the white pattern, tinted", others,
                      other_lamp_codes);
            plan_.filter_blend = 0;
        } else {
            const double pixel_sr = in_.geometry.plane_area_px;
            const double core_per_lx = other_lamp_core_ratio / (4 * std::max(pixel_sr, 1e-18));
            const double skirt_per_lx = bound_.psf_sr(skirt_starts_px * in_.geometry.pitch);
            double spent_codes = 0;
            int stand_ins = 0;
            for (std::size_t lamp = 1; lamp < most_lamps; ++lamp) {
                const std::uint32_t bit = 1U << lamp;
                if ((own & bit) == 0 || std::popcount(own) == 1) continue;
                const double codes =
                    sensitivity_.codes_per_cd_m2 * lights_.lux_of_lamp[lamp] * (core_per_lx + skirt_per_lx);
                if (!affords(codes)) continue;
                own &= ~bit;
                spent_codes += codes;
                ++stand_ins;
            }
            leave_out(Omitted::own_patterns,
                      "all lights of the lamp are too faint for its own pattern to show", stand_ins,
                      spent_codes);
            const int beyond = std::popcount(own) - settings.max_lamps_in_view;
            leave_out(Omitted::own_patterns,
                      "more lamps in view than max_lamps_in_view: the pattern of the nearest lamp",
                      std::max(beyond, 0), other_lamp_codes);
            if (plan_.filter_blend > 0 && std::popcount(own) > 1) {
                leave_out(Omitted::quality,
                          "time is short: the patterns of coloured lamps draw nearer to the white one",
                          std::popcount(own) - 1, other_lamp_codes * plan_.filter_blend);
                if (plan_.filter_blend >= 1) own = 1;
            }
        }
        // What the others go over to must be there from the first step on.
        if (plan_.filter_blend > 0) own |= 1;
        plan_.lamps_with_pattern = own;
        lamps_ = std::min(std::popcount(own), settings.max_lamps_in_view);
    }

    void choose_thresholds() {
        AccumulationPlan& plan = plan_.accumulation;
        const double pitch = in_.geometry.pitch;
        const double skirts_codes = part_codes(budget_part::skirts);
        const double tails_codes = part_codes(budget_part::tails);
        plan.structure_codes = skirts_codes;
        // Where the skirt hands over early the coarse grid follows the curve by a quarter of the bound at worst.
        plan.skirt_threshold_cd_m2 =
            share_of_each(lights_.neighbourhoods, sensitivity_.luminance_cd_m2(skirts_codes) / 1.25,
                          bound_.psf_sr(3 * pitch));
        leave_out(Omitted::skirts, "outskirts below each light's share are left to the smooth tail",
                  plan.skirt_threshold_cd_m2 > 0 ? lights_.lights : 0, skirts_codes);
        if (!in_.has_tail) {
            plan.tail_cell_px = 0;
            return;
        }
        // The tail is the curve itself, a structure_headroom-th of the bound by which its end is found.
        const double window_psf_sr = bound_.psf_sr(std::asin(std::min(in_.window_inner, 1.0)));
        const double most_cd_m2 = sensitivity_.luminance_cd_m2(tails_codes);
        if (lights_.all.total_lux() * window_psf_sr / structure_headroom <= most_cd_m2) {
            plan.tail_cell_px = 0;
            leave_out(Omitted::tails, "all tails together change no display code", lights_.lights,
                      tails_codes);
            return;
        }
        plan.tail_threshold_cd_m2 = structure_headroom * share_of_each(std::span(&lights_.all, 1), most_cd_m2,
                                                                       window_psf_sr / structure_headroom);
        leave_out(Omitted::tails, "they end below each light's share",
                  plan.tail_threshold_cd_m2 > 0 ? lights_.lights : 0, tails_codes);
        choose_grid();
    }

    // What a grid of cells loses between its nodes, as a part of the tail there: h^2/8 of the second derivatives along both
    // axes, of the half cosine by which the tail takes over from the skirt and of the curve, a power of about -2.5.
    double grid_ratio(int cell) const {
        const double start_px = in_.window_outer / in_.geometry.pitch;
        const double fade_px = std::max(5.0 * cell, start_px / 3);
        const double fade = std::numbers::pi * cell / fade_px;
        const double curve = cell / start_px;
        return (fade * fade / 2 + 2.5 * 3.5 * curve * curve) / 8;
    }
    double grid_codes(int cell) const {
        if (cell <= 1) return 0;
        const double tail_sr = bound_.psf_sr(std::asin(std::min(in_.window_outer, 1.0))) / structure_headroom;
        double most_lx = 0;
        for (const BrightnessHistogram& cell_lights : lights_.neighbourhoods)
            most_lx = std::max(most_lx, cell_lights.total_lux());
        const double ratio = grid_ratio(cell);
        return std::min(sensitivity_.codes_per_unit_ratio * ratio,
                        sensitivity_.codes_per_cd_m2 * most_lx * tail_sr * ratio);
    }
    void choose_grid() {
        const double window_px = in_.window_outer / in_.geometry.pitch;
        int cell = static_cast<int>(std::clamp(std::floor(window_px / 6), 1.0, 8.0));
        while (cell > 1 && grid_codes(cell) > part_codes(budget_part::grid))
            --cell;
        plan_.accumulation.tail_cell_px = cell;
        leave_out(Omitted::fine_tails, "the tails are smooth: a coarse grid carries them", cell > 1 ? 1 : 0,
                  grid_codes(cell));
    }

    void choose_method() {
        const CoveredArea area = covered_area(
            in_, plan_.accumulation, bound_, sensitivity_.luminance_cd_m2(plan_.accumulation.structure_codes),
            sensitivity_.luminance_cd_m2(least_composited_codes));
        area_ = area;
        AccumulationPlan& plan = plan_.accumulation;
        const auto cost_of = [&](Accumulation method) {
            AccumulationPlan other = plan;
            other.method = method;
            const double cost = accumulation_ms(in_, area, other, costs_);
            return method == in_.last_method ? cost * clear_gain : cost;
        };
        Accumulation best = Accumulation::gl_billboards;
        if (in_.can_gather && cost_of(Accumulation::cl_tiles) < cost_of(best)) best = Accumulation::cl_tiles;
        plan.method = best;
        // What is not known yet may cost as much again as all that is.
        if (best == Accumulation::cl_tiles) {
            plan.most_unknown_px =
                accumulation_ms(in_, area, plan, costs_) * 1e6 / std::max(costs_.of(Work::gl_skirt_px), 1e-3);
        }
    }

    void plan_passes() {
        const double lights_ms = costs_.of(Work::light_uploaded) * lights_.lights / 1e6;
        const bool makes = plan_.pattern == PatternAction::make;
        const PatternWork work =
            makes ? pattern_work(in_, lamps_, layers_, plan_.pattern_step_s, costs_) : PatternWork{};
        // What a gather reads of the pattern is copied to its device by who makes the pattern.
        const bool in_frame = plan_.accumulation.method == Accumulation::gl_billboards;
        plan_.upload_lights_ms = lights_ms / 2;
        plan_.pattern_taken_ms = in_frame ? work.taken_ms : 0;
        pass(PassKind::pattern,
             makes ? "the eye moves, or other lights are in view" : "the one that is there is used again",
             work.made_ms * work.made_per_frame +
                 (work.mixed_ms + work.taken_ms - plan_.pattern_taken_ms) * work.taken_per_frame);
        pass(PassKind::upload, "lights that can change a display code, and the pattern",
             lights_ms / 2 + plan_.pattern_taken_ms * work.taken_per_frame);
        if (in_.has_depth)
            pass(PassKind::occlusion, "the frame has depth", lights_ms / 2 + costs_.of(Work::gl_draw) / 1e6);
        else
            leave_out(Omitted::depth_test, "the frame has no depth", 1, 0);
        static constexpr std::array<std::string_view, 2> reasons = {
            "one cropped rectangle a light costs least", "a gather over tiles in OpenCL costs least"};
        pass(PassKind::accumulate, reasons[static_cast<std::size_t>(plan_.accumulation.method)],
             accumulation_ms(in_, area_, plan_.accumulation, costs_));
        pass(PassKind::composite, "tone map and add to the target",
             (costs_.of(Work::gl_draw) + costs_.of(Work::composite_px) * area_.composite_px) / 1e6);
    }

    const PlanInput& in_;
    const DeviceCosts& costs_;
    const LightSummary& lights_;
    GlareBound bound_;
    Sensitivity sensitivity_;
    CoveredArea area_;
    int layers_ = 1;
    int lamps_ = 1;
    Plan plan_;
};

}  // namespace

Plan make_plan(const PlanInput& input, const Budget& budget, const DeviceCosts& costs) {
    return Planner(input, budget, costs).make();
}

double error_allowed_codes(const Budget& budget, double given_up) {
    const double least = std::max(budget.max_error_codes, 0.0);
    if (!(budget.time_ms > 0) || !(given_up > 0)) return least;
    const double most = std::max(budget.most_error_codes, least);
    // By the same factor for each step, so that a step shows as little anywhere.
    const double from = std::max(least, 0.05);
    return std::max(least, from * std::pow(std::max(most / from, 1.0), std::min(given_up, 1.0)));
}

double light_threshold_codes(const Budget& budget, double given_up, int cullings) {
    // What is not even evaluated adds up to a quarter of the threshold: least_light.h.
    constexpr double not_evaluated = 0.25;
    return budget_part::lights * error_allowed_codes(budget, given_up) / (cullings + not_evaluated);
}

std::string_view name_of(PassKind kind) {
    static constexpr std::array<std::string_view, pass_kinds> names = {
        "evaluate", "visibility", "pattern", "upload", "occlusion", "accumulate", "composite"};
    return names[static_cast<std::size_t>(kind)];
}

std::string_view name_of(Omitted what) {
    // Of a light the reason says which kind it is.
    static constexpr std::array<std::string_view, omission_kinds> names = {"frame",
                                                                           "light",
                                                                           "light",
                                                                           "light",
                                                                           "light",
                                                                           "light",
                                                                           "light",
                                                                           "new pattern",
                                                                           "complex half of the transform",
                                                                           "disc layer",
                                                                           "disc",
                                                                           "rod hue",
                                                                           "lamp's own pattern",
                                                                           "spectrum",
                                                                           "outskirts",
                                                                           "end of a tail",
                                                                           "fine tails",
                                                                           "depth test",
                                                                           "visibility callback",
                                                                           "quality"};
    return names[static_cast<std::size_t>(what)];
}

std::string_view name_of(Accumulation method) {
    static constexpr std::array<std::string_view, 2> names = {"gl_billboards", "cl_tiles"};
    return names[static_cast<std::size_t>(method)];
}

std::string_view name_of(PatternAction action) {
    static constexpr std::array<std::string_view, 3> names = {"none", "reuse", "make"};
    return names[static_cast<std::size_t>(action)];
}

}  // namespace seaglare::glare
