#include "glare/reference/plane_raster.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "glare/eye/aperture.h"
#include "glare/eye/veil.h"

namespace seaglare::reference {

namespace {

constexpr double beta = 13;
constexpr int lines_per_sample = 8;
constexpr int table_steps = 4096;  // of the kernel's integral, per sample

// One piece of a line with constant amplitude begins here.
struct Jump {
    double x_mm;
    double amplitude;  // from here on
};

struct Event {
    double x_mm;
    int particles;  // +1 a particle begins, -1 it ends
    int gratings;
    int blinds;
};

// Amplitude along a horizontal line of the aperture, as the places where it changes.
class LineCutter {
  public:
    explicit LineCutter(const Aperture& aperture) : aperture_(aperture), particles_(aperture.particles) {
        std::sort(particles_.begin(), particles_.end(), [](const Circle& a, const Circle& b) {
            return a.y_mm - a.radius_mm < b.y_mm - b.radius_mm;
        });
    }

    // Lines must come with rising y. The last jump is back to 0; none where the line misses the pupil.
    const std::vector<Jump>& cut(double y_mm) {
        jumps_.clear();
        admit(y_mm);
        const double radius = aperture_.pupil_mm / 2;
        const double square = radius * radius - y_mm * y_mm;
        if (square <= 0) return jumps_;
        const double end = std::sqrt(square);
        events_.clear();
        for (const Circle& c : active_) {
            const double dy = y_mm - c.y_mm;
            const double chord = std::sqrt(std::max(c.radius_mm * c.radius_mm - dy * dy, 0.0));
            add(c.x_mm - chord, c.x_mm + chord, end, {0, 1, 0, 0});
        }
        cut_gratings(y_mm, end);
        for (const Blind& blind : aperture_.blinds_mm)
            cut_blind(blind, y_mm, end);
        std::sort(events_.begin(), events_.end(),
                  [](const Event& a, const Event& b) { return a.x_mm < b.x_mm; });
        int covered = 0;
        int line = 0;
        int blind = 0;
        const auto amplitude = [&] {
            return blind > 0 ? 0.0
                             : (covered > 0 ? -1.0 : 1.0) * (line > 0 ? 1 - aperture_.gratings.depth : 1.0);
        };
        double last = amplitude();
        jumps_.push_back({-end, last});
        for (const Event& event : events_) {
            covered += event.particles;
            line += event.gratings;
            blind += event.blinds;
            const double now = amplitude();
            if (now == last) continue;
            if (event.x_mm == jumps_.back().x_mm)
                jumps_.back().amplitude = now;
            else
                jumps_.push_back({event.x_mm, now});
            last = now;
        }
        jumps_.push_back({end, 0});
        return jumps_;
    }

  private:
    void admit(double y_mm) {
        while (next_ < particles_.size() && particles_[next_].y_mm - particles_[next_].radius_mm <= y_mm)
            active_.push_back(particles_[next_++]);
        std::erase_if(active_, [y_mm](const Circle& c) { return c.y_mm + c.radius_mm < y_mm; });
    }

    // What begins at `from` and ends at `to`.
    void add(double from, double to, double limit, Event what) {
        from = std::max(from, -limit);
        to = std::min(to, limit);
        if (to <= from) return;
        events_.push_back({from, what.particles, what.gratings, what.blinds});
        events_.push_back({to, -what.particles, -what.gratings, -what.blinds});
    }

    // The chord of the ring of lines, in the one or two pieces that are left and right of its hole.
    void cut_gratings(double y_mm, double limit) {
        const glare::LensGratings& g = aperture_.gratings;
        if (g.count <= 0 || !(g.depth > 0) || !(g.duty > 0) || std::abs(y_mm) >= g.outer_radius_mm) return;
        const double outer = std::min(std::sqrt(g.outer_radius_mm * g.outer_radius_mm - y_mm * y_mm), limit);
        const double hole = g.inner_radius_mm * g.inner_radius_mm - y_mm * y_mm;
        if (hole <= 0) {
            cut_lines(y_mm, -outer, outer, limit);
            return;
        }
        const double inner = std::sqrt(hole);
        if (inner >= outer) return;
        cut_lines(y_mm, -outer, -inner, limit);
        cut_lines(y_mm, inner, outer, limit);
    }

