// Which lights a band of the picture needs: they are put in the order of their rows, so that those of a band lie together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "glare/apply/accumulator.h"
#include "glare/apply/light_instance.h"

namespace seaglare::glare {

// Consecutive lights.
struct LightRange {
    std::size_t first = 0;
    std::size_t end = 0;
    bool empty() const { return first >= end; }
};

// Puts lights in the order of their rows, by steps of some, and their tags with them; lights of one step keep their order.
// Allocates nothing once it has seen as many.
class RowOrder {
  public:
    static constexpr int step_rows = 8;
    void sort(int height_px, std::vector<LightInstance>& lights, std::vector<std::uint32_t>& tags);

  private:
    std::vector<std::size_t> next_;  // by step: where its next light goes
    std::vector<LightInstance> lights_;
    std::vector<std::uint32_t> tags_;
};

// For each band the shortest range of lights that holds all of which a rectangle reaches it.
class BandLights {
  public:
    // `rect`: which of a light's rectangles; those without area reach nothing.
    void find(std::span<const LightInstance> lights, RectPx LightInstance::*rect, int height_px);
    LightRange of(RowRange band) const { return ranges_[static_cast<std::size_t>(band.first / band_rows)]; }

  private:
    std::vector<LightRange> ranges_;
};

}  // namespace seaglare::glare
