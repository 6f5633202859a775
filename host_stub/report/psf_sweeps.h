// Production's pattern beside the reference and the yardsticks. Everything here writes tables and plots onto the page;
// `unit_ms` is fftw_512_ms().
#pragma once

#include "host_stub/report/progress.h"
#include "host_stub/report/psf_errors.h"

namespace seaglare::report {

// One knob turned at a time, each setting beside its error against the reference and its time.
void sweep_knobs(Page& page, Progress& progress, const Subject& subject,
                 const reference::ReferencePattern& truth, double unit_ms);
// Every eye that ships (config/eye), each against its own reference, with each knob turned; and every lamp's colour.
void compare_presets(Page& page, Progress& progress, const Subject& subject, double unit_ms);
// Error against run time of the physical pattern, by one transform and by two scales, while the eye moves.
void sweep_frontier(Page& page, Progress& progress, const Subject& subject, double unit_ms);
// Error against run time at the 2012 thesis's own scale, and its algorithm.
void sweep_yardstick(Page& page, Progress& progress, const Subject& subject, double unit_ms);

}  // namespace seaglare::report
