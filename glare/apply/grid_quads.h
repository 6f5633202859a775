// What of TileLists is drawn as rectangles in GL, band by band: the radial means on the grids, what is near a light on the
// picture, and departures in runs of tiles. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "glare/apply/accumulator.h"
#include "glare/apply/tile_lists.h"

namespace seaglare::glare {

// What a rectangle is drawn with. A rasteriser on a CPU takes every branch of a shader: what one needs costs all of them.
enum class QuadKind : std::uint8_t {
    mean_of_one,  // a level's mean, of one layer
    mean_of_two,  // or between two
    near_one,     // all of the pattern, on the picture
    near_two,
    near_and_tail,  // and the tail beyond the skirt
    departs_one,    // departures, beyond the fade
    departs_two,
    departs_fading,
};
inline constexpr std::size_t quad_kinds = 8;

// As shaders/grid_quad.vert.glsl reads it: three texels.
struct GridQuad {
    float light = 0;              // its place among TileLists::lights()
    float lower_only = 0;         // 1: its lower layer will do
    float departs_from = 0;       // nodes; 0: all of the pattern is drawn, by `fade`
    float reach2 = 0;             // nodes squared, of departures
    std::array<float, 4> rect{};  // left, bottom, right, top in nodes of the grid
    std::array<float, 4> fade{};  // as GatherEntry's
};
static_assert(sizeof(GridQuad) == 3 * 16);

struct QuadRange {
    int first = 0;
    int end = 0;
    int count() const { return end > first ? end - first : 0; }
};

class GridQuads {
  public:
    // Of lists just built of these lights; the tail begins at `tail_from_nodes`. Allocates nothing once it has seen as many.
    void build(const ScreenGeometry& geometry, const TileLists& lists, std::span<const LightInstance> lights,
               double tail_from_nodes);

    std::span<const GridQuad> quads() const { return quads_; }
    // Those of a grid, level 1 and up, of one kind.
    QuadRange of_level(int level, QuadKind kind) const {
        return levels_[static_cast<std::size_t>(level)][static_cast<std::size_t>(kind)];
    }
    // Those that reach a band of the picture.
    QuadRange of_band(RowRange band, QuadKind kind) const {
        return bands_[static_cast<std::size_t>(band.first / band_rows)][static_cast<std::size_t>(kind)];
    }
    // Nodes of all grids and pixels of the picture that they cover; overlapping ones count each.
    double covered_nodes() const { return covered_nodes_; }
    double covered_px() const { return covered_px_; }

  private:
    using Ranges = std::array<QuadRange, quad_kinds>;
    struct Run {  // of tiles in a row
        QuadKind kind{};
        GridQuad quad;
    };
    void add_level(const TileLists& lists, int level, double tail_from_nodes);
    void add_departures(const TileLists& lists, std::span<const LightInstance> lights);
    void add_row(const TileLists& lists, std::span<const LightInstance> lights, int tile_y);
    // Nodes from a light to the nearest pixel of a rectangle.
    float nearest_nodes(const GatherLight& light, const std::array<float, 2>& centre_px,
                        const std::array<float, 4>& rect) const;

    std::vector<GridQuad> quads_;
    std::array<Ranges, most_levels> levels_{};
    std::vector<Ranges> bands_;
    std::array<std::vector<GridQuad>, quad_kinds> kept_;  // by kind, on their way to quads_
    std::array<std::array<float, 3>, 3> ray_{};           // constant, per px in x, per px in y
    std::vector<Run> row_;
    std::vector<int> run_of_light_;  // of the row, by light; -1: none
    double covered_nodes_ = 0;
    double covered_px_ = 0;
};

}  // namespace seaglare::glare
