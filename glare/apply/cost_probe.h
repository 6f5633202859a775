// Measures on the device itself what work costs: a few pictures of 128 x 64 px are drawn to a target of its own and waited
// for. For the time when a view is made, never for a frame.
#pragma once

#include "glare/apply/view_renderer.h"
#include "glare/device/gl.h"
#include "glare/plan/device_costs.h"

namespace seaglare::glare {

// Draws a picture of each kind once untimed, because drivers compile at the first draw - which the first frame is then
// spared - and times all after that, twice where the first time is not what the usual costs say, for `at_most_ms` altogether
// and the picture under way: where that is not enough for all, nothing counts as measured.
// Waits for the GPU. GL state is the caller's to save; what it changes is in glare/device/gl_touched_state.h. Makes no GL error
// of its own, and leaves the renderer untimed and otherwise as if it had drawn nothing. Throws as ViewRenderer::render.
ProbeTimes probe_costs(const Gl& gl, ViewRenderer& renderer, const Pattern& pattern, double at_most_ms);

}  // namespace seaglare::glare
