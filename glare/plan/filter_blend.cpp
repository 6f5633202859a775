#include "glare/plan/filter_blend.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "glare/psf/pattern_cache.h"

namespace seaglare::glare {

namespace {

// Each slot's values after the first's, by `part` towards the first's.
void blend_slots(const std::vector<float>& from, std::size_t slots, float part, std::vector<float>& to) {
    const std::size_t per_slot = from.size() / slots;
    for (std::size_t i = per_slot; i < from.size(); ++i)
        to[i] = from[i] + part * (from[i % per_slot] - from[i]);
}

}  // namespace

void blend_towards_first_lamp(const Pattern& pattern, double blend, Pattern& out) {
    out = pattern;
    out.generation = new_generation();
    if (pattern.lamps.size() < 2) return;
    const auto part = static_cast<float>(std::clamp(blend, 0.0, 1.0));
    for (std::size_t slot = 1; slot < pattern.lamps.size(); ++slot)
        for (std::size_t c = 0; c < 4; ++c)
            out.core_energy[slot][c] += part * (pattern.core_energy[0][c] - pattern.core_energy[slot][c]);
    blend_slots(pattern.skirt, pattern.lamps.size(), part, out.skirt);
    blend_slots(pattern.fine, pattern.lamps.size(), part, out.fine);
}

const Pattern& BlendedPattern::of(const Pattern& pattern, double blend) {
    if (!(blend > 0) || pattern.lamps.size() < 2) return pattern;
    if (from_ != pattern.generation || blend_ != blend) {
        from_ = 0;  // what follows may throw
        blend_towards_first_lamp(pattern, blend, mixed_);
        from_ = pattern.generation;
        blend_ = blend;
    }
    return mixed_;
}

}  // namespace seaglare::glare
