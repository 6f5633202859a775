#include "glare/apply/footprint.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seaglare::glare {

namespace {

constexpr double pi = std::numbers::pi;

// Integral of the Hann window (1 + cos(2 pi t/w))/w, |t| <= w/2.
double hann_integral(double x_px) {
    const double t = std::clamp(x_px / kernel_hann_px, -0.5, 0.5);
    return 0.5 + t + std::sin(2 * pi * t) / (2 * pi);
}

// Integral of hann_integral.
double hann_second_integral(double x_px) {
    const double t = std::max(x_px / kernel_hann_px, -0.5);
    if (t >= 0.5) return x_px;
    return kernel_hann_px * (t * t / 2 + t / 2 + 0.125 - (1 + std::cos(2 * pi * t)) / (4 * pi * pi));
}

}  // namespace

double kernel(double x_px) {
    return (hann_integral(x_px + 1) - hann_integral(x_px - 1)) / 2;
}

double kernel_integral(double x_px) {
    return std::clamp((hann_second_integral(x_px + 1) - hann_second_integral(x_px - 1)) / 2, 0.0, 1.0);
}

double disc_share(double radius_px) {
    const double ratio = std::clamp(radius_px / smallest_disc_px, 0.0, 1.0);
    const double come_in = (radius_px - point_until_px) / (mixed_from_px - point_until_px);
    return std::clamp(come_in, 0.0, 1.0) * ratio * ratio;
}

std::array<DiscRow, 12> disc_rows() {
    std::array<DiscRow, 12> rows{};
    const double step_rad = pi / (static_cast<double>(rows.size()) + 1);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double angle_rad = (static_cast<double>(i) + 1) * step_rad;
        const double sine = std::sin(angle_rad);
        rows[i] = {std::cos(angle_rad), sine, 2 * sine * sine * step_rad / pi};
    }
    return rows;
}

double core_weight(double x_px, double y_px, const std::array<double, 4>& px_from_disc, double radius_px) {
    const double point = kernel(x_px) * kernel(y_px);
    if (radius_px <= point_until_px) return point;
    const double share = disc_share(radius_px);
    const double scale = std::max(smallest_disc_px / radius_px, 1.0);
    std::array<double, 4> m{};
    for (std::size_t i = 0; i < m.size(); ++i)
        m[i] = scale * px_from_disc[i];
    // The ellipse M u, |u| <= 1, cut by horizontal lines: its extent, the lean of the chords' middles, their length.
    const double xx = m[0] * m[0] + m[2] * m[2];
    const double xy = m[0] * m[1] + m[2] * m[3];
    const double yy = m[1] * m[1] + m[3] * m[3];
    const double reach_y = std::sqrt(yy);
    const double widest = std::sqrt(std::max(xx - xy * xy / yy, 0.0));
    double disc = 0;
    for (const DiscRow& row : disc_rows()) {
        const double row_y = row.height * reach_y;
        const double x = x_px - row_y * xy / yy;
        const double c = widest * row.half_width;
        disc +=
            row.weight * kernel(y_px - row_y) * (kernel_integral(x + c) - kernel_integral(x - c)) / (2 * c);
    }
    return (1 - share) * point + share * disc;
}

}  // namespace seaglare::glare
