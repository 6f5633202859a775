#include "glare/reference/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace seaglare::reference {

namespace {

constexpr double degrees = 180 / std::numbers::pi;
constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

// 1 inside, a half cosine down to 0.
double window_at(double sine, double inner, double outer) {
    const double t = std::clamp((sine - inner) / std::max(outer - inner, 1e-12), 0.0, 1.0);
    return 0.5 + 0.5 * std::cos(std::numbers::pi * t);
}

double core_share(double distance_nodes, double core_radius_nodes) {
    const double t = std::min(distance_nodes / core_radius_nodes, 1.0);
    return 0.5 + 0.5 * std::cos(std::numbers::pi * t);
}

double tail_sr(double sine, double age_years, double pigmentation) {
    const double theta = std::asin(std::min(sine, 1.0));
    const double t = std::clamp(std::cos(theta) / 0.17, 0.0, 1.0);  // the last ten degrees
    return cie_curve_sr(theta * degrees, age_years, pigmentation) * t * t * (3 - 2 * t);
}

Rgbv node_of(const glare::Pattern& pattern, std::size_t slot, std::size_t layer, int a, int b) {
    if (std::abs(a) > pattern.radius_nodes || std::abs(b) > pattern.radius_nodes) return {};
    const std::size_t side = 2 * static_cast<std::size_t>(pattern.radius_nodes) + 1;
    const std::size_t layers = pattern.layer_radius_nodes.size();
    const std::size_t at =
        ((slot * layers + layer) * side + static_cast<std::size_t>(b + pattern.radius_nodes)) * side +
        static_cast<std::size_t>(a + pattern.radius_nodes);
    Rgbv value{};
    for (std::size_t c = 0; c < 4; ++c)
        value[c] = static_cast<double>(pattern.skirt[4 * at + c]) * pattern.pitch * pattern.pitch;
    return value;
}

std::array<double, 3> cielab(const Rgbv& c, double white) {
    const std::array<double, 3> xyz = {(0.4124 * c[0] + 0.3576 * c[1] + 0.1805 * c[2]) / 0.9505,
                                       0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2],
                                       (0.0193 * c[0] + 0.1192 * c[1] + 0.9505 * c[2]) / 1.089};
    std::array<double, 3> f{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double t = xyz[i] / white;
        constexpr double knee = 6.0 / 29;
        f[i] = t > knee * knee * knee ? std::cbrt(t) : t / (3 * knee * knee) + 4.0 / 29;
    }
    return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

double delta_e(const Rgbv& made, const Rgbv& expected) {
    const double white = 0.2126 * expected[0] + 0.7152 * expected[1] + 0.0722 * expected[2];
    if (!(white > 0)) return no_value;
    const auto a = cielab(made, white);
    const auto b = cielab(expected, white);
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

void add(Rgbv& sum, const Rgbv& value) {
    for (std::size_t c = 0; c < 4; ++c)
        sum[c] += value[c];
}

}  // namespace

double tail_energy(double age_years, double pigmentation, double window_inner, double window_outer) {
    constexpr int steps = 40000;
    const double from = std::asin(std::min(window_inner, 1.0));
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        // Steps that grow with the angle: the curve falls as its square.
        const double t = (i + 0.5) / steps;
        const double span = std::numbers::pi / 2 - from;
        const double theta = from + span * t * t * t;
        const double sine = std::sin(theta);
        sum += tail_sr(sine, age_years, pigmentation) * (1 - window_at(sine, window_inner, window_outer)) *
               2 * std::numbers::pi * sine * span * 3 * t * t / steps;
    }
    return sum;
}

