// The sum of a frame's lights: what all of it shares, then band by band, also to be read.
#include <string>

#include "glare/apply/view_renderer_impl.h"

namespace seaglare::glare {

namespace {

bool reaches_anything(std::span<const LightInstance> lights, RectPx LightInstance::*rect) {
    return std::any_of(lights.begin(), lights.end(),
                       [rect](const LightInstance& light) { return area_px(light.*rect) > 0; });
}

}  // namespace

// Before any band: the far tails of all lights. And which lights each band is drawn from.
void ViewRenderer::Impl::draw_grid(const ReachSettings& reach, RenderStats& stats) {
    const bool in_bands = reach.tails && sum.cell_px() == 0;
    const std::span<const LightInstance> none;
    tail_lights.find(in_bands ? std::span<const LightInstance>(instances) : none, &LightInstance::tail_rect,
                     height_px);
    skirt_lights.find(instances, &LightInstance::skirt_rect, height_px);
    core_lights.find(instances, &LightInstance::core_rect, height_px);
    if (on_grids) stats.draw_calls += grids.draw_grids(billboards.pattern());
    if (!reach.tails || in_bands || !reaches_anything(instances, &LightInstance::tail_rect)) return;
    sum.light_grid();
    draw_lights({0, instances.size()}, stats, [this](const LightRun& lights) {
        return billboards.draw_tails(sum.grid(), sum.cell_px(), lights);
    });
}

template <typename Draw>
void ViewRenderer::Impl::draw_lights(LightRange range, RenderStats& stats, Draw draw) {
    for (std::size_t i = range.first; i < range.end;) {
        const std::size_t chunk = i / lights_per_chunk;
        const std::size_t first = chunk * lights_per_chunk;
        const std::size_t end = std::min(range.end, first + lights_per_chunk);
        light_buffer.bind(chunk);
        stats.draw_calls += draw(
            LightRun{static_cast<int>(i - first), static_cast<int>(end - i), occlusion.first_texel(first)});
        i = end;
    }
}

void ViewRenderer::Impl::draw_band(RowRange band, RenderStats& stats) {
    const FloatBuffer& to = sum.band();
    if (on_grids)
        sum.tiles().light_all();
    else
        sum.tiles().light(instances, sum.lit_cell_px());
    if (on_grids) stats.draw_calls += grids.draw_band(to, band);
    draw_lights(tail_lights.of(band), stats,
                [&](const LightRun& lights) { return billboards.draw_tails(to, 0, lights); });
    draw_lights(skirt_lights.of(band), stats,
                [&](const LightRun& lights) { return billboards.draw_skirts(to, lights); });
    draw_lights(core_lights.of(band), stats,
                [&](const LightRun& lights) { return billboards.draw_cores(to, lights); });
}

void ViewRenderer::Impl::for_each_band(RowRange rows, RenderStats& stats,
                                       const std::function<void(RowRange)>& use) {
    if (gathers && sharing.shares) {
        const double bytes = sum.band_bytes();
        if (shared_bytes != bytes)
            gather->forget_textures();  // their names may be those of other textures now
        shared_bytes = bytes;
        const auto take = [&](RowRange band) {
            sum.given(band);
            draw_band(band, stats);
            use(band);
        };
        stats.kernel_launches +=
            gather->sum_into(rows, {sum.texture_in_turn(1), sum.texture_in_turn(2)}, std::ref(take));
        return;
    }
    if (gathers) {
        const auto take = [&](RowRange band, std::span<const float> rgbv) {
            sum.fill(band, rgbv);
            draw_band(band, stats);
            use(band);
            // While the next band is waited for, GL works on this one: and its time is not that of the wait.
            gl.Flush();
        };
        stats.kernel_launches += gather->sum(rows, std::ref(take));
        return;
    }
    for (int first = rows.first; first < rows.end(); first += band_rows) {
        const RowRange band{first, std::min(band_rows, rows.end() - first)};
        sum.empty(band);
        draw_band(band, stats);
        use(band);
    }
}

// No picture is kept: the bands are made once more, of the lights and the pattern that GL and OpenCL still hold.
void ViewRenderer::Impl::read_hdr(std::span<float> rgba) {
    bind_own_objects();
    occlusion.bind();
    const auto row_floats = static_cast<std::size_t>(width_px) * 4;
    const auto rows_of = [&](RowRange band) {
        return rgba.subspan(static_cast<std::size_t>(band.first) * row_floats,
                            static_cast<std::size_t>(band.count) * row_floats);
    };
    RenderStats not_counted;
    try {
        for_each_band({0, height_px}, not_counted, [&](RowRange band) { sum.band().read(rows_of(band)); });
    } catch (const ClError& error) {
        throw GlError(std::string("reading the glare: ") + error.what());
    }
    if (sum.cell_px() == 0) return;
    const FloatBuffer& grid = sum.grid();
    std::vector<float> cells(static_cast<std::size_t>(grid.width_px()) *
                             static_cast<std::size_t>(grid.height_px()) * 4);
    grid.read(cells);
    add_coarse_grid(cells, grid.width_px(), sum.cell_px(), rgba, width_px);
}

}  // namespace seaglare::glare
