// The lens never holds quite still: its focus fluctuates, and with it the particles and gratings that it carries draw
// together and apart. A pure function of (seed, absolute time).
#pragma once

#include <cstdint>

namespace seaglare::glare {

// Ritschel et al. 2009 name two parts: slow and noise-like, below 0.6 Hz, stronger for a wide pupil; and quicker and small,
// 1.3 to 2.1 Hz. Their amplitudes are not known to us: these are plausible ones. 0: that part is off and costs nothing.
struct AccommodationMotion {
    double slow_dioptre = 0;  // amplitude at a 7 mm pupil; it grows with the pupil's diameter
    double quick_dioptre = 0;
    double lens_strain_per_dioptre =
        0.004;  // relative change of the lens's radius, equatorial, for one dioptre
    friend bool operator==(const AccommodationMotion&, const AccommodationMotion&) = default;
};

// Focus away from its mean, dioptres; at most slow + quick in size.
double accommodation_dioptre(const AccommodationMotion& motion, double pupil_mm, double time_s,
                             std::uint64_t seed);

// What the lens's particles and gratings are scaled by about the axis: near 1. More power is a rounder, narrower lens.
double lens_scale(const AccommodationMotion& motion, double pupil_mm, double time_s, std::uint64_t seed);

}  // namespace seaglare::glare