SplitReference split(const ReferencePattern& reference, const glare::EyeModel& eye,
                     const glare::Pattern& pattern, double core_radius_nodes) {
    if (std::abs(reference.pitch / pattern.pitch - 1) > 1e-9)
        throw std::invalid_argument("comparison: pattern and reference differ in pitch");
    SplitReference result;
    result.skirt.assign(reference.pixels.size(), Rgbv{});
    const bool has_tail = eye.cie_tail && pattern.angular_scale == 1.0;
    result.tail_scale = has_tail ? reference.transmitted : 0;
    const double energy =
        reference.transmitted - result.tail_scale * tail_energy(eye.age_years, eye.pigmentation,
                                                                pattern.window_inner, pattern.window_outer);
    Rgbv total{};
    const double pixel = reference.pitch * reference.pitch;
    std::size_t i = 0;
    for (int b = -reference.radius; b <= reference.radius; ++b) {
        for (int a = -reference.radius; a <= reference.radius; ++a, ++i) {
            const double distance = std::hypot(a, b);
            const double window =
                window_at(distance * reference.pitch, pattern.window_inner, pattern.window_outer);
            if (window <= 0) continue;
            const double in_core = core_share(distance, core_radius_nodes);
            const Rgbv value = reference.relative(a, b);
            for (std::size_t c = 0; c < 4; ++c) {
                total[c] += value[c] * window * pixel;
                result.core[c] += value[c] * window * pixel * in_core;
                result.skirt[i][c] = value[c] * window * pixel * (1 - in_core);
            }
        }
    }
    result.structure_scale = energy / total[1];
    for (std::size_t c = 0; c < 4; ++c) {
        result.core[c] *= energy / total[c];
        for (Rgbv& value : result.skirt)
            value[c] *= energy / total[c];
    }
    return result;
}

PatternError compare(const ReferencePattern& reference, const glare::EyeModel& eye,
                     const glare::Pattern& pattern, double core_radius_nodes, std::size_t slot,
                     std::size_t layer) {
    const SplitReference expected = split(reference, eye, pattern, core_radius_nodes);
    const std::vector<Rgbv> discs = average_over_disc(
        expected.skirt, reference.side(), static_cast<double>(pattern.layer_radius_nodes.at(layer)));
    PatternError error;
    error.structure_scale = expected.structure_scale;
    double apart = 0;
    double sum = 0;
    double total_apart = 0;
    double total_sum = 0;
    double peak = 0;
    double worst = 0;
    Rgbv core_made = {};
    Rgbv core_expected = {};
    Rgbv ring_made = {};
    Rgbv ring_expected = {};
    std::vector<double> ring_sum(static_cast<std::size_t>(reference.radius) + 1);
    std::vector<double> ring_count(ring_sum.size());
    const auto for_each = [&](auto visit) {
        std::size_t i = 0;
        for (int b = -reference.radius; b <= reference.radius; ++b)
            for (int a = -reference.radius; a <= reference.radius; ++a, ++i)
                if (std::hypot(a, b) <= reference.radius) visit(a, b, i);
    };
    for_each([&](int a, int b, std::size_t i) {
        const auto ring = static_cast<std::size_t>(std::hypot(a, b));
        ring_sum[ring] += discs[i][1];
        ring_count[ring] += 1;
    });
    for_each([&](int a, int b, std::size_t i) {
        const Rgbv made = node_of(pattern, slot, layer, a, b);
        const double sine = std::hypot(a, b) * reference.pitch;
        const double angle_deg = std::asin(std::min(sine, 1.0)) * degrees;
        const double ring_mean = ring_sum[static_cast<std::size_t>(std::hypot(a, b))] /
                                 ring_count[static_cast<std::size_t>(std::hypot(a, b))];
        // The product draws the tail by its own curve; what the two disagree in here is how much of it there is.
        const double tail = sine > pattern.window_inner
                                ? tail_sr(sine, eye.age_years, eye.pigmentation) * reference.pitch *
                                      reference.pitch *
                                      (1 - window_at(sine, pattern.window_inner, pattern.window_outer))
                                : 0;
        for (std::size_t c = 0; c < 4; ++c) {
            const double difference = std::abs(made[c] - discs[i][c]);
            apart += difference;
            sum += std::abs(discs[i][c]);
            worst = std::max(worst, difference);
            peak = std::max(peak, std::abs(discs[i][c]));
            error.worst_relative = std::max(
                error.worst_relative, sine < pattern.window_inner
                                          ? difference / (std::abs(discs[i][c]) + 0.1 * std::abs(ring_mean))
                                          : 0);
            // What the eye makes there, in the field that the reference has.
            const double truth = reference.relative(a, b)[c] * reference.pitch * reference.pitch *
                                 (1 - core_share(std::hypot(a, b), core_radius_nodes));
            total_apart += std::abs(made[c] + pattern.tail_scale * tail - truth);
            total_sum += std::abs(truth);
        }
        if (angle_deg < core_zone.outer_deg) {
            add(core_made, made);
            add(core_expected, discs[i]);
        }
        if (angle_deg > ring_zone.inner_deg && angle_deg < ring_zone.outer_deg) {
            add(ring_made, made);
            add(ring_expected, discs[i]);
        }
    });
    error.skirt_l1 = apart / sum;
    error.worst_of_peak = worst / peak;
    for (std::size_t c = 0; c < 4; ++c) {
        const auto core = static_cast<double>(pattern.core_energy[slot][c]);
        core_made[c] += core;
        core_expected[c] += expected.core[c];
        apart += std::abs(core - expected.core[c]);
        sum += std::abs(expected.core[c]);
        double truth = 0;
        for_each([&](int a, int b, std::size_t) {
            truth += reference.relative(a, b)[c] * reference.pitch * reference.pitch *
                     core_share(std::hypot(a, b), core_radius_nodes);
        });
        total_apart += std::abs(core - truth);
        total_sum += std::abs(truth);
    }
    error.relative_l1 = apart / sum;
    error.total_l1 = layer == 0 ? total_apart / total_sum : no_value;
    error.core_energy = static_cast<double>(pattern.core_energy[slot][1]) - expected.core[1];
    error.core_delta_e = delta_e(core_made, core_expected);
    const bool has_ring =
        std::asin(std::min(pattern.window_outer, 1.0)) * degrees > ring_zone.outer_deg &&
        std::asin(std::min(reference.radius * reference.pitch, 1.0)) * degrees > ring_zone.outer_deg;
    error.ring_delta_e = has_ring ? delta_e(ring_made, ring_expected) : no_value;
    return error;
}

