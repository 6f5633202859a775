// seaglare-report speed: what frames take, pass by pass, beside their error; and how time grows with the lights, beside the
// naive way of 2012.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <numeric>

#include "host_stub/headless.h"
#include "host_stub/report/billboard_yardstick.h"
#include "host_stub/report/commands.h"
#include "host_stub/report/frame_knobs.h"
#include "host_stub/report/frame_points.h"
#include "host_stub/report/frame_subject.h"
#include "host_stub/report/report_page.h"

namespace seaglare::report {

namespace {

double median_of(const FrameRun& run, double seaglare_stats::*member) {
    std::vector<double> values;
    for (const seaglare_stats& stats : run.stats)
        values.push_back(stats.*member);
    return spread_of(values).median;
}

// What is left of a frame without finding its lights and without making its pattern: uploads, occlusion, accumulation, tone
// mapping, GL work included.
Spread drawing_of(const FrameRun& run) {
    std::vector<double> values;
    for (std::size_t i = 0; i < run.wall_ms.size(); ++i)
        values.push_back(run.wall_ms[i] - run.stats[i].evaluate_ms - run.stats[i].pattern_ms);
    return spread_of(values);
}

constexpr std::uint32_t many_lights = 1000;

// Every knob against what the eye would have; else those that leave the pattern alone, against its sum with nothing left
// out, which is quick to make.
struct Expected {
    std::vector<reference::Rgbv> frame;
    std::vector<double> codes;
    std::string what;
    bool is_sum = true;
};
Expected expected_of(FrameSubject& subject, Progress& progress, bool full) {
    Expected expected;
    try {
        if (full) expected = {subject.truth(progress), {}, "the reference", false};
    } catch (const std::invalid_argument&) {
        // An eye that the reference does not know: the sum will do.
    }
    if (expected.is_sum) expected = {subject.same_sum({}, progress), {}, "the sum of its pattern", true};
    expected.codes = subject.codes_of(expected.frame);
    return expected;
}

std::vector<Knob> knobs_for(const FrameOptions& options, bool sum_only) {
    std::vector<Knob> knobs = frame_knobs(range_of(options));
    if (sum_only) std::erase_if(knobs, [](const Knob& knob) { return !knob.same_pattern; });
    return knobs;
}

void measure_scene(Page& page, Progress& progress, FrameSubject& subject, const FrameOptions& options,
                   Table& passes) {
    const Expected expected = expected_of(subject, progress, options.full);
    const std::vector<Knob> knobs = knobs_for(options, expected.is_sum);
    std::vector<Point> points;
    for (std::size_t i = 0; i < knobs.size(); ++i) {
        const Knob& knob = knobs[i];
        progress.show(subject.name() + ": " + knob.name + " " + knob.value,
                      static_cast<double>(i) / static_cast<double>(knobs.size()));
        const FrameRun run = subject.run(knob.changes, 3, options.quick ? 3 : 9, false,
                                         knob.opencl ? 0U : std::uint32_t{SEAGLARE_CREATE_NO_OPENCL});
        const std::vector<reference::Rgbv> made = to_double(run.hdr);
        const FrameError error =
            compare_frames(subject, made, subject.codes_of(made), expected.frame, expected.codes);
        const FrameTimes times = times_of(run);
        passes.add() << subject.name() << expected.what << knob.name << knob.value << error.max_codes
                     << error.mean_codes << times.wall.median << times.wall.lower << times.wall.upper
                     << times.cpu.median << times.cpu.lower << times.cpu.upper
                     << median_of(run, &seaglare_stats::evaluate_ms)
                     << median_of(run, &seaglare_stats::pattern_ms)
                     << median_of(run, &seaglare_stats::upload_ms)
                     << median_of(run, &seaglare_stats::occlusion_ms)
                     << median_of(run, &seaglare_stats::accumulate_ms)
                     << median_of(run, &seaglare_stats::composite_ms)
                     << median_of(run, &seaglare_stats::gpu_upload_ms)
                     << median_of(run, &seaglare_stats::gpu_occlusion_ms)
                     << median_of(run, &seaglare_stats::gpu_accumulate_ms)
                     << median_of(run, &seaglare_stats::gpu_composite_ms)
                     << static_cast<int>(run.stats.back().lights_drawn)
                     << static_cast<int>(run.stats.back().draw_calls);
        passes.write_csv(page.folder() / "speed.csv");
        points.push_back({knob.name + " " + knob.value, times.cpu.median, error.mean_codes});
    }
    Plot plot;
    plot.name = "speed_" + subject.name();
    plot.title = subject.name() + ": error against processor time";
    plot.x_label = "ms of processor time of a frame, all threads";
    plot.y_label = "mean difference to " + expected.what + ", 8-bit codes";
    plot_points(page, plot, points, "cpu ms", "mean codes");
}

struct Way {
    std::string name;
    std::vector<double> lights, wall, codes;
};

class Growth {
  public:
    Growth(Page& page, Progress& progress, const host::Plugin& plugin, const FrameOptions& options)
        : page_(page), progress_(progress), plugin_(plugin), options_(options) {}

