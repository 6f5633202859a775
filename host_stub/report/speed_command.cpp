// seaglare-report speed: what frames take, pass by pass, beside their error; and how time grows with the lights, beside the
// naive way of 2012.
#include <algorithm>
#include <iostream>

#include "host_stub/headless.h"
#include "host_stub/report/commands.h"
#include "host_stub/report/frame_knobs.h"
#include "host_stub/report/frame_points.h"
#include "host_stub/report/frame_subject.h"
#include "host_stub/report/light_growth.h"
#include "host_stub/report/report_page.h"

namespace seaglare::report {

namespace {

constexpr double growth_takes = 0.5;  // of the whole

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
        LightGrowth growth(page, progress, plugin, options);
        for (std::size_t i = 0; i < counts.size(); ++i) {
            progress.part(growth_takes * static_cast<double>(i) / static_cast<double>(counts.size()),
                          growth_takes * static_cast<double>(i + 1) / static_cast<double>(counts.size()));
            growth.measure(crowd, counts[i]);
        }
        growth.write();
    }
    Table passes(
        {"scene",      "against",       "knob",           "value",         "max codes",    "mean codes",
         "ms",         "ms lower",      "ms upper",       "cpu ms",        "cpu lower",    "cpu upper",
         "evaluate",   "pattern",       "upload",         "occlusion",     "accumulate",   "composite",
         "gpu upload", "gpu occlusion", "gpu accumulate", "gpu composite", "lights drawn", "draw calls"});
    page.heading("Scenes and knobs");
    const double begun = counts.empty() ? 0 : growth_takes;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        const double share = (1 - begun) / static_cast<double>(scenes.size());
        progress.part(begun + share * static_cast<double>(i), begun + share * static_cast<double>(i + 1));
        FrameSubject subject(plugin, scenes[i], options);
        measure_scene(page, progress, subject, options, passes);
    }
    page.table("speed", "Every scene under every knob, pass by pass, ms", passes);
    page.finish();
    std::cout << (page.folder() / "index.html").string() << "\n";
    return 0;
}

}  // namespace seaglare::report
