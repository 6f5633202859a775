// Times with their spread, and points of error against time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host_stub/report/frame_subject.h"
#include "host_stub/report/report_page.h"

namespace seaglare::report {

struct Spread {
    double median = 0;
    double lower = 0;  // quartiles
    double upper = 0;
};
Spread spread_of(const std::vector<double>& values);

struct FrameTimes {
    Spread wall, cpu;
};
FrameTimes times_of(const FrameRun& run);
// Of one of the statistics, over the frames counted.
double median_of(const FrameRun& run, double seaglare_stats::*member);

struct Point {
    std::string name;
    double time = 0;
    double error = 0;
};
// NAME.csv of all points and NAME_front.csv of those than which none is both faster and better, by time.
void write_points(const std::filesystem::path& folder, const std::string& name,
                  const std::vector<Point>& points, const std::string& time, const std::string& error);
// Writes them and plots error against time with the Pareto front, whose points have their names beside them. `plot` has
// name, title and the two axes' labels.
void plot_points(Page& page, Plot plot, const std::vector<Point>& points, const std::string& time,
                 const std::string& error);

}  // namespace seaglare::report
