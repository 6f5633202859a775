// A pattern as grids in GL read it: radial means, and what the nodes have beside them in half precision. Knows no GL, so that
// whoever makes patterns can make these, too, on another thread than the one that draws.
#pragma once

#include <cstdint>
#include <vector>

#include "glare/apply/pattern_profile.h"
#include "glare/device/half.h"
#include "glare/psf/pattern.h"

namespace seaglare::glare {

struct GridTexels {
    std::uint64_t generation = 0;  // of the pattern they were made from; 0: of none
    PatternProfile profile;
    std::vector<Half> departures;  // PatternProfile::departures(), in the order of Pattern::skirt
    float departures_scale = 1;    // what a half is to be multiplied by
};

// Makes them. One thread at a time.
class GridTexelMaker {
  public:
    // Nothing to do where `to` is of this pattern already. Memory of `to` is used again.
    void make(const Pattern& pattern, GridTexels& to);

  private:
    std::vector<float> departures_;  // on their way to halves
};

}  // namespace seaglare::glare
