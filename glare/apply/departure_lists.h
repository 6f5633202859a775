// Which lights show their structure in which tile of the picture: needles, speckle and rings less the mean over the azimuth,
// which the grids have (tile_lists.h). In each tile the faintest of them are left out together, as many as its pixels can
// afford to lose. What lights in different places leave out at a pixel has nothing to do with each other, and so adds up as
// squares do; unless they are so few that even if all of them agreed they would show less. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "glare/apply/luminance_floor.h"
#include "glare/apply/pattern_profile.h"
#include "glare/apply/screen_geometry.h"

namespace seaglare::glare {

// One light, by its place among GatherLights.
struct DepartingLight {
    std::array<double, 3> direction{};  // unit
    std::array<float, 3> along_u{};     // GatherLight's
    std::array<float, 3> along_v{};
    std::array<float, 2> centre_px{};
    double lux = 0;  // of its strongest display channel
    std::size_t lower_table = 0;
    std::size_t upper_table = 0;
    float from_nodes = 0;   // nearer than this all of it is drawn
    float upper_share = 0;  // of the upper table's layer
    std::array<float, 4> illuminance{};
};

// As in shaders/gather.cl.
struct alignas(8) Departure {
    std::int32_t light =
        0;             // its place among GatherLights; below zero: -1 less it, and its lower layer will do
    float reach2 = 0;  // nodes squared: what it shows farther away the tile can afford to lose
};
static_assert(sizeof(Departure) == 8);

class DepartureLists {
  public:
    void build(const ScreenGeometry& geometry, const Pattern& pattern, const PatternProfile& profile,
               const LuminanceFloor& floor, const CodeBudget& budget, double otherwise_cd_m2,
               std::span<const DepartingLight> lights);

    // Of tile t, row by row of tiles: entries()[tile_begin()[t]] up to entries()[tile_begin()[t + 1]].
    std::span<const std::int32_t> tile_begin() const { return tile_begin_; }
    std::span<const Departure> entries() const { return kept_; }
    // In each tile: the part of what it can afford that is left out, at most 1.
    std::span<const float> spent() const { return spent_; }

  private:
    // Of what a tile can afford.
    struct Parts {
        float square =
            0;  // of departure_deviations standard deviations: of lights that have nothing to do with each other
        float most = 0;  // if all of them agreed
    };
    static constexpr int classes = 24;  // of the square of what a light shows, each half of the one before
    struct Candidate {
        std::uint32_t tile_and_class = 0;
        std::int32_t light = 0;  // as a Departure's
        Parts parts;
    };
    void find_slopes(const LuminanceFloor& floor, const CodeBudget& budget, double otherwise_cd_m2);
    void find_rays(const ScreenGeometry& geometry);
    void add(const ScreenGeometry& geometry, const Pattern& pattern, const PatternProfile& profile,
             std::int32_t index, const DepartingLight& light, double least_shown);
    void add(std::size_t tile, std::int32_t index, float upper_share, Parts parts);
    void choose();
    void limit(const PatternProfile& profile, std::span<const DepartingLight> lights);

    int tiles_across_ = 0;
    int tiles_down_ = 0;
    std::vector<float> per_length_;   // by corner of the tiles: one over the length of its ray
    std::vector<CodeSlopes> slopes_;  // by tile
    std::vector<float> part_;         // by tile: what 1 cd/m2 in all channels takes of what it can afford
    std::vector<Parts> sums_;         // by tile and class
    std::vector<std::int32_t> first_kept_;  // by tile: the number of brightest classes that are kept
    std::vector<Parts> lost_;               // by tile
    std::vector<Candidate> candidates_;
    std::vector<float> deviation_;  // of the light at hand, by ring: of its strongest channel, cd/m2
    std::vector<std::int32_t> tile_begin_;
    std::vector<Departure> kept_;
    std::vector<float> spent_;
};

}  // namespace seaglare::glare
