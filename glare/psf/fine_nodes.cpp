#include "glare/psf/fine_nodes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "glare/psf/cie_calibration.h"

namespace seaglare::glare {

namespace {

constexpr int per_node = fine_per_node;
constexpr int radius = fine_per_node * fine_radius_nodes;
constexpr int half_box = per_node / 2;
static_assert(per_node % 2 == 1, "a box of one node must begin and end where cells do");

// Nodes. Nearer than the first the difference does not begin: what the core's window leaves of the peak would be a box of one
// pixel, which flickers as the light moves under the grid, and the footprint is there so that it does not.
constexpr double rise_from = 0;
constexpr double rise_to = 0.75;
constexpr double fall_from = fine_radius_nodes - 1.5;

double half_cosine(double t) {
    return 0.5 - 0.5 * std::cos(std::numbers::pi * std::clamp(t, 0.0, 1.0));
}
double share_at(double distance_nodes) {
    return half_cosine((distance_nodes - rise_from) / (rise_to - rise_from)) *
           (1 - half_cosine((distance_nodes - fall_from) / (fine_radius_nodes - fall_from)));
}

// 1 up to inner, 0 from outer on.
double fade_at(double sine, const PatternGrid& grid) {
    if (sine <= grid.window_inner) return 1;  // nearly everywhere
    return 1 - half_cosine((sine - grid.window_inner) / (grid.window_outer - grid.window_inner));
}

// A node of a skirt's first layer; zero beyond it.
const float* node_at(const Pattern& pattern, std::size_t layer, int u, int v) {
    static constexpr std::array<float, 4> none{};
    const int r = pattern.radius_nodes;
    if (std::abs(u) > r || std::abs(v) > r) return none.data();
    const std::size_t side = 2 * static_cast<std::size_t>(r) + 1;
    return pattern.skirt.data() +
           4 * ((layer * side + static_cast<std::size_t>(v + r)) * side + static_cast<std::size_t>(u + r));
}

// What is taken back lies within two nodes: raised cosines, whose integer translates add up to one.
constexpr int taken_back_within = 2 * per_node;
double taken_back_at(int fine) {
    return 0.25 + 0.25 * std::cos(std::numbers::pi / taken_back_within * fine);
}

std::size_t offset_of(int a, int b) {
    return 4 * (static_cast<std::size_t>(b + radius) * fine_side + static_cast<std::size_t>(a + radius));
}
// Which of the places under the grid.
std::size_t place_of(int a, int b) {
    const int place = (b + radius) % per_node * per_node + (a + radius) % per_node;
    return static_cast<std::size_t>(place);
}

int floor_of(int fine) {
    return (fine + radius) / per_node - fine_radius_nodes;
}

}  // namespace

PatternGrid fine_grid(const PatternGrid& grid) {
    PatternGrid fine = grid;
    fine.pitch = grid.pitch / per_node;
    fine.structure_radius = fine_cells_radius;
    fine.radius = fine_cells_radius;
    fine.margin = 0;
    return fine;
}

void fill_fine_nodes(std::span<Rgbv> cells, const FineSplit& split, const PatternGrid& grid, std::size_t slot,
                     Pattern& pattern) {
    if (cells.size() != fine_cells_side * fine_cells_side)
        throw std::invalid_argument("glare pattern: finer nodes need all their cells");
    // The skirt's energy in each cell, as a mean over a node's box.
    std::size_t at = 0;
    for (int b = -fine_cells_radius; b <= fine_cells_radius; ++b) {
        for (int a = -fine_cells_radius; a <= fine_cells_radius; ++a, ++at) {
            const double distance = std::hypot(a, b) / per_node;
            double weight =
                fade_at(distance * grid.pitch, grid) * (1 - core_window(distance, split.core_radius_nodes));
            if (!split.gains.empty()) weight *= calibration_gain(split.gains, distance);
            weight /= grid.pitch * grid.pitch;
            for (std::size_t c = 0; c < 4; ++c)
                cells[at][c] *= static_cast<float>(weight * split.scale[c]);
        }
    }
    // Sums over boxes, less straight lines between the nodes; and what that adds up to at each place under the grid.
    pattern.fine.resize(pattern.lamps.size() * fine_floats);
    float* const fine = pattern.fine.data() + slot * fine_floats;
    const std::size_t layer = slot * std::max<std::size_t>(pattern.layer_radius_nodes.size(), 1);
    std::array<std::array<double, 4>, static_cast<std::size_t>(per_node * per_node)> sums{};
    for (int b = -radius; b <= radius; ++b) {
        for (int a = -radius; a <= radius; ++a) {
            float* const out = fine + offset_of(a, b);
            std::fill_n(out, 4, 0.0F);
            const double share = share_at(std::hypot(a, b) / per_node);
            if (share <= 0) continue;
            std::array<double, 4> value{};
            for (int y = b - half_box; y <= b + half_box; ++y) {
                const std::size_t row = static_cast<std::size_t>(y + fine_cells_radius) * fine_cells_side +
                                        static_cast<std::size_t>(a - half_box + fine_cells_radius);
                for (std::size_t x = row; x < row + static_cast<std::size_t>(per_node); ++x)
                    for (std::size_t c = 0; c < 4; ++c)
                        value[c] += static_cast<double>(cells[x][c]);
            }
            const int u = floor_of(a);
            const int v = floor_of(b);
            const double tu = static_cast<double>(a - u * per_node) / per_node;
            const double tv = static_cast<double>(b - v * per_node) / per_node;
            const std::array<const float*, 4> corner = {
                node_at(pattern, layer, u, v), node_at(pattern, layer, u + 1, v),
                node_at(pattern, layer, u, v + 1), node_at(pattern, layer, u + 1, v + 1)};
            const std::array<double, 4> part = {(1 - tu) * (1 - tv), tu * (1 - tv), (1 - tu) * tv, tu * tv};
            for (std::size_t c = 0; c < 4; ++c) {
                double line = 0;
                for (std::size_t k = 0; k < 4; ++k)
                    line += part[k] * static_cast<double>(corner[k][c]);
                const double beside = share * (value[c] - line);
                out[c] = static_cast<float>(beside);
                sums[place_of(a, b)][c] += beside;
            }
        }
    }
    for (int b = -taken_back_within; b <= taken_back_within; ++b) {
        for (int a = -taken_back_within; a <= taken_back_within; ++a) {
            const double part = taken_back_at(a) * taken_back_at(b);
            float* const out = fine + offset_of(a, b);
            for (std::size_t c = 0; c < 4; ++c)
                out[c] -= static_cast<float>(part * sums[place_of(a, b)][c]);
        }
    }
}

}  // namespace seaglare::glare
