#include "lightdb/box_tree.h"

#include <algorithm>
#include <cmath>

namespace seaglare::lightdb {

namespace {

BoxTree::Box united(const BoxTree::Box& a, const BoxTree::Box& b) {
    BoxTree::Box result;
    for (std::size_t i = 0; i < 3; ++i) {
        result.low_m[i] = std::min(a.low_m[i], b.low_m[i]);
        result.high_m[i] = std::max(a.high_m[i], b.high_m[i]);
    }
    return result;
}

BoxTree::Reach united(const BoxTree::Reach& a, const BoxTree::Reach& b) {
    return {std::max(a.peak_cd, b.peak_cd), std::max(a.radius_m, b.radius_m), a.lights + b.lights,
            a.by_day + b.by_day};
}

// What an insertion keeps small: the sum of the edges, for boxes as flat as a sea.
double cost_m(const BoxTree::Box& box) {
    double sum_m = 0;
    for (std::size_t i = 0; i < 3; ++i)
        sum_m += box.high_m[i] - box.low_m[i];
    return sum_m;
}

}  // namespace

bool BoxTree::Box::contains(const Box& other) const {
    for (std::size_t i = 0; i < 3; ++i) {
        if (!(low_m[i] <= other.low_m[i] && other.high_m[i] <= high_m[i])) return false;
    }
    return true;
}

BoxTree::Node BoxTree::take() {
    if (free_.empty()) {
        nodes_.emplace_back();
        // So that giving one back needs no memory.
        free_.reserve(nodes_.capacity());
        return static_cast<Node>(nodes_.size() - 1);
    }
    const Node node = free_.back();
    free_.pop_back();
    nodes_[node] = {};
    return node;
}

// Downwards to where the boxes above grow least.
BoxTree::Node BoxTree::best_sibling(const Box& box) const {
    Node at = root_;
    while (nodes_[at].height > 0) {
        const double here_m = cost_m(nodes_[at].bounds.box);
        const double grown_m = cost_m(united(nodes_[at].bounds.box, box));
        // Whatever is chosen further down, this node grows.
        const double inherited_m = 2 * (grown_m - here_m);
        const auto cost_below_m = [&](Node child) {
            const Box& of_child = nodes_[child].bounds.box;
            const double together_m = cost_m(united(of_child, box));
            return inherited_m + together_m - (nodes_[child].height > 0 ? cost_m(of_child) : 0);
        };
        const double first_m = cost_below_m(nodes_[at].first);
        const double second_m = cost_below_m(nodes_[at].second);
        if (2 * grown_m < std::min(first_m, second_m)) break;
        at = first_m <= second_m ? nodes_[at].first : nodes_[at].second;
    }
    return at;
}

bool BoxTree::bound(Node node) {
    Inner& n = nodes_[node];
    const Inner& a = nodes_[n.first];
    const Inner& b = nodes_[n.second];
    const Bounds bounds{united(a.bounds.box, b.bounds.box), united(a.bounds.reach, b.bounds.reach)};
    const std::uint32_t height = 1 + std::max(a.height, b.height);
    const bool same = height == n.height && bounds.reach == n.bounds.reach &&
                      bounds.box.low_m == n.bounds.box.low_m && bounds.box.high_m == n.bounds.box.high_m;
    n.bounds = bounds;
    n.height = height;
    return !same;
}

void BoxTree::replace_child(Node parent, Node child, Node by) {
    if (parent == none) {
        root_ = by;
    } else if (nodes_[parent].first == child) {
        nodes_[parent].first = by;
    } else {
        nodes_[parent].second = by;
    }
    if (by != none) nodes_[by].parent = parent;
}

// The risen child keeps its higher child; the node takes the other one in its stead.
BoxTree::Node BoxTree::rotate(Node node, bool first_rises) {
    const Node risen = first_rises ? nodes_[node].first : nodes_[node].second;
    const Node parent = nodes_[node].parent;
    const bool keeps_first = nodes_[nodes_[risen].first].height > nodes_[nodes_[risen].second].height;
    const Node kept = keeps_first ? nodes_[risen].first : nodes_[risen].second;
    const Node handed = keeps_first ? nodes_[risen].second : nodes_[risen].first;
    replace_child(parent, node, risen);
    (first_rises ? nodes_[node].first : nodes_[node].second) = handed;
    nodes_[handed].parent = node;
    nodes_[risen].first = node;
    nodes_[risen].second = kept;
    nodes_[node].parent = risen;
    nodes_[kept].parent = risen;
    bound(node);
    bound(risen);
    return risen;
}

BoxTree::Node BoxTree::balance(Node node) {
    const Inner& n = nodes_[node];
    if (n.height < 2) return node;
    const std::uint32_t first = nodes_[n.first].height;
    const std::uint32_t second = nodes_[n.second].height;
    if (first > second + 1) return rotate(node, true);
    if (second > first + 1) return rotate(node, false);
    return node;
}

void BoxTree::repair_upwards(Node node) {
    while (node != none) {
        const bool changed = bound(node);
        const Node now = balance(node);
        if (!changed && now == node) return;
        node = nodes_[now].parent;
    }
}

BoxTree::Node BoxTree::insert(const Bounds& bounds, std::uint32_t tag) {
    const Node leaf = take();
    nodes_[leaf].bounds = bounds;
    nodes_[leaf].first = tag;
    ++leaves_;
    if (root_ == none) {
        root_ = leaf;
        return leaf;
    }
    const Node joint = take();
    const Node sibling = best_sibling(bounds.box);
    replace_child(nodes_[sibling].parent, sibling, joint);
    nodes_[joint].first = sibling;
    nodes_[joint].second = leaf;
    nodes_[sibling].parent = joint;
    nodes_[leaf].parent = joint;
    repair_upwards(joint);
    return leaf;
}

void BoxTree::erase(Node leaf) {
    const Node joint = nodes_[leaf].parent;
    free_.push_back(leaf);
    --leaves_;
    if (joint == none) {
        root_ = none;
        return;
    }
    const Node sibling = nodes_[joint].first == leaf ? nodes_[joint].second : nodes_[joint].first;
    const Node above = nodes_[joint].parent;
    replace_child(above, joint, sibling);
    free_.push_back(joint);
    repair_upwards(above);
}

void BoxTree::set_reach(Node leaf, const Reach& reach) {
    if (nodes_[leaf].bounds.reach == reach) return;
    nodes_[leaf].bounds.reach = reach;
    repair_upwards(nodes_[leaf].parent);
}

}  // namespace seaglare::lightdb
