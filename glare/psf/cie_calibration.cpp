#include "glare/psf/cie_calibration.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "glare/psf/cie_curve.h"

namespace seaglare::glare {

int calibration_rings(const PatternGrid& grid) {
    // The corner of the square farthest away, and one more to interpolate towards.
    return static_cast<int>(std::ceil(std::numbers::sqrt2 * grid.structure_radius)) + 2;
}

std::vector<float> calibration_targets(const PatternGrid& grid, double age_years, double pigmentation) {
    const auto rings = static_cast<std::size_t>(calibration_rings(grid));
    std::vector<double> sum(rings);
    std::vector<double> count(rings);
    for (int b = 0; b <= grid.structure_radius; ++b) {
        for (int a = 0; a <= grid.structure_radius; ++a) {
            const double distance = std::hypot(a, b);
            const auto ring = static_cast<std::size_t>(std::lround(distance));
            // As many nodes of the whole square are like this one.
            const double copies = (a > 0 ? 2 : 1) * (b > 0 ? 2 : 1);
            const double angle_deg = std::asin(std::min(distance * grid.pitch, 1.0)) * 180 / std::numbers::pi;
            sum[ring] += copies * cie_total_glare_sr(angle_deg, age_years, pigmentation);
            count[ring] += copies;
        }
    }
    std::vector<float> targets(rings);
    for (std::size_t r = 0; r < rings; ++r)
        targets[r] = count[r] > 0 ? static_cast<float>(sum[r] / count[r] * grid.pitch * grid.pitch) : 0.0F;
    return targets;
}

std::vector<float> calibration_gains(const std::vector<float>& targets, const std::vector<double>& means,
                                     double scale) {
    std::vector<float> gains(targets.size(), 1.0F);
    for (std::size_t r = 1; r < gains.size() && r < means.size(); ++r)
        if (means[r] > 0) gains[r] = static_cast<float>(scale * static_cast<double>(targets[r]) / means[r]);
    if (gains.size() > 1) gains[0] = gains[1];
    return gains;
}

double calibration_gain(std::span<const float> gains, double distance_nodes) {
    const double whole = std::floor(distance_nodes);
    const auto ring = static_cast<std::size_t>(whole);
    if (ring + 1 >= gains.size()) return 1;
    const double t = distance_nodes - whole;
    return (1 - t) * static_cast<double>(gains[ring]) + t * static_cast<double>(gains[ring + 1]);
}

}  // namespace seaglare::glare
