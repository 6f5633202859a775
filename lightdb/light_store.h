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

using LightId = std::uint64_t;      // generation << 32 | (slot + 1); 0 is never a light
using LightIndex = std::uint32_t;   // slot

struct BodyPose {
    std::array<double, 3> position_m{};             // scene, East-North-Up
    std::array<double, 4> orientation{0, 0, 0, 1};  // scene from body
};

class LightStore {
  public:
    LightId add(Light light);
    bool remove(LightId id);            // false: stale
    void clear();
    Light* find(LightId id);            // nullptr: stale
    const Light* find(LightId id) const;
    LightId id_of(LightIndex slot) const;
    std::size_t size() const;           // live lights
    std::vector<LightId> ids() const;   // in load order
    void set_body_pose(std::uint32_t body_id, const BodyPose& pose);
    const BodyPose* body_pose(std::uint32_t body_id) const;  // nullptr: never posed

    struct Slot {
        Light light;
        std::uint32_t generation = 1;
        bool live = false;
    };
    std::span<const Slot> slots() const { return slots_; }

  private:
    std::vector<Slot> slots_;
    std::vector<LightIndex> free_;
    std::vector<LightIndex> order_;
    std::unordered_map<std::uint32_t, BodyPose> bodies_;
};

}  // namespace seaglare::lightdb
