// A pattern as GL's texture holds it: half precision, each channel of each lamp scaled by itself. Knows no GL, so that whoever
// makes patterns can make these, too, on another thread than the one that draws.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "glare/colour/navigation_colours.h"
#include "glare/device/half.h"
#include "glare/psf/pattern.h"

namespace seaglare::glare {

struct PatternTexels {
    std::uint64_t generation = 0;  // of the pattern they were made from; 0: of none
    std::vector<Half> halves;      // Pattern::skirt, in its order
    // What a lamp's halves are to be multiplied by, channel by channel: powers of two that put the largest of each channel
    // between 2^14 and 2^15, where half precision ends.
    std::array<std::array<float, 4>, most_lamps> scale{};
};

// Memory of `to` is used again. Throws std::invalid_argument when the skirt has not as many nodes as the pattern says.
void make_texels(const Pattern& pattern, PatternTexels& to);

}  // namespace seaglare::glare
