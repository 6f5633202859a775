// The naive way of 2012, kept as the yardstick: one textured square of 512 x 512 pixels per light, whatever its brightness,
// blended additively into a floating-point target.
#pragma once

#include <span>
#include <vector>

#include "glare/frame.h"
#include "glare/reference/frame.h"

namespace seaglare::report {

struct BillboardRun {
    std::vector<double> wall_ms;
    std::vector<double> cpu_ms;  // of the process
    std::vector<float> hdr;      // RGBA as seaglare.hdr/1 has it; lowest row first
};

// Draws the same lights with the same pattern at the same angular size: a square holds the pattern's core, skirt and tail
// out to 256 pixels. `half`: target and texture of 16 bit floats, else of 32. `frames` are timed after one that is not;
// glFinish() before and after. Needs a GL context; leaves its own framebuffer bound and blending on. Throws
// host::GlFailure.
BillboardRun draw_billboards(const reference::FrameScreen& screen, const reference::GlareShape& shape,
                             std::span<const glare::PointSource> lights, bool half, int frames);

}  // namespace seaglare::report
