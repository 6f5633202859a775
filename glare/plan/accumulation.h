// How the lights of a frame are added up: what the plan decides and glare/apply carries out. Plain data.
#pragma once

#include <cstdint>

namespace seaglare::glare {

// The ways to add lights up. All lead to the same picture, within the plan's error budget.
enum class Accumulation : std::uint8_t {
    gl_billboards,  // one cropped rectangle a light, drawn in GL
    cl_tiles,       // OpenCL: each tile of the picture gathers the lights that reach it
};

struct AccumulationPlan {
    Accumulation method = Accumulation::gl_billboards;
    // Omissions of many lights add up in a pixel; both are one light's share, in cd/m2. 0: nothing is left out.
    double skirt_threshold_cd_m2 = 0;  // below it a light's skirt is left to the smooth tail
    double tail_threshold_cd_m2 = 0;   // below it its tail ends
    // What the outskirts of all lights together may lose at a pixel, 8-bit codes: a gather leaves out the structure of the
    // faintest there. 0: of each light no more than the skirts' threshold.
    double structure_codes = 0;
    // Edge of the coarse grid's cells that carry the tails, px; 1: a cell for every pixel; 0: no tail is drawn.
    int tail_cell_px = 8;
    // Beside a gather: pixels of rectangles, a cell for one, that may be drawn in GL for lights of which it is not known yet
    // how much of them is hidden. Where they would need more, all of them show their cores alone until it is known, a frame
    // or two later.
    double most_unknown_px = 1e12;
    // How far each light's apparent disc counts in its skirt, 0 ... 1: 1 unless a time budget drops layers.
    double disc_scale = 1;
};

}  // namespace seaglare::glare
