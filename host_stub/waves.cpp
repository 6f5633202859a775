#include "host_stub/waves.h"

#include <cmath>
#include <numbers>

namespace seaglare::host {

Sea make_sea(double wind_speed_m_s, double wind_from_deg) {
    constexpr double deg = std::numbers::pi / 180;
    constexpr double gravity_m_s2 = 9.81;
    constexpr double longest_m = 30, shortest_m = 0.35;
    // Of the slope's variance; long waves carry height, short ones slope.
    constexpr double resolved_share = 0.5;
    Sea sea;
    sea.slope_variance = (0.003 + 0.00512 * wind_speed_m_s) / 2;
    const double per_wave = 2 * sea.slope_variance * resolved_share / wave_count;
    for (int i = 0; i < wave_count; ++i) {
        Wave& w = sea.waves[static_cast<std::size_t>(i)];
        const double u = (i + 0.5) / wave_count;
        const double length_m = longest_m * std::pow(shortest_m / longest_m, u);
        // Directions without a pattern, or crests would cross in a lattice; wider for short waves.
        const double a = std::fmod(0.137 + i * 0.6180339887498949, 1.0),
                     b = std::fmod(0.731 + i * 0.3247179572447460, 1.0);
        const double spread = a + b - 1;  // triangular
        const double towards = (wind_from_deg + 180 + spread * (40 + 70 * u)) * deg;
        const double k = 2 * std::numbers::pi / length_m;
        w.wave_vector_rad_m = {k * std::sin(towards), k * std::cos(towards)};
        w.frequency_rad_s = std::sqrt(gravity_m_s2 * k);
        // Variance of a sine of amplitude a is a^2/2; swell longer than the wind's own waves is weak.
        const double grown = std::min(1.0, wind_speed_m_s * wind_speed_m_s * 0.6 / length_m);
        w.slope = std::sqrt(2 * per_wave * grown);
        w.phase_rad = 2 * std::numbers::pi * std::fmod(0.3 + i * 0.7548776662466927, 1.0);
    }
    return sea;
}

}  // namespace seaglare::host
