// What the lights of a frame add up to: luminance and scotopic luminance at full resolution, and their far tails on a grid
// of cells. The picture is the sum of both, the grid read bilinearly (add_coarse_grid).
#pragma once

#include "glare/apply/hdr_buffers.h"

namespace seaglare::glare {

struct HdrSum {
    explicit HdrSum(const Gl& gl) : full(gl), coarse(gl) {}

    // Throws GlError as FloatBuffer::resize. `cell` 0: without the grid; otherwise 2 at least.
    // Of the full resolution only `rows` from `first_row` on are needed.
    void resize(int width_px, int height_px, int first_row, int rows, int cell) {
        full.resize(GL_RGBA32F, width_px, height_px, first_row, rows, "the HDR buffer");
        if (cell > 0) {
            coarse.resize(GL_RGBA32F, (2 * width_px - 1) / (2 * cell) + 2,
                          (2 * height_px - 1) / (2 * cell) + 2, "the coarse HDR buffer");
        }
        cell_px = cell;
    }
    // Leaves one of them bound for drawing.
    void clear() const {
        full.bind_for_drawing();
        full.clear();
        if (cell_px > 0) clear_coarse();
    }
    void clear_coarse() const {
        coarse.bind_for_drawing();
        coarse.clear();
    }
    double memory_bytes() const { return full.memory_bytes() + coarse.memory_bytes(); }
    void forget() {
        full.forget();
        coarse.forget();
    }

    FloatBuffer full;
    FloatBuffer coarse;
    int cell_px = 0;  // of the grid in the last frame; 0: there was none
};

}  // namespace seaglare::glare
