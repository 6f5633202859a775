// What a pattern's skirt and tail look like when only the distance from the light counts, and how far the pattern departs
// from that: needles and speckle are the first thing that faint light does not need. Pure, no GL, no CL.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "glare/apply/departure_blocks.h"
#include "glare/psf/pattern.h"

namespace seaglare::glare {

// The radial table's argument is q, the square of the direction cosine in nodes of the pattern. Entry i stands at the float
// whose bits are first_q_bits + (i << entry_shift): sixteen entries evenly in each octave from q = 4. It holds psf times q,
// which hardly bends, so that straight lines between entries err by less than 1e-3; shaders/gather.cl reads it so.
struct RadialTable {
    static constexpr std::uint32_t first_q_bits = 0x40800000U;  // 4.0F
    static constexpr int entry_shift = 19;
    static constexpr int entries = 18 * 16 + 1;  // to q = 2^20: a quarter turn where a node is 1/1024 or more
    static float q_of(int entry) {
        return std::bit_cast<float>(first_q_bits + (static_cast<std::uint32_t>(entry) << entry_shift));
    }
};

// A sum of independent departures exceeds so many of its standard deviations nowhere in a picture of a million pixels: one
// in 5e7 of a normal distribution does.
inline constexpr double departure_deviations = 5.5;

class PatternProfile {
  public:
    // Reads a pattern; nothing to do while its generation is the same. About half a millisecond for four lamps of two
    // layers of 175 x 175 nodes.
    void update(const Pattern& pattern);

    // Tables of `entries` x 4 channels: one for each layer of each slot (slot by slot), mean of the skirt over the azimuth
    // and the tail beyond it; last that of the tail alone, which begins where the skirt fades.
    std::span<const float> tables() const { return tables_; }
    std::size_t table_of(std::size_t slot, std::size_t layer) const { return slot * layers_ + layer; }
    std::size_t tail_table() const { return slots_ * layers_; }

    // How far nodes depart from the radial mean, by distance: entry i is the root of the mean square, over the azimuth, of
    // the channel that departs most, or a departure_deviations-th of the largest, whichever is more; the largest from i nodes on
    // outwards; sr^-1. Zero from the end of the span on. Departures at one pixel of lights in different places have nothing to
    // do with each other: they add up as their squares do.
    std::span<const float> deviation(std::size_t table) const;
    // The same by parts of the pattern, as it stands: without lashes only. In nodes.
    Departed departed(std::size_t table, DepartureBlocks::Range u, DepartureBlocks::Range v) const {
        return blocks_.within(table, u, v);
    }
    // The nodes of the skirt less the mean of the tables, tail excluded, in the skirt's order; zero nearer than
    // nearest_departure_nodes, where nobody may ask. `out` is as large as the skirt.
    void departures(const Pattern& pattern, std::span<float> out) const;
    static constexpr double nearest_departure_nodes = 3;
    // Largest radius, in nodes, at which a channel exceeds psf_sr; at most a quarter turn.
    double reach_nodes(std::size_t table, double psf_sr) const;
    // The least that each channel of any table has at that squared distance or nearer.
    const std::array<float, 4>& least_psf_sr(float radius2_nodes) const {
        // The entry beyond, which is no more.
        const float q =
            std::clamp(radius2_nodes, RadialTable::q_of(0), RadialTable::q_of(RadialTable::entries - 2));
        const std::uint32_t bits = std::bit_cast<std::uint32_t>(q) - RadialTable::first_q_bits;
        return least_[(bits >> RadialTable::entry_shift) + 1];
    }
    // Radius, in nodes, beyond which a grid of cells of 2^level nodes, 1 <= level <= grids, has the mean to psf_sr: what cubic
    // interpolation through four of its nodes errs by half way between them and, on the first, what straight lines between the
    // nodes of the pattern err by, which the departures are drawn with. At least grid_precision of the mean itself.
    double grid_reach_nodes(std::size_t table, int level, double psf_sr) const;
    static constexpr int grids = 8;
    static constexpr float grid_precision = 5e-4F;  // as halves of floats have

  private:
    void measure_rings(const Pattern& pattern, const float* skirt);
    void measure_departures(const Pattern& pattern, std::size_t table, const float* skirt);
    // What the tables say of a node of the upper half, without the tail.
    std::array<float, 4> mean_of_node(std::size_t table, std::size_t node) const;
    void fill_table(const Pattern& pattern, std::size_t table, bool with_skirt);
    void find_reaches(std::size_t table);
    void measure_grids(std::size_t table);
    std::array<float, 4> mean_at(std::size_t table, float radius_nodes) const;
    void smooth_table(const Pattern& pattern, std::size_t table);
    void find_least();

    std::uint64_t generation_ = 0;
    std::size_t slots_ = 0;
    std::size_t layers_ = 0;
    double quarter_turn_q_ = 1e6;
    int radius_ = -1;
    // Of each node of the upper half plane: the ring inside it, and how far it lies towards the next.
    std::vector<std::uint16_t> ring_;
    std::vector<float> towards_next_;
    std::vector<std::uint16_t> entry_;  // of the tables, by the same nodes
    std::vector<float> towards_entry_;
    std::vector<float> inverse_q_;
    std::vector<float> ring_weight_;
    std::vector<float> ring_sum_;  // psf times q
    std::vector<float> ring_square_, ring_nodes_, ring_most_;
    std::vector<float> deviation_;  // by table and ring
    DepartureBlocks blocks_;
    std::vector<float> tables_;
    std::vector<float> smoothed_;
    std::vector<float> largest_;     // by table and entry: the largest channel of psf from there on outwards
    std::vector<float> grid_error_;  // by table, level and entry: the largest error from there on outwards
    std::vector<std::array<float, 4>> least_;  // by entry: the least of all tables from there on inwards
    std::vector<float> curve_;                 // the tail's psf times q, by entry
    double curve_age_ = -1;
    double curve_pigmentation_ = -1;
    double curve_pitch_ = -1;
};

}  // namespace seaglare::glare
