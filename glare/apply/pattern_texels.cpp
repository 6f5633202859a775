#include "glare/apply/pattern_texels.h"

#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>

namespace seaglare::glare {

namespace {

// 2^29 of dynamic range below the largest are as precise as it is, and factor and its inverse are exact.
struct Scale {
    std::array<float, 4> to_half{};
    std::array<float, 4> from_half{};
};
Scale scale_of(std::span<const float> rgba) {
    std::array<float, 4> largest{};
    for (std::size_t i = 0; i + 4 <= rgba.size(); i += 4)
        for (std::size_t c = 0; c < 4; ++c) {
            const float magnitude = std::abs(rgba[i + c]);
            largest[c] = largest[c] < magnitude ? magnitude : largest[c];
        }
    Scale scale;
    for (std::size_t c = 0; c < 4; ++c) {
        // An empty channel, and one that is not finite, stays as it is.
        const bool ordinary = largest[c] > 1e-30F && largest[c] < 1e30F;
        const int exponent = ordinary ? 14 - std::ilogb(largest[c]) : 0;
        scale.to_half[c] = std::ldexp(1.0F, exponent);
        scale.from_half[c] = std::ldexp(1.0F, -exponent);
    }
    return scale;
}

}  // namespace

void make_texels(const Pattern& pattern, PatternTexels& to) {
    const std::size_t slots = pattern.lamps.size();
    if (slots == 0 || slots > most_lamps || pattern.skirt.size() % (4 * slots) != 0)
        throw std::invalid_argument("pattern: the skirt has not as many nodes for each lamp");
    to.generation = 0;
    const std::size_t floats = pattern.skirt.size() / slots;
    to.halves.resize(pattern.skirt.size());
    for (std::size_t slot = 0; slot < slots; ++slot) {
        const std::span<const float> skirt = std::span(pattern.skirt).subspan(slot * floats, floats);
        const Scale scale = scale_of(skirt);
        to.scale[slot] = scale.from_half;
        halves_from_floats(skirt, scale.to_half, std::span(to.halves).subspan(slot * floats, floats));
    }
    to.generation = pattern.generation;
}

}  // namespace seaglare::glare