double disc_error(const ReferencePattern& reference, const glare::EyeModel& eye,
                  const glare::Pattern& pattern, double core_radius_nodes, double radius_nodes) {
    const SplitReference expected = split(reference, eye, pattern, core_radius_nodes);
    const std::vector<Rgbv> disc = average_over_disc(expected.skirt, reference.side(), radius_nodes);
    const auto& radii = pattern.layer_radius_nodes;
    std::size_t upper = 0;
    while (upper + 1 < radii.size() && static_cast<double>(radii[upper]) < radius_nodes)
        ++upper;
    const std::size_t lower = upper == 0 ? 0 : upper - 1;
    const auto square = [&](std::size_t l) { return std::pow(static_cast<double>(radii[l]), 2); };
    const double span = square(upper) - square(lower);
    const double t =
        span > 0 ? std::clamp((radius_nodes * radius_nodes - square(lower)) / span, 0.0, 1.0) : 1.0;
    double apart = 0;
    double sum = 0;
    std::size_t i = 0;
    for (int b = -reference.radius; b <= reference.radius; ++b) {
        for (int a = -reference.radius; a <= reference.radius; ++a, ++i) {
            const Rgbv low = node_of(pattern, 0, lower, a, b);
            const Rgbv high = node_of(pattern, 0, upper, a, b);
            for (std::size_t c = 0; c < 4; ++c) {
                apart += std::abs((1 - t) * low[c] + t * high[c] - disc[i][c]);
                sum += std::abs(disc[i][c]);
            }
        }
    }
    return apart / sum;
}

}  // namespace seaglare::reference
