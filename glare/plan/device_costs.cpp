#include "glare/plan/device_costs.h"

#include <algorithm>
#include <cmath>

namespace seaglare::glare {

namespace {

constexpr std::array<std::string_view, work_kinds> names = {
    "light_evaluated", "light_uploaded", "gl_draw",           "gl_core_px",
    "gl_skirt_px",     "gl_tail_cell",   "cl_pass",           "cl_screen_px",
    "cl_light_px",     "fft_pass",       "fft_cell",          "composite_px",
    "pattern_sample",  "pattern_node",   "pattern_disc_node", "pattern_upload_node"};

// Of the way to what a frame has shown, in the logarithm; and the most that one frame counts for.
constexpr double learned_per_frame = 0.05;
constexpr double most_surprise = 4;

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

}  // namespace seaglare::glare
