#include "glare/reference/field_loss.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "glare/tone/operators.h"

namespace seaglare::reference {

namespace {

template <typename Visit>
void for_each_pixel(const LuminanceField& field, Visit visit) {
    std::size_t at = 0;
    for (int b = -field.radius; b <= field.radius; ++b) {
        for (int a = -field.radius; a <= field.radius; ++a, ++at) {
            const double distance = std::hypot(a, b);
            if (distance <= field.radius) visit(at, distance);
        }
    }
}

}  // namespace

RingStatistics ring_statistics(const LuminanceField& field, double angle_deg) {
    constexpr double half_width = 0.06;  // of the angle
    double sum = 0;
    double squares = 0;
    double count = 0;
    for_each_pixel(field, [&](std::size_t at, double distance) {
        const double angle = std::asin(std::min(1.0, distance * field.pitch)) * 180 / std::numbers::pi;
        if (std::abs(angle - angle_deg) > half_width * angle_deg) return;
        const double level = field.per_sr[at] * angle * angle;
        sum += level;
        squares += level * level;
        count += 1;
    });
    const double mean = sum / count;
    return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean)) / mean};
}

FieldLoss field_loss(const LuminanceField& made, const LuminanceField& truth,
                     std::span<const double> contrast_angles_deg) {
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    if (made.radius != truth.radius || made.pitch != truth.pitch) return {nothing, nothing, nothing};
    FieldLoss loss;
    for (int step = 0; step < 20; ++step) {
        const double angle_deg = 0.25 * std::pow(1.15, step);
        const double wanted = ring_statistics(truth, angle_deg).mean;
        // A field that ends before has no such ring, and an empty one no mean to compare with.
        if (!(wanted > 0)) continue;
        loss.radial = std::max(loss.radial, std::abs(ring_statistics(made, angle_deg).mean / wanted - 1));
    }
    for (const double angle_deg : contrast_angles_deg) {
        const double wanted = ring_statistics(truth, angle_deg).contrast;
        if (!(wanted > 0)) continue;
        const double change = ring_statistics(made, angle_deg).contrast / wanted - 1;
        if (std::abs(change) > std::abs(loss.contrast)) loss.contrast = change;
    }
    constexpr double illuminance_lx = 1e-2;
    constexpr double background_cd_m2 = 1e-3;
    const glare::ToneCurve curve = glare::tone_curve({}, background_cd_m2);
    const auto code = [&](double per_sr) {
        const double luminance = background_cd_m2 + illuminance_lx * per_sr;
        return 255 * glare::srgb_encode(std::min(1.0, glare::tone_map(curve, luminance)));
    };
    for_each_pixel(truth, [&](std::size_t at, double /*distance*/) {
        loss.codes = std::max(loss.codes, std::abs(code(made.per_sr[at]) - code(truth.per_sr[at])));
    });
    return loss;
}

}  // namespace seaglare::reference
