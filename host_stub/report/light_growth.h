// How time and error grow with the number of lights, beside the naive way of 2012 in the same run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "host_stub/report/frame_knobs.h"
#include "host_stub/report/frame_points.h"
#include "host_stub/report/frame_subject.h"
#include "host_stub/report/report_page.h"

namespace seaglare::report {

struct GrowthTruth;

class LightGrowth {
  public:
    LightGrowth(Page& page, Progress& progress, const host::Plugin& plugin, const FrameOptions& options);

    // The crowd's scene with so many lights: every way, the yardstick first. Rows are in the page's folder as they come.
    void measure(const std::filesystem::path& scene, std::uint32_t count);
    // Tables, plots and what they come to.
    void write();

  private:
    struct Measured {
        std::uint32_t lights = 0;
        double drawing_ms = 0, frame_ms = 0, cpu_ms = 0, times_faster = 0, max_codes = 0;
    };
    struct Way {
        std::string name;
        std::vector<Measured> at;
    };
    struct Row {
        std::string way, remark;
        Spread frame, cpu, drawing;
        double accumulation_ms = 0;  // 0: it is the frame
        FrameError error;
    };

    void measure_yardstick(std::uint32_t count, FrameSubject& subject, const GrowthTruth& truth);
    void measure_way(std::uint32_t count, FrameSubject& subject, const Knob& way, const GrowthTruth& truth);
    // Processor time of a frame with so many lights, by what fewer took: the work of a light is its own. NaN where none were
    // measured.
    double predicted_cpu_ms(const std::string& way, std::uint32_t count) const;
    void add(std::uint32_t count, const Row& row);
    void leave_out(std::uint32_t count, const std::string& way, const std::string& why);
    std::string summary() const;

    Page& page_;
    Progress& progress_;
    const host::Plugin& plugin_;
    const FrameOptions& options_;
    Table table_;
    std::vector<Way> ways_;
    Spread yardstick_wall_, yardstick_cpu_;
};

}  // namespace seaglare::report
