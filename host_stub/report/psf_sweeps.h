// Production's pattern with one knob turned at a time, each beside its error against the reference and its time.
#pragma once

#include <memory>

#include "glare/psf/pattern_sources.h"
#include "glare/reference/comparison.h"
#include "host_stub/report/progress.h"
#include "host_stub/report/report_page.h"

namespace seaglare::report {

struct Subject {
    glare::EyeModel eye;
    glare::PatternSettings settings;
    double pupil_mm = 6;
    double time_s = 0;
    double pitch = 1 / 869.1;
    std::uint64_t seed = 1;
    int radius = 64;  // of the reference
    int step_nm = 5;
};

// OpenCL where it is, else the plain source.
std::unique_ptr<glare::PatternSource> source_of(const Subject& subject);
glare::PatternRequest request_of(const Subject& subject);

// Milliseconds of a pattern as a frame asks for it, eye and all: the median of a few, after one that nobody counts. Each
// asks for another pupil by a millionth, so that nothing made before serves.
double time_of(glare::PatternSource& source, const glare::PatternRequest& request);

// Everything below writes tables and plots onto the page. `unit_ms` is fftw_512_ms().
void sweep_knobs(Page& page, Progress& progress, const Subject& subject,
                 const reference::ReferencePattern& truth, double unit_ms);
void compare_presets(Page& page, Progress& progress, const Subject& subject);
void sweep_yardstick(Page& page, Progress& progress, const Subject& subject, double unit_ms);

}  // namespace seaglare::report
