#include "glare/apply/fine_reach.h"

#include <algorithm>
#include <cmath>

namespace seaglare::glare {

void FineReach::update(const Pattern& pattern) {
    if (generation_ == pattern.generation && generation_ != 0) return;
    generation_ = pattern.generation;
    slots_ = std::min<std::size_t>(pattern.fine.size() / fine_floats, most_lamps);
    constexpr int radius = fine_per_node * fine_radius_nodes;
    for (std::size_t slot = 0; slot < slots_; ++slot) {
        std::array<float, steps>& largest = largest_[slot];
        largest.fill(0);
        const float* node = pattern.fine.data() + slot * fine_floats;
        for (int b = -radius; b <= radius; ++b) {
            for (int a = -radius; a <= radius; ++a, node += 4) {
                // What a node adds reaches a fine node farther: straight lines.
                const double distance = (std::hypot(a, b) + 1) / fine_per_node;
                const auto step = std::min(static_cast<std::size_t>(distance * steps_per_node), steps - 1);
                for (std::size_t c = 0; c < 4; ++c)
                    largest[step] = std::max(largest[step], std::abs(node[c]));
            }
        }
        for (std::size_t step = steps - 1; step > 0; --step)
            largest[step - 1] = std::max(largest[step - 1], largest[step]);
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
