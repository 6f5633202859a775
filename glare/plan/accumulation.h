// How the lights of a frame are added up: what the plan decides and glare/apply carries out. Plain data.
#pragma once

#include <cstdint>

namespace seaglare::glare {

// The ways to add lights up. All lead to the same picture, within the plan's error budget.
enum class Accumulation : std::uint8_t {
    gl_billboards,  // one cropped rectangle a light, drawn in GL
    cl_tiles,       // OpenCL: each tile of the picture gathers the lights that reach it
    crowd_fft,  // cores and skirts as gl_billboards; the smooth tails of all lights as splats and one convolution
};

struct AccumulationPlan {
    Accumulation method = Accumulation::gl_billboards;
    // Omissions of many lights add up in a pixel; both are one light's share, in cd/m2. 0: nothing is left out.
    double skirt_threshold_cd_m2 = 0;  // below it a light's skirt is left to the smooth tail
    double tail_threshold_cd_m2 = 0;   // below it its tail ends
    // Edge of the coarse grid's cells that carry the tails, px; 1: a cell for every pixel; 0: no tail is drawn.
    int tail_cell_px = 8;
    // How far each light's apparent disc counts in its skirt, 0 ... 1: 1 unless a time budget drops layers.
    double disc_scale = 1;
};

}  // namespace seaglare::glare