    // Line k covers the azimuths (k ... k + duty)/count of a turn. Along a row the azimuth is monotonic.
    void cut_lines(double y_mm, double from, double to, double limit) {
        const glare::LensGratings& g = aperture_.gratings;
        const double per_line = 2 * std::numbers::pi / g.count;
        const double a = std::atan2(y_mm, from) / per_line;
        const double b = std::atan2(y_mm, to) / per_line;
        const auto x_at = [&](double azimuth) {
            return std::clamp(y_mm / std::tan(azimuth * per_line), from, to);
        };
        const double low = std::min(a, b);
        const double high = std::max(a, b);
        const double duty = std::min(g.duty, 1.0);
        const int last = static_cast<int>(std::floor(high));  // an azimuth is at most half of the count
        for (int k = static_cast<int>(std::floor(low - duty)); k <= last; ++k) {
            const double begin = std::clamp(static_cast<double>(k), low, high);
            const double end = std::clamp(k + duty, low, high);
            if (end <= begin) continue;
            const double x0 = begin == low ? (a < b ? from : to) : x_at(begin);
            const double x1 = end == high ? (a < b ? to : from) : x_at(end);
            add(std::min(x0, x1), std::max(x0, x1), limit, {0, 0, 1, 0});
        }
    }

    // The line's two crossings with the edges of a convex shape.
    void cut_blind(const Blind& blind, double y_mm, double limit) {
        double from = limit;
        double to = -limit;
        for (std::size_t i = 0; i < 4; ++i) {
            const double x0 = blind[2 * i];
            const double y0 = blind[2 * i + 1];
            const double x1 = blind[2 * ((i + 1) % 4)];
            const double y1 = blind[2 * ((i + 1) % 4) + 1];
            if ((y0 <= y_mm) == (y1 <= y_mm)) continue;
            const double x = x0 + (x1 - x0) * (y_mm - y0) / (y1 - y0);
            from = std::min(from, x);
            to = std::max(to, x);
        }
        add(from, to, limit, {0, 0, 0, 1});
    }

    const Aperture& aperture_;
    std::vector<Circle> particles_;
    std::vector<Circle> active_;
    std::size_t next_ = 0;
    std::vector<Event> events_;
    std::vector<Jump> jumps_;
};

}  // namespace

Aperture aperture_of(const glare::EyeModel& eye, const glare::EyeInstant& instant, std::uint64_t seed) {
    if (instant.defocus_dioptre != 0) throw std::invalid_argument("reference: an eye out of focus");
    // One sample per millimetre: the places come back in millimetres from the plane's corner.
    constexpr int plane = 64;
    std::vector<glare::Disc> discs;
    glare::ApertureParts(eye, seed).place(instant, plane, plane, discs);
    Aperture aperture;
    aperture.pupil_mm = instant.pupil_mm;
    aperture.gratings = eye.gratings;
    aperture.gratings.inner_radius_mm *= instant.lens_scale;
    aperture.gratings.outer_radius_mm *= instant.lens_scale;
    aperture.particles.reserve(discs.size());
    for (const glare::Disc& disc : discs)
        aperture.particles.push_back({static_cast<double>(disc.x) - plane / 2.0,
                                      static_cast<double>(disc.y) - plane / 2.0,
                                      static_cast<double>(disc.radius)});
    std::vector<glare::Quad> quads;
    glare::Veil(eye, seed).place(instant, quads);
    for (const glare::Quad& quad : quads) {
        Blind blind{};
        std::copy(quad.xy.begin(), quad.xy.end(), blind.begin());
        aperture.blinds_mm.push_back(blind);
    }
    return aperture;
}

Aperture aperture_of(const glare::EyeModel& eye, double pupil_mm, double time_s, std::uint64_t seed) {
    return aperture_of(eye, glare::eye_instant(eye, pupil_mm, time_s, {}, 0, seed), seed);
}

GriddingKernel::GriddingKernel() {
    scale_ = 1 / (2 * half_width * std::sinh(beta) / beta);
    const int steps = static_cast<int>(2 * half_width) * table_steps;
    integral_.resize(static_cast<std::size_t>(steps) + 1);
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double x = (i + 0.5) / table_steps - half_width;
        sum += at(x) / table_steps;
        integral_[static_cast<std::size_t>(i) + 1] = sum;
    }
}

double GriddingKernel::at(double x) const {
    const double t = 1 - x * x / (half_width * half_width);
    return t > 0 ? scale_ * std::cyl_bessel_i(0.0, beta * std::sqrt(t)) : 0;
}

double GriddingKernel::integral(double x) const {
    const double position = (x + half_width) * table_steps;
    if (position <= 0) return 0;
    if (position >= static_cast<double>(integral_.size() - 1)) return 1;
    const auto i = static_cast<std::size_t>(position);
    return std::lerp(integral_[i], integral_[i + 1], position - static_cast<double>(i)) / integral_.back();
}

