#include "glare/eye/accommodation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "glare/eye/noise.h"

namespace seaglare::glare {

namespace {

constexpr std::uint64_t slow_stream = 0x736C6F77;
constexpr std::uint64_t quick_stream = 0x71756963;
constexpr double slow_hz = 0.3;  // one value of the noise per period, an octave above it: below 0.6 Hz
constexpr double quick_hz = 1.7;
constexpr double quick_spread_hz = 0.4;  // 1.3 to 2.1 Hz
constexpr double widest_pupil_mm = 7;

// A sine whose frequency wanders between the limits: its phase is a noise added to a steady one, which moves by at most
// `quick_spread_hz` a second.
double wandering_sine(double time_s, std::uint64_t seed) {
    constexpr double wander_period_s = 5;
    // The noise's slope is at most 15/8 * 2 * (1 + 2 * 0.5) / 1.5 = 5 a period (smootherstep between -1 and 1, two octaves).
    constexpr double steepest = 5;
    constexpr double wander_turns = quick_spread_hz * wander_period_s / steepest;
    const double turns = quick_hz * time_s;
    const double steady = turns - std::floor(turns);
    const double wander = wander_turns * smooth_noise(hash(seed, quick_stream), time_s / wander_period_s);
    return std::sin(2 * std::numbers::pi * (steady + wander));
}

}  // namespace

double accommodation_dioptre(const AccommodationMotion& motion, double pupil_mm, double time_s,
                             std::uint64_t seed) {
    if (!std::isfinite(time_s)) time_s = 0;
    double dioptre = 0;
    if (motion.slow_dioptre > 0) {
        const double wide = std::clamp(pupil_mm / widest_pupil_mm, 0.0, 1.0);
        dioptre += motion.slow_dioptre * wide * smooth_noise(hash(seed, slow_stream), time_s * slow_hz);
    }
    if (motion.quick_dioptre > 0) dioptre += motion.quick_dioptre * wandering_sine(time_s, seed);
    return dioptre;
}

double lens_scale(const AccommodationMotion& motion, double pupil_mm, double time_s, std::uint64_t seed) {
    const double dioptre = accommodation_dioptre(motion, pupil_mm, time_s, seed);
    return std::clamp(1 - motion.lens_strain_per_dioptre * dioptre, 0.5, 2.0);
}

}  // namespace seaglare::glare
