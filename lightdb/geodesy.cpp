#include "lightdb/geodesy.h"

#include <cmath>
#include <numbers>

namespace seaglare::lightdb {

namespace {

// WGS 84 (NIMA TR8350.2).
constexpr double semi_major_axis_m = 6378137;
constexpr double flattening = 1 / 298.257223563;
constexpr double eccentricity_squared = flattening * (2 - flattening);

constexpr double rad_per_deg = std::numbers::pi / 180;

}  // namespace

Vec3 earth_centred_from_geographic(const GeographicPoint& point) {
    const double latitude = point.latitude_deg * rad_per_deg;
    const double longitude = point.longitude_deg * rad_per_deg;
    const double sine = std::sin(latitude);
    const double cosine = std::cos(latitude);
    const double normal_m = semi_major_axis_m / std::sqrt(1 - eccentricity_squared * sine * sine);
    return {(normal_m + point.height_m) * cosine * std::cos(longitude),
            (normal_m + point.height_m) * cosine * std::sin(longitude),
            (normal_m * (1 - eccentricity_squared) + point.height_m) * sine};
}

LocalFrame::LocalFrame(const GeographicPoint& origin) : origin_m(earth_centred_from_geographic(origin)) {
    const double sin_latitude = std::sin(origin.latitude_deg * rad_per_deg);
    const double cos_latitude = std::cos(origin.latitude_deg * rad_per_deg);
    const double sin_longitude = std::sin(origin.longitude_deg * rad_per_deg);
    const double cos_longitude = std::cos(origin.longitude_deg * rad_per_deg);
    east = {-sin_longitude, cos_longitude, 0};
    north = {-sin_latitude * cos_longitude, -sin_latitude * sin_longitude, cos_latitude};
    up = {cos_latitude * cos_longitude, cos_latitude * sin_longitude, sin_latitude};
}

Vec3 LocalFrame::turned_to_local(const Vec3& direction) const {
    return {dot(east, direction), dot(north, direction), dot(up, direction)};
}

Vec3 LocalFrame::local_from_earth_centred(const Vec3& position_m) const {
    return turned_to_local(position_m - origin_m);
}

Vec3 LocalFrame::earth_centred_from_local(const Vec3& position_m) const {
    Vec3 result = origin_m;
    for (std::size_t i = 0; i < 3; ++i) {
        result[i] += east[i] * position_m[0] + north[i] * position_m[1] + up[i] * position_m[2];
    }
    return result;
}

Vec3 scene_from_geographic(const GeographicPoint& point, const GeographicPoint& origin, Earth earth) {
    Vec3 position_m = LocalFrame(origin).local_from_earth_centred(earth_centred_from_geographic(point));
    if (earth == Earth::flat) position_m[2] = point.height_m - origin.height_m;
    return position_m;
}

double true_north_in_scene_deg(const GeographicPoint& point, const GeographicPoint& origin) {
    const Vec3 north = LocalFrame(origin).turned_to_local(LocalFrame(point).north);
    return std::atan2(north[0], north[1]) / rad_per_deg;
}

void place_light(Light& light, const GeographicPoint& origin, Earth earth) {
    if (!light.geographic) return;
    const GeographicPoint point = {light.latitude_deg, light.longitude_deg, light.height_m};
    light.position_m = scene_from_geographic(point, origin, earth);
    light.true_north_deg = true_north_in_scene_deg(point, origin);
}

void place_lights(std::vector<Light>& lights, const GeographicPoint& origin, Earth earth) {
    for (Light& light : lights)
        place_light(light, origin, earth);
}

}  // namespace seaglare::lightdb
