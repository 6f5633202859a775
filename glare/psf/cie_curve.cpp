#include "glare/psf/cie_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seaglare::glare {

double cie_total_glare_sr(double angle_deg, double age_years, double pigmentation) {
    const double a = std::pow(age_years / 70, 4);
    const double p = pigmentation;
    const auto bell = [angle_deg](double width_deg) { return 1 + std::pow(angle_deg / width_deg, 2); };
    const double diffraction = 9.2e6 / std::pow(bell(0.0046), 1.5) + 1.5e5 / std::pow(bell(0.045), 1.5);
    const double scatter = 400 / bell(0.1) + 3e-8 * angle_deg * angle_deg +
                           p * (1300 / std::pow(bell(0.1), 1.5) + 0.8 / std::sqrt(bell(0.1)));
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