    void measure(const std::filesystem::path& scene, std::uint32_t count) {
        FrameSubject subject(plugin_, scene, options_, count);
        const reference::GlareShape shape = subject.same_shape({});
        // The brute sum grows with the lights: of ten thousand every eleventh row is made, and the errors are of those.
        const int row_step = count > many_lights ? static_cast<int>(count / many_lights) | 1 : 1;
        const std::vector<reference::Rgbv> sum = subject.same_sum({}, progress_, row_step);
        const std::vector<double> codes = subject.codes_of(sum);
        const auto error_of = [&](const std::vector<float>& hdr) {
            const std::vector<reference::Rgbv> made = to_double(hdr);
            return compare_frames(subject, made, subject.codes_of(made), sum, codes, row_step);
        };
        const bool many = count > many_lights;
        const int frames = options_.quick || many ? 3 : 7;
        double yardstick_ms = 0;
        double yardstick_cpu_ms = 0;
        for (const bool half : {false, true}) {
            show(count, "512 x 512 billboards");
            if (half && count >= many_lights && !options_.full) continue;
            const BillboardRun run = draw_billboards(subject.screen(), shape, subject.lights(), half,
                                                     count >= many_lights ? 1 : std::min(frames, 3));
            const Spread wall = spread_of(run.wall_ms);
            const Spread cpu = spread_of(run.cpu_ms);
            if (!half) {
                yardstick_ms = wall.median;
                yardstick_cpu_ms = cpu.median;
            }
            add(count, half ? "512² billboards, RGBA16F" : "512² billboards, RGBA32F", wall, cpu, wall,
                cpu.median, 0, yardstick_ms, yardstick_cpu_ms, error_of(run.hdr));
        }
        std::vector<Knob> knobs = {{"", "the plan's choice", {}, true, true}};
        for (Knob& knob : accumulation_knobs())
            knobs.push_back(std::move(knob));
        for (const Knob& knob : knobs) {
            if (is_slow(knob) && many && !options_.full) continue;
            show(count, knob.value);
            const bool once = is_slow(knob) && count >= many_lights;
            const FrameRun run = subject.run(knob.changes, once ? 1 : 3, once ? 1 : frames, false);
            const FrameTimes times = times_of(run);
            const Spread drawing = drawing_of(run);
            const double accumulate = std::max(median_of(run, &seaglare_stats::accumulate_ms),
                                               median_of(run, &seaglare_stats::gpu_accumulate_ms));
            add(count, knob.value, times.wall, times.cpu, drawing, times.cpu.median, accumulate, yardstick_ms,
                yardstick_cpu_ms, error_of(run.hdr));
        }
    }

    void write() {
        page_.heading("How time grows with the lights");
        page_.paragraph(
            "The scene of the 2012 master's thesis's figure 6.19, its crowd from 100 to 10 000 lights "
            "spread over 1280 x 720 pixels. The yardstick draws one square of 512 x 512 pixels per light, "
            "the same pattern at the same angular size, in the same run, to pixels as if they were all on "
            "the "
            "picture's axis, as was done then: its energy is off by the cosines towards the corners, and "
            "glare "
            "ends at its squares' edges. From 1000 lights on it draws one frame. Errors are of the glare "
            "against the "
            "same pattern, all lights summed in double precision with nothing left out; beyond 1000 lights "
            "on some rows of the picture "
            "only. Drawing: a frame "
            "less finding its lights and making its pattern, so uploads, occlusion and tone mapping are in "
            "it, which the yardstick does not do; accumulation: the pass alone, on the clock where it took "
            "longer, the CPU's or the GPU's.");
        page_.table("lights", "Lights, time, error", table_);
        std::vector<Curve> times;
        std::vector<Curve> errors;
        for (std::size_t i = 0; i < ways_.size(); ++i) {
            Table one({"lights", "ms", "max codes"});
            for (std::size_t k = 0; k < ways_[i].lights.size(); ++k)
                one.add() << ways_[i].lights[k] << ways_[i].wall[k] << ways_[i].codes[k];
            const std::string file = "lights_" + std::to_string(i) + ".csv";
            one.write_csv(page_.folder() / file);
            times.push_back({file, 1, 2, ways_[i].name, "linespoints pt 7", 0});
            errors.push_back({file, 1, 3, ways_[i].name, "linespoints pt 7", 0});
        }
        page_.plot({"lights_time", "Drawing: time against lights", "lights", "ms", times, true, true, ""});
        page_.plot({"lights_error", "Error against lights", "lights", "largest difference, 8-bit codes",
                    errors, true, true, ""});
    }

