// The inside of ViewRenderer: what its steps share. A frame's order is in view_renderer.cpp, which lights are handed to whom in
// view_lights.cpp, the bands in view_bands.cpp; nobody else includes this.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "glare/apply/band_lights.h"
#include "glare/apply/cl_gather.h"
#include "glare/apply/compositor.h"
#include "glare/apply/gl_billboards.h"
#include "glare/apply/gl_grids.h"
#include "glare/apply/hdr_sum.h"
#include "glare/apply/light_buffer.h"
#include "glare/apply/light_instance.h"
#include "glare/apply/occlusion.h"
#include "glare/apply/view_renderer.h"

namespace seaglare::glare {

inline double area_px(const RectPx& rect) {
    const double width = static_cast<double>(rect[2]) - static_cast<double>(rect[0]);
    const double height = static_cast<double>(rect[3]) - static_cast<double>(rect[1]);
    return std::max(width, 0.0) * std::max(height, 0.0);
}

struct ViewRenderer::Impl {
    Impl(const Gl& table, bool timed);

    RenderResult render(const Frame& frame, const ToneSettings& tone, const Pattern& pattern,
                        std::span<const PointSource> sources, const AccumulationPlan& plan,
                        RenderStats& stats);
    void read_hdr(std::span<float> rgba);
    DeviceMemory memory() const;

    // The steps of render(), in their order.
    PixelRect take_lights(const ScreenGeometry& g, const Pattern& pattern, const ReachSettings& reach,
                          std::span<const PointSource> sources);
    void bind_own_objects();
    void look_what_hides(const Frame& frame, const ScreenGeometry& g, RenderStats& stats);
    bool leave_to_gather(AccumulationInput input, double most_unknown_px, RenderStats& stats);
    void leave_unknown(const Pattern& pattern, int cell_px, double most_px, RenderStats& stats);
    bool grids_pay(const ScreenGeometry& g, const Pattern& pattern, int cell_px) const;
    void leave_to_grids(const AccumulationInput& input);
    void let_go_of_copies();
    void take_pattern(const Pattern& pattern);
    void draw_grid(const ReachSettings& reach, RenderStats& stats);
    // Makes one band after the other and has it used. Throws ClError when the gather fails, GlError, or as `use` does.
    void for_each_band(RowRange rows, RenderStats& stats, const std::function<void(RowRange)>& use);
    void draw_band(RowRange band, RenderStats& stats);
    template <typename Draw>
    void draw_lights(LightRange range, RenderStats& stats, Draw draw);

    const Gl gl;
    PassTimer timer;
    GlObject vertex_array, sampler;
    LightBuffer light_buffer;
    Occlusion occlusion;
    GlBillboards billboards;
    GlGrids grids;
    Compositor compositor;
    HdrSum sum;
    FineReach fine_reach;
    std::vector<LightInstance> instances;
    std::vector<std::uint32_t> tags;  // of the instances
    RowOrder row_order;
    BandLights tail_lights, skirt_lights, core_lights;  // of the instances; tails where the bands carry them
    std::unique_ptr<ClGather> gather;                   // null: cannot, or need not
    SharingDecision sharing = {false, "nothing is gathered"};
    double shared_bytes = 0;  // of the bands when they were shared last
    const PreparedPattern* prepared = nullptr;
    bool draws_skirts = false;   // in the last frame that drew
    std::vector<float> visible;  // of the instances, where anything can hide them
    bool gathers = false;        // in this frame
    bool on_grids = false;       // in this frame: what is not gathered
    int width_px = 0;
    int height_px = 0;
    bool nothing_drawn = true;
};

}  // namespace seaglare::glare
