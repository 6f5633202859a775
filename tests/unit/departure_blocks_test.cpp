// What a part of a pattern has at most: never less than any of its nodes, nor much more than those around it.
#include "glare/apply/departure_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace seaglare::test {
namespace {

using namespace glare;

// Point-symmetric, of random nodes.
struct Nodes {
    explicit Nodes(int of_radius) : radius(of_radius) {
        std::mt19937_64 random(static_cast<std::uint64_t>(of_radius));
        std::normal_distribution<float> normal;
        const auto side = 2 * static_cast<std::size_t>(radius) + 1;
        values.resize(side * side);
        blocks.resize(radius, 1);
        blocks.begin();
        std::size_t node = 0;
        for (int y = 0; y <= radius; ++y)
            for (int x = -radius; x <= radius; ++x, ++node) {
                std::array<float, 4>& value = at(x, y);
                if (y > 0 || x >= 0)
                    for (float& channel : value)
                        channel = normal(random);
                else
                    value = at(-x, -y);
                if (y == 0 && x < 0) continue;
                at(-x, -y) = value;
            }
        node = 0;
        for (int y = 0; y <= radius; ++y)
            for (int x = -radius; x <= radius; ++x, ++node)
                blocks.add(node, at(x, y));
        blocks.finish(0);
    }
    std::array<float, 4>& at(int x, int y) {
        const int place = (y + radius) * (2 * radius + 1) + x + radius;
        return values[static_cast<std::size_t>(place)];
    }
    // The largest of a channel among the nodes of a rectangle.
    float most(int left, int right, int bottom, int top, std::size_t channel) {
        float largest = 0;
        for (int y = std::max(bottom, -radius); y <= std::min(top, radius); ++y)
            for (int x = std::max(left, -radius); x <= std::min(right, radius); ++x)
                largest = std::max(largest, std::abs(at(x, y)[channel]));
        return largest;
    }
    int radius;
    std::vector<std::array<float, 4>> values;
    DepartureBlocks blocks;
};

}  // namespace

TEST(DepartureBlocks, APartHasNoLessThanItsNodesAndNoMoreThanThoseABlockAround) {
    for (const int radius : {3, 20, 41, 87}) {
        Nodes nodes(radius);
        std::mt19937_64 random(3);
        for (int i = 0; i < 400; ++i) {
            const auto any = [&](int count) {
                return static_cast<int>(random() % static_cast<unsigned>(count));
            };
            const int left = any(2 * radius + 20) - radius - 10;
            const int bottom = any(2 * radius + 20) - radius - 10;
            const int right = left + any(60);
            const int top = bottom + any(40);
            // Between the nodes: what is drawn there is interpolated from those on either side.
            const auto between = [](int node) { return static_cast<float>(node) + 0.5F; };
            const Departed found =
                nodes.blocks.within(0, {between(left), between(right)}, {between(bottom), between(top)});
            // Blocks are looked up by fours and twos, and not all fit.
            constexpr int around = 4 * DepartureBlocks::block_nodes;
            for (std::size_t c = 0; c < 4; ++c) {
                EXPECT_GE(found.most[c], nodes.most(left, right + 1, bottom, top + 1, c));
                EXPECT_LE(found.most[c],
                          nodes.most(left - around, right + around, bottom - around, top + around, c));
                EXPECT_LE(found.rms[c], found.most[c]);
            }
        }
    }
}

TEST(DepartureBlocks, ThereIsNothingBeyondThePattern) {
    const Nodes nodes(20);
    const Departed found = nodes.blocks.within(0, {60, 70}, {-5, 5});
    for (std::size_t c = 0; c < 4; ++c)
        EXPECT_EQ(found.most[c], 0);
}

TEST(DepartureBlocks, ANeedleShowsWhereItIs) {
    DepartureBlocks blocks;
    constexpr int radius = 80;
    blocks.resize(radius, 1);
    blocks.begin();
    std::size_t node = 0;
    for (int y = 0; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x, ++node)
            blocks.add(node, y == 0 ? std::array<float, 4>{1, 1, 1, 1} : std::array<float, 4>{});
    blocks.finish(0);
    EXPECT_EQ(blocks.within(0, {40, 72}, {-8, 8}).most[1], 1);
    EXPECT_EQ(blocks.within(0, {-72, -40}, {-8, 8}).most[1], 1);
    EXPECT_EQ(blocks.within(0, {-16, 16}, {40, 56}).most[1], 0);
    EXPECT_EQ(blocks.within(0, {-16, 16}, {-56, -40}).most[1], 0);
}

}  // namespace seaglare::test
