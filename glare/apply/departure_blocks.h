// How far a pattern departs from its radial mean in each part of it: what is left out of a tile of the picture is what the
// pattern has there, not what a ring of that radius has at its brightest needle. Pure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace seaglare::glare {

// By channel, linear sRGB and scotopic, sr^-1.
struct Departed {
    std::array<float, 4> most{};  // the largest of any node, its sign left out
    std::array<float, 4> rms{};   // root of the mean square of the block where that is largest
};

// Square blocks of nodes, the light in the middle of one. A pattern is point-symmetric, so that only the upper half is
// measured.
class DepartureBlocks {
  public:
    static constexpr int block_nodes = 8;

    void resize(int radius_nodes, std::size_t tables);
    // Before and after the nodes of a table are added.
    void begin();
    void finish(std::size_t table);
    // A node of row y >= 0, by its place there from -radius on.
    void add(std::size_t node, const std::array<float, 4>& off) {
        Sum& sum = sums_[block_[node]];
        for (std::size_t c = 0; c < 4; ++c) {
            const float size = off[c] < 0 ? -off[c] : off[c];
            sum.most[c] = sum.most[c] > size ? sum.most[c] : size;
            sum.squares[c] += off[c] * off[c];
        }
    }
    // Of all places with u between u.first and u.last, and v likewise, in nodes; what lies between nodes included.
    struct Range {
        float first = 0, last = 0;
    };
    Departed within(std::size_t table, Range u, Range v) const;

  private:
    // Neighbours are looked up together: this many across and down from each block on.
    static constexpr int across = 4;
    static constexpr int down = 2;
    struct Sum {
        std::array<float, 4> most{};
        std::array<float, 4> squares{};
    };
    int radius_ = -1;
    int half_ = 0;  // blocks -half_ ... half_ along both axes
    int side_ = 1;
    std::vector<std::uint16_t> block_;  // of each node of the upper half
    std::vector<float> nodes_;          // in each block, of that half
    std::vector<Sum> sums_;
    std::vector<Departed> windows_;  // by table and first block
};

}  // namespace seaglare::glare
