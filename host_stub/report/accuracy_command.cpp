// seaglare-report accuracy: every scene under every knob, beside the frame reference.
#include <algorithm>
#include <cmath>
#include <iostream>

#include "host_stub/headless.h"
#include "host_stub/image_files.h"
#include "host_stub/report/commands.h"
#include "host_stub/report/frame_knobs.h"
#include "host_stub/report/frame_points.h"
#include "host_stub/report/frame_subject.h"
#include "host_stub/report/report_page.h"

namespace seaglare::report {

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();
constexpr int difference_gain = 16;

struct Compared {
    Knob knob;
    FrameError truth{no_value, no_value, no_value, no_value, no_value};
    FrameError same{no_value, no_value, no_value, no_value, no_value};
    PictureError shown;
    FrameTimes times;
    seaglare_stats stats{};
};

struct References {
    std::vector<reference::Rgbv> truth;
    std::vector<double> truth_codes;
    std::vector<std::uint8_t> truth_picture;
    std::vector<reference::Rgbv> same;
    std::vector<double> same_codes;
    std::vector<std::uint8_t> same_picture;
};

// Those of the eye stay empty, and the page says why, where the reference does not know the eye.
References make_references(Page& page, FrameSubject& subject, Progress& progress) {
    References references;
    references.same = subject.same_sum({}, progress);
    references.same_codes = subject.codes_of(references.same);
    references.same_picture = subject.picture_of(references.same);
    try {
        references.truth = subject.truth(progress);
        references.truth_codes = subject.codes_of(references.truth);
        references.truth_picture = subject.picture_of(references.truth);
    } catch (const std::invalid_argument& unknown) {
        page.paragraph(std::string("Compared with the sum of its own pattern only: ") + unknown.what() + ".");
    }
    return references;
}

std::vector<std::uint8_t> amplified(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    std::vector<std::uint8_t> rgba(a.size(), 255);
    for (std::size_t i = 0; i < a.size(); ++i)
        if (i % 4 != 3)
            rgba[i] = static_cast<std::uint8_t>(
                std::min(difference_gain * std::abs(static_cast<int>(a[i]) - static_cast<int>(b[i])), 255));
    return rgba;
}

Compared compare(FrameSubject& subject, const Knob& knob, const References& references, int frames,
                 std::vector<std::uint8_t>* after) {
    Compared compared;
    compared.knob = knob;
    const FrameRun run = subject.run(knob.changes, 2, frames, true,
                                     knob.opencl ? 0U : std::uint32_t{SEAGLARE_CREATE_NO_OPENCL});
    const std::vector<reference::Rgbv> made = to_double(run.hdr);
    const std::vector<double> codes = subject.codes_of(made);
    const bool has_truth = !references.truth.empty();
    if (has_truth)
        compared.truth = compare_frames(subject, made, codes, references.truth, references.truth_codes);
    if (knob.same_pattern)
        compared.same = compare_frames(subject, made, codes, references.same, references.same_codes);
    compared.shown =
        compare_pictures(run.after, has_truth ? references.truth_picture : references.same_picture);
    compared.times = times_of(run);
    compared.stats = run.stats.back();
    if (after != nullptr) *after = run.after;
    return compared;
}

void add_row(Table& table, const std::string& scene, const Compared& c) {
    table.add() << scene << c.knob.name << c.knob.value << c.truth.relative_l2 << c.truth.energy_ratio
                << c.truth.max_codes << c.truth.p99_codes << c.truth.mean_codes << c.same.relative_l2
                << c.same.energy_ratio << c.same.max_codes << c.same.p99_codes << c.same.mean_codes
                << c.shown.max_codes << c.shown.mean_codes << c.times.wall.median << c.times.wall.lower
                << c.times.wall.upper << c.times.cpu.median << static_cast<int>(c.stats.lights_drawn)
                << static_cast<int>(c.stats.lights_below_threshold) << c.stats.device_memory_bytes / 1048576;
}

Table accuracy_table() {
    return Table({"scene",           "knob",          "value",         "eye L2",
                  "eye energy",      "eye max codes", "eye p99 codes", "eye mean codes",
                  "sum L2",          "sum energy",    "sum max codes", "sum p99 codes",
                  "sum mean codes",  "shown max",     "shown mean",    "ms",
                  "ms lower",        "ms upper",      "cpu ms",        "lights drawn",
                  "lights left out", "device MB"});
}

// Of the whole report.
struct Share {
    double from = 0, to = 1;
    double at(double fraction) const { return from + (to - from) * fraction; }
};
constexpr double references_take = 0.25;

void write_scene(Page& page, Progress& progress, const Share& share, FrameSubject& subject,
                 const FrameOptions& options, Table& everything) {
    page.heading(subject.name());
    progress.part(share.from, share.at(references_take));
    const References references = make_references(page, subject, progress);
    progress.part(share.at(references_take), share.to);
    page.paragraph(std::to_string(subject.width_px()) + " x " + std::to_string(subject.height_px()) + ", " +
                   std::to_string(subject.lights().size()) + " lights reach the eye, adaptation " +
                   std::to_string(subject.display().adaptation_cd_m2) +
                   " cd/m2. The simulated part of the reference's pattern was scaled by " +
                   std::to_string(subject.structure_scale()) + " to make it whole with the tail.");
    Table table = accuracy_table();
    std::vector<Point> points;
    const std::vector<Knob> knobs = frame_knobs(range_of(options));
    for (std::size_t i = 0; i < knobs.size(); ++i) {
        progress.show(subject.name() + ": " + knobs[i].name + " " + knobs[i].value,
                      static_cast<double>(i) / static_cast<double>(knobs.size()));
        std::vector<std::uint8_t> after;
        const Compared compared =
            compare(subject, knobs[i], references, options.quick ? 1 : 3, i == 0 ? &after : nullptr);
        add_row(table, subject.name(), compared);
        add_row(everything, subject.name(), compared);
        everything.write_csv(page.folder() / "accuracy.csv");
        const double error = references.truth.empty() ? compared.same.mean_codes : compared.truth.mean_codes;
        if (std::isfinite(error))
            points.push_back(
                {compared.knob.name + " " + compared.knob.value, compared.times.cpu.median, error});
        if (i > 0) continue;
        const std::vector<std::uint8_t>& expected =
            references.truth.empty() ? references.same_picture : references.truth_picture;
        const auto write = [&](const std::string& what, const std::vector<std::uint8_t>& rgba) {
            host::write_png(page.folder() / (subject.name() + "_" + what + ".png"), subject.width_px(),
                            subject.height_px(), rgba);
            return subject.name() + "_" + what + ".png";
        };
        page.pictures({write("before", subject.before()), write("after", after), write("reference", expected),
                       write("difference", amplified(after, expected))},
                      {"The host's picture", "With the product's glare, default quality",
                       "With the reference's glare", "Their difference, 16 times"});
    }
    page.table("accuracy_" + subject.name(), "Each knob by itself", table);
    Plot plot;
    plot.name = "pareto_" + subject.name();
    plot.title = subject.name() + ": error against processor time";
    plot.x_label = "ms of processor time of a frame, all threads";
    plot.y_label = std::string("mean difference to ") +
                   (references.truth.empty() ? "the sum" : "the reference") + ", 8-bit codes";
    plot_points(page, plot, points, "cpu ms", "mean codes");
}

void plot_budgets(Page& page, const Table& everything) {
    Table budgets({"scene", "budget", "sum max codes", "eye max codes", "ms"});
    std::vector<Curve> curves;
    std::string scene;
    Table one({"budget", "sum max codes", "ms"});
    const auto close = [&] {
        if (one.rows().empty()) return;
        one.write_csv(page.folder() / ("budget_" + scene + ".csv"));
        curves.push_back({"budget_" + scene + ".csv", 1, 2, scene, "linespoints pt 7", 0});
        one = Table({"budget", "sum max codes", "ms"});
    };
    for (const Table::Row& row : everything.rows()) {
        const auto& fields = row.fields();
        if (fields[1] != "budget") continue;
        if (fields[0] != scene) close();
        scene = fields[0];
        const std::string codes = fields[2].substr(0, fields[2].find(' '));
        budgets.add() << fields[0] << codes << fields[10] << fields[5] << fields[15];
        one.add() << codes << fields[10] << fields[15];
    }
    close();
    page.heading("What a budget of display codes gives");
    page.table(
        "budgets",
        "Largest difference of any channel of any pixel to the same pattern with nothing left out, and "
        "to the eye's reference",
        budgets);
    Plot plot;
    plot.name = "budgets";
    plot.title = "Measured error under a budget";
    plot.x_label = "budget, 8-bit codes";
    plot.y_label = "largest difference, 8-bit codes";
    plot.curves = curves;
    plot.log_y = true;
    plot.extra = "set samples 400\nset xrange [0:4]\nset yrange [0.01:10]";
    plot.command = "x with lines dt 2 lc rgb '#888888' title 'the budget itself'";
    page.plot(plot);
}

}  // namespace

