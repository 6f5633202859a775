// Measures on the device itself what work costs: a few pictures of 128 x 64 px are drawn to a target of its own and waited
// for. For the time when a view is made, never for a frame.
#pragma once

#include "glare/apply/view_renderer.h"
#include "glare/device/gl.h"
#include "glare/plan/device_costs.h"

namespace seaglare::glare {

// GL state is the caller's to save; what they change is in glare/device/gl_touched_state.h. They make no
// GL error of their own, and leave the renderer untimed and otherwise as if it had drawn nothing. Throw as ViewRenderer::render.

// Draws a picture of each kind, because drivers compile at the first draw: no frame is to wait for that.
void draw_each_kind_once(const Gl& gl, ViewRenderer& renderer, const Pattern& pattern);

// What was compiled before is timed, twice where the first time is not what the usual costs say, for `at_most_ms` altogether
// and the picture under way, and waits for the GPU: where that is not enough for all, nothing counts as measured.
ProbeTimes probe_costs(const Gl& gl, ViewRenderer& renderer, const Pattern& pattern, double at_most_ms);

}  // namespace seaglare::glare
