// What many lights have in common, kept once: rhythm, sectors, profiles, lamp, and how their colours' intensities compare.
// Where a million lights are of a few thousand kinds a light costs twelve bytes for its kind and its intensity instead of
// most of a kilobyte.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "lightdb/chunked.h"
#include "lightdb/lamp_registry.h"
#include "lightdb/light.h"

namespace seaglare::lightdb {

// At least what the light ever sends in any direction, summed over its colours, in cd, whatever the time, and
// infinity where its data are not numbers. 0: it never shines.
float peak_cd(const Light& light);

class LightKinds {
  public:
    using Index = std::uint32_t;

    struct Kind {
        Light light;        // what is a light's own (name, place, state, key) has its default
        float peak_cd = 0;  // where the scale is 1
        std::uint8_t colours =
            0;  // bit per colour that it has by night, also while its intensity is set to 0
        bool has_direction = false;
        bool shared = false;                                   // may be found by others: never changed
        std::array<LampRegistry::Index, colour_count> lamp{};  // of lamps(), per colour
        std::uint32_t lights = 0;
        std::uint64_t hash = 0;
    };

    // A light's kind, and by what the intensities of the kind are multiplied to give the light's: to the last bit.
    struct Member {
        Index kind = 0;
        double scale = 1;
    };

    // The kind of a light; each call counts one light more.
    Member intern(Light light);
    void release(Index kind);
    const Kind& operator[](Index kind) const { return kinds_[kind]; }
    // Intensities of a light, its own.
    static void scale_up(Light& light, double scale);
    // Replaces the intensity by night of every colour that the light has. Returns what the light is now.
    Member with_intensity(const Member& before, double intensity_cd);
    std::size_t size() const { return kinds_.size() - free_.size(); }
    const LampRegistry& lamps() const { return lamps_; }
    std::size_t memory_bytes() const;

  private:
    // Many small tables, so that none is ever so large that its growing would hold up a frame.
    static constexpr std::size_t table_count = 256;
    using Table = std::unordered_multimap<std::uint64_t, Index>;

    Index take(Kind kind);
    void enter_lamps(Kind& kind);
    void leave_lamps(const Kind& kind);
    Index intern_as_it_is(Light light);
    Table& table_of(std::uint64_t hash) { return by_hash_[hash >> 56]; }

    LampRegistry lamps_;
    Chunked<Kind> kinds_;
    std::vector<Index> free_;
    std::array<Table, table_count> by_hash_;  // by the hash's highest byte
};

}  // namespace seaglare::lightdb
