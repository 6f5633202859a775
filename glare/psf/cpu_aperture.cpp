#include "glare/psf/cpu_aperture.h"

#include <kissfft/kiss_fftr.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <numbers>
#include <stdexcept>

namespace seaglare::glare {

namespace {

std::size_t index(int n, int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(n) + static_cast<std::size_t>(x);
}

// The area of a disc in the unit square whose lower left corner is at (left, low) from the disc's centre.
double area_in_square(double left, double low, double radius) {
    const double from = std::max(low, -radius);
    const double to = std::min(low + 1, radius);
    if (to <= from) return 0;
    constexpr int lines = 12;
    double area = 0;
    for (int s = 0; s < lines; ++s) {
        const double y = from + (to - from) * (s + 0.5) / lines;
        const double chord = std::sqrt(std::max(radius * radius - y * y, 0.0));
        area += std::max(0.0, std::min(chord, left + 1) - std::max(-chord, left));
    }
    return std::min(1.0, area * (to - from) / lines);
}

template <typename Visit>
void for_each_covered(double x, double y, double radius, int n, Visit visit) {
    const auto first = [n](double v) { return static_cast<int>(std::clamp(std::floor(v), 0.0, n - 1.0)); };
    if (x + radius < 0 || y + radius < 0 || x - radius > n || y - radius > n) return;
    for (int row = first(y - radius); row <= first(y + radius); ++row)
        for (int column = first(x - radius); column <= first(x + radius); ++column)
            visit(column, row, area_in_square(column - x, row - y, radius));
}

// The share of a sample's square that grating lines cover, by looking at many points of it.
double grating_share(const GratingShape& g, double dx, double dy) {
    const double distance = std::hypot(dx, dy);
    const double inner = static_cast<double>(g.inner_radius);
    const double outer = static_cast<double>(g.outer_radius);
    const double ring =
        std::clamp(distance - inner + 0.5, 0.0, 1.0) * std::clamp(outer - distance + 0.5, 0.0, 1.0);
    if (ring <= 0) return 0;
    constexpr int points = 8;
    int covered = 0;
    for (int j = 0; j < points; ++j) {
        for (int i = 0; i < points; ++i) {
            const double x = dx - 0.5 + (i + 0.5) / points;
            const double y = dy - 0.5 + (j + 0.5) / points;
            const double lines = static_cast<double>(g.count) * std::atan2(y, x) / (2 * std::numbers::pi);
            if (lines - std::floor(lines) < static_cast<double>(g.duty)) ++covered;
        }
    }
    return ring * covered / (points * points);
}

std::unique_ptr<kiss_fft_state, void (*)(void*)> complex_plan(int n) {
    std::unique_ptr<kiss_fft_state, void (*)(void*)> plan(kiss_fft_alloc(n, 0, nullptr, nullptr),
                                                          [](void* p) { kiss_fft_free(p); });
    if (!plan) throw std::bad_alloc();
    return plan;
}

// All n x n frequencies of a complex plane, rows, then columns, in place.
void transform(std::vector<kiss_fft_cpx>& plane, int n) {
    const auto plan = complex_plan(n);
    std::vector<kiss_fft_cpx> line(static_cast<std::size_t>(n));
    for (int y = 0; y < n; ++y) {
        kiss_fft(plan.get(), plane.data() + index(n, 0, y), line.data());
        std::copy(line.begin(), line.end(), plane.begin() + static_cast<std::ptrdiff_t>(index(n, 0, y)));
    }
    for (int x = 0; x < n; ++x) {
        kiss_fft_stride(plan.get(), plane.data() + x, line.data(), n);
        for (int y = 0; y < n; ++y)
            plane[index(n, x, y)] = line[static_cast<std::size_t>(y)];
    }
}

double power_of(const kiss_fft_cpx& f) {
    return static_cast<double>(f.r) * static_cast<double>(f.r) +
           static_cast<double>(f.i) * static_cast<double>(f.i);
}

// Length of the chord of the line at height y inside [left, left + 1].
double chord_in(const Quad& q, double y, double left) {
    double from = left + 1;
    double to = left;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t j = (i + 1) % 4;
        const auto y0 = static_cast<double>(q.xy[2 * i + 1]);
        const auto y1 = static_cast<double>(q.xy[2 * j + 1]);
        if ((y0 <= y) == (y1 <= y)) continue;
        const double x = std::lerp(static_cast<double>(q.xy[2 * i]), static_cast<double>(q.xy[2 * j]),
                                   (y - y0) / (y1 - y0));
        from = std::min(from, x);
        to = std::max(to, x);
    }
    return std::max(0.0, std::min(to, left + 1) - std::max(from, left));
}

// Rows, then columns. (kiss_fftndr would do both, but returns null for sizes that the one-dimensional plans take.)
std::vector<kiss_fft_cpx> transform(const std::vector<float>& amplitude, int n) {
    const auto free_plan = [](void* plan) { kiss_fft_free(plan); };
    const std::unique_ptr<kiss_fftr_state, decltype(free_plan)> row_plan(
        kiss_fftr_alloc(n, 0, nullptr, nullptr), free_plan);
    const std::unique_ptr<kiss_fft_state, decltype(free_plan)> column_plan(
        kiss_fft_alloc(n, 0, nullptr, nullptr), free_plan);
    if (!row_plan || !column_plan) throw std::bad_alloc();
    const int columns = n / 2 + 1;
    std::vector<kiss_fft_cpx> spectrum(static_cast<std::size_t>(n) * static_cast<std::size_t>(columns));
    for (int y = 0; y < n; ++y)
        kiss_fftr(row_plan.get(), amplitude.data() + index(n, 0, y), spectrum.data() + index(columns, 0, y));
    std::vector<kiss_fft_cpx> column(static_cast<std::size_t>(n));
    for (int x = 0; x < columns; ++x) {
        kiss_fft_stride(column_plan.get(), spectrum.data() + x, column.data(), columns);
        for (int y = 0; y < n; ++y)
            spectrum[index(columns, x, y)] = column[static_cast<std::size_t>(y)];
    }
    return spectrum;
}

}  // namespace

