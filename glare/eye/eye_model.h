// The eye as numbers: what its aperture is made of, and how wide its pupil stands. Pure data and pure functions.
// Sources: Moon & Spencer 1944 (pupil); Ritschel et al. 2009, "Temporal Glare" (parts of the aperture); CIE 135/1-1999
// (the curve that the counts and sizes were fitted to). The eyes below equal the files of config/eye.
#pragma once

#include <cstdint>
#include <vector>

namespace seaglare::glare {

// A family of discs of half-wave transmission (-1): lossless scatterers. Diameters follow d^-exponent between the
// limits; positions are uniform in a disc of radius `field_radius_mm`.
struct ParticleFamily {
    int count = 0;
    double min_diameter_um = 4.5;
    double max_diameter_um = 25;
    double exponent = 2.6;
    double field_radius_mm = 4;
    double drift_um = 0;  // amplitude of the slow drift of the whole family
    double drift_period_s = 10;
};

// Radial fibres in the lens periphery: lines at equal angles between two radii.
struct LensGratings {
    int count = 0;
    double inner_radius_mm = 3.0;
    double outer_radius_mm = 3.4;
    double duty = 0.5;    // opaque fraction of a period
    double depth = 0.35;  // amplitude taken by a line: 0 none, 1 opaque
};

struct EyeModel {
    double age_years = 24;
    double pigmentation = 0.5;  // CIE 135/1: 0 very dark, 0.5 brown, 1 green, 1.2 light blue
    double fixed_pupil_mm = 0;  // 0: from the adaptation luminance
    double hippus_amplitude_mm = 0.15;
    double hippus_period_s = 1.2;
    LensGratings gratings;
    std::vector<ParticleFamily> particles;  // lens, cornea, vitreous
    bool cie_tail = true;                   // beyond the simulated field the PSF follows the CIE curve
};

// 24 years, brown eyes. Its radial average follows the CIE curve within tens of per cent from 0.1 to 8 degrees; its
// parameters were fitted to that curve, not to anatomy. The gratings lie outside a 5 mm pupil: a halo only at night.
EyeModel young_eye();
// 60 years: more haze, a pupil that stays at 5 mm, no halo.
EyeModel sixty_year_eye();
// The aperture of Ritschel et al. 2009 as the 2012 thesis drew it: 200 gratings, 750 lens particles. Meant to be
// magnified (thesis_settings in glare/psf/pattern.h); at its true angles the ring stands at 0.33 degrees.
EyeModel thesis_eye();

// The fraction of the light on an open pupil of this diameter that the eye passes: 1 but for what gratings absorb,
// because particles only delay the wave. This is what core, skirt and tail of a pattern add up to.
double transmitted_fraction(const EyeModel& eye, double pupil_mm);

// Mean pupil diameter in mm for an adaptation luminance in cd/m2: p = 4.9 - 3 tanh(0.4 (log10 L + 1)), Moon & Spencer
// 1944. Finite for every input: L <= 1e-6 or NaN counts as 1e-6, L > 1e6 as 1e6.
double mean_pupil_diameter_mm(double adaptation_luminance_cd_m2);

// Pupil diameter at an instant: the mean plus hippus, a smooth noise that is a pure function of (seed, time). Clamped
// to 1.5 ... 8.5 mm. The noise has the form of Ritschel et al. 2009, n(t/period) (9/p) sqrt(1 - p/9), with a fixed
// period, because a phase t/p jumps whenever p changes.
double pupil_diameter_mm(const EyeModel& eye, double adaptation_luminance_cd_m2, double time_s,
                         std::uint64_t seed);

}  // namespace seaglare::glare
