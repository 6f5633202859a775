// What the tables of the glare pattern have in common: its errors against the reference beside what it costs.
#pragma once

#include <string>
#include <vector>

#include "glare/psf/pattern_sources.h"
#include "glare/reference/comparison.h"
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
// A pattern whose window ends where the reference does.
Subject limited(Subject subject);
reference::ReferenceRequest reference_request(const Subject& subject);

// Rounded to a half float: 11 bits of mantissa, 6e-8 the smallest step; beyond 65504 clamped.
float to_half(float value);

// Milliseconds of one pattern. `work` is the processor's time of all threads where the device is the processor, and the time
// on the clock where it is another: on a machine that does something else besides, the clock says little.
struct Cost {
    double wall_ms = 0;
    double work_ms = 0;
};
// Of a pattern as a frame asks for it, eye and all: the median of a few, after one that nobody counts. Each asks for another
// pupil by a millionth, so that nothing made before serves.
Cost cost_of(glare::PatternSource& source, const glare::PatternRequest& request);
// The mean of `frames` frames at 60 Hz from `from_s` on, as they follow each other, each with another pupil by a millionth of
// the one it swings about: of patterns that work ahead.
Cost cost_of_frames(glare::PatternSource& source, glare::PatternRequest request, double from_s, int frames);

// `first` and then the errors and the cost, this over `unit_ms` too.
Table error_table(std::vector<std::string> first);
void add_error(Table::Row& row, const reference::PatternError& error);
void add_error(Table::Row& row, const reference::PatternError& error, const Cost& cost, double unit_ms);

}  // namespace seaglare::report
