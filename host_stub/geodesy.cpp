#include "host_stub/geodesy.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace seaglare::host {
namespace {

constexpr double deg = std::numbers::pi / 180;

// WGS 84 (NIMA TR8350.2): semi-major axis and flattening.
constexpr double equatorial_radius_m = 6378137.0;
constexpr double flattening = 1 / 298.257223563;

glm::dvec3 earth_centred_m(GeoPoint p) {
    const double e2 = flattening * (2 - flattening);
    const double s = std::sin(p.latitude_deg * deg), c = std::cos(p.latitude_deg * deg);
    const double n = equatorial_radius_m / std::sqrt(1 - e2 * s * s);
    return {n * c * std::cos(p.longitude_deg * deg), n * c * std::sin(p.longitude_deg * deg),
            n * (1 - e2) * s};
}

}  // namespace

glm::dvec2 east_north_m(GeoPoint origin, GeoPoint point) {
    const glm::dvec3 d = earth_centred_m(point) - earth_centred_m(origin);
    const double sp = std::sin(origin.latitude_deg * deg), cp = std::cos(origin.latitude_deg * deg);
    const double sl = std::sin(origin.longitude_deg * deg), cl = std::cos(origin.longitude_deg * deg);
    return {-sl * d.x + cl * d.y, -sp * cl * d.x - sp * sl * d.y + cp * d.z};
}

double bearing_deg(glm::dvec2 v) {
    const double b = std::atan2(v.x, v.y) / deg;
    return b < 0 ? b + 360 : b;
}

glm::dvec3 unit_vector(SkyDirection d) {
    const double ce = std::cos(d.elevation_deg * deg);
    return {ce * std::sin(d.azimuth_deg * deg), ce * std::cos(d.azimuth_deg * deg),
            std::sin(d.elevation_deg * deg)};
}

SkyDirection after_hours(SkyDirection now, double latitude_deg, double hours) {
    // Rodrigues' rotation about the pole; the sky turns from east over south to west, clockwise seen along
    // the pole from outside, hence the minus.
    const glm::dvec3 pole = unit_vector({latitude_deg, 0});
    const glm::dvec3 v = unit_vector(now);
    const double a = -15 * deg * hours;
    const glm::dvec3 r =
        v * std::cos(a) + glm::cross(pole, v) * std::sin(a) + pole * glm::dot(pole, v) * (1 - std::cos(a));
    return {std::asin(std::clamp(r.z, -1.0, 1.0)) / deg, bearing_deg({r.x, r.y})};
}

}  // namespace seaglare::host