int accuracy_command(const FrameOptions& options, const std::vector<std::filesystem::path>& scenes) {
    const host::Plugin plugin(options.plugin);
    const host::HeadlessContext gl;
    Progress progress;
    Page page(options.out, "Frames beside the reference");
    page.paragraph(
        "Each scene's first channel at its start, without dither and without depth: what the land hides is "
        "another question. Columns named eye compare with what the eye would have: the frame reference, in "
        "double precision, every " +
        std::to_string(options.step_nm) +
        " nm diffracted on its own, all lights summed at all pixels, discs exact, the CIE 135/1-1999 curve "
        "beyond the simulated field, nothing left out. Columns named sum compare with the same pattern that "
        "the product has, all lights summed in double precision with nothing left out: what accumulation and "
        "the plan's omissions do, and nothing else. Codes are those of an 8-bit sRGB display and not "
        "rounded; "
        "their mean is over channels that glare changes by a tenth of a code or more. Shown: the bytes in "
        "the "
        "host's target against the reference's, rounded. L2 is of linear luminance, which the lights' cores "
        "dominate. Times are of the product's part of a frame, GL work included: median and quartiles, and "
        "the processor time of all threads.");
    Table everything = accuracy_table();
    const auto whole = static_cast<double>(scenes.size());
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        FrameSubject subject(plugin, scenes[i], options);
        write_scene(page, progress, {static_cast<double>(i) / whole, static_cast<double>(i + 1) / whole},
                    subject, options, everything);
    }
    plot_budgets(page, everything);
    page.table("accuracy", "All scenes and knobs", everything, false);
    page.finish();
    std::cout << (page.folder() / "index.html").string() << "\n";
    return 0;
}

}  // namespace seaglare::report
