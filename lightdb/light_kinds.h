// What many lights have in common, kept once: intensities, rhythm, sectors, profiles, lamp. Where a million lights are
// of a few thousand kinds a light costs four bytes for its kind instead of most of a kilobyte.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <unordered_map>
#include <vector>

#include "lightdb/light.h"

namespace seaglare::lightdb {

// At least what the light ever sends in any direction, summed over its colours, in cd, whatever the time, and
// infinity where its data are not numbers. 0: it never shines.
float peak_cd(const Light& light);

class LightKinds {
  public:
    using Index = std::uint32_t;

    struct Kind {
        Light light;  // what is a light's own (name, place, state, key) has its default
        float peak_cd = 0;
        std::uint8_t colours =
            0;  // bit per colour that it has by night, also while its intensity is set to 0
        bool has_direction = false;
        bool shared = false;  // may be found by others: never changed
        std::uint32_t lights = 0;
        std::uint64_t hash = 0;
    };

    // The kind of a light; each call counts one light more.
    Index intern(Light light);
    void release(Index kind);
    const Kind& operator[](Index kind) const { return kinds_[kind]; }
    // A kind for one light alone, with the intensity by night of every colour that it has replaced. Returns the
    // light's new kind.
    Index with_intensity(Index kind, double intensity_cd);
    std::size_t size() const { return kinds_.size() - free_.size(); }
    std::size_t memory_bytes() const;

  private:
    Index take(Kind kind);

    std::deque<Kind> kinds_;
    std::vector<Index> free_;
    std::unordered_multimap<std::uint64_t, Index> by_hash_;
};

}  // namespace seaglare::lightdb
