#include "lightdb/sector.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seaglare::lightdb {

namespace {

constexpr double deg_per_rad = 180 / std::numbers::pi;

// Clockwise from `from_deg` to `to_deg`, -180 ... 180.
double difference_deg(double to_deg, double from_deg) {
    const double difference = wrapped_deg(to_deg - from_deg);
    return difference > 180 ? difference - 360 : difference;
}

bool holds(const Sector& sector, double bearing_deg) {
    return wrapped_deg(bearing_deg - sector.from_deg) < sector_width_deg(sector);
}

void add_hard_edged(std::span<const Sector> sectors, double bearing_deg, double weight,
                    SectorFactors& factors) {
    for (std::size_t i = sectors.size(); i-- > 0;) {
        const Sector& sector = sectors[i];
        if (!holds(sector, bearing_deg)) continue;
        if (sector.colour)
            factors[static_cast<std::size_t>(*sector.colour)] += weight * sector.intensity_factor;
        return;
    }
}

// The widest transition of those limits inside whose transition the bearing lies; 0: none.
double transition_here_deg(std::span<const Sector> sectors, double bearing_deg) {
    double width_deg = 0;
    for (const Sector& sector : sectors) {
        if (!(sector.transition_deg > width_deg)) continue;
        if (sector_width_deg(sector) >= 360) continue;  // has no limits
        for (const double limit_deg : {sector.from_deg, sector.to_deg}) {
            if (2 * std::abs(difference_deg(limit_deg, bearing_deg)) < sector.transition_deg) {
                width_deg = sector.transition_deg;
            }
        }
    }
    return std::min(width_deg, 180.0);
}

}  // namespace

double wrapped_deg(double angle_deg) {
    if (!std::isfinite(angle_deg)) return 0;
    double result = std::fmod(angle_deg, 360.0);
    if (result < 0) result += 360;
    return result < 360 ? result : 0;  // -1e-20 + 360 is 360
}

double bearing_from_seaward_deg(const std::array<double, 3>& to_light_m, double true_north_deg) {
    if (to_light_m[0] == 0 && to_light_m[1] == 0) return 0;
    return wrapped_deg(std::atan2(to_light_m[0], to_light_m[1]) * deg_per_rad - true_north_deg);
}

double bearing_from_ahead_deg(const std::array<double, 3>& to_eye_m) {
    if (to_eye_m[0] == 0 && to_eye_m[1] == 0) return 0;
    return wrapped_deg(std::atan2(to_eye_m[0], to_eye_m[1]) * deg_per_rad);
}

double sector_width_deg(const Sector& sector) {
    const double turn_deg = sector.to_deg - sector.from_deg;
    const double width_deg = wrapped_deg(turn_deg);
    return width_deg == 0 && turn_deg != 0 ? 360 : width_deg;
}

SectorFactors sector_factors(std::span<const Sector> sectors, double bearing_deg) {
    SectorFactors factors{};
    if (sectors.empty()) {
        factors.fill(1);
        return factors;
    }
    const double width_deg = transition_here_deg(sectors, bearing_deg);
    if (width_deg == 0) {
        add_hard_edged(sectors, bearing_deg, 1, factors);
        return factors;
    }
    // The mean of the hard-edged sectors over the transition's width, exactly: piece by piece between the
    // limits.
    const double half_deg = width_deg / 2;
    double from_deg = -half_deg;
    while (from_deg < half_deg) {
        double to_deg = half_deg;
        for (const Sector& sector : sectors) {
            if (sector_width_deg(sector) >= 360) continue;
            for (const double limit_deg : {sector.from_deg, sector.to_deg}) {
                const double at_deg = difference_deg(limit_deg, bearing_deg);
                if (at_deg > from_deg && at_deg < to_deg) to_deg = at_deg;
            }
        }
        add_hard_edged(sectors, bearing_deg + (from_deg + to_deg) / 2, (to_deg - from_deg) / width_deg,
                       factors);
        from_deg = to_deg;
    }
    return factors;
}

}  // namespace seaglare::lightdb
