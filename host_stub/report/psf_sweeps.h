// Production's pattern beside the reference and the yardsticks. Everything here writes tables and plots onto the page, and
// its rows as they are measured.
#pragma once

#include <string>

#include "glare/reference/frame_shape.h"
#include "host_stub/report/progress.h"
#include "host_stub/report/psf_errors.h"

namespace seaglare::report {

struct Study {
    Page& page;
    Progress& progress;
    reference::PatternMaker reference;  // keeps what it made: several parts ask for the same
    double unit_ms = 0;                 // fftw_512_ms()
    std::string part;                   // of the report, for the progress line

    void show(const std::string& what, double fraction = -1) const { progress.show(part + what, fraction); }
};

// The instant at which eyes in motion are looked at: between those that wide fields of 1, 2, 4 and 8 s are made for, half,
// a quarter, five and thirteen sixteenths or so of the way.
inline constexpr double instant_s = 6.5;

// One knob turned at a time, each setting beside its error against the reference and its time.
void sweep_knobs(const Study& study, const Subject& subject, const reference::ReferencePattern& truth);
// Every eye that ships (config/eye), each against its own reference, with each knob turned; and every lamp's colour.
void compare_presets(const Study& study, const Subject& subject);
// Error against run time of the physical pattern, by one transform and by two scales, while the eye moves.
void sweep_frontier(const Study& study, const Subject& subject);
// Error against run time at the 2012 thesis's own scale, and its algorithm.
void sweep_yardstick(const Study& study, const Subject& subject);

}  // namespace seaglare::report
