#include <algorithm>
#include <cmath>

#include "glare/eye/eye_model.h"
#include "glare/eye/noise.h"

namespace seaglare::glare {

namespace {

constexpr double smallest_pupil_mm = 1.5;
constexpr double largest_pupil_mm = 8.5;
constexpr double hippus_limit_mm = 9;  // p_max of the hippus law; above largest_pupil_mm, so its root is real

}  // namespace

double mean_pupil_diameter_mm(double adaptation_luminance_cd_m2) {
    double luminance = adaptation_luminance_cd_m2;
    if (!(luminance > 1e-6)) luminance = 1e-6;
    luminance = std::min(luminance, 1e6);
    return 4.9 - 3 * std::tanh(0.4 * (std::log10(luminance) + 1));
}

double aged_pupil_diameter_mm(double diameter_mm, double age_years) {
    constexpr double reference_age_years = 28.58;
    const double age = age_years > 20 ? std::min(age_years, 83.0) : 20;
    return diameter_mm + (age - reference_age_years) * (0.02132 - 0.009562 * diameter_mm);
}

double resting_pupil_diameter_mm(const EyeModel& eye, double adaptation_luminance_cd_m2) {
    double wanted = eye.fixed_pupil_mm;
    if (!(wanted > 0)) {
        wanted = mean_pupil_diameter_mm(adaptation_luminance_cd_m2);
        if (eye.pupil_shrinks_with_age) wanted = aged_pupil_diameter_mm(wanted, eye.age_years);
    }
    return std::clamp(wanted, smallest_pupil_mm, largest_pupil_mm);
}

double pupil_diameter_mm(const EyeModel& eye, double adaptation_luminance_cd_m2, double time_s,
                         std::uint64_t seed) {
    const double mean = resting_pupil_diameter_mm(eye, adaptation_luminance_cd_m2);
    if (!(eye.hippus_amplitude_mm > 0) || !(eye.hippus_period_s > 0)) return mean;
    constexpr std::uint64_t hippus_stream = 0x68697070;
    const double noise = smooth_noise(hash(seed, hippus_stream), time_s / eye.hippus_period_s);
    const double swing = (hippus_limit_mm / mean) * std::sqrt(1 - mean / hippus_limit_mm);
    return std::clamp(mean + eye.hippus_amplitude_mm * noise * swing, smallest_pupil_mm, largest_pupil_mm);
}

}  // namespace seaglare::glare
