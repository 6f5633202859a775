// A light file that is read again: which of its lights are which of those it gave before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lightdb/light.h"
#include "lightdb/light_store.h"

namespace seaglare::lightdb {

// What is remembered of a light that came from a file: enough to know it again, not the light itself. 32 bytes.
struct LoadedLight {
    LightId id = 0;
    std::uint64_t data = 0;   // hash of all that the file says of it
    std::uint64_t place = 0;  // of its name and place
    std::uint64_t name = 0;   // of its name and body; 0: it has no name
    friend bool operator==(const LoadedLight&, const LoadedLight&) = default;
};

// Of lights as they were read, before place_lights(), in the same order; ids are 0. What is set at run time (on, visibility)
// does not count. O(bytes of the lights), and once for each photometric solid.
std::vector<LoadedLight> remembered(std::span<const Light> lights);

struct Reload {
    static constexpr std::size_t none = ~std::size_t{0};
    struct Fate {
        std::size_t before = none;  // index of the light it was; none: it is new
        bool changed = false;       // it is that light, but the file says something else of it now
    };
    std::vector<Fate> fates;            // of each light of `after`
    std::vector<std::size_t> vanished;  // indices of `before`, ascending
};

// Each light of before becomes at most one of after: first those of which the file says exactly the same, then those of one
// name and place, then those of one name if only one of before and one of after is left with it (it was moved). Lights that
// are alike pair in the order of the file. O(n log n).
Reload match_reload(std::span<const LoadedLight> before, std::span<const LoadedLight> after);

}  // namespace seaglare::lightdb
