#include "glare/apply/glare_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "glare/psf/cie_curve.h"

namespace seaglare::glare {

namespace {

constexpr double smallest_angle_rad = 1e-5;
const double log_range = std::log(std::numbers::pi / 2 / smallest_angle_rad);

}  // namespace

double GlareBound::angle_of(double sample) {
    return smallest_angle_rad * std::exp(log_range * sample / (samples - 1));
}

GlareBound::GlareBound(double age_years, double pigmentation, double angular_scale) {
    const double scale = angular_scale > 0 ? angular_scale : 1;
    double largest = 0;
    for (int i = samples - 1; i >= 0; --i) {
        const double angle_deg = angle_of(i) / scale * 180 / std::numbers::pi;
        largest =
            std::max(largest, structure_headroom * cie_total_glare_sr(angle_deg, age_years, pigmentation) /
                                  (scale * scale));
        log_psf_[static_cast<std::size_t>(i)] = std::log(largest);
    }
}

double GlareBound::psf_sr(double angle_rad) const {
    if (!(angle_rad > smallest_angle_rad)) return std::exp(log_psf_[0]);
    // The sample below: never less than the bound at the angle itself.
    const double sample = std::log(angle_rad / smallest_angle_rad) / log_range * (samples - 1);
    const auto below = static_cast<std::size_t>(std::clamp(sample, 0.0, samples - 1.0));
    return std::exp(log_psf_[below]);
}

double GlareBound::reach_rad(double psf_sr) const {
    if (!(psf_sr > 0)) return std::numbers::pi / 2;
    const double wanted = std::log(psf_sr);
    // log_psf_ falls: the first sample at or below the wanted value.
    const auto* const first = std::partition_point(log_psf_.begin(), log_psf_.end(),
                                                   [wanted](double value) { return value > wanted; });
    if (first == log_psf_.begin()) return 0;
    if (first == log_psf_.end()) return std::numbers::pi / 2;
    return std::min(angle_of(static_cast<double>(first - log_psf_.begin())), std::numbers::pi / 2);
}

}  // namespace seaglare::glare
