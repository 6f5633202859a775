// Which lights are handed to a gather or to grids, and which are drawn as rectangles.
#include "glare/apply/view_renderer_impl.h"

namespace seaglare::glare {

namespace {

// Grids cost what they cost, however few the lights: passes over the picture and over the coarser ones, and the profile of the
// pattern. Rectangles that cover no more than the picture so many times, as those of one light never do, are drawn as they are.
constexpr double grids_from_pictures = 2;

}  // namespace

// Takes skirts and tails of what is gathered off the instances, which leaves the cores to be drawn. False: the device failed.
bool ViewRenderer::Impl::leave_to_gather(AccumulationInput input, double most_unknown_px,
                                         RenderStats& stats) {
    visible.clear();
    if (occlusion.can_hide()) {
        for (const std::uint32_t tag : tags)
            visible.push_back(occlusion.known(tag).value_or(-1.0F));
    }
    if (prepared != nullptr) input.copies = prepared->copies_of(input.pattern, *gather->shared());
    try {
        input.visible = visible;
        stats.kernel_launches += gather->prepare(input);
    } catch (const ClError&) {
        gather.reset();
        return false;
    }
    for (std::size_t i = 0; i < instances.size(); ++i) {
        if (!is_gathered(input.pattern, instances[i], visible.empty() ? 1.0F : visible[i])) continue;
        instances[i].skirt_rect = {};
        instances[i].tail_rect = {};
        ++stats.lights_gathered;
    }
    if (!visible.empty()) leave_unknown(input.pattern, input.reach.cell_px, most_unknown_px, stats);
    light_buffer.upload(instances);
    return true;
}

// All or none: of a few that come into view the rectangles cost little; of a thousand, after a cut, the next frame's gather
// is there before a software rasteriser has drawn the half of them.
void ViewRenderer::Impl::leave_unknown(const Pattern& pattern, int cell_px, double most_px,
                                       RenderStats& stats) {
    const auto waits = [&](std::size_t i) {
        return visible[i] < 0 && is_gathered(pattern, instances[i], 1.0F);
    };
    double needed_px = 0;
    for (std::size_t i = 0; i < instances.size(); ++i) {
        if (!waits(i)) continue;
        needed_px += area_px(instances[i].skirt_rect) + area_px(instances[i].tail_rect) / (cell_px * cell_px);
    }
    if (needed_px <= most_px) return;
    for (std::size_t i = 0; i < instances.size(); ++i) {
        if (!waits(i)) continue;
        instances[i].skirt_rect = {};
        instances[i].tail_rect = {};
        ++stats.lights_late;
    }
}

// Whether it is cheaper to draw the lights on grids than as rectangles.
bool ViewRenderer::Impl::grids_pay(const ScreenGeometry& g, const Pattern& pattern, int cell_px) const {
    double covered_px = 0;
    for (const LightInstance& light : instances)
        if (GlGrids::takes(pattern, light))
            covered_px += area_px(light.skirt_rect) + area_px(light.tail_rect) / (cell_px * cell_px);
    return covered_px > grids_from_pictures * g.width_px * g.height_px;
}

// Takes skirts and tails of what the grids take off the instances, before these are uploaded.
void ViewRenderer::Impl::leave_to_grids(const AccumulationInput& input) {
    AccumulationInput taken = input;
    visible.clear();
    // What hides them is drawn, and fetched where they are.
    if (occlusion.can_hide()) visible.assign(instances.size(), -1.0F);
    taken.visible = visible;
    if (prepared != nullptr) taken.grid_texels = prepared->grid_texels_of(input.pattern);
    on_grids = grids.prepare(taken);
    if (!on_grids) return;
    for (LightInstance& light : instances) {
        if (!GlGrids::takes(input.pattern, light)) continue;
        light.skirt_rect = {};
        light.tail_rect = {};
    }
}

}  // namespace seaglare::glare
