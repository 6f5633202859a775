#include "glare/psf/cie_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seaglare::glare {

double cie_total_glare_sr(double angle_deg, double age_years, double pigmentation) {
    const double t = std::clamp(angle_deg, 0.0, 90.0);
    const double a = std::pow(age_years / 70, 4);
    const double p = pigmentation;
    const auto falloff = [t](double width_deg) { return 1 / (1 + (t / width_deg) * (t / width_deg)); };
    const double core = falloff(0.0046);
    const double ring = falloff(0.045);
    const double wide = falloff(0.1);
    const double diffraction = 9.2e6 * core * std::sqrt(core) + 1.5e5 * ring * std::sqrt(ring);
    const double scatter =
        400 * wide + 3e-8 * t * t + p * (1300 * wide * std::sqrt(wide) + 0.8 * std::sqrt(wide));
    return ((1 - 0.08 * a) * diffraction + (1 + 1.6 * a) * scatter + 2.5e-3 * p) /
           (1 + p * (0.0417 + 0.055 * a));
}

double fade_window(double sine, double inner, double outer) {
    if (sine <= inner) return 1;
    if (sine >= outer) return 0;
    return 0.5 * (1 + std::cos(std::numbers::pi * (sine - inner) / (outer - inner)));
}

double cie_tail_energy(double age_years, double pigmentation, double window_inner, double window_outer) {
    // Simpson's rule over ln(theta): the integrand theta^2 f(theta) is smooth there over five decades.
    const double from = std::log(std::asin(std::clamp(window_inner, 1e-7, 1.0)));
    const double to = std::log(std::numbers::pi / 2);
    constexpr int intervals = 2000;
    const double step = (to - from) / intervals;
    double sum = 0;
    for (int i = 0; i <= intervals; ++i) {
        const double theta = std::exp(from + step * i);
        const double sine = std::sin(theta);
        const double fade = std::clamp(std::cos(theta) / 0.17, 0.0, 1.0);
        const double value = cie_total_glare_sr(theta * 180 / std::numbers::pi, age_years, pigmentation) *
                             (1 - fade_window(sine, window_inner, window_outer)) * fade * fade *
                             (3 - 2 * fade) * 2 * std::numbers::pi * sine * theta;
        const int weight = i == 0 || i == intervals ? 1 : (i % 2 == 1 ? 4 : 2);
        sum += weight * value;
    }
    return sum * step / 3;
}

}  // namespace seaglare::glare
