// Bodies, where they are and which lights they carry: a ship out of reach costs a frame nothing.
//
// Each body stands in a tree (box_tree.h) with a box that leaves it room to move: giving it a pose costs O(log n) only once
// it has left that room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "lightdb/box_tree.h"
#include "lightdb/culling.h"
#include "lightdb/light_arrays.h"

namespace seaglare::lightdb {

class LightMarks;

struct BodyPose {
    Vec3 position_m{};                   // scene, East-North-Up
    Quaternion orientation{0, 0, 0, 1};  // scene from body: x to starboard, y ahead, z up
};

class BodyIndex {
  public:
    // The orientation is normalised.
    void set_pose(std::uint32_t body_id, const BodyPose& pose);
    const BodyPose* pose(
        std::uint32_t body_id) const;  // nullptr: never posed; its lights are at the scene's origin

    // An awake light of a body. Returns its rank among those of the body.
    std::uint32_t insert(const LightArrays& lights, LightIndex light);
    // Returns the light that now has its rank, or no_light.
    LightIndex erase(const LightArrays& lights, LightIndex light, std::uint32_t rank);
    // After a change of its place, size or intensity.
    void widen(const LightArrays& lights, LightIndex light);

    // Marks the lights that may matter and counts the others.
    void collect(const CullingEye& eye, LightMarks& marks, LeftOutCounts& counts) const;

    // Bodies that carry lights and are bounded.
    std::size_t bounded_count() const { return tree_.size(); }
    std::size_t memory_bytes() const;

  private:
    static constexpr std::uint32_t nowhere = 0xFFFFFFFFU;
    struct Body {
        BodyPose pose;
        bool posed = false;
        std::vector<LightIndex> lights;
        BoxTree::Box
            box;  // of its lights in the body's frame; like the reach it only grows while there are lights
        BoxTree::Reach reach;
        BoxTree::Node leaf = BoxTree::none;
        std::uint32_t unbounded_rank = nowhere;
    };

    void place(std::uint32_t body_id, Body& body);
    void withdraw(Body& body);

    std::unordered_map<std::uint32_t, Body> bodies_;
    BoxTree tree_;
    std::vector<std::uint32_t> unbounded_;  // ids of those that are too far out, or nowhere
};

}  // namespace seaglare::lightdb
