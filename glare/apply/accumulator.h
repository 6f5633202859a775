// What every way of adding lights to the HDR sum is given, and what it says it did. All ways lead to the same picture within
// the plan's thresholds; tests/gl/accumulate_test.cpp holds them to that.
//
// GlBillboards draws rectangles and can add any light. GlGrids in GL and ClGather in OpenCL add most lights (is_gathered()), without
// their cores; what they leave, the billboards add to their result.
//
// No way holds the sum of a whole picture: it is made, used and forgotten in bands of rows. What bands share (lists of lights,
// coarse grids) is prepared once a frame; then every band is summed when it is its turn, and may be summed again.
#pragma once

#include <functional>
#include <span>

#include "glare/apply/light_instance.h"
#include "glare/apply/luminance_floor.h"
#include "glare/apply/screen_geometry.h"
#include "glare/psf/pattern.h"

namespace seaglare::glare {

struct GatherPattern;
struct GridTexels;

struct AccumulationInput {
    const ScreenGeometry& geometry;
    const Pattern& pattern;
    ReachSettings reach;
    std::span<const LightInstance> lights;
    // How much of each light is seen, 0 ... 1; negative where it is not known on the CPU. None where nothing can hide them.
    std::span<const float> visible;
    // What a pixel may lose of the lights' structure where only the mean over the azimuth is left of it. Without one,
    // everywhere what one light may lose, reach.threshold_cd_m2.
    CodeBudget structure = {};
    // The pattern as the gather reads it, where somebody has made that already: of another pattern, or null, it makes its own.
    const GatherPattern* copies = nullptr;
    // The pattern as grids in GL read it: of this pattern, or null, and it is made when it is needed.
    const GridTexels* grid_texels = nullptr;
};

// Rows of the picture, from the bottom up.
struct RowRange {
    int first = 0;
    int count = 0;
    int end() const { return first + count; }
};
// Bands begin at multiples of this and have so many rows at most; the last may have fewer.
inline constexpr int band_rows = 64;

// Takes a band of the sum: rgbv has count x width x 4 floats, and is gone when it returns.
using TakeRows = std::function<void(RowRange band, std::span<const float> rgbv)>;

}  // namespace seaglare::glare
