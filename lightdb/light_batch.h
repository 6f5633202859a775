// Lights on their way into a store, with all that can be worked out before they are in it: their order in space, the blocks
// of the spatial index. None of it needs the store, so frames go on meanwhile. LightStore::take_in() and show() do the rest.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lightdb/light.h"
#include "lightdb/light_block.h"

namespace seaglare::lightdb {

using LightId = std::uint64_t;  // generation << 32 | (slot + 1); 0 is never a light

// A hash of the light's own data (name, place, character): what its rhythm's phase hangs on.
std::uint64_t stable_key_of(const Light& light);

// At least what a light can send in cd whose kind sends at most peak_cd and whose intensities are `scale` times its kind's.
float peak_of_kind_cd(float peak_cd, double scale);

class LightBatch {
  public:
    // O(n log n). Stable keys of 0 are filled in.
    explicit LightBatch(std::vector<Light> lights);

    std::size_t size() const { return lights_.size(); }
    // In the order of the lights given; 0 until the light is taken in. Empty once they are shown.
    std::span<const LightId> ids() const { return ids_; }

  private:
    friend class LightStore;

    void make_blocks(const LightArrays& hot, std::span<LightBlock::Entry> entries);

    std::vector<Light> lights_;         // moved from once taken in
    std::vector<std::uint32_t> entry_;  // which light comes next: block by block by rank, then those of none
    std::vector<LightBlock> blocks_;    // of what the lights are in lights_, until they have slots
    std::vector<LightId> ids_;
    // How far take_in() has come.
    std::size_t taken_ = 0;
    std::size_t awake_ = 0;  // of them
    std::size_t block_ = 0;
    std::vector<LightIndex> slots_;     // of the block's lights so far, by rank
    std::vector<std::size_t> numbers_;  // of the blocks that the index has
    std::vector<LightIndex> homeless_;  // awake lights in none of them
};

}  // namespace seaglare::lightdb
