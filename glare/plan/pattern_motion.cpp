#include "glare/plan/pattern_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "glare/apply/glare_bound.h"

namespace seaglare::glare {

namespace {

// What the table in glare/psf/README.md was fitted at: a pupil by starlight, 720 lines over 45 degrees, the young eye's hippus.
constexpr double fitted_pupil_mm = 6.9;
constexpr double fitted_pitch = 1.0 / 869;
constexpr double fitted_hippus_mm = 0.15;
constexpr double core_at_fit = 0.005;
constexpr double skirt_at_fit = 0.5;
// No pattern is further from another of the same energy.
constexpr MotionSpread anything{1, std::numeric_limits<double>::infinity()};

bool moves(const EyeModel& eye) {
    const bool drifts = std::any_of(eye.particles.begin(), eye.particles.end(),
                                    [](const ParticleFamily& f) { return f.count > 0 && f.drift_um > 0; });
    const AccommodationMotion& lens = eye.accommodation;
    return drifts || eye.hippus_amplitude_mm > 0 || lens.slow_dioptre > 0 || lens.quick_dioptre > 0;
}

// Of the skirt's spread, what its inner nodes have: close to the light the core's own rings stand, which a pupil that swings
// moves little.
double share_at(double nodes) {
    return std::min(1.0, 0.1 + 0.15 * nodes);
}

}  // namespace

MotionSpread motion_spread(const EyeModel& eye, const PatternSettings& settings, double resting_pupil_mm,
                           double pitch) {
    // A blink takes all of the light away; focus moves the core; a magnified pattern was not measured.
    const bool blinks = eye.lids.motion.blink_interval_s > 0;
    if (blinks || settings.angular_scale != 1 || !(resting_pupil_mm > 0) || !(pitch > 0)) return anything;
    if (!moves(eye)) return {};
    const AccommodationMotion& lens = eye.accommodation;
    if (eye.accommodation_moves_focus && (lens.slow_dioptre > 0 || lens.quick_dioptre > 0)) return anything;
    const double finer = std::sqrt(std::max(fitted_pitch / pitch, 0.25));
    const double narrower = fitted_pupil_mm / std::min(resting_pupil_mm, fitted_pupil_mm);
    const double swing = std::max(eye.hippus_amplitude_mm / fitted_hippus_mm, 1.0);
    MotionSpread spread;
    spread.core = std::min(1.0, core_at_fit * finer * std::pow(narrower, 2.5) * swing);
    spread.skirt = skirt_at_fit * finer * std::pow(narrower, 1.2) * swing;
    return spread;
}

double motion_bound_codes(const MotionSpread& spread, const Sensitivity& sensitivity,
                          const LightSummary& lights, double pitch, double smallest_pixel_sr,
                          double angular_scale) {
    if (spread.core <= 0 && spread.skirt <= 0) return 0;
    // Each pixel is off by a part of itself: of a dark speckle, what remains beside the change.
    double codes = std::numeric_limits<double>::infinity();
    if (spread.skirt < 1) {
        const double ratio = std::max(spread.core, spread.skirt / (1 - spread.skirt));
        codes = sensitivity.codes_per_unit_ratio * ratio;
    }
    // And by no more than all lights together that can reach it.
    double lux = lights.neighbourhoods.empty() ? lights.all.total_lux() : 0;
    for (const BrightnessHistogram& cell : lights.neighbourhoods)
        lux = std::max(lux, cell.total_lux());
    // The bound of the eye whose glare is widest, as culling takes it.
    constexpr double widest_age_years = 80;
    constexpr double widest_pigmentation = 1.2;
    const GlareBound bound(widest_age_years, widest_pigmentation, angular_scale);
    double skirt_sr = 0;
    for (const double nodes : {1.0, 2.0, 4.0, 6.0})
        skirt_sr = std::max(skirt_sr, spread.skirt * share_at(nodes) * bound.psf_sr(nodes * pitch));
    if (!(smallest_pixel_sr > 0)) return codes;
    // The footprint's brightest pixel has a quarter of the core.
    const double per_lux = spread.core / (4 * smallest_pixel_sr) + std::min(skirt_sr, 1 / smallest_pixel_sr);
    return std::min(codes, sensitivity.codes_per_cd_m2 * lux * per_lux);
}

}  // namespace seaglare::glare
