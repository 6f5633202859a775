// What every way of adding lights to the HDR sum is given, and what it says it did. All ways lead to the same picture within
// the plan's thresholds; tests/gl/accumulate_test.cpp holds them to that.
//
// GlBillboards draws rectangles and can add any light. ClGather sums most lights in OpenCL (gathers()), without their cores;
// what it leaves, the billboards add to its result.
#pragma once

#include <span>

#include "glare/apply/light_instance.h"
#include "glare/apply/screen_geometry.h"
#include "glare/psf/pattern.h"

namespace seaglare::glare {

struct AccumulationInput {
    const ScreenGeometry& geometry;
    const Pattern& pattern;
    ReachSettings reach;
    std::span<const LightInstance> lights;
    // How much of each light is seen, 0 ... 1; negative where it is not known on the CPU. None where nothing can hide them.
    std::span<const float> visible;
};

}  // namespace seaglare::glare
