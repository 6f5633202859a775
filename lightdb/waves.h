// The sea as a sum of sinusoids that the host supplies, by linear wave theory. Pure functions of place and absolute time.
#pragma once

#include <span>

#include "lightdb/vector_math.h"

namespace seaglare::lightdb {

inline constexpr double gravity_m_s2 = 9.80665;  // standard gravity

// Elevation a cos(k . x - w t + phase), x from the scene's origin.
struct WaveComponent {
    double amplitude_m = 0;
    double direction_deg = 0;  // towards which it runs, clockwise from the scene's north
    double angular_frequency_rad_s = 0;
    double wavenumber_rad_m = 0;
    double phase_rad = 0;
    friend bool operator==(const WaveComponent&, const WaveComponent&) = default;
};

// Dispersion in water of a depth in m, infinity: deep. w^2 = g k tanh(k h) (Airy 1845). Arguments above 0.
double angular_frequency_of(double wavenumber_rad_m, double depth_m);
double wavenumber_of(double angular_frequency_rad_s, double depth_m);  // the inverse, to the last digits

// The amplitude beyond which a wave breaks: 0.142 tanh(k h) of its length from trough to crest (Miche 1944; in deep water
// Michell 1893).
double breaking_amplitude_m(double wavenumber_rad_m, double depth_m);

// One sinusoid of that length, its frequency by dispersion; an amplitude beyond breaking is cut to it.
WaveComponent wave_of_length(double amplitude_m, double direction_deg, double wavelength_m, double phase_rad,
                             double depth_m);
// The same by its angular frequency.
WaveComponent wave_of_frequency(double amplitude_m, double direction_deg, double angular_frequency_rad_s,
                                double phase_rad, double depth_m);

// The surface at a point of the scene.
struct SeaSurface {
    double elevation_m = 0;
    double slope_east = 0;  // of the surface, rise over run
    double slope_north = 0;
};
SeaSurface sea_surface(std::span<const WaveComponent> waves, double east_m, double north_m, double time_s);

}  // namespace seaglare::lightdb
