#include "host_stub/report/light_growth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host_stub/report/billboard_yardstick.h"

namespace seaglare::report {

// What a crowd's glare should be, and how much of the picture is looked at.
struct GrowthTruth {
    const std::vector<reference::Rgbv>& sum;
    const std::vector<double>& codes;
    int row_step = 1;
};

namespace {

constexpr std::uint32_t many_lights = 1000;
// A frame that is expected to take longer is not drawn, except for who wants everything.
constexpr double longest_frame_cpu_ms = 25000;
constexpr const char* plan_name = "the plan's choice";
constexpr const char* every_frame_name = "the plan's choice with a pattern for each frame";

// What is left of a frame without finding its lights and without making its pattern: uploads, occlusion, accumulation, tone
// mapping, GL work included.
Spread drawing_of(const FrameRun& run) {
    std::vector<double> values;
    for (std::size_t i = 0; i < run.wall_ms.size(); ++i)
        values.push_back(run.wall_ms[i] - run.stats[i].evaluate_ms - run.stats[i].pattern_ms);
    return spread_of(values);
}

std::vector<Knob> ways_to_draw() {
    std::vector<Knob> ways = {{"", plan_name, {}, true, true},
                              {"",
                               every_frame_name,
                               {{"pattern.motion.mode", "\"every_frame\""}, {"pattern.motion.wait", "true"}},
                               true,
                               true}};
    for (Knob& knob : accumulation_knobs())
        ways.push_back(std::move(knob));
    return ways;
}

FrameError error_of(const FrameSubject& subject, const std::vector<float>& hdr, const GrowthTruth& truth) {
    const std::vector<reference::Rgbv> made = to_double(hdr);
    return compare_frames(subject, made, subject.codes_of(made), truth.sum, truth.codes, truth.row_step);
}

std::string rounded(double value) {
    const double unit = std::pow(10, std::floor(std::log10(std::max(std::abs(value), 1e-9))) - 1);
    std::string text = std::to_string(std::round(value / unit) * unit);
    if (text.find('.') != std::string::npos) {
        text.erase(text.find_last_not_of('0') + 1);
        if (text.back() == '.') text.pop_back();
    }
    return text;
}

}  // namespace

LightGrowth::LightGrowth(Page& page, Progress& progress, const host::Plugin& plugin,
                         const FrameOptions& options)
    : page_(page),
      progress_(progress),
      plugin_(plugin),
      options_(options),
      table_({"lights", "way", "frame ms", "frame lower", "frame upper", "frame cpu ms", "drawing ms",
              "drawing lower", "drawing upper", "accumulation ms", "x drawing", "x accumulation",
              "x frame cpu", "max codes", "p99 codes", "mean codes", "L2", "energy", "remark"}) {
    table_.keep_at(page.folder() / "lights.csv");
}

void LightGrowth::measure(const std::filesystem::path& scene, std::uint32_t count) {
    FrameSubject subject(plugin_, scene, options_, count);
    // The brute sum grows with the lights: of ten thousand every eleventh row is made, and the errors are of those.
    const int row_step = count > many_lights ? static_cast<int>(count / many_lights) | 1 : 1;
    const std::vector<reference::Rgbv> sum = subject.same_sum({}, progress_, row_step);
    const std::vector<double> codes = subject.codes_of(sum);
    const GrowthTruth truth{sum, codes, row_step};
    measure_yardstick(count, subject, truth);
    for (const Knob& way : ways_to_draw())
        measure_way(count, subject, way, truth);
}

void LightGrowth::measure_yardstick(std::uint32_t count, FrameSubject& subject, const GrowthTruth& truth) {
    const reference::GlareShape shape = subject.same_shape({});
    for (const bool half : {false, true}) {
        progress_.show(std::to_string(count) + " lights: squares of 512 pixels", 0.4);
        const BillboardRun run = draw_billboards(subject.screen(), shape, subject.lights(), half,
                                                 count >= many_lights || options_.quick ? 1 : 3);
        Row row;
        row.way = half ? "512² billboards in RGBA16F" : "512² billboards in RGBA32F";
        row.frame = row.drawing = spread_of(run.wall_ms);
        row.cpu = spread_of(run.cpu_ms);
        row.error = error_of(subject, run.hdr, truth);
        if (!half) {
            yardstick_wall_ = row.frame;
            yardstick_cpu_ = row.cpu;
        }
        add(count, row);
    }
}

void LightGrowth::measure_way(std::uint32_t count, FrameSubject& subject, const Knob& way,
                              const GrowthTruth& truth) {
    const double expected_ms = predicted_cpu_ms(way.value, count);
    if (expected_ms > longest_frame_cpu_ms && !options_.full)
        return leave_out(count, way.value,
                         "not drawn: " + rounded(expected_ms / 1000) +
                             " s of processor time a frame expected from what fewer lights took");
    progress_.show(std::to_string(count) + " lights: " + way.value, 0.7);
    const bool slow = expected_ms > longest_frame_cpu_ms / 4;
    const bool few = options_.quick || count > many_lights;
    const FrameRun run = subject.run(way.changes, slow ? 1 : 3, slow ? 1 : (few ? 3 : 7), false);
    Row row;
    row.way = way.value;
    row.frame = times_of(run).wall;
    row.cpu = times_of(run).cpu;
    row.drawing = drawing_of(run);
    // The GPU's time is that of the frame before, which after one frame alone was the first.
    row.accumulation_ms = std::min(std::max(median_of(run, &seaglare_stats::accumulate_ms),
                                            median_of(run, &seaglare_stats::gpu_accumulate_ms)),
                                   row.drawing.median);
    row.error = error_of(subject, run.hdr, truth);
    if (slow) row.remark = "one frame";
    add(count, row);
}

double LightGrowth::predicted_cpu_ms(const std::string& way, std::uint32_t count) const {
    for (const Way& known : ways_) {
        if (known.name != way || known.at.empty()) continue;
        const Measured& last = known.at.back();
        return last.cpu_ms * count / last.lights;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

void LightGrowth::add(std::uint32_t count, const Row& row) {
    const double of_accumulation =
        row.accumulation_ms > 0 ? yardstick_wall_.median / row.accumulation_ms : std::nan("");
    table_.add() << static_cast<int>(count) << row.way << row.frame.median << row.frame.lower
                 << row.frame.upper << row.cpu.median << row.drawing.median << row.drawing.lower
                 << row.drawing.upper << row.accumulation_ms << yardstick_wall_.median / row.drawing.median
                 << of_accumulation << yardstick_cpu_.median / row.cpu.median << row.error.max_codes
                 << row.error.p99_codes << row.error.mean_codes << row.error.relative_l2
                 << row.error.energy_ratio << row.remark;
    table_.flush();
    auto way = std::find_if(ways_.begin(), ways_.end(), [&](const Way& w) { return w.name == row.way; });
    if (way == ways_.end()) way = ways_.insert(ways_.end(), Way{row.way, {}});
    way->at.push_back(
        {count, row.drawing.median, row.frame.median, row.cpu.median, of_accumulation, row.error.max_codes});
}

void LightGrowth::leave_out(std::uint32_t count, const std::string& way, const std::string& why) {
    Table::Row& row = table_.add();
    row << static_cast<int>(count) << way;
    while (row.fields().size() + 1 < table_.columns().size())
        row << "";
    row << why;
    table_.flush();
}

// What the figures come to, in a sentence each.
std::string LightGrowth::summary() const {
    std::string text;
    for (const Way& way : ways_) {
        if (way.name != plan_name && way.name != every_frame_name) continue;
        for (const Measured& m : way.at) {
            if (m.lights != many_lights) continue;
            if (way.name == plan_name)
                text += "With 1000 lights the plan's choice adds them up " + rounded(m.times_faster) +
                        " times as fast as the squares in RGBA32F, within " + rounded(m.max_codes) +
                        " codes. ";
            else
                text += "A frame of them with a pattern of its own takes " + rounded(m.frame_ms) + " ms, " +
                        rounded(1000 / m.frame_ms) + " a second. ";
        }
        if (way.name == plan_name && way.at.size() > 1 && way.at.front().drawing_ms > 0)
            text += "From " + std::to_string(way.at.front().lights) + " to " +
                    std::to_string(way.at.back().lights) + " lights the time to draw them grows " +
                    rounded(way.at.back().drawing_ms / way.at.front().drawing_ms) + " times. ";
    }
    return text;
}

void LightGrowth::write() {
    page_.heading("How time grows with the lights");
    page_.paragraph(
        "The scene of the 2012 master's thesis's figure 6.19, its crowd from 100 to 10 000 lights spread "
        "over 1280 x "
        "720 pixels. The yardstick draws one square of 512 x 512 pixels per light, the same pattern at the "
        "same "
        "angular size, in the same run, to pixels as if they were all on the picture's axis, as was done "
        "then: its "
        "energy is off by the cosines towards the corners, and glare ends at its squares' edges. From 1000 "
        "lights on "
        "it draws one frame. Errors are of the glare against the same pattern, all lights summed in double "
        "precision with nothing left out; beyond 1000 lights on some rows of the picture only. Drawing: a "
        "frame less "
        "finding its lights and making its pattern, so uploads, occlusion and tone mapping are in it, which "
        "the "
        "yardstick does not do; accumulation: the pass alone, on the clock where it took longer, the CPU's "
        "or the "
        "GPU's. x: how many times as fast as the squares in RGBA32F. Patterns are made beside the frames, "
        "but for "
        "the row that says so.");
    page_.paragraph(summary());
    page_.table("lights", "Lights, time, error", table_);
    std::vector<Curve> times;
    std::vector<Curve> errors;
    for (std::size_t i = 0; i < ways_.size(); ++i) {
        Table one({"lights", "ms", "max codes"});
        for (const Measured& m : ways_[i].at)
            one.add() << static_cast<int>(m.lights) << m.drawing_ms << m.max_codes;
        const std::string file = "lights_" + std::to_string(i) + ".csv";
        one.write_csv(page_.folder() / file);
        times.push_back({file, 1, 2, ways_[i].name, "linespoints pt 7", 0});
        errors.push_back({file, 1, 3, ways_[i].name, "linespoints pt 7", 0});
    }
    page_.plot({"lights_time", "Drawing: time against lights", "lights", "ms", times, true, true, ""});
    page_.plot({"lights_error", "Error against lights", "lights", "largest difference, 8-bit codes", errors,
                true, true, ""});
}

}  // namespace seaglare::report
