#include "glare/apply/gather_pattern.h"

#include <algorithm>
#include <cstddef>
#include <span>

namespace seaglare::glare {

namespace {

constexpr std::size_t node_bytes = 4 * sizeof(Half);

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
