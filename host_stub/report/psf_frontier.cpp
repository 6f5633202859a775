// The physical pattern while the eye moves: one transform for every frame, or two scales of one pattern, each with what a
// frame costs and how far it is from the reference at an instant that no wide field was made for.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "glare/colour/spectrum.h"
#include "glare/reference/field_loss.h"
#include "host_stub/report/pattern_image.h"
#include "host_stub/report/psf_sweeps.h"
#include "host_stub/report/thesis_pattern.h"

namespace seaglare::report {

namespace {

using reference::Rgbv;

constexpr int frames = 48;
constexpr double degree = std::numbers::pi / 180;

double window(double sine, double inner, double outer) {
    const double t = std::clamp((sine - inner) / std::max(outer - inner, 1e-12), 0.0, 1.0);
    return 0.5 + 0.5 * std::cos(std::numbers::pi * t);
}

// Of a pixel or node at (a, b) in a square of (2 radius + 1)^2.
std::size_t index_of(int a, int b, int radius) {
    const auto side = 2 * static_cast<std::size_t>(radius) + 1;
    return static_cast<std::size_t>(b + radius) * side + static_cast<std::size_t>(a + radius);
}

// What is drawn around a point: energies of pixels but for the core, and the core's.
struct Field {
    int radius = 0;
    double pitch = 0;
    std::vector<Rgbv> pixels;
    Rgbv core{};
    const Rgbv& at(int a, int b) const { return pixels[index_of(a, b, radius)]; }
};

template <typename Structure>
Field field_of(const Subject& s, const glare::Pattern& shape, const Rgbv& core, double tail_scale,
               Structure structure) {
    Field field{s.radius, s.pitch, {}, core};
    for (int b = -s.radius; b <= s.radius; ++b) {
        for (int a = -s.radius; a <= s.radius; ++a) {
            Rgbv value = structure(a, b);
            const double sine = std::hypot(a, b) * s.pitch;
            const double faded = 1 - window(sine, shape.window_inner, shape.window_outer);
            const double tail = faded > 0
                                    ? tail_scale * faded *
                                          reference::cie_curve_sr(std::asin(std::min(sine, 1.0)) / degree,
                                                                  s.eye.age_years, s.eye.pigmentation)
                                    : 0;
            for (double& channel : value)
                channel += tail * s.pitch * s.pitch;
            field.pixels.push_back(value);
        }
    }
    return field;
}

Field drawn(const Subject& s, const glare::Pattern& pattern) {
    Rgbv core{};
    std::copy(pattern.core_energy[0].begin(), pattern.core_energy[0].end(), core.begin());
    return field_of(s, pattern, core, pattern.tail_scale, [&](int a, int b) {
        Rgbv value{};
        if (std::max(std::abs(a), std::abs(b)) > pattern.radius_nodes) return value;
        const std::size_t at = 4 * index_of(a, b, pattern.radius_nodes);
        for (std::size_t c = 0; c < 4; ++c)
            value[c] = static_cast<double>(pattern.skirt[at + c]) * s.pitch * s.pitch;
        return value;
    });
}

// The reference, split and given its tail as a pattern of the whole field is.
Field expected(const Subject& s, const reference::ReferencePattern& truth, const glare::Pattern& whole) {
    const reference::SplitReference parts =
        reference::split(truth, s.eye, whole, s.settings.core_radius_nodes);
    return field_of(s, whole, parts.core, parts.tail_scale,
                    [&](int a, int b) { return parts.skirt[index_of(a, b, s.radius)]; });
}

template <typename Visit>
void for_each_pixel(const Field& field, Visit visit) {
    for (int b = -field.radius; b <= field.radius; ++b)
        for (int a = -field.radius; a <= field.radius; ++a)
            if (std::hypot(a, b) <= field.radius) visit(a, b);
}

struct Loss {
    double l1 = 0;        // sum |difference| over sum |reference|, four channels, core included
    double radial = 0;    // of the mean over a ring, the worst of 0.25 to 3.6 degrees
    double contrast = 0;  // of sigma over mean at 1, 2 and 3 degrees: the largest change
    double codes = 0;     // the largest difference in 8-bit codes: 10 000 cd at 1 km by starlight
};

reference::LuminanceField luminance_of(const Field& field) {
    reference::LuminanceField luminance{field.radius, field.pitch, {}};
    luminance.per_sr.reserve(field.pixels.size());
    for (const Rgbv& energy : field.pixels)
        luminance.per_sr.push_back(photopic(energy) / (field.pitch * field.pitch));
    return luminance;
}

Loss loss_of(const Field& made, const Field& truth) {
    Loss loss;
    double sum = 0;
    for (std::size_t c = 0; c < 4; ++c) {
        loss.l1 += std::abs(made.core[c] - truth.core[c]);
        sum += std::abs(truth.core[c]);
    }
    for_each_pixel(truth, [&](int a, int b) {
        const Rgbv& p = made.at(a, b);
        const Rgbv& q = truth.at(a, b);
        for (std::size_t c = 0; c < 4; ++c) {
            loss.l1 += std::abs(p[c] - q[c]);
            sum += std::abs(q[c]);
        }
    });
    loss.l1 /= sum;
    const reference::FieldLoss seen =
        reference::field_loss(luminance_of(made), luminance_of(truth), std::array{1.0, 2.0, 3.0});
    loss.radial = seen.radial;
    loss.contrast = seen.contrast;
    loss.codes = seen.codes;
    return loss;
}

struct Point {
    std::string kind;
    std::string name;
    Loss loss;
    Cost cost;
};

using Measure = double Loss::*;

// No other point is both faster and better.
bool on_front(const Point& p, const std::vector<Point>& all, Measure loss) {
    return std::none_of(all.begin(), all.end(), [&](const Point& q) {
        return q.cost.work_ms <= p.cost.work_ms && q.loss.*loss <= p.loss.*loss &&
               (q.cost.work_ms < p.cost.work_ms || q.loss.*loss < p.loss.*loss);
    });
}

std::vector<Point> front_of(const std::vector<Point>& points, Measure loss) {
    std::vector<Point> front;
    std::copy_if(points.begin(), points.end(), std::back_inserter(front),
                 [&](const Point& p) { return on_front(p, points, loss); });
    std::sort(front.begin(), front.end(),
              [](const Point& a, const Point& b) { return a.cost.work_ms < b.cost.work_ms; });
    return front;
}

Table new_table() {
    return Table({"kind", "pattern", "relative L1", "radial mean", "contrast", "codes", "ms", "x FFTW 512",
                  "ms by the clock", "on the front"});
}

Table table_of(const std::vector<Point>& points, const std::vector<Point>& all, double unit_ms) {
    Table table = new_table();
    for (const Point& p : points)
        table.add() << p.kind << p.name << p.loss.l1 << p.loss.radial << p.loss.contrast << p.loss.codes
                    << p.cost.work_ms << p.cost.work_ms / unit_ms << p.cost.wall_ms
                    << (on_front(p, all, &Loss::l1) ? "yes" : "no");
    return table;
}

// The thesis's 512 samples at their true angles: 28 pixels of this picture are all that they reach. Samples are summed into
// the pixel that they lie in, and the energy is what its own sum is.
Field thesis_field(const Subject& s, Cost& cost) {
    constexpr double plane_mm = 9;
    const ThesisPattern made = make_thesis_pattern(s.eye, s.pupil_mm, plane_mm, s.seed, {0, 1, 2});
    cost = {made.times.without_aperture_ms(), made.times.without_aperture_ms()};
    Field field{s.radius, s.pitch, {}, {}};
    field.pixels.resize(index_of(s.radius, s.radius, s.radius) + 1);
    const double pixels_per_sample = 575e-6 / plane_mm / s.pitch;
    constexpr int middle = ThesisPattern::n / 2;
    std::size_t sample_index = 0;
    for (int y = -middle; y < middle; ++y) {
        for (int x = -middle; x < middle; ++x) {
            const auto a = static_cast<int>(std::lround(x * pixels_per_sample));
            const auto b = static_cast<int>(std::lround(y * pixels_per_sample));
            const auto& sample = made.pixels[sample_index++];
            const double distance = std::hypot(a, b);
            if (distance > s.radius) continue;
            const double in_core = 1 - window(distance, 0, s.settings.core_radius_nodes);
            auto& pixel = field.pixels[index_of(a, b, s.radius)];
            for (std::size_t c = 0; c < 4; ++c) {
                // It knows no scotopic channel: as for white, the same as its luminance.
                const double energy = c < 3 ? static_cast<double>(sample[c])
                                            : 0.2126 * static_cast<double>(sample[0]) +
                                                  0.7152 * static_cast<double>(sample[1]) +
                                                  0.0722 * static_cast<double>(sample[2]);
                pixel[c] += energy * in_core;
                field.core[c] += energy * (1 - in_core);
            }
        }
    }
    return field;
}

void plot(Page& page, const std::string& name, const char* title, int column, const char* label) {
    const std::string front = name + "_front.csv";
    page.plot(
        {name,
         title,
         "processor time of a frame's pattern, in FFTW's complex 512 x 512 transforms",
         label,
         {{front, 8, column, "Pareto front", "lines lc rgb '#888888' lw 2 dt 1", 0},
          {"frontier_one.csv", 8, column, "one transform of 512, 1024, 2048, 4096", "points lt 1", 0},
          {"frontier_two.csv", 8, column, "two scales, core + wide field", "points lt 5", 0},
          {"frontier_thesis.csv", 8, column, "the 2012 thesis, 512, 3 layers", "points lt 2", 0}},
         true,
         true,
         "set bmargin 7\nset key at screen 0.5,0.02 bottom center horizontal maxcols 2\nset format y '%g'"});
}

}  // namespace

void sweep_frontier(const Study& study, const Subject& subject) {
    Page& page = study.page;
    const double unit_ms = study.unit_ms;
    Subject s = subject;
    s.eye = glare::no_lash_eye();
    s.eye.hippus_amplitude_mm = 0;
    s.settings = {};
    s.settings.layer_radii_px = subject.settings.layer_radii_px;
    s.time_s = instant_s;
    s = limited(s);
    const auto truth =
        study.reference(reference_request(s), {reference::lines_of(glare::d65, s.step_nm)}).front();
    const auto exact = source_of(s);
    const Field wanted = expected(s, truth, exact->make(request_of(s)));

    std::vector<Point> points;
    Table so_far = new_table();  // who interrupts this has what was measured; the whole table takes its place
    page.keep("frontier", so_far);
    const auto measured = [&](Point point) {
        so_far.add() << point.kind << point.name << point.loss.l1 << point.loss.radial << point.loss.contrast
                     << point.loss.codes << point.cost.work_ms << point.cost.work_ms / unit_ms
                     << point.cost.wall_ms << "";
        points.push_back(std::move(point));
    };
    const auto try_out = [&](const std::string& kind, const std::string& name, const Subject& k) {
        study.show(name, static_cast<double>(points.size()) / 45);
        const auto source = source_of(k);
        glare::PatternRequest request = request_of(k);
        request.largest_disc_nodes = 3;  // the point layer and two more, as a lamp near by needs
        const bool ahead = k.settings.wide_field_size > 0;
        // Two scales: from the very instant on, so that the wide field there is what frames before would have made.
        const Cost cost =
            ahead ? cost_of_frames(*source, request, k.time_s, frames) : cost_of(*source, request);
        request.time_s = k.time_s;
        measured({kind, name, loss_of(drawn(k, source->make(request)), wanted), cost});
    };
    for (const int n : {512, 1024, 2048, 4096}) {
        for (const int wavelengths : {8, 15, 30, 60}) {
            Subject k = s;
            k.settings.transform_size = n;
            k.settings.wavelengths = wavelengths;
            try_out("one transform", std::to_string(n) + "/" + std::to_string(wavelengths), k);
        }
    }
    const auto two_scales = [&](int core, int wide, double interval_s, int wavelengths) {
        Subject k = s;
        k.settings.transform_size = core;
        k.settings.wide_field_size = wide;
        k.settings.wide_field_interval_s = interval_s;
        k.settings.wavelengths = wavelengths;
        try_out("two scales",
                std::to_string(core) + "+" + std::to_string(wide) + "/" +
                    std::to_string(static_cast<int>(interval_s)) + "s/" + std::to_string(wavelengths),
                k);
    };
    for (const int core : {256, 512, 1024}) {
        for (const double interval_s : {1.0, 2.0, 4.0, 8.0})
            two_scales(core, 4096, interval_s, 30);
        for (const int wavelengths : {8, 15, 60})
            two_scales(core, 4096, 4, wavelengths);
        two_scales(core, 2048, 4, 30);
    }
    study.show("the thesis");
    Cost thesis_cost;
    const Field thesis = thesis_field(s, thesis_cost);
    measured({"thesis", "2012, brute force", loss_of(thesis, wanted), thesis_cost});

    page.heading("Error against run time: the physical pattern");
    page.paragraph(
        "An eye that moves (no_lash: drifting particles, a lens that is strained; the pupil is held), at " +
        std::to_string(instant_s).substr(0, 3) +
        " s, between the instants that any wide field was made for. Each pattern's core, skirt and tail "
        "against the "
        "reference's over the whole field, whatever the transform reaches. One transform N/wavelengths is "
        "made anew in "
        "every frame; two scales core+wide/interval/wavelengths, the mean of " +
        std::to_string(frames) +
        " frames. Radial mean: the worst ring of 0.25 to 3.6 degrees; contrast: the largest change of sigma "
        "over mean at 1, 2 "
        "and 3 degrees; codes: the largest difference of a pixel outside the core, 8 bits, 10 000 cd at 1 km "
        "by starlight. "
        "The thesis's algorithm at true angles reaches 14 pixels.");
    page.table("frontier", "All points", table_of(points, points, unit_ms));
    for (const auto& [kind, file] :
         std::vector<std::pair<const char*, const char*>>{{"one transform", "frontier_one.csv"},
                                                          {"two scales", "frontier_two.csv"},
                                                          {"thesis", "frontier_thesis.csv"}}) {
        std::vector<Point> some;
        std::copy_if(points.begin(), points.end(), std::back_inserter(some),
                     [kind = kind](const Point& p) { return p.kind == kind; });
        table_of(some, points, unit_ms).write_csv(page.folder() / file);
    }
    table_of(front_of(points, &Loss::l1), points, unit_ms).write_csv(page.folder() / "frontier_front.csv");
    table_of(front_of(points, &Loss::codes), points, unit_ms)
        .write_csv(page.folder() / "frontier_codes_front.csv");
    plot(page, "frontier", "Error against run time: one frame's pattern, eye in motion", 3,
         "relative L1 on screen pixels");
    plot(page, "frontier_codes", "The same by the worst pixel outside the core", 6,
         "largest difference, 8-bit codes");
}

}  // namespace seaglare::report
