#include "glare/eye/eye_instant.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seaglare::glare {

namespace {

double share(double value) {
    return value > 0 ? std::min(value, 1.0) : 0;
}

}  // namespace

EyeInstant eye_instant(const EyeModel& eye, double pupil_mm, double time_s, const LidPose& lids,
                       double vitreous_roll_rad, std::uint64_t seed) {
    if (!std::isfinite(time_s)) time_s = 0;
    EyeInstant now;
    now.pupil_mm = pupil_mm;
    const auto any = [&eye](auto&& holds) {
        return std::any_of(eye.particles.begin(), eye.particles.end(),
                           [&](const ParticleFamily& family) { return family.count > 0 && holds(family); });
    };
    if (any([](const ParticleFamily& f) { return f.drift_um > 0; })) now.time_s = time_s;
    if (any([](const ParticleFamily& f) { return f.site == ParticleSite::vitreous; }) &&
        std::isfinite(vitreous_roll_rad))
        now.vitreous_roll_rad = vitreous_roll_rad;
    now.lid_closure = 1 - (1 - share(eye.lids.closure)) * (1 - share(lids.squint)) * (1 - share(lids.blink));
    now.defocus_dioptre = std::isfinite(eye.defocus_dioptre) ? eye.defocus_dioptre : 0;
    if (eye.accommodation.slow_dioptre > 0 || eye.accommodation.quick_dioptre > 0) {
        now.lens_scale = lens_scale(eye.accommodation, pupil_mm, time_s, seed);
        if (eye.accommodation_moves_focus)
            now.defocus_dioptre += accommodation_dioptre(eye.accommodation, pupil_mm, time_s, seed);
    }
    return now;
}

double defocus_phase(double dioptre, int n, double plane_width_mm) {
    constexpr double wavelength_m = 575e-9;
    const double sample_m = plane_width_mm * 1e-3 / n;
    return std::numbers::pi * dioptre / wavelength_m * sample_m * sample_m;
}

}  // namespace seaglare::glare
