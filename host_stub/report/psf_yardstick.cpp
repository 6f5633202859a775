// The 2012 thesis's algorithm beside production in one run: error against time, at the thesis's own scale, where its 512
// samples fill the picture.
#include <algorithm>
#include <cmath>

#include "glare/colour/spectrum.h"
#include "host_stub/report/psf_sweeps.h"
#include "host_stub/report/thesis_pattern.h"

namespace seaglare::report {

namespace {

constexpr double thesis_pupil_mm = 6.5;
constexpr double plane_mm = 9;

// Both scaled to the same sum, as a picture is exposed: sum |difference| over sum, red, green and blue.
double thesis_error(const ThesisPattern& made, const reference::ReferencePattern& truth) {
    double made_sum = 0;
    double truth_sum = 0;
    const auto pixel = [&](int a, int b, std::size_t c) {
        const auto i = static_cast<std::size_t>(b + ThesisPattern::n / 2) * ThesisPattern::n +
                       static_cast<std::size_t>(a + ThesisPattern::n / 2);
        return static_cast<double>(made.pixels[i][c]);
    };
    const auto sweep = [&](auto visit) {
        for (int b = -truth.radius; b <= truth.radius; ++b)
            for (int a = -truth.radius; a <= truth.radius; ++a)
                if (std::hypot(a, b) <= truth.radius)
                    for (std::size_t c = 0; c < 3; ++c)
                        visit(a, b, c);
    };
    sweep([&](int a, int b, std::size_t c) {
        made_sum += pixel(a, b, c);
        truth_sum += truth.relative(a, b)[c];
    });
    double apart = 0;
    sweep([&](int a, int b, std::size_t c) {
        apart += std::abs(pixel(a, b, c) / made_sum - truth.relative(a, b)[c] / truth_sum);
    });
    return apart;
}

struct Point {
    std::string kind;
    std::string name;
    double error;
    double ms;
};

// No other point is both faster and better.
bool on_front(const Point& p, const std::vector<Point>& all) {
    return std::none_of(all.begin(), all.end(), [&](const Point& q) {
        return q.ms <= p.ms && q.error <= p.error && (q.ms < p.ms || q.error < p.error);
    });
}

Table table_of(const std::vector<Point>& points, const std::string& kind, const std::vector<Point>& all,
               double unit_ms) {
    Table table({"pattern", "relative L1", "ms", "x FFTW 512", "on the front"});
    for (const Point& p : points)
        if (kind.empty() || p.kind == kind)
            table.add() << p.name << p.error << p.ms << p.ms / unit_ms << (on_front(p, all) ? "yes" : "no");
    return table;
}

}  // namespace

void sweep_yardstick(const Study& study, const Subject& subject) {
    Page& page = study.page;
    const double unit_ms = study.unit_ms;
    Subject s = subject;
    s.eye = glare::thesis_eye();
    s.settings = glare::thesis_settings();
    s.pupil_mm = thesis_pupil_mm;
    // A pixel is one sample at 575 nm, for both.
    s.settings.angular_scale = s.pitch / (575e-6 / plane_mm);
    s.radius = std::min(subject.radius, 60);
    reference::ReferenceRequest request;
    request.eye = s.eye;
    request.pupil_mm = s.pupil_mm;
    request.seed = s.seed;
    request.pitch = s.pitch;
    request.radius = s.radius;
    request.angular_scale = s.settings.angular_scale;
    const auto truth = study.reference(request, {reference::lines_of(glare::d65, s.step_nm)}).front();

    std::vector<Point> points;
    Table stages({"layers", "aperture ms", "transform ms", "spread ms", "discs ms", "sum without aperture",
                  "x FFTW 512"});
    page.keep("yardstick_stages", stages);
    Table so_far({"pattern", "relative L1", "ms", "x FFTW 512", "on the front"});
    page.keep("yardstick", so_far);
    const auto measured = [&](Point point) {
        so_far.add() << point.name << point.error << point.ms << point.ms / unit_ms << "";
        points.push_back(std::move(point));
    };
    for (const auto& [name, radii] : std::vector<std::pair<std::string, std::vector<int>>>{
             {"1", {0}}, {"3", {0, 1, 2}}, {"5", {0, 1, 2, 4, 10}}}) {
        study.show("the thesis with " + name + " layers");
        const ThesisPattern made = make_thesis_pattern(s.eye, s.pupil_mm, plane_mm, s.seed, radii);
        const ThesisTimes& t = made.times;
        stages.add() << name << t.aperture_ms << t.transform_ms << t.spread_ms << t.discs_ms
                     << t.without_aperture_ms() << t.without_aperture_ms() / unit_ms;
        measured(
            {"thesis", "thesis, " + name + " layers", thesis_error(made, truth), t.without_aperture_ms()});
    }
    for (const int scale : {1, 2, 4}) {
        for (const int wavelengths : {8, 15, 30, 60}) {
            for (const auto& radii : {std::vector<float>{0}, {0, 1, 2}, {0, 1, 2, 4, 10}}) {
                Subject k = s;
                // More samples over a wider plane: the same field, sampled more finely.
                k.settings.transform_size = 512 * scale;
                k.settings.plane_width_mm = plane_mm * scale;
                k.settings.wavelengths = wavelengths;
                k.settings.layer_radii_px = radii;
                study.show("production", static_cast<double>(points.size()) / 39);
                const auto source = source_of(k);
                const glare::PatternRequest wanted = request_of(k);
                const double ms = cost_of(*source, wanted).work_ms;
                // The error within the reference's radius; the time is of the whole field.
                Subject near = k;
                near.settings.max_radius_nodes = s.radius + 12;
                const auto near_source = source_of(near);
                const auto e = reference::compare(truth, near.eye, near_source->make(request_of(near)),
                                                  near.settings.core_radius_nodes);
                measured({"production",
                          std::to_string(512 * scale) + "/" + std::to_string(wavelengths) + "/" +
                              std::to_string(radii.size()),
                          e.relative_l1, ms});
            }
        }
    }
    page.heading("Error against run time: the yardstick");
    page.paragraph(
        "At the scale of the 2012 thesis (magnified: one sample is one pixel at 575 nm) its algorithm, in "
        "plain C++ on one "
        "thread, and production, on the machine's OpenCL device with the aperture drawn anew and the pattern "
        "read back. "
        "Names are transform size / wavelengths / disc layers. The unit is one complex 512 x 512 transform "
        "by FFTW on one "
        "thread.");
    page.table("yardstick_stages", "The thesis's algorithm by stage", stages);
    page.table("yardstick", "All points", table_of(points, "", points, unit_ms));
    table_of(points, "thesis", points, unit_ms).write_csv(page.folder() / "yardstick_thesis.csv");
    table_of(points, "production", points, unit_ms).write_csv(page.folder() / "yardstick_production.csv");
    std::vector<Point> front;
    std::copy_if(points.begin(), points.end(), std::back_inserter(front),
                 [&](const Point& p) { return on_front(p, points); });
    std::sort(front.begin(), front.end(), [](const Point& a, const Point& b) { return a.ms < b.ms; });
    table_of(front, "", points, unit_ms).write_csv(page.folder() / "yardstick_front.csv");
    page.plot(
        {"yardstick",
         "Error against run time at the thesis's scale: 512 samples over 9 mm, and finer",
         "processor time, in FFTW's complex 512 x 512 transforms",
         "relative L1 on screen pixels",
         {{"yardstick_front.csv", 4, 2, "Pareto front", "lines lc rgb '#888888' lw 2 dt 1", 0},
          {"yardstick_production.csv", 4, 2, "production, 512, 1024, 2048 samples", "points lt 1", 0},
          {"yardstick_thesis.csv", 4, 2, "the 2012 thesis: 1, 3, 5 layers", "points lt 2", 0}},
         true,
         true,
         "set bmargin 7\nset key at screen 0.5,0.02 bottom center horizontal maxcols 2\nset format y '%g'"});
}

}  // namespace seaglare::report
