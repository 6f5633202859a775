// Finer nodes near a light. The skirt's nodes stand a pixel apart and are drawn with straight lines between them; within a few
// pixels of a light, where the skirt falls with the second to third power of the distance, such lines are up to half too
// bright, and the core's window, which is evaluated at the nodes, jumps from one to the next. So the pattern has, near the
// light, the difference between nodes a third of a node apart and those straight lines. It is drawn with the core.
//
// Every node, coarse or fine, is a mean over a box of one pixel around it. So the sum over pixels is the same wherever the
// light stands under the grid, and straight lines between them keep that. The difference adds nothing to a light's energy:
// what is left at each of the nine places of the fine nodes under the grid is taken back over the core's width, by a shape
// whose sum over pixels is the same at every place, too.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "glare/psf/pattern.h"
#include "glare/psf/pattern_grid.h"

namespace seaglare::glare {

// The grid of their cells: `fine_per_node` to a node, each the energy in a box of its own size. What the sources spread
// energy onto.
PatternGrid fine_grid(const PatternGrid& grid);
inline constexpr int fine_cells_radius = fine_per_node * fine_radius_nodes + fine_per_node / 2;
inline constexpr std::size_t fine_cells_side = 2 * fine_cells_radius + 1;

// What splits core from skirt at the nodes, to be done at the cells.
struct FineSplit {
    double core_radius_nodes = 2;
    std::span<const float> gains;  // of the rings of nodes; empty: not calibrated
    std::array<double, 4> scale{
        1, 1, 1, 1};  // energy of core + skirt, channel by channel, as it should be over as it is
};

// Fills the part of Pattern::fine that belongs to a slot, whose skirt is there. `cells`: fine_cells_side^2, rows from -v to
// +v; overwritten. Throws std::invalid_argument when there are not as many.
void fill_fine_nodes(std::span<Rgbv> cells, const FineSplit& split, const PatternGrid& grid, std::size_t slot,
                     Pattern& pattern);

}  // namespace seaglare::glare
