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

std::array<DiscNode, 7> small_disc_nodes() {
    std::array<DiscNode, 7> nodes{};
    nodes[0] = {0, 0, 0.25};
    const double radius = std::sqrt(2.0 / 3);
    for (int i = 0; i < 6; ++i) {
        nodes[static_cast<std::size_t>(i) + 1] = {radius * std::cos(i * pi / 3),
                                                  radius * std::sin(i * pi / 3), 0.125};
    }
    return nodes;
}

}  // namespace seaglare::glare
