// Which lights may matter to an eye, found without looking at each one.
//
// Lights that stay where they are stand in blocks (light_block.h); lights of a body are bounded with it (body_index.h); a
// light that has just come or moved is "loose" and looked at one by one, until it has kept still for a while. So nothing is
// ever rebuilt as a whole while frames are drawn: one call builds at most one block for each 4096 lights it was given, and
// settle() at most one. A block most of whose lights are switched off for long is given up, so that those that burn stand
// close together again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lightdb/body_index.h"
#include "lightdb/chunked.h"
#include "lightdb/light_arrays.h"
#include "lightdb/light_block.h"

namespace seaglare::lightdb {

class SpatialIndex {
  public:
    // Fewer lights than this are not worth a block: they stay loose.
    static constexpr std::size_t smallest_block = 512;
    // A moved light is loose for at least so many calls of settle().
    static constexpr std::uint32_t frames_to_settle = 30;
    // A block in which fewer than one light in so many burns is given up once nothing in it has been switched for so many
    // calls of settle(): a host that makes its lights flash by switching them keeps its blocks.
    static constexpr std::size_t fewest_burning = 4;
    static constexpr std::uint32_t frames_to_forget = 600;

    // Places, homeless yet, for all slots that there are: before anything else is done with a slot. insert() does it, too.
    void make_room(const LightArrays& lights) {
        if (place_.size() < lights.size()) place_.resize(lights.size());
    }
    // A light that is live, with its arrays filled in. Amortised O(log n).
    void insert(const LightArrays& lights, LightIndex light);
    // Before its arrays change. O(log n).
    void erase(const LightArrays& lights, LightIndex light);
    // After the change, of a light that was and is awake.
    void moved(const LightArrays& lights, LightIndex light);
    void intensity_changed(const LightArrays& lights, LightIndex light);
    // Its flag `awake` has just changed, and nothing else. It keeps its place in a block for a while.
    void awake_changed(const LightArrays& lights, LightIndex light);
    void clear();

    // Bodies keep their poses whether they carry lights or not.
    void set_body_pose(std::uint32_t body_id, const BodyPose& pose) { bodies_.set_pose(body_id, pose); }
    const BodyPose* body_pose(std::uint32_t body_id) const { return bodies_.pose(body_id); }
    const BodyIndex& bodies() const { return bodies_; }

    // Takes over a block that was built elsewhere, of lights that have no home yet. They are not collected before it is
    // shown: the first is O(lights in it), the second O(1). Returns its number.
    std::size_t take_block(const LightArrays& lights, LightBlock block);
    void show_block(std::size_t number) { blocks_[number]->shown = true; }

    // Once a frame: lights that have kept still leave the loose ones. At most one block is built.
    void settle(const LightArrays& lights);
    // After loading: orders everything afresh. O(n log n).
    void rebuild(const LightArrays& lights);

    // Marks the slots of all lights that may matter. The others that are awake are counted with the reason that holds for
    // their whole group. Asleep lights are not counted.
    void collect(const CullingEye& eye, LightMarks& marks, LeftOutCounts& counts) const;

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
    struct Numbered {
        LightBlock block;
        std::uint32_t switched = 0;  // frame in which one of its lights last was
        bool shown = false;
    };

    LightBlock& block_of(LightIndex light) { return blocks_[place_[light].at / LightBlock::capacity]->block; }
    std::size_t rank_of(LightIndex light) const { return place_[light].at % LightBlock::capacity; }
    void make_loose(LightIndex light);
    void leave_loose(LightIndex light);
    void leave_body(const LightArrays& lights, LightIndex light);
    void leave_block(const LightArrays& lights, LightIndex light);
    void dissolve(const LightArrays& lights, std::size_t block);
    void give_up_thin_block(const LightArrays& lights);
    void fold_newest(const LightArrays& lights);
    void build_block(const LightArrays& lights, std::span<LightBlock::Entry> entries);
    void build_blocks(const LightArrays& lights, std::span<LightBlock::Entry> entries);

    Chunked<Place> place_;                         // by slot
    std::vector<std::optional<Numbered>> blocks_;  // by number; nullopt: the number is free
    std::vector<std::uint32_t> free_blocks_;
    std::size_t block_count_ = 0;
    std::vector<Loose> loose_;
    BodyIndex bodies_;
    std::uint32_t frame_ = 0;
    std::size_t cursor_ = 0;        // of settle(), in loose_
    std::size_t block_cursor_ = 0;  // likewise, in blocks_
    std::size_t newcomers_ = 0;     // since the last block that was made of them
};

}  // namespace seaglare::lightdb
