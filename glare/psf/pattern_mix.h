// A pattern between two patterns: their energies added in proportion. Light of two instants adds up on a retina that is
// slower than either, and the sum of two patterns of one energy has that energy: whatever is mixed, nothing is lost or won.
#pragma once

#include "glare/psf/pattern.h"

namespace seaglare::glare {

// Whether the nodes of two patterns stand at the same angles, so that they can be mixed.
bool can_mix(const Pattern& a, const Pattern& b);

// out = (1 - weight_of_b) a + weight_of_b b, both multiplied by `share`: of core, skirt and tail, in every layer and lamp.
// Lamps are those of b; a lamp that a has not is taken from the one that stands in for it there. Of the lamps of the mask
// `in_view`, those that another stands in for in b than in a have a slot of their own in `out`, too: each goes over from what
// it was drawn with to what it will be drawn with, also where more lamps are in view than have patterns. Layers are those of
// the pattern that has more; the other's largest disc stands in for what it has not, because every layer has the same energy.
// All else that a pattern says of itself is b's; the generation is new. The weight is clamped to 0 ... 1, NaN counts as 1.
// `out` is neither a nor b; its memory is used again. Throws std::invalid_argument unless can_mix().
void mix_patterns(const Pattern& a, const Pattern& b, double weight_of_b, Pattern& out, double share = 1,
                  std::uint32_t in_view = 0);

// One pattern multiplied by `share`: an eye that lets so much less light through, its lid coming down.
void dim_pattern(double share, Pattern& pattern);

}  // namespace seaglare::glare
