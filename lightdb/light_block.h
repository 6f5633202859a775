// A k-d tree of up to 4096 lights that do not move: the unit in which the spatial index grows and shrinks, small
// enough to be built within a millisecond or so.
//
// The tree is balanced and lies in memory in heap order; where a light stands in it is its rank. Five lengths tell
// lights apart: east, north, up, how far its intensity carries and how far its height does. A node halves the
// longest, so that far-reaching lights among faint ones stand together, too.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lightdb/culling.h"
#include "lightdb/light_arrays.h"

namespace seaglare::lightdb {

class LightMarks;

class LightBlock {
  public:
    static constexpr std::size_t capacity = 4096;
    static constexpr std::size_t leaf_size = 8;

    // One light while trees are built.
    struct Entry {
        std::array<float, 5> length_m{};  // what tells it apart
        LightIndex light = no_light;
    };
    static Entry entry_of(const LightArrays& lights, LightIndex light);
    // Orders the entries so that each part stands together.
    static void halve(std::span<Entry> entries, std::size_t middle);

    // Of at most `capacity` lights; asleep ones may be among them. Reorders the entries.
    LightBlock(const LightArrays& lights, std::span<Entry> entries);

    // Gives the lights other slots: `slots` by rank.
    void renumber(std::span<const LightIndex> slots) { order_.assign(slots.begin(), slots.end()); }

    std::span<const LightIndex> order() const { return order_; }  // by rank; no_light: taken out
    std::size_t present() const { return present_; }
    std::uint32_t awake() const { return nodes_.front().awake; }

    // O(log n) each.
    void take_out(std::size_t rank, bool day_off);
    void set_awake(std::size_t rank, bool awake, bool day_off);
    void raise_peak(std::size_t rank, float peak_cd);

    // Marks every light that is awake and may matter, and counts the others that are awake with their reason.
    void collect(const CullingEye& eye, LightMarks& marks, LeftOutCounts& counts) const;

    std::size_t memory_bytes() const;

  private:
    // Single precision, relative to the block's origin, rounded outwards.
    struct Node {
        std::array<float, 3> low_m{};
        std::array<float, 3> high_m{};
        float peak_cd = 0;
        float radius_m = 0;
        float round_height_m = 0;  // highest z + (x^2 + y^2) / 2R, not relative to anything
        std::uint16_t awake = 0;
        std::uint16_t by_day = 0;  // of them without a photometer
    };

    std::size_t first_of(std::size_t node_in_level, std::size_t nodes_in_level) const {
        return node_in_level * order_.size() / nodes_in_level;
    }
    std::size_t leaf_node(std::size_t rank) const;
    void order_within(std::span<Entry> entries, std::size_t node_in_level, std::size_t nodes_in_level);
    void bound(const LightArrays& lights);
    GroupBounds bounds_for(const Node& node, const CullingEye& eye) const;
    bool is_awake(std::size_t rank) const { return (awake_[rank / 64] >> rank % 64 & 1U) != 0; }

    std::vector<LightIndex> order_;
    std::vector<Node> nodes_;  // children of n: 2n + 1, 2n + 2
    std::size_t leaves_ = 1;
    std::size_t present_ = 0;
    std::vector<std::uint64_t> awake_;  // bit per rank: sleeping lights are not even fetched
    Vec3 origin_m_{};
};

}  // namespace seaglare::lightdb
