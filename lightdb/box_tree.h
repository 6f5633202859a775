// A tree of boxes that come, go and move: a balanced binary tree in which each node bounds its two children (Ericson, Real-Time
// Collision Detection, 2005, chapter 6), kept balanced by rotations as in AVL trees.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lightdb/vector_math.h"

namespace seaglare::lightdb {

class BoxTree {
  public:
    using Node = std::uint32_t;
    static constexpr Node none = 0xFFFFFFFFU;

    struct Box {
        Vec3 low_m{};
        Vec3 high_m{};
        bool contains(const Box& other) const;
    };
    // What culling asks of the lights within a box.
    struct Reach {
        float peak_cd = 0;
        float radius_m = 0;
        std::uint32_t lights = 0;
        std::uint32_t by_day = 0;  // of them without a photometer
        friend bool operator==(const Reach&, const Reach&) = default;
    };
    struct Bounds {
        Box box;
        Reach reach;
    };

    // O(log n) each. Boxes are finite.
    Node insert(const Bounds& bounds, std::uint32_t tag);
    void erase(Node leaf);
    void set_reach(Node leaf, const Reach& reach);

    const Box& box_of(Node leaf) const { return nodes_[leaf].bounds.box; }
    std::size_t size() const { return leaves_; }
    std::size_t depth() const { return root_ == none ? 0 : nodes_[root_].height + 1U; }

    // From the root downwards: `enter(bounds)` says whether what lies within a node may matter, `leaf(tag)` is told of each
    // leaf that was entered.
    template <class Enter, class Leaf>
    void visit(const Enter& enter, const Leaf& leaf) const {
        // The height of a balanced tree is below 1.45 log2 of its leaves; one sibling waits at each level.
        Node waiting[64];
        std::size_t count = 0;
        if (root_ != none) waiting[count++] = root_;
        while (count > 0) {
            const Inner& node = nodes_[waiting[--count]];
            if (!enter(node.bounds)) continue;
            if (node.height == 0) {
                leaf(node.first);
                continue;
            }
            waiting[count++] = node.second;
            waiting[count++] = node.first;
        }
    }

    std::size_t memory_bytes() const {
        return nodes_.capacity() * sizeof(Inner) + free_.capacity() * sizeof(Node);
    }

  private:
    struct Inner {
        Bounds bounds;
        Node parent = none;
        Node first = none;  // of a leaf: its tag
        Node second = none;
        std::uint32_t height = 0;  // 0: a leaf
    };

    Node take();
    Node best_sibling(const Box& box) const;
    // Makes a node's bounds those of its children. False: they were that already.
    bool bound(Node node);
    void replace_child(Node parent, Node child, Node by);
    // If one child is higher than the other by more than one, it takes the node's place. Returns what stands there now.
    Node balance(Node node);
    Node rotate(Node node, bool first_rises);
    void repair_upwards(Node node);

    std::vector<Inner> nodes_;
    std::vector<Node> free_;
    Node root_ = none;
    std::size_t leaves_ = 0;
};

}  // namespace seaglare::lightdb
