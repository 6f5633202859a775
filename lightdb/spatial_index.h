// Which lights may matter to an eye, found without looking at each one.
//
// Lights that stay where they are stand in blocks (light_block.h); lights of a body are bounded with it; a light
// that has just come or moved is "loose" and looked at one by one, until it has kept still for a while. So nothing
// is ever rebuilt as a whole while frames are drawn: one call builds at most one block for each 4096 lights it was
// given, and settle() at most one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "lightdb/light_arrays.h"
#include "lightdb/light_block.h"

namespace seaglare::lightdb {

struct BodyPose {
    Vec3 position_m{};                   // scene, East-North-Up
    Quaternion orientation{0, 0, 0, 1};  // scene from body: x to starboard, y ahead, z up
};
using BodyPoses = std::unordered_map<std::uint32_t, BodyPose>;

class SpatialIndex {
  public:
    // Fewer lights than this are not worth a block: they stay loose.
    static constexpr std::size_t smallest_block = 512;
    // A moved light is loose for at least so many calls of settle().
    static constexpr std::uint32_t frames_to_settle = 30;

    // A light that is live, with its arrays filled in. Amortised O(log n).
    void insert(const LightArrays& lights, LightIndex light);
    // Before its arrays change. O(log n).
    void erase(const LightArrays& lights, LightIndex light);
    // After the change, of a light that was and is awake.
    void moved(const LightArrays& lights, LightIndex light);
    void intensity_changed(const LightArrays& lights, LightIndex light);
    // Its flag `awake` has just changed, and nothing else. It keeps its place in a block.
    void awake_changed(const LightArrays& lights, LightIndex light);
    void clear();

    // Once a frame: lights that have kept still leave the loose ones. At most one block is built.
    void settle(const LightArrays& lights);
    // After loading: orders everything afresh. O(n log n).
    void rebuild(const LightArrays& lights);

    // Marks the slots of all lights that may matter; asleep ones may be among them. The others that are awake are
    // counted with the reason that holds for their whole group. Asleep lights are not counted.
    void collect(const BodyPoses& poses, const CullingEye& eye, LightMarks& marks,
                 LeftOutCounts& counts) const;

    std::size_t loose_count() const { return loose_.size(); }
    std::size_t block_count() const { return block_count_; }
    std::size_t memory_bytes() const;

  private:
    // Asleep lights have no home, unless they fell asleep in a block.
    enum class Home : std::uint8_t { none, loose, block, body };
    struct Place {
        Home home = Home::none;
        std::uint32_t at = 0;  // in loose_, in the body's list, or block * capacity + rank
    };
    struct Loose {
        LightIndex light = no_light;
        std::uint32_t since = 0;  // frame of its last change
    };
    struct BodyLights {
        std::vector<LightIndex> lights;
        double reach_m = 0;  // farthest light from the body's origin; like the rest it grows only
        double peak_cd = 0;
        double radius_m = 0;
        void widen(const LightArrays& arrays, LightIndex light);
    };

    LightBlock& block_of(LightIndex light) { return *blocks_[place_[light].at / LightBlock::capacity]; }
    std::size_t rank_of(LightIndex light) const { return place_[light].at % LightBlock::capacity; }
    void make_loose(LightIndex light);
    void leave_loose(LightIndex light);
    void leave_body(const LightArrays& lights, LightIndex light);
    void leave_block(const LightArrays& lights, LightIndex light);
    void dissolve(const LightArrays& lights, std::size_t block);
    void fold_newest(const LightArrays& lights);
    void build_block(const LightArrays& lights, std::span<LightBlock::Entry> entries);
    void build_blocks(const LightArrays& lights, std::span<LightBlock::Entry> entries);
    void collect_body(const BodyPoses& poses, std::uint32_t body_id, const BodyLights& body,
                      const CullingEye& eye, LightMarks& marks, LeftOutCounts& counts) const;

    std::vector<Place> place_;                       // by slot
    std::vector<std::optional<LightBlock>> blocks_;  // by number; nullopt: the number is free
    std::vector<std::uint32_t> free_blocks_;
    std::size_t block_count_ = 0;
    std::vector<Loose> loose_;
    std::unordered_map<std::uint32_t, BodyLights> bodies_;
    std::uint32_t frame_ = 0;
    std::size_t cursor_ = 0;     // of settle(), in loose_
    std::size_t newcomers_ = 0;  // since the last block that was made of them
};

}  // namespace seaglare::lightdb
