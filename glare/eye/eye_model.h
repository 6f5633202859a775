// The eye as numbers: what its aperture is made of, and how wide its pupil stands. Pure data and pure functions.
// Sources: Moon & Spencer 1944 (pupil); Ritschel et al. 2009, "Temporal Glare" (parts of the aperture); CIE 135/1-1999
// (the curve that the counts and sizes were fitted to). The eyes below equal the files of config/eye.
#pragma once

#include <cstdint>
#include <vector>

#include "glare/eye/accommodation.h"
#include "glare/eye/lids.h"

namespace seaglare::glare {

// What carries a family of particles, and so what moves it: the cornea stands still, the lens is strained by
// accommodation, the vitreous body turns after the head.
enum class ParticleSite : std::uint8_t { cornea, lens, vitreous };

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
    ParticleSite site = ParticleSite::cornea;
    friend bool operator==(const ParticleFamily&, const ParticleFamily&) = default;
};

// Radial fibres in the lens periphery: lines at equal angles between two radii.
struct LensGratings {
    int count = 0;
    double inner_radius_mm = 3.0;
    double outer_radius_mm = 3.4;
    double duty = 0.5;    // opaque fraction of a period
    double depth = 0.35;  // amplitude taken by a line: 0 none, 1 opaque
    friend bool operator==(const LensGratings&, const LensGratings&) = default;
};

// Lashes of the upper lid that hang before the pupil: opaque, tapered, curved. Four to eight stand before a pupil, at
// random angles about the normal of the lid with a standard deviation of 10 to 30 degrees (Nakamae et al. 1990). Width,
// length and curvature are ours. They hang about a centimetre before the eye: another place in the field of view has other
// lashes before the pupil. The pattern is one for all lights, so that is told to the picture as a turn and a bend.
struct Eyelashes {
    int count = 0;  // 0: none
    double mean_angle_deg = 0;
    double spread_deg = 20;
    double width_um = 100;           // at the root
    double length_mm = 7;            // as seen from the front
    double curvature_per_mm = 0.1;   // largest; each lash has its own, to either side
    std::uint64_t seed = 0;          // beside the context's
    double streak_turn_deg = 8;      // of the streaks, at most, to either side across the picture
    double streak_bend_per_rad = 1;  // how far a streak leaves its straight line: bend times angle squared
    friend bool operator==(const Eyelashes&, const Eyelashes&) = default;
};

// The lids' margins before the pupil's plane, and their movement. With margins of an open eye they cover no pupil of up
// to 8.5 mm. The upper margin stands 4 to 4.5 mm above the pupil's centre, the opening is 8 to 12 mm high (margin reflex
// distance and palpebral fissure of clinical practice). In a blink the lower lid hardly rises.
struct Lids {
    double closure = 0;  // standing: 0 open, 1 shut; squint and blink come on top
    LidMotion motion;
    double upper_margin_mm = 4.5;  // above the centre, open
    double lower_margin_mm = 5;    // below it
    double lower_share = 0.05;     // of the opening that the lower lid closes
    double edge_radius_mm = 12;    // of the margins' arch, open; it flattens as they close
    friend bool operator==(const Lids&, const Lids&) = default;
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
    bool cie_calibrated = false;            // inside it its radial average does (psf/cie_calibration.h)
    bool pupil_shrinks_with_age = false;    // otherwise the age counts for the CIE curve alone
    Eyelashes eyelashes;
    Lids lids;
    AccommodationMotion accommodation;
    bool accommodation_moves_focus = false;  // otherwise it strains the lens and no more
    double defocus_dioptre = 0;              // residual; positive: focused nearer than the light
    double vitreous_drag_per_s = 2;          // how fast the cloud in the vitreous body comes to rest
    bool adapts = false;  // adaptation takes time; otherwise it is at once what the frame says
    friend bool operator==(const EyeModel&, const EyeModel&) = default;
};

// 24 years, brown eyes. Its radial average follows the CIE curve within tens of per cent from 0.1 to 8 degrees; its
// parameters were fitted to that curve, not to anatomy. The gratings lie outside a 5 mm pupil: a halo only at night.
EyeModel young_eye();
// 60 years: more haze, a pupil that stays at 5 mm, no halo.
EyeModel sixty_year_eye();
// The aperture of Ritschel et al. 2009 as the 2012 thesis drew it: 200 gratings, 750 lens particles. Meant to be
// magnified (thesis_settings in glare/psf/pattern.h); at its true angles the ring stands at 0.33 degrees.
EyeModel thesis_eye();

// The young eye with all that moves and hangs before it: lashes, blink and squint, accommodation, drifting particles,
// adaptation in time.
EyeModel young_eye_with_lashes();
// The same without lashes.
EyeModel no_lash_eye();
// A round hole: no particles, no gratings, no hippus, no curve beyond its own diffraction.
EyeModel circular_pupil_eye();

// The fraction of the light on an open pupil of this diameter that the eye passes: 1 but for what gratings absorb,
// because particles only delay the wave. Lids and lashes are not in it: veil.h. This is what core, skirt and tail of a
// pattern add up to.
double transmitted_fraction(const EyeModel& eye, double pupil_mm);

// Mean pupil diameter in mm for an adaptation luminance in cd/m2: p = 4.9 - 3 tanh(0.4 (log10 L + 1)), Moon & Spencer
// 1944. Finite for every input: L <= 1e-6 or NaN counts as 1e-6, L > 1e6 as 1e6.
double mean_pupil_diameter_mm(double adaptation_luminance_cd_m2);

// What age makes of a pupil: D + (age - 28.58) (0.02132 - 0.009562 D), the term of the unified formula of Watson & Yellott
// 2012 (J. Vision 12(10):12), which has it for the Stanley & Davies diameter D; here D is Moon & Spencer's. The age is
// clamped to 20 ... 83 years, where the formula holds.
double aged_pupil_diameter_mm(double diameter_mm, double age_years);

// The diameter that a pupil swings about: fixed, or from the luminance and, where the eye has it, the age. Clamped as below.
double resting_pupil_diameter_mm(const EyeModel& eye, double adaptation_luminance_cd_m2);

// Pupil diameter at an instant: the mean plus hippus, a smooth noise that is a pure function of (seed, time). Clamped
// to 1.5 ... 8.5 mm. The noise has the form of Ritschel et al. 2009, n(t/period) (9/p) sqrt(1 - p/9), with a fixed
// period, because a phase t/p jumps whenever p changes.
double pupil_diameter_mm(const EyeModel& eye, double adaptation_luminance_cd_m2, double time_s,
                         std::uint64_t seed);

}  // namespace seaglare::glare
