#include "glare/plan/plan_cost.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seaglare::glare {

namespace {

constexpr double ns_per_ms = 1e6;
constexpr double crop_least_px = 3;
constexpr double core_side_px = 4.5;        // the footprint's rectangle
constexpr double fine_of_skirt = 0.55;      // so much of the skirt's logarithm is where finer nodes end
constexpr double nearest_structure_px = 5;  // nearer, a gather has all of a light at full resolution

double disc_px2(double radius_px) {
    return std::numbers::pi * radius_px * radius_px;
}

// A billboard is a rectangle around what it covers.
double box_px2(double radius_px, double picture_px2) {
    return std::min(4 * radius_px * radius_px, picture_px2);
}

double transform_samples(int side) {
    const double n = side;
    return n * n * std::log2(std::max(n, 2.0));
}

}  // namespace

CoveredArea covered_area(const PlanInput& input, const AccumulationPlan& accumulation,
                         const GlareBound& bound, double structure_cd_m2, double least_cd_m2) {
    CoveredArea area;
    // Departures of lights from their mean add up as squares do: of N that share, each may lose the N-th root of what is
    // lost together, not an N-th. The bound is above the mean, and departures are below it (glare_bound.h).
    const double own_cd_m2 = accumulation.skirt_threshold_cd_m2;
    const double structure_threshold_cd_m2 =
        structure_headroom * (structure_cd_m2 > 0 ? std::sqrt(structure_cd_m2 * own_cd_m2) : own_cd_m2);
    const ScreenGeometry& g = input.geometry;
    const double picture = static_cast<double>(g.width_px) * g.height_px;
    const double window_px = input.window_outer / g.pitch;
    const double cell = std::max(accumulation.tail_cell_px, 1);
    double widest_px = 0;
    double lit_px2 = 0;
    for (std::size_t k = 0; k < brightness_classes; ++k) {
        const auto count = static_cast<double>(input.lights->all.count[k]);
        if (count == 0) continue;
        const double lux = static_cast<double>(input.lights->all.lux[k]) / count;
        const auto reach_px = [&](double share) {
            return std::sin(std::min(bound.reach_rad(share / lux), std::numbers::pi / 2)) / g.pitch;
        };
        const double crop_px = std::max(reach_px(accumulation.skirt_threshold_cd_m2), crop_least_px);
        // As set_fade in apply/light_instance.cpp.
        const double skirt_px = crop_px < window_px ? crop_px + std::max(4.0, crop_px / 4)
                                                    : window_px + std::max(5 * cell, window_px / 3);
        const double structure_px =
            std::min(std::max(reach_px(structure_threshold_cd_m2), nearest_structure_px), window_px);
        area.gather_px += count * box_px2(structure_px, picture);
        // What finer nodes have beside straight lines falls by two powers of the distance more than the skirt does.
        const double fine_px = std::min<double>(std::pow(crop_px, fine_of_skirt), fine_radius_nodes);
        area.core_px += count * std::max(core_side_px * core_side_px, box_px2(fine_px, picture));
        area.skirt_px += count * box_px2(skirt_px, picture);
        widest_px = std::max(widest_px, skirt_px);
        if (accumulation.tail_cell_px > 0) {
            const double tail_px = reach_px(accumulation.tail_threshold_cd_m2);
            area.tail_cells += count * box_px2(tail_px, picture) / (cell * cell);
            widest_px = std::max(widest_px, tail_px);
        }
        if (least_cd_m2 > 0) {
            // The mean of the glare, a structure_headroom-th of its bound; needles are thinner than a tile.
            const double lit_px = std::max(reach_px(structure_headroom * least_cd_m2), crop_least_px);
            lit_px2 += count * std::min(disc_px2(lit_px), picture);
        }
    }
    const double disc_px = input.lights->largest_disc_rad / g.pitch;
    area.core_px += std::min(disc_px2(disc_px), picture);
    area.composite_px = std::min(picture, input.lights->lights * box_px2(widest_px, picture));
    // Discs anywhere in the picture cover so much of it, where some lie over others.
    if (least_cd_m2 > 0)
        area.composite_px = std::min(area.composite_px, -picture * std::expm1(-lit_px2 / picture));
    return area;
}

double accumulation_ms(const PlanInput& input, const CoveredArea& area, const AccumulationPlan& accumulation,
                       const DeviceCosts& costs) {
    const ScreenGeometry& g = input.geometry;
    const double picture = static_cast<double>(g.width_px) * g.height_px;
    const double chunks = std::ceil(input.lights->lights / lights_per_draw);
    if (accumulation.method == Accumulation::cl_tiles) {
        return (costs.of(Work::cl_pass) + costs.of(Work::cl_screen_px) * picture +
                costs.of(Work::cl_light) * input.lights->lights +
                costs.of(Work::cl_light_px) * area.gather_px + costs.of(Work::gl_draw) * chunks +
                costs.of(Work::gl_core_px) * area.core_px) /
               ns_per_ms;
    }
    const double billboards = costs.of(Work::gl_core_px) * area.core_px +
                              costs.of(Work::gl_skirt_px) * area.skirt_px +
                              costs.of(Work::gl_tail_cell) * area.tail_cells;
    return (costs.of(Work::gl_draw) * chunks * 5 + billboards) / ns_per_ms;
}

PatternWork pattern_work(const PlanInput& input, int lamps, int layers, double step_s,
                         const DeviceCosts& costs) {
    const PatternSettings& settings = *input.pattern;
    const PatternMotion& motion = settings.motion;
    const double frame_s = std::clamp(input.frame_interval_s, 1e-4, 1.0);
    PatternWork work;
    work.taken_per_frame = step_s > 0 ? std::min(frame_s / step_s, 1.0) : 1;
    switch (motion.mode) {
        case MotionMode::every_frame:
            work.made_per_frame = work.taken_per_frame;
            break;
        case MotionMode::interpolated:
            work.made_per_frame = std::min(frame_s * std::max(motion.rate_hz, 0.0), 1.0);
            break;
        case MotionMode::flip_book:
            work.made_per_frame = 0;  // its pages stay
            break;
    }
    double samples = transform_samples(settings.transform_size);
    if (settings.wide_field_size > 0) {
        // Once in an interval, a slice of it with every pattern.
        const double patterns_per_s = std::max(work.made_per_frame / frame_s, 1e-3);
        samples += transform_samples(settings.wide_field_size) /
                   std::max(settings.wide_field_interval_s * patterns_per_s, 1.0);
    }
    const double side = 2.0 * input.radius_nodes + 1;
    const double nodes = side * side * std::max(lamps, 1);
    work.made_ms = (costs.of(Work::pattern_sample) * samples +
                    costs.of(Work::pattern_node) * nodes * settings.wavelengths +
                    costs.of(Work::pattern_disc_node) * nodes * std::max(layers - 1, 0)) /
                   ns_per_ms;
    const double table_nodes = nodes * std::max(layers, 1);
    if (motion.mode != MotionMode::every_frame)
        work.mixed_ms = costs.of(Work::pattern_mixed_node) * table_nodes / ns_per_ms;
    work.taken_ms = costs.of(Work::pattern_upload_node) * table_nodes / ns_per_ms;
    return work;
}

}  // namespace seaglare::glare