std::vector<float> draw_eye_parts(const ApertureParts& parts, int n, double plane_width_mm) {
    std::vector<float> amplitude(static_cast<std::size_t>(n) * static_cast<std::size_t>(n), 1.0F);
    std::vector<Disc> discs;
    parts.place(0, n, plane_width_mm, discs);
    std::vector<float> clear(amplitude.size(), 1.0F);  // what no particle covers
    for (const Disc& disc : discs)
        for_each_covered(
            static_cast<double>(disc.x), static_cast<double>(disc.y), static_cast<double>(disc.radius), n,
            [&](int x, int y, double area) { clear[index(n, x, y)] *= static_cast<float>(1 - area); });
    const GratingShape gratings = parts.gratings(n, plane_width_mm);
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            float& value = amplitude[index(n, x, y)];
            value = 2 * clear[index(n, x, y)] - 1;
            if (gratings.count > 0)
                value *=
                    static_cast<float>(1 - static_cast<double>(gratings.depth) *
                                               grating_share(gratings, x + 0.5 - n / 2.0, y + 0.5 - n / 2.0));
        }
    }
    return amplitude;
}

std::vector<float> draw_pupil(int n, double radius_samples) {
    std::vector<float> coverage(static_cast<std::size_t>(n) * static_cast<std::size_t>(n), 0.0F);
    for_each_covered(n / 2.0, n / 2.0, radius_samples, n,
                     [&](int x, int y, double area) { coverage[index(n, x, y)] = static_cast<float>(area); });
    return coverage;
}

void cover(std::vector<float>& amplitude, int n, const std::vector<Quad>& veil) {
    if (veil.empty()) return;
    std::vector<double> covered(amplitude.size());
    constexpr int lines = 12;
    for (const Quad& q : veil) {
        const auto [left, right] = std::minmax({q.xy[0], q.xy[2], q.xy[4], q.xy[6]});
        const auto [low, high] = std::minmax({q.xy[1], q.xy[3], q.xy[5], q.xy[7]});
        const auto sample = [n](float v) {
            return static_cast<int>(std::clamp(std::floor(static_cast<double>(v)), 0.0, n - 1.0));
        };
        if (right < 0 || high < 0 || left > static_cast<float>(n) || low > static_cast<float>(n)) continue;
        for (int y = sample(low); y <= sample(high); ++y) {
            const double from = std::max<double>(y, static_cast<double>(low));
            const double to = std::min<double>(y + 1, static_cast<double>(high));
            for (int x = sample(left); x <= sample(right) && to > from; ++x)
                for (int s = 0; s < lines; ++s)
                    covered[index(n, x, y)] +=
                        (to - from) / lines * chord_in(q, from + (to - from) * (s + 0.5) / lines, x);
        }
    }
    for (std::size_t i = 0; i < amplitude.size(); ++i)
        amplitude[i] *= static_cast<float>(1 - std::min(covered[i], 1.0));
}