  private:
    // Rectangles of ten thousand lights take a minute a frame where the CPU draws them.
    static bool is_slow(const Knob& knob) { return knob.value == "GL billboards"; }
    void show(std::uint32_t count, const std::string& what) {
        progress_.show(std::to_string(count) + " lights: " + what);
    }
    void add(std::uint32_t count, const std::string& name, const Spread& wall, const Spread& cpu,
             const Spread& drawing, double cpu_ms, double accumulate, double yardstick_ms,
             double yardstick_cpu_ms, const FrameError& error) {
        table_.add() << static_cast<int>(count) << name << wall.median << wall.lower << wall.upper
                     << cpu.median << drawing.median << drawing.lower << drawing.upper << accumulate
                     << yardstick_ms / drawing.median
                     << (accumulate > 0 ? yardstick_ms / accumulate : std::nan(""))
                     << yardstick_cpu_ms / cpu_ms << error.max_codes << error.p99_codes << error.mean_codes
                     << error.relative_l2 << error.energy_ratio;
        table_.write_csv(page_.folder() / "lights.csv");
        auto way = std::find_if(ways_.begin(), ways_.end(), [&](const Way& w) { return w.name == name; });
        if (way == ways_.end()) way = ways_.insert(ways_.end(), Way{name, {}, {}, {}});
        way->lights.push_back(count);
        way->wall.push_back(drawing.median);
        way->codes.push_back(error.max_codes);
    }

    Page& page_;
    Progress& progress_;
    const host::Plugin& plugin_;
    const FrameOptions& options_;
    Table table_{{"lights", "way", "frame ms", "frame lower", "frame upper", "frame cpu ms", "drawing ms",
                  "drawing lower", "drawing upper", "accumulation ms", "x drawing", "x accumulation",
                  "x frame cpu", "max codes", "p99 codes", "mean codes", "L2", "energy"}};
    std::vector<Way> ways_;
};

}  // namespace

int speed_command(const FrameOptions& options, const std::vector<std::filesystem::path>& scenes,
                  const std::filesystem::path& crowd, const std::vector<std::uint32_t>& counts) {
    const host::Plugin plugin(options.plugin);
    const host::HeadlessContext gl;
    Progress progress;
    Page page(options.out, "What frames take");
    page.paragraph(
        "Milliseconds of the product's part of a frame, GL work included: medians with quartiles, and the "
        "processor time of all threads, which a busy machine stretches less. Errors are against the frame "
        "reference, as in the report on accuracy. Pass by pass: CPU times from the statistics of the frames, "
        "GPU times from timestamps that came in later. Times on a machine whose GPU and OpenCL device are "
        "its "
        "CPU say nothing about a GPU.");
    if (!counts.empty()) {
        Growth growth(page, progress, plugin, options);
        for (const std::uint32_t count : counts)
            growth.measure(crowd, count);
        growth.write();
    }
    Table passes(
        {"scene",      "against",       "knob",           "value",         "max codes",    "mean codes",
         "ms",         "ms lower",      "ms upper",       "cpu ms",        "cpu lower",    "cpu upper",
         "evaluate",   "pattern",       "upload",         "occlusion",     "accumulate",   "composite",
         "gpu upload", "gpu occlusion", "gpu accumulate", "gpu composite", "lights drawn", "draw calls"});
    page.heading("Scenes and knobs");
    for (const std::filesystem::path& scene : scenes) {
        FrameSubject subject(plugin, scene, options);
        measure_scene(page, progress, subject, options, passes);
    }
    page.table("speed", "Every scene under every knob, pass by pass, ms", passes);
    page.finish();
    std::cout << (page.folder() / "index.html").string() << "\n";
    return 0;
}

}  // namespace seaglare::report
