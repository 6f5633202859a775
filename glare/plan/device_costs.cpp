#include "glare/plan/device_costs.h"

#include <algorithm>
#include <cmath>

namespace seaglare::glare {

namespace {

constexpr std::array<std::string_view, work_kinds> names = {
    "light_evaluated",    "frame_planned",      "light_uploaded", "gl_draw",      "gl_core_px",
    "gl_skirt_px",        "gl_tail_cell",       "cl_pass",        "cl_screen_px", "cl_light",
    "cl_light_px",        "composite_px",       "pattern_sample", "pattern_node", "pattern_disc_node",
    "pattern_mixed_node", "pattern_upload_node"};

// Of the way to what a frame has shown, in the logarithm; and the most that one frame counts for.
constexpr double learned_per_frame = 0.05;
constexpr double most_surprise = 4;
// Devices differ from the usual by no more; a probe that says so was disturbed.
constexpr double most_unusual = 100;

void scale(DeviceCosts& costs, double factor, std::initializer_list<Work> kinds) {
    if (!std::isfinite(factor) || !(factor > 0)) return;
    for (const Work work : kinds)
        costs.of(work) *= std::clamp(factor, 1 / most_unusual, most_unusual);
}

}  // namespace

std::string_view name_of(Work work) {
    return names[static_cast<std::size_t>(work)];
}

void learn(DeviceCosts& costs, std::initializer_list<Work> kinds, double predicted_ms, double measured_ms) {
    if (costs.pinned || !(predicted_ms > 0) || !(measured_ms > 0)) return;
    const double surprise = measured_ms / predicted_ms;
    if (!std::isfinite(surprise)) return;
    const double factor = std::pow(std::clamp(surprise, 1 / most_surprise, most_surprise), learned_per_frame);
    const DeviceCosts usual;
    for (const Work work : kinds) {
        double& cost = costs.of(work);
        cost = std::clamp(cost * factor, usual.of(work) * 1e-6, usual.of(work) * 1e6);
    }
}

DeviceCosts measured_costs(const ProbeTimes& t) {
    constexpr double ns_per_ms = 1e6;
    const DeviceCosts usual;
    DeviceCosts costs;
    if (!(t.picture_px > 0) || !(t.lights > 1) || !(t.draws > 0)) return costs;
    if (!(t.core > 0)) return costs;
    scale(costs, t.core * ns_per_ms / t.draws / usual.of(Work::gl_draw), {Work::gl_draw});
    if (!(t.skirt > 0) || !(t.many_skirts > 0)) return costs;
    const double skirt_ns = (t.many_skirts - t.skirt) * ns_per_ms / ((t.lights - 1) * t.picture_px);
    scale(costs, skirt_ns / usual.of(Work::gl_skirt_px),
          {Work::gl_skirt_px, Work::gl_core_px, Work::gl_tail_cell});
    const double composite_ns = (t.skirt - t.core) * ns_per_ms / t.picture_px - costs.of(Work::gl_skirt_px);
    scale(costs, composite_ns / usual.of(Work::composite_px), {Work::composite_px});
    if (!(t.gather > 0) || !(t.many_gathered > 0)) return costs;
    const auto light_ns = [&](const DeviceCosts& from) {
        return from.of(Work::cl_light) + from.of(Work::cl_light_px) * t.picture_px;
    };
    scale(costs, (t.many_gathered - t.gather) * ns_per_ms / ((t.lights - 1) * light_ns(usual)),
          {Work::cl_light, Work::cl_light_px});
    // Its core is drawn, and the sum shown, as without a gather.
    const double pass_ns = t.gather * ns_per_ms - t.core * ns_per_ms -
                           costs.of(Work::composite_px) * t.picture_px - light_ns(costs);
    scale(costs, pass_ns / (usual.of(Work::cl_pass) + usual.of(Work::cl_screen_px) * t.picture_px),
          {Work::cl_pass, Work::cl_screen_px});
    return costs;
}

}  // namespace seaglare::glare
