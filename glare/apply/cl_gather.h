// Sums lights in OpenCL by gathering them, tile by tile, on a pyramid of grids (shaders/gather.cl). Knows no GL: what it
// sums is mapped for whoever wants it. On a CPU this is often a hundred times cheaper than drawing rectangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "glare/apply/accumulator.h"
#include "glare/apply/pattern_profile.h"
#include "glare/apply/tile_lists.h"
#include "glare/device/cl_device.h"

namespace seaglare::glare {

class ClGather {
  public:
    // Compiles. Throws as ClDevice does when there is no OpenCL.
    ClGather();
    // Runs each kernel once on a small picture: drivers compile again at the first launch.
    void warm_up();

    // Sums the skirts and tails of those lights that is_gathered(); the others, and every core, are left to the billboards.
    // Returns the kernels launched. Throws ClError when the device fails.
    std::uint32_t sum(const AccumulationInput& input);
    // What sum() does, for those who measure it.
    void prepare(const AccumulationInput& input);
    std::uint32_t launch(const ScreenGeometry& geometry, const Pattern& pattern);
    void finish() const { device_.finish(); }

    // Waits for the sum: width x height x 4 floats, rows from the bottom up. Valid until unmap().
    std::span<const float> map();
    void unmap();

    const TileLists& lists() const { return lists_; }
    double memory_bytes() const;

  private:
    void take_pattern(const Pattern& pattern);

    ClDevice device_;
    int rows_;  // of nodes that a work-item sums
    ClOwned<cl_program> program_;
    ClKernel mean_;
    ClKernel structure_;
    PatternProfile profile_;
    TileLists lists_;
    std::uint64_t generation_ = 0;
    std::vector<std::uint16_t> halves_;
    float skirt_scale_ = 1;
    ClBuffer skirt_;
    ClBuffer tables_;
    ClBuffer lights_;
    ClBuffer entries_;
    ClBuffer tile_begin_;
    ClBuffer tile_entries_;
    std::array<ClBuffer, most_levels> sums_;
    void* mapped_ = nullptr;
};

}  // namespace seaglare::glare
