// Device memory by what it is for. Plain data.
#pragma once

namespace seaglare::glare {

// Bytes. GL objects of one view and OpenCL objects of one context; drivers may round up what they are asked for.
struct DeviceMemory {
    double hdr = 0;             // the sum of all lights at full resolution
    double coarse_grid = 0;     // their far tails
    double background = 0;      // the copy of the host's pixels
    double occlusion = 0;       // visibility of lights, a copy of the host's depth where one is needed
    double lights = 0;          // the lights of a draw call
    double pattern_layers = 0;  // the pattern as a texture
    double accumulation = 0;    // of other ways to add lights up than drawing: buffers, copies of patterns
    double pattern_core = 0;    // pupil plane and energy table that are made every frame
    double pattern_wide_field = 0;  // the same for wide angles, and tables of several instants
    double pattern_screen = 0;      // the pattern on the grids of screens

    double total() const {
        return hdr + coarse_grid + background + occlusion + lights + pattern_layers + accumulation +
               pattern_core + pattern_wide_field + pattern_screen;
    }
    // The parts that belong to the context, beside those of this view.
    void take_pattern(const DeviceMemory& context) {
        accumulation += context.accumulation;
        pattern_core = context.pattern_core;
        pattern_wide_field = context.pattern_wide_field;
        pattern_screen = context.pattern_screen;
    }
};

}  // namespace seaglare::glare
