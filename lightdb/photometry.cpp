#include "lightdb/photometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace seaglare::lightdb {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double smallest_radius_m = 1e-3;

// 2.08 nm per root of a metre: earth's curvature with mean refraction.
constexpr double horizon_nm_per_sqrt_m = 2.08;

double root_height(double height_m) {
    return std::sqrt(std::max(height_m, 0.0));
}

}  // namespace

double extinction_per_m(double meteorological_visibility_m) {
    if (!(meteorological_visibility_m > 0)) return infinity;
    return -std::log(visibility_contrast) / meteorological_visibility_m;
}

double transmission(double extinction_per_m, double distance_m) {
    if (!(distance_m > 0) || !(extinction_per_m > 0)) return 1;  // no infinity times zero
    return std::exp(-extinction_per_m * distance_m);
}

double illuminance_lx(double intensity_cd, double distance_m, double radius_m, double extinction_per_m) {
    if (!(intensity_cd > 0) || !std::isfinite(distance_m)) return 0;
    const double effective_m = std::max({distance_m, radius_m, smallest_radius_m});
    return intensity_cd / (effective_m * effective_m) * transmission(extinction_per_m, distance_m);
}

double intensity_for_range_cd(double range_nm, double threshold_lx, double visibility_nm) {
    if (!(range_nm > 0)) return 0;
    const double range_m = range_nm * metres_per_nautical_mile;
    return threshold_lx * range_m * range_m * std::pow(visibility_contrast, -range_nm / visibility_nm);
}

double range_for_intensity_nm(double intensity_cd, double threshold_lx, double visibility_nm) {
    if (!(intensity_cd > 0)) return 0;
    const auto reaches = [&](double range_nm) {
        return intensity_for_range_cd(range_nm, threshold_lx, visibility_nm) <= intensity_cd;
    };
    double near_nm = 0;
    double far_nm = 1;
    while (reaches(far_nm) && far_nm < 1e9)
        far_nm *= 2;  // ends at once: the law grows faster than exponentially
    for (;;) {
        const double middle_nm = near_nm + (far_nm - near_nm) / 2;
        if (middle_nm <= near_nm || middle_nm >= far_nm) return near_nm;
        (reaches(middle_nm) ? near_nm : far_nm) = middle_nm;
    }
}

double colreg_intensity_cd(double range_nm) {
    if (!(range_nm > 0)) return 0;
    return 3.43e6 * 2e-7 * range_nm * range_nm * std::pow(0.8, -range_nm);
}

double geographical_range_nm(double height_m, double eye_height_m) {
    return horizon_nm_per_sqrt_m * (root_height(height_m) + root_height(eye_height_m));
}

double fraction_above_horizon(double distance_m, double lamp_height_m, double lamp_radius_m,
                              double eye_height_m) {
    const double beyond =
        distance_m / (horizon_nm_per_sqrt_m * metres_per_nautical_mile) - root_height(eye_height_m);
    if (!(beyond > 0)) return 1;
    const double hidden_below_m = beyond * beyond;
    const double above_m = std::max(lamp_height_m, 0.0) - hidden_below_m;
    const double x = above_m / std::max(lamp_radius_m, smallest_radius_m);
    if (x >= 1) return 1;
    if (x <= -1) return 0;
    return 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / std::numbers::pi;  // segment of a disc
}

double effective_intensity_cd(double intensity_cd, double duration_s) {
    if (!(duration_s > 0)) return 0;
    if (!std::isfinite(duration_s)) return intensity_cd;
    return intensity_cd * duration_s / (0.2 + duration_s);
}

}  // namespace seaglare::lightdb
