// The screen's grid for a pattern: how many nodes, where the structure fades, which disc layers. Pure functions, shared
// by every source, so that what they make has one shape.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "glare/psf/pattern.h"

namespace seaglare::glare {

struct PatternGrid {
    double pitch = 0;
    int radius = 0;            // R: the table has (2R+1)^2 nodes
    int structure_radius = 0;  // no node farther than this has structure
    int margin = 0;            // what the largest disc adds: radius = structure_radius + margin
    double window_inner = 0;
    double window_outer = 0;
    int side() const { return 2 * radius + 1; }
};

// The field in which even the shortest wavelength is there, N 380 nm / (2 S) magnified, cropped to max_radius_nodes.
// Throws std::invalid_argument when the pitch is not positive and finite.
PatternGrid plan_grid(const PatternSettings& settings, double pitch);

// The layers for lights up to `largest_disc_nodes`: the point layer, those up to that size, and one beyond it. Layers
// that would not fit into max_radius_nodes are left out.
std::vector<float> plan_layers(const PatternSettings& settings, const PatternGrid& grid,
                               float largest_disc_nodes);
// The same without memory of the heap.
struct LayerPlan {
    std::array<float, most_layers + 1> radii_nodes{};  // [0] = 0
    std::size_t count = 1;
};
LayerPlan layer_plan(const PatternSettings& settings, const PatternGrid& grid, float largest_disc_nodes);

// A disc of `radius_nodes` on the grid: per cell the area that the disc covers, divided by the sum over all cells.
// Whole rows of cells that it covers fully are spans (they cost two look-ups in a prefix sum), the others taps.
struct DiscSpan {
    int dy = 0;
    int half_width = 0;  // cells -half_width ... half_width
};
struct DiscTap {
    int dx = 0;
    int dy = 0;
    double weight = 0;
};
struct DiscStencil {
    std::vector<DiscSpan> spans;
    double span_weight = 0;
    std::vector<DiscTap> taps;
};
DiscStencil make_disc_stencil(double radius_nodes);

// The core's share of a node at a distance: cos^2, 1 at the light, 0 from core_radius_nodes on.
double core_window(double distance_nodes, double core_radius_nodes);

// What structure and tail add up to, for one white light.
struct EnergyPlan {
    double structure = 1;   // core + skirt
    double tail_scale = 0;  // of the CIE curve; 0: none
};
EnergyPlan plan_energy(const EyeModel& eye, const PatternSettings& settings, const PatternGrid& grid,
                       double pupil_mm);

}  // namespace seaglare::glare
