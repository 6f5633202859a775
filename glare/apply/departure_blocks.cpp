#include "glare/apply/departure_blocks.h"

#include <algorithm>
#include <cmath>

namespace seaglare::glare {

namespace {

// Symmetric about zero: half a block rounds away from it.
int block_at(int node) {
    constexpr int size = DepartureBlocks::block_nodes;
    return node >= 0 ? (node + size / 2) / size : -((size / 2 - node) / size);
}

int block_at(float place, int half) {
    // Rounded without a call: from a middle that makes it positive, it is cut off.
    constexpr auto size = static_cast<float>(DepartureBlocks::block_nodes);
    const auto blocks = static_cast<float>(half + 1);
    const float from_middle = std::clamp(place / size + 0.5F, -blocks, blocks) + blocks;
    return static_cast<int>(from_middle) - half - 1;
}

void take_larger(Departed& all, const Departed& one) {
    for (std::size_t c = 0; c < 4; ++c) {
        all.most[c] = all.most[c] > one.most[c] ? all.most[c] : one.most[c];
        all.rms[c] = all.rms[c] > one.rms[c] ? all.rms[c] : one.rms[c];
    }
}

}  // namespace

void DepartureBlocks::resize(int radius_nodes, std::size_t tables) {
    if (radius_ != radius_nodes) {
        radius_ = radius_nodes;
        half_ = block_at(radius_nodes);
        side_ = 2 * half_ + 1;
        const auto count = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
        nodes_.assign(count, 0.0F);
        sums_.resize(count);
        block_.clear();
        for (int y = 0; y <= radius_nodes; ++y)
            for (int x = -radius_nodes; x <= radius_nodes; ++x) {
                const int place = (block_at(y) + half_) * side_ + block_at(x) + half_;
                const auto block = static_cast<std::size_t>(place);
                block_.push_back(static_cast<std::uint16_t>(block));
                nodes_[block] += 1;
            }
    }
    windows_.assign(tables * nodes_.size(), {});
}

void DepartureBlocks::begin() {
    std::fill(sums_.begin(), sums_.end(), Sum{});
}

void DepartureBlocks::finish(std::size_t table) {
    const auto count = sums_.size();
    Departed* const out = &windows_[table * count];
    // Blocks of the lower half are those opposite; the row through the light has a part of both.
    for (std::size_t block = 0; block < count; ++block) {
        const std::size_t opposite = count - 1 - block;
        const float nodes = std::max(nodes_[block] + nodes_[opposite], 1.0F);
        for (std::size_t c = 0; c < 4; ++c) {
            out[block].most[c] = std::max(sums_[block].most[c], sums_[opposite].most[c]);
            out[block].rms[c] = std::sqrt((sums_[block].squares[c] + sums_[opposite].squares[c]) / nodes);
        }
    }
    // Neighbours to the right and above, in place: those that follow are still as they were.
    const auto side = static_cast<std::size_t>(side_);
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x) {
            Departed& window = out[y * side + x];
            for (std::size_t j = 0; j < down && y + j < side; ++j)
                for (std::size_t i = 0; i < across && x + i < side; ++i)
                    take_larger(window, out[(y + j) * side + x + i]);
        }
}

Departed DepartureBlocks::within(std::size_t table, Range u, Range v) const {
    Departed found;
    // Between two nodes it is no more than at either.
    const int left = std::max(block_at(u.first - 1, half_), -half_);
    const int right = std::min(block_at(u.last + 1, half_), half_);
    const int bottom = std::max(block_at(v.first - 1, half_), -half_);
    const int top = std::min(block_at(v.last + 1, half_), half_);
    if (left > right || bottom > top || windows_.empty()) return found;
    const Departed* const windows = &windows_[table * sums_.size()];
    for (int y = bottom;; y += down) {
        const int row = std::max(std::min(y, top - down + 1), bottom);
        for (int x = left;; x += across) {
            const int column = std::max(std::min(x, right - across + 1), left);
            const int place = (row + half_) * side_ + column + half_;
            take_larger(found, windows[static_cast<std::size_t>(place)]);
            if (column + across > right) break;
        }
        if (row + down > top) break;
    }
    return found;
}

}  // namespace seaglare::glare
