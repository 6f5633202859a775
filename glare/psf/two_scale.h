// The two scales of one pattern. The core is transformed every frame from the whole pupil at few samples; the wide field
// (halo, outer corona) at many samples, at whole multiples of an interval, a slice per frame. Both have the same plane
// and so the same frequencies: they are joined in the transform, by a half cosine over a band of frequencies where both are
// right, and everything after (colour, screen, discs, energy) sees one pattern.
//
// Between two instants the energies of both are mixed. What is mixed depends on the time and the pupil asked for and on
// nothing else, so that channels and processes with other frame times agree to the last bit.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "glare/device/cl_device.h"
#include "glare/eye/eye_instant.h"
#include "glare/psf/cl_aperture.h"
#include "glare/psf/fft.h"
#include "glare/psf/pattern.h"
#include "glare/psf/wide_strips.h"

namespace seaglare::glare {

// Where the core hands over, in samples of the transform from the centre.
struct ScaleJoin {
    float inner = 0;
    float outer = 0;
};
ScaleJoin scale_join(int core_transform_size);

// An instant of the wide field and its weight; weights add up to 1. One of weight 0 is about to be needed.
struct WideInstant {
    EyeInstant eye;
    double weight = 0;
};
// Two times and two pupils, of steps of the wide field's own; fewer where those are the same. Energy is mixed in
// proportion: that of the halo's ring, which comes from the pupil's rim, grows with the pupil's square.
struct WideInstants {
    std::array<WideInstant, 4> list;
    int count = 0;
    void add(const EyeInstant& eye, double weight);  // equal instants are one
};
struct WideTime {
    double interval_s = 2;
    double time_s = 0;
    int intervals_ahead = 0;
};
WideInstants wide_instants(const EyeModel& eye, const WideTime& time, double pupil_mm, double plane_width_mm,
                           std::uint64_t seed);

// Cumulative energy of every step-th frequency, as shaders/two_scale.cl leaves it.
struct WideTable {
    EyeInstant eye;
    std::uint64_t id = 0;  // of no other table in this process
    double weight = 0;     // at the instant last asked for
    bool complete = false;
    ClBuffer energy;
};

class WideField {
  public:
    // Throws as ClDevice and BatchFft do. Launches nothing.
    WideField(const ClDevice& device, const EyeModel& eye, const PatternSettings& settings,
              std::uint64_t seed);

    // Brings the tables for this instant, at once where they are missing, and does its share of those for the next
    // interval. A pitch finer than any before needs finer tables, and so new ones. Returns the launches.
    int advance(double time_s, double pupil_mm, double pitch);

    // Which of the two ways to transform; the constructor chooses by the kind of device. Strips are for a CPU and up to
    // WideStrips::most_samples. Before the first advance().
    void transform_in_strips(bool on);

    // Whether the wide field of this eye changes with time. One that does not can follow every swing of the pupil.
    bool moves() const { return moves_; }
    // The tables with a weight, until the next advance().
    std::span<const WideTable* const> tables() const { return {shown_.data(), shown_count_}; }
    const ScaleJoin& join() const { return join_; }
    // Where the tables' energy ends, in samples of the transform: beyond the last edge.
    double reach() const { return n_ / 2.0 + 1; }
    int step() const { return step_; }
    int edges() const { return edges_of(step_); }
    int stride() const { return stride_of(step_); }
    std::size_t device_bytes() const;

  private:
    int edges_of(int step) const { return (n_ / 2 - 1) / step + 3; }
    int stride_of(int step) const { return (edges_of(step) + 15) / 16 * 16; }
    WideTable* find(const EyeInstant& eye);
    WideTable& claim(const EyeInstant& eye, const WideInstants& shown, const WideInstants& next);
    void use_step(int step);
    // A slice is a row of tiles or a block of columns. Those of a table are numbered from 0, pass by pass: in each all rows
    // are transformed, and of the columns, outermost first, those that the pass has room to keep.
    struct Slices {
        int first_tile_row = 0;
        int rows = 0;
        int columns = 0;
        int columns_per_pass() const { return (columns + most_passes - 1) / most_passes; }
        int passes() const { return (columns + columns_per_pass() - 1) / columns_per_pass(); }
        int all() const { return passes() * rows + columns; }
    };
    // Each more transforms all rows once more, and holds less of them.
    static constexpr int most_passes = 4;
    Slices slices(const EyeInstant& eye) const;
    struct Columns {
        int first = 0;
        int count = 0;
    };
    Columns kept_columns(const Slices& s, int pass) const;
    int run(WideTable& table, int first, int last);  // slices first ... last - 1
    void transform_rows(const EyeInstant& eye, const Slices& s, int pass, int slice);
    void transform_columns(WideTable& table, const Slices& s, int pass, int slice);

    const ClDevice& device_;
    EyeModel eye_;
    int n_;
    double plane_width_mm_;
    double interval_s_;
    std::uint64_t seed_;
    ScaleJoin join_;
    bool moves_;  // otherwise tables serve all times
    int step_ = 4;
    ClAperture aperture_;
    // One way or the other: strips where the device is a CPU.
    std::optional<WideStrips> strips_;
    std::optional<BatchFft> row_fft_;
    std::optional<BatchFft> column_fft_;
    ClKernel keep_rows_;
    ClKernel gather_columns_;
    ClKernel sum_along_columns_;
    ClKernel sum_across_columns_;
    ClBuffer rows_;
    ClBuffer kept_;
    ClBuffer columns_;
    ClBuffer unbox_;
    ClBuffer sums_;
    ClBuffer carry_;
    static constexpr std::size_t most_tables = 8;
    std::vector<std::unique_ptr<WideTable>> tables_;
    std::array<const WideTable*, 4> shown_{};
    std::size_t shown_count_ = 0;
    std::uint64_t building_ = 0;  // id of the table under way; 0: none
    int slices_done_ = 0;         // of it
};

}  // namespace seaglare::glare
