// Which light is summed on which grid, and in which tiles: what the CPU decides before shaders/gather.cl sums. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "glare/apply/departure_lists.h"
#include "glare/apply/light_instance.h"
#include "glare/apply/luminance_floor.h"
#include "glare/apply/pattern_profile.h"
#include "glare/apply/screen_geometry.h"
#include "glare/psf/pattern.h"

namespace seaglare::glare {

// Tiles of a grid: as many nodes as a work-group of shaders/gather.cl sums, 4 x 16 strips of eight.
inline constexpr int tile_width = 32;
inline constexpr int tile_height = 16;
inline constexpr int strip_nodes = 8;

// A grid of the pyramid. Node (i, j) stands at pixel (0.5, 0.5) + cell_px (i - pad, j - pad).
struct GridLevel {
    int cell_px = 1;
    int pad = 0;  // nodes before the picture, for the interpolation: 0 for the picture itself
    int width = 0;
    int height = 0;
    int tiles_across = 0;
    int tiles_down = 0;
    int first_tile = 0;  // among the tiles of all levels
    int row_nodes() const { return (width + strip_nodes - 1) / strip_nodes * strip_nodes; }
};
// The picture, then grids of 2, 4, ... px while they have more than a few nodes; at most most_levels.
inline constexpr int most_levels = 7;
std::vector<GridLevel> plan_levels(int width_px, int height_px);

// The outer edge of the windows between grids over their inner one; shaders/gather.cl and radial.glsl have it, too.
inline constexpr double fade_ratio = 1.75;

// As in shaders/gather.cl.
struct alignas(16) GatherLight {
    std::array<float, 3> along_u{};
    std::int32_t lower_table = 0;
    std::array<float, 3> along_v{};
    std::int32_t upper_table = 0;
    std::array<float, 3> towards{};
    float upper_share = 0;
    std::array<float, 4> illuminance{};
    std::array<float, 3> lash = {1, 0, 0};
    float departs_from =
        0;  // nodes: nearer, all of it is drawn, from fade_ratio times as far on its departures
};
static_assert(sizeof(GatherLight) == 5 * 16);
struct alignas(16) GatherEntry {
    std::int32_t light = 0;
    std::uint32_t columns = 0;  // first and last, sixteen bits each
    std::uint32_t rows = 0;
    std::int32_t unused = 0;
    std::array<float, 4> fade{};  // in over the first two, out over the others, nodes; 0: it does not
};
static_assert(sizeof(GatherEntry) == 2 * 16);

// What may be lost.
struct GatherThresholds {
    double share_cd_m2 = 0;  // by one light, by interpolation
    double reach_cd_m2 = 0;  // by one light, where it ends
    // By all lights, by the mean over the azimuth in place of the pattern: in codes, or everywhere one light's share.
    CodeBudget structure;
    // Takes lights of unknown visibility, too, as if nothing hid them; they make no pixel brighter that could lose more.
    bool unknown_too = false;
};

// Whether a light is gathered: not one whose visibility is unknown (negative), nor a lamp larger than the largest layer, of
// which there are never many, nor with a pattern that ends within two nodes, as of a small transform on a coarse picture.
bool is_gathered(const Pattern& pattern, const LightInstance& light, float visible);

class TileLists {
  public:
    // `visible`: one factor for each light, or none where nothing hides them.
    void build(const ScreenGeometry& geometry, const Pattern& pattern, const PatternProfile& profile,
               const GatherThresholds& thresholds, std::span<const LightInstance> lights,
               std::span<const float> visible);

    std::span<const GridLevel> levels() const { return levels_; }
    std::span<const GatherLight> lights() const { return lights_; }
    // By light: its place among those given.
    std::span<const std::int32_t> sources() const { return sources_; }
    std::span<const GatherEntry> entries() const { return entries_; }
    std::span<const std::uint8_t> level_of_entry() const { return level_of_entry_; }
    // Entries of tile t: tile_entries()[tile_begin()[t]] up to tile_begin()[t + 1].
    std::span<const std::int32_t> tile_begin() const { return tile_begin_; }
    std::span<const std::int32_t> tile_entries() const { return tile_entries_; }
    // Of the picture's tiles.
    const DepartureLists& departures() const { return departures_; }
    // Coarsest level with a light, and the number of levels before it plus one: grids above need not be summed.
    int levels_used() const { return levels_used_; }

  private:
    void add_light(const ScreenGeometry& geometry, const Pattern& pattern, const PatternProfile& profile,
                   const GatherThresholds& thresholds, const LightInstance& light, float visible);
    void add_entry(const ScreenGeometry& geometry, const LightInstance& light, double pitch, int level,
                   const std::array<double, 4>& fade);
    void sort_into_tiles();

    std::vector<GridLevel> levels_;
    LuminanceFloor floor_;
    DepartureLists departures_;
    std::vector<DepartingLight> departing_;  // by light
    std::vector<GatherLight> lights_;
    std::vector<std::int32_t> sources_;
    std::vector<GatherEntry> entries_;
    std::vector<std::uint8_t> level_of_entry_;
    std::vector<std::int32_t> tile_begin_;
    std::vector<std::int32_t> tile_entries_;
    int levels_used_ = 0;
};

}  // namespace seaglare::glare