EnergySums::EnergySums(const std::vector<float>& amplitude, int n, double pupil_radius_samples) : n_(n) {
    if (n < 2) throw std::invalid_argument("EnergySums: a transform has at least two samples a side");
    const std::vector<kiss_fft_cpx> spectrum = transform(amplitude, n);
    sum_up(pupil_radius_samples, [&](int kx, int ky) {
        // F(-k) is the conjugate of F(k).
        return power_of(spectrum[index(n / 2 + 1, std::abs(kx), ((kx < 0 ? -ky : ky) + n) % n)]);
    });
}

EnergySums::EnergySums(const std::vector<float>& amplitude, int n, double pupil_radius_samples,
                       double phase_per_square)
    : n_(n) {
    if (n < 2) throw std::invalid_argument("EnergySums: a transform has at least two samples a side");
    std::vector<kiss_fft_cpx> plane(amplitude.size());
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            const double dx = x + 0.5 - n / 2.0;
            const double dy = y + 0.5 - n / 2.0;
            const double phase = phase_per_square * (dx * dx + dy * dy);
            const auto a = static_cast<double>(amplitude[index(n, x, y)]);
            plane[index(n, x, y)] = {static_cast<float>(a * std::cos(phase)),
                                     static_cast<float>(a * std::sin(phase))};
        }
    }
    transform(plane, n);
    sum_up(pupil_radius_samples,
           [&](int kx, int ky) { return power_of(plane[index(n, (kx + n) % n, (ky + n) % n)]); });
}

template <typename Power>
void EnergySums::sum_up(double pupil_radius_samples, Power power) {
    const int n = n_;
    const double open_area = std::numbers::pi * pupil_radius_samples * pupil_radius_samples;
    const double scale = 1 / (static_cast<double>(n) * n * open_area);
    std::vector<double> weight(static_cast<std::size_t>(n) + 1);
    for (int i = 0; i <= n; ++i) {
        const int k = i - n / 2;
        const double x = std::numbers::pi * k / n;
        const double sinc = k == 0 ? 1 : std::sin(x) / x;
        weight[static_cast<std::size_t>(i)] = (std::abs(k) == n / 2 ? 0.5 : 1.0) / (sinc * sinc);
    }
    const int side = n + 2;
    sums_.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0.0);
    for (int ky = -n / 2; ky <= n / 2; ++ky) {
        double row = 0;
        for (int kx = -n / 2; kx <= n / 2; ++kx) {
            const int i = kx + n / 2;
            const int j = ky + n / 2;
            row += power(kx, ky) * scale * weight[static_cast<std::size_t>(i)] *
                   weight[static_cast<std::size_t>(j)];
            sums_[index(side, i + 1, j + 1)] = sums_[index(side, i + 1, j)] + row;
        }
    }
}

double EnergySums::at(double x, double y) const {
    const double last = n_ + 1;
    const double ex = std::clamp(x + 0.5 * n_ + 0.5, 0.0, last);
    const double ey = std::clamp(y + 0.5 * n_ + 0.5, 0.0, last);
    const int i = std::min(static_cast<int>(ex), n_);
    const int j = std::min(static_cast<int>(ey), n_);
    const double tx = ex - i;
    const double ty = ey - j;
    const int side = n_ + 2;
    const double low = std::lerp(sums_[index(side, i, j)], sums_[index(side, i + 1, j)], tx);
    const double high = std::lerp(sums_[index(side, i, j + 1)], sums_[index(side, i + 1, j + 1)], tx);
    return std::lerp(low, high, ty);
}

double EnergySums::box(double x0, double x1, double y0, double y1) const {
    return at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0);
}

}  // namespace seaglare::glare
