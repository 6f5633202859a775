#include "lightdb/photometric_solid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seaglare::lightdb {

namespace {

constexpr double deg_per_rad = 180 / std::numbers::pi;
constexpr double rad_per_deg = std::numbers::pi / 180;

// A reading at the edge of the grid may miss it by rounding.
constexpr double edge_tolerance_deg = 1e-6;

// Between samples i and j of a list of angles, the share of j.
struct Between {
    std::size_t i = 0;
    std::size_t j = 0;
    double share = 0;
};

// False: outside of the list.
bool find_between(const std::vector<double>& angle_deg, double at_deg, Between& out) {
    const double first_deg = angle_deg.front();
    const double last_deg = angle_deg.back();
    if (!(at_deg >= first_deg - edge_tolerance_deg && at_deg <= last_deg + edge_tolerance_deg)) return false;
    const double inside_deg = std::clamp(at_deg, first_deg, last_deg);
    const auto above = std::upper_bound(angle_deg.begin(), angle_deg.end(), inside_deg);
    const auto j = std::min(static_cast<std::size_t>(above - angle_deg.begin()), angle_deg.size() - 1);
    if (j == 0) return true;  // one sample
    out = {j - 1, j, (inside_deg - angle_deg[j - 1]) / (angle_deg[j] - angle_deg[j - 1])};
    return true;
}

bool find_azimuth(const PhotometricSolid& solid, double azimuth_deg, Between& out) {
    const std::vector<double>& samples = solid.azimuth_deg;
    if (samples.size() == 1 && solid.whole_turn) return true;
    double turned_deg = std::fmod(azimuth_deg - samples.front(), 360.0);
    if (turned_deg < 0) turned_deg += 360;
    // Just before the first sample is the end of the turn.
    if (!solid.whole_turn && turned_deg > 360 - edge_tolerance_deg) turned_deg = 0;
    const double at_deg = samples.front() + turned_deg;
    if (solid.whole_turn && at_deg > samples.back()) {
        const double gap_deg = samples.front() + 360 - samples.back();
        out = {samples.size() - 1, 0, (at_deg - samples.back()) / gap_deg};
        return true;
    }
    return find_between(samples, at_deg, out);
}

// Integral of (a + (b - a) t) cos(latitude) over a step of latitude, t running from 0 to 1 over it; radians.
double band(double from_rad, double to_rad, double a, double b) {
    const double slope = (b - a) / (to_rad - from_rad);
    return b * std::sin(to_rad) - a * std::sin(from_rad) + slope * (std::cos(to_rad) - std::cos(from_rad));
}

// Integral of one azimuth's candela over its latitudes up to `to_deg`, cd rad.
double column_integral(const PhotometricSolid& solid, std::size_t azimuth, double to_deg) {
    const std::vector<double>& latitude_deg = solid.latitude_deg;
    const double* const candela = solid.candela.data() + azimuth * latitude_deg.size();
    double sum = 0;
    for (std::size_t i = 1; i < latitude_deg.size() && latitude_deg[i - 1] < to_deg; ++i) {
        const double below_deg = latitude_deg[i - 1];
        const double above_deg = std::min(latitude_deg[i], to_deg);
        const double share = (above_deg - below_deg) / (latitude_deg[i] - below_deg);
        sum += band(below_deg * rad_per_deg, above_deg * rad_per_deg, candela[i - 1],
                    candela[i - 1] + (candela[i] - candela[i - 1]) * share);
    }
    return sum;
}

// Flux below a latitude, lm.
double flux_below_lm(const PhotometricSolid& solid, double to_deg) {
    const std::vector<double>& azimuth_deg = solid.azimuth_deg;
    if (azimuth_deg.empty() || solid.latitude_deg.empty()) return 0;
    const double first = column_integral(solid, 0, to_deg);
    double before = first;
    double sum = 0;
    for (std::size_t i = 1; i < azimuth_deg.size(); ++i) {
        const double here = column_integral(solid, i, to_deg);
        sum += (azimuth_deg[i] - azimuth_deg[i - 1]) * (before + here) / 2;
        before = here;
    }
    if (solid.whole_turn) sum += (azimuth_deg.front() + 360 - azimuth_deg.back()) * (before + first) / 2;
    return sum * rad_per_deg;
}

// The largest candela in the light's horizontal plane. Linear between samples: the largest stands at one of them.
double horizontal_peak_cd(const PhotometricSolid& solid) {
    double peak_cd = 0;
    if (solid.axis == PhotometricSolid::Axis::up) {
        for (const double azimuth_deg : solid.azimuth_deg)
            peak_cd = std::max(peak_cd, candela_at(solid, azimuth_deg, 0));
    } else {  // ahead and astern, from port to starboard
        for (const double latitude_deg : solid.latitude_deg) {
            for (const double azimuth_deg : {0.0, 180.0})
                peak_cd = std::max(peak_cd, candela_at(solid, azimuth_deg, latitude_deg));
        }
    }
    return peak_cd;
}

}  // namespace

bool operator==(const PhotometricSolid& a, const PhotometricSolid& b) {
    return a.axis == b.axis && a.whole_turn == b.whole_turn && a.reference_cd == b.reference_cd &&
           a.radius_m == b.radius_m && a.azimuth_deg == b.azimuth_deg && a.latitude_deg == b.latitude_deg &&
           a.candela == b.candela;
}

double candela_at(const PhotometricSolid& solid, double azimuth_deg, double latitude_deg) {
    Between azimuth;
    Between latitude;
    if (solid.azimuth_deg.empty() || solid.latitude_deg.empty() || !std::isfinite(azimuth_deg)) return 0;
    if (!find_between(solid.latitude_deg, latitude_deg, latitude)) return 0;
    if (!find_azimuth(solid, azimuth_deg, azimuth)) return 0;
    const std::size_t stride = solid.latitude_deg.size();
    const auto along = [&](std::size_t column) {
        const double* const candela = solid.candela.data() + column * stride;
        return candela[latitude.i] + (candela[latitude.j] - candela[latitude.i]) * latitude.share;
    };
    const double a = along(azimuth.i);
    return azimuth.share == 0 ? a : a + (along(azimuth.j) - a) * azimuth.share;
}

double candela_towards(const PhotometricSolid& solid, const std::array<double, 3>& direction) {
    const auto& [x, y, z] = direction;
    const double length = std::hypot(x, y, z);
    if (!(length > 0) || !std::isfinite(length)) return 0;
    const bool up = solid.axis == PhotometricSolid::Axis::up;
    const double along = up ? z : x;
    const double across = up ? x : z;
    const double latitude_deg = std::atan2(along, std::hypot(across, y)) * deg_per_rad;
    const double azimuth_deg = across == 0 && y == 0 ? 0 : std::atan2(across, y) * deg_per_rad;
    return candela_at(solid, azimuth_deg, latitude_deg);
}

double flux_lm(const PhotometricSolid& solid) {
    return flux_below_lm(solid, 90);
}

double flux_below_horizon_lm(const PhotometricSolid& solid) {
    return flux_below_lm(solid, 0);
}

double reference_of(const PhotometricSolid& solid) {
    if (solid.candela.empty()) return 0;
    const double peak_cd = *std::max_element(solid.candela.begin(), solid.candela.end());
    const double horizontal_cd = horizontal_peak_cd(solid);
    return horizontal_cd >= peak_cd / 100 ? horizontal_cd : peak_cd;
}

}  // namespace seaglare::lightdb
