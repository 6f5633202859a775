#include "host_stub/report/frame_points.h"

#include <algorithm>

#include "host_stub/timing.h"

namespace seaglare::report {

Spread spread_of(const std::vector<double>& values) {
    return {host::quantile(values, 0.5), host::quantile(values, 0.25), host::quantile(values, 0.75)};
}

FrameTimes times_of(const FrameRun& run) {
    return {spread_of(run.wall_ms), spread_of(run.cpu_ms)};
}

double median_of(const FrameRun& run, double seaglare_stats::*member) {
    std::vector<double> values;
    for (const seaglare_stats& stats : run.stats)
        values.push_back(stats.*member);
    return spread_of(values).median;
}

void write_points(const std::filesystem::path& folder, const std::string& name,
                  const std::vector<Point>& points, const std::string& time, const std::string& error) {
    std::vector<Point> front;
    for (const Point& point : points) {
        const bool beaten = std::any_of(points.begin(), points.end(), [&](const Point& other) {
            return other.time <= point.time && other.error <= point.error &&
                   (other.time < point.time || other.error < point.error);
        });
        if (!beaten) front.push_back(point);
    }
    std::sort(front.begin(), front.end(), [](const Point& a, const Point& b) { return a.time < b.time; });
    const auto write = [&](const std::string& file, const std::vector<Point>& list) {
        Table table({"name", time, error});
        for (const Point& point : list)
            table.add() << point.name << point.time << point.error;
        table.write_csv(folder / file);
    };
    write(name + ".csv", points);
    write(name + "_front.csv", front);
}

void plot_points(Page& page, Plot plot, const std::vector<Point>& points, const std::string& time,
                 const std::string& error) {
    write_points(page.folder(), plot.name, points, time, error);
    plot.curves = {{plot.name + ".csv", 2, 3, "a knob", "points pt 7 ps 0.7 lc rgb '#999999'", 0},
                   {plot.name + "_front.csv", 2, 3, "Pareto front", "linespoints lw 2 pt 6", 1,
                    "left rotate by 35 offset 0.5,0.5"}};
    plot.log_x = plot.log_y = true;
    page.plot(plot);
}

}  // namespace seaglare::report
