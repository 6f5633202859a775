// The sea as a handful of sine waves that can be resolved and a Gaussian rest that cannot.
#pragma once

#include <array>
#include <glm/vec2.hpp>

namespace seaglare::host {

struct Wave {
    glm::dvec2 wave_vector_rad_m{};  // towards where it runs
    double frequency_rad_s = 0;      // deep water: sqrt(g k)
    double slope = 0;                // amplitude of the slope
    double phase_rad = 0;
};

inline constexpr int wave_count = 36;

struct Sea {
    std::array<Wave, wave_count> waves{};
    double slope_variance = 0;  // of everything, one axis: half of Cox and Munk's total
};

// Total mean square slope of a clean sea, 0.003 + 0.00512 U: Cox and Munk, J. Opt. Soc. Am. 44 (1954) 838.
// The sine waves, 0.35 to 30 m long, carry a part of it; ripples too short to see from a bridge carry the
// rest.
Sea make_sea(double wind_speed_m_s, double wind_from_deg);

}  // namespace seaglare::host
