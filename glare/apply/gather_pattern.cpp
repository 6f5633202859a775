#include "glare/apply/gather_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace seaglare::glare {

namespace {

constexpr std::size_t node_bytes = 4 * sizeof(Half);

// Returns what the halves are to be multiplied by, a power of two that lets the largest fit.
float to_halves(std::span<const float> from, std::vector<Half>& to) {
    to.resize(from.size());
    float largest = 0;
    for (const float value : from)
        largest = std::max(largest, std::abs(value));
    const bool ordinary = largest > 1e-30F && largest < 1e30F;
    const float scale = ordinary ? std::ldexp(1.0F, std::ilogb(largest) - 14) : 1.0F;
    std::array<float, 4> factor{};
    factor.fill(1 / scale);
    halves_from_floats(from, factor, to);
    return scale;
}

}  // namespace

void GatherPatternWriter::write(const Pattern& pattern, GatherPattern& to) {
    if (pattern.generation == to.generation && to.generation != 0) return;
    to.generation = 0;
    const auto put = [this](ClBuffer& buffer, auto values, const char* what) {
        const std::size_t bytes = values.size_bytes();
        buffer.reserve(device_.context(), device_.queue(), std::max(bytes, node_bytes), what);
        buffer.write(device_.queue(), bytes, values.data());
    };
    to.profile.update(pattern);
    put(to.tables, to.profile.tables(), "radial tables");
    to.skirt_scale = to_halves(pattern.skirt, skirt_halves_);
    put(to.skirt, std::span<const Half>(skirt_halves_), "pattern");
    departures_.resize(pattern.skirt.size());
    to.profile.departures(pattern, departures_);
    to.departures_scale = to_halves(departures_, departure_halves_);
    put(to.departures, std::span<const Half>(departure_halves_), "pattern's departures");
    // What was written from may change after this, and other queues may read.
    device_.finish();
    to.generation = pattern.generation;
}

}  // namespace seaglare::glare
