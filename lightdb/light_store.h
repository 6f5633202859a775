// The lights of a context, with ids that carry a generation and bodies that move. No GL, no CL, no files.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "lightdb/light.h"

namespace seaglare::lightdb {

using LightId = std::uint64_t;     // generation << 32 | (slot + 1); 0 is never a light
using LightIndex = std::uint32_t;  // slot

struct BodyPose {
    std::array<double, 3> position_m{};             // scene, East-North-Up
    std::array<double, 4> orientation{0, 0, 0, 1};  // scene from body: x to starboard, y ahead, z up
};

// A hash of the light's own data (name, place, character): what its rhythm's phase hangs on.
std::uint64_t stable_key_of(const Light& light);

class LightStore {
  public:
    // Normalises the orientation and fills a stable_key of 0. O(1) but for memory.
    LightId add(Light light);
    bool remove(LightId id);  // false: stale
    void clear();             // every id so far becomes stale; bodies are forgotten
    Light* find(LightId id);  // nullptr: stale
    const Light* find(LightId id) const;
    LightId id_of(LightIndex slot) const;  // 0: the slot is free or does not exist
    std::size_t size() const { return live_; }
    std::vector<LightId> ids() const;                                 // in load order
    void set_body_pose(std::uint32_t body_id, const BodyPose& pose);  // normalises the orientation
    const BodyPose* body_pose(std::uint32_t body_id) const;           // nullptr: never posed

    struct Slot {
        Light light;
        std::uint32_t generation = 1;
        bool live = false;
    };
    std::span<const Slot> slots() const { return slots_; }

  private:
    std::vector<Slot> slots_;
    std::vector<LightIndex> free_;
    std::vector<LightId> order_;  // may hold stale ids, at most as many as live ones and a few
    std::size_t live_ = 0;
    std::unordered_map<std::uint32_t, BodyPose> bodies_;
};

}  // namespace seaglare::lightdb
