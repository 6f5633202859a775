#include "glare/plan/filter_blend.h"

#include <algorithm>

#include "glare/psf/pattern_cache.h"

namespace seaglare::glare {

void blend_towards_first_lamp(const Pattern& pattern, double blend, Pattern& out) {
    out = pattern;
    out.generation = new_generation();
    if (pattern.lamps.size() < 2) return;
    const auto part = static_cast<float>(std::clamp(blend, 0.0, 1.0));
    const std::size_t per_lamp = pattern.skirt.size() / pattern.lamps.size();
    for (std::size_t slot = 1; slot < pattern.lamps.size(); ++slot) {
        for (std::size_t c = 0; c < 4; ++c)
            out.core_energy[slot][c] += part * (pattern.core_energy[0][c] - pattern.core_energy[slot][c]);
        const float* own = pattern.skirt.data() + slot * per_lamp;
        const float* first = pattern.skirt.data();
        float* mixed = out.skirt.data() + slot * per_lamp;
        for (std::size_t i = 0; i < per_lamp; ++i)
            mixed[i] = own[i] + part * (first[i] - own[i]);
    }
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
