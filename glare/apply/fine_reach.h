// How far from a light the finer nodes of its pattern show: of most lights they need not be drawn.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "glare/psf/pattern.h"

namespace seaglare::glare {

class FineReach {
  public:
    // Nothing to do while the pattern's generation is the same. A few microseconds a lamp.
    void update(const Pattern& pattern);
    // Distance in nodes beyond which the finer nodes of a slot change no channel by more than psf_sr; 0: nowhere. Of a pattern
    // without them 0.
    double nodes(std::size_t slot, double psf_sr) const;

  private:
    void find_steps();
    static constexpr int steps_per_node = 2;
    static constexpr std::size_t steps = fine_radius_nodes * steps_per_node + 1;
    // The largest in each slot from a distance on outwards; sr^-1.
    std::array<std::array<float, steps>, most_lamps> largest_{};
    // Of each node from the light on to the end of the upper half plane.
    std::vector<std::uint8_t> step_of_;
    std::size_t slots_ = 0;
    std::uint64_t generation_ = 0;
};

}  // namespace seaglare::glare
