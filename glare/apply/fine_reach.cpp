#include "glare/apply/fine_reach.h"

#include <algorithm>
#include <cmath>

namespace seaglare::glare {

void FineReach::update(const Pattern& pattern) {
    if (generation_ == pattern.generation && generation_ != 0) return;
    generation_ = pattern.generation;
    slots_ = std::min<std::size_t>(pattern.fine.size() / fine_floats, most_lamps);
    // A pattern is point-symmetric: the rows from the light's on are enough.
    constexpr std::size_t half = fine_side * fine_side / 2;
    if (step_of_.empty()) find_steps();
    for (std::size_t slot = 0; slot < slots_; ++slot) {
        std::array<float, steps>& largest = largest_[slot];
        largest.fill(0);
        const float* node = pattern.fine.data() + slot * fine_floats + 4 * half;
        for (const std::uint8_t step : step_of_) {
            const float either = std::max(std::max(std::abs(node[0]), std::abs(node[1])),
                                          std::max(std::abs(node[2]), std::abs(node[3])));
            largest[step] = std::max(largest[step], either);
            node += 4;
        }
        for (std::size_t step = steps - 1; step > 0; --step)
            largest[step - 1] = std::max(largest[step - 1], largest[step]);
    }
}

void FineReach::find_steps() {
    constexpr int radius = fine_per_node * fine_radius_nodes;
    for (int b = 0; b <= radius; ++b) {
        for (int a = b == 0 ? 0 : -radius; a <= radius; ++a) {
            // What a node adds reaches a fine node farther: straight lines.
            const double distance = (std::hypot(a, b) + 1) / fine_per_node;
            const auto step = static_cast<std::size_t>(distance * steps_per_node);
            step_of_.push_back(static_cast<std::uint8_t>(std::min(step, steps - 1)));
        }
    }
}

double FineReach::nodes(std::size_t slot, double psf_sr) const {
    if (slot >= slots_) return 0;
    const std::array<float, steps>& largest = largest_[slot];
    const auto shows = [psf_sr](float value) { return static_cast<double>(value) > psf_sr; };
    const auto end = std::find_if_not(largest.begin(), largest.end(), shows);
    // The last step that shows reaches as far as the next begins.
    const auto count = static_cast<double>(end - largest.begin());
    return std::min<double>(count / steps_per_node, fine_radius_nodes);
}

}  // namespace seaglare::glare
