// The uniforms of shaders/geometry.glsl and shaders/cie_tail.glsl, which several programs share.
#pragma once

#include "glare/apply/screen_geometry.h"
#include "glare/device/gl_program.h"
#include "glare/psf/pattern.h"

namespace seaglare::glare {

// Of the program in use. `node_pitch` is the pattern's, direction cosine per node.
void set_geometry(const GlProgram& program, const ScreenGeometry& geometry, double node_pitch);
void set_tail(const GlProgram& program, const Pattern& pattern);

}  // namespace seaglare::glare