double GriddingKernel::transform(double frequency) const {
    const double w = 2 * std::numbers::pi * half_width * frequency;
    const double square = beta * beta - w * w;
    const double root = std::sqrt(std::abs(square));
    if (root < 1e-9) return beta / std::sinh(beta);
    return (square > 0 ? std::sinh(root) : std::sin(root)) / root * beta / std::sinh(beta);
}

void draw_aperture(const Aperture& aperture, int n, double spacing_mm, const GriddingKernel& kernel,
                   double* samples, std::size_t stride) {
    for (int row = 0; row < n; ++row)
        std::fill_n(samples + static_cast<std::size_t>(row) * stride, n, 0.0);
    constexpr int reach = static_cast<int>(GriddingKernel::half_width);
    const double axis = n / 2;  // NOLINT(bugprone-integer-division): the axis stands on a sample
    std::vector<double> weight(static_cast<std::size_t>(2 * reach * lines_per_sample));
    double total = 0;
    for (std::size_t i = 0; i < weight.size(); ++i)
        total += weight[i] = kernel.at((static_cast<double>(i) + 0.5) / lines_per_sample - reach);
    for (double& w : weight)
        w /= total;

    LineCutter cutter(aperture);
    std::vector<double> line(static_cast<std::size_t>(n));
    std::vector<double> step(static_cast<std::size_t>(n) + 1);
    const int first_row =
        std::max(0, static_cast<int>(std::floor(axis - aperture.pupil_mm / 2 / spacing_mm)) - 1);
    const int last_row = std::min(n - 1, n - first_row);
    for (int row = first_row; row <= last_row; ++row) {
        for (int s = 0; s < lines_per_sample; ++s) {
            // The line's place in samples: between row and row + 1.
            const double y = row + (s + 0.5) / lines_per_sample;
            const std::vector<Jump>& jumps = cutter.cut((y - axis) * spacing_mm);
            if (jumps.empty()) continue;
            const int from =
                std::max(0, static_cast<int>(jumps.front().x_mm / spacing_mm + axis) - reach - 1);
            const int to =
                std::min(n - 1, static_cast<int>(jumps.back().x_mm / spacing_mm + axis) + reach + 2);
            std::fill(line.begin() + from, line.begin() + to + 1, 0.0);
            std::fill(step.begin() + from, step.begin() + to + 2, 0.0);
            double before = 0;
            for (const Jump& jump : jumps) {
                const double height = jump.amplitude - before;
                before = jump.amplitude;
                const double x = jump.x_mm / spacing_mm + axis;
                // Sample j gathers the kernel's part to the right of the jump: integral(j - x).
                const int near_first = std::max(from, static_cast<int>(std::ceil(x)) - reach);
                const int near_last = std::min(to, static_cast<int>(std::floor(x)) + reach);
                for (int j = near_first; j <= near_last; ++j)
                    line[static_cast<std::size_t>(j)] += height * kernel.integral(j - x);
                step[static_cast<std::size_t>(near_last) + 1] += height;
            }
            double level = 0;
            for (int j = from; j <= to; ++j) {
                level += step[static_cast<std::size_t>(j)];
                line[static_cast<std::size_t>(j)] += level;
            }
            for (int target = std::max(0, row - reach + 1); target <= std::min(n - 1, row + reach);
                 ++target) {
                const int index = (reach - target + row) * lines_per_sample + s;
                const double w = weight[static_cast<std::size_t>(index)];
                double* const out = samples + static_cast<std::size_t>(target) * stride;
                for (int j = from; j <= to; ++j)
                    out[j] += w * line[static_cast<std::size_t>(j)];
            }
        }
    }
}

double transmitted(const Aperture& aperture, double line_spacing_mm) {
    LineCutter cutter(aperture);
    const double radius = aperture.pupil_mm / 2;
    const int lines = std::max(2, static_cast<int>(std::ceil(aperture.pupil_mm / line_spacing_mm)));
    double open = 0;
    double passed = 0;
    for (int i = 0; i < lines; ++i) {
        const std::vector<Jump>& jumps = cutter.cut(-radius + (i + 0.5) * aperture.pupil_mm / lines);
        for (std::size_t j = 0; j + 1 < jumps.size(); ++j) {
            const double width = jumps[j + 1].x_mm - jumps[j].x_mm;
            open += width;
            passed += width * jumps[j].amplitude * jumps[j].amplitude;
        }
    }
    return open > 0 ? passed / open : 0;
}

}  // namespace seaglare::reference
