#include "lightdb/waves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seaglare::lightdb {

namespace {

WaveComponent wave(double amplitude_m, double direction_deg, double angular_frequency_rad_s,
                   double wavenumber_rad_m, double phase_rad, double depth_m) {
    return {std::min(amplitude_m, breaking_amplitude_m(wavenumber_rad_m, depth_m)), direction_deg,
            angular_frequency_rad_s, wavenumber_rad_m, phase_rad};
}

}  // namespace

double angular_frequency_of(double wavenumber_rad_m, double depth_m) {
    return std::sqrt(gravity_m_s2 * wavenumber_rad_m * std::tanh(wavenumber_rad_m * depth_m));
}

double wavenumber_of(double angular_frequency_rad_s, double depth_m) {
    const double deep = angular_frequency_rad_s * angular_frequency_rad_s / gravity_m_s2;
    const double y = deep * depth_m;  // of x tanh x = y, x = k h
    // tanh is 1 to the last digit; also where the depth is infinite.
    if (!(y < 20)) return deep;
    // Newton: x tanh x is convex, so from the second step on it comes down to the root.
    double x = std::max(std::sqrt(y), y);
    for (int i = 0; i < 50; ++i) {
        const double t = std::tanh(x);
        const double step = (x * t - y) / (t + x * (1 - t * t));
        x -= step;
        if (std::abs(step) <= 1e-16 * x) break;
    }
    return x / depth_m;
}

double breaking_amplitude_m(double wavenumber_rad_m, double depth_m) {
    const double length_m = 2 * std::numbers::pi / wavenumber_rad_m;
    return 0.142 * length_m * std::tanh(wavenumber_rad_m * depth_m) / 2;
}

WaveComponent wave_of_length(double amplitude_m, double direction_deg, double wavelength_m, double phase_rad,
                             double depth_m) {
    const double k = 2 * std::numbers::pi / wavelength_m;
    return wave(amplitude_m, direction_deg, angular_frequency_of(k, depth_m), k, phase_rad, depth_m);
}

WaveComponent wave_of_frequency(double amplitude_m, double direction_deg, double angular_frequency_rad_s,
                                double phase_rad, double depth_m) {
    return wave(amplitude_m, direction_deg, angular_frequency_rad_s,
                wavenumber_of(angular_frequency_rad_s, depth_m), phase_rad, depth_m);
}

SeaSurface sea_surface(std::span<const WaveComponent> waves, double east_m, double north_m, double time_s) {
    SeaSurface sea;
    for (const WaveComponent& wave : waves) {
        const double direction_rad = wave.direction_deg * std::numbers::pi / 180;
        const double k_east = wave.wavenumber_rad_m * std::sin(direction_rad);
        const double k_north = wave.wavenumber_rad_m * std::cos(direction_rad);
        const double phase =
            k_east * east_m + k_north * north_m - wave.angular_frequency_rad_s * time_s + wave.phase_rad;
        sea.elevation_m += wave.amplitude_m * std::cos(phase);
        sea.slope_east -= wave.amplitude_m * k_east * std::sin(phase);
        sea.slope_north -= wave.amplitude_m * k_north * std::sin(phase);
    }
    return sea;
}

}  // namespace seaglare::lightdb
