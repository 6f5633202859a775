// Sums lights in OpenCL by gathering them, tile by tile, on a pyramid of grids (shaders/gather.cl). Knows no GL: what it
// sums is mapped for whoever wants it. On a CPU this is often a hundred times cheaper than drawing rectangles.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>

#include "glare/apply/accumulator.h"
#include "glare/apply/gather_pattern.h"
#include "glare/apply/tile_lists.h"
#include "glare/device/cl_device.h"
#include "glare/device/cl_gl_texture.h"

namespace seaglare::glare {

class ClGather {
  public:
    // Compiles. Throws as ClDevice does when there is no OpenCL.
    ClGather() : ClGather(ClDevice()) {}
    // On a context that others may have objects of.
    explicit ClGather(std::shared_ptr<ClShared> shared) : ClGather(ClDevice(std::move(shared))) {}
    ~ClGather();
    ClGather(const ClGather&) = delete;
    ClGather& operator=(const ClGather&) = delete;
    // Runs each kernel once on a small picture: drivers compile again at the first launch.
    void warm_up();

    // Takes up the skirts and tails of those lights that is_gathered(); the others, and every core, are left to the
    // billboards. Keeps nothing of `input` but copies, and reads input.copies until the last sum(). Returns the kernels
    // launched. Throws ClError when the device fails.
    std::uint32_t prepare(const AccumulationInput& input);
    // Of what was prepared last, some rows, which begin at a multiple of band_rows: `take` is given band after band, upwards,
    // each while the next is summed. May be called again. Returns and throws as prepare(), or as `take` does.
    std::uint32_t sum(RowRange rows, const TakeRows& take);

    // The same without a way through the CPU, where shared() shares with the GL context that is current: band i of these rows
    // is in textures[i % 2], of RGBA32F, before `use` is given it. They must stay as they are until forget_textures().
    std::uint32_t sum_into(RowRange rows, const std::array<unsigned, 2>& textures,
                           const std::function<void(RowRange)>& use);
    void forget_textures() { textures_ = {}; }
    // Waits for what is under way still, which is hardly ever anything: sums return when their picture is there, or will be
    // for GL. Before input.copies are written to; prepare() does it by itself. Throws ClError.
    void settle();

    // Where input.copies have to be.
    const std::shared_ptr<ClShared>& shared() const { return device_.shared(); }
    const TileLists& lists() const { return lists_; }
    double memory_bytes() const;

  private:
    explicit ClGather(ClDevice device);
    void reserve_sums();
    std::uint32_t sum_grids();
    const ClGlTexture& texture_of(unsigned name);
    void launch_band(RowRange band, cl_mem out);

    ClDevice device_;
    int rows_;  // of nodes that a work-item sums
    ClKernel mean_;
    ClKernel structure_;
    GatherPatternWriter writer_;
    GatherPattern own_copies_;  // of patterns that come without
    TileLists lists_;
    ScreenGeometry geometry_;                // of the frame prepared
    const GatherPattern* copies_ = nullptr;  // of its pattern
    float tail_from_nodes_ = 0;
    int radius_nodes_ = 0;
    ClBuffer departing_begin_;
    ClBuffer departing_;
    ClBuffer lights_;
    ClBuffer entries_;
    ClBuffer tile_begin_;
    ClBuffer tile_entries_;
    std::array<ClBuffer, 2> bands_;           // of the picture: one is summed while the other is taken
    std::array<ClBuffer, most_levels> sums_;  // of the grids above it
    std::array<ClGlTexture, 2> textures_;     // that were summed into last
    std::size_t next_texture_ = 0;
    bool under_way_ = false;  // something may be
};

}  // namespace seaglare::glare
