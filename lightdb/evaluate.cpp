#include "lightdb/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "glare/colour/navigation_colours.h"
#include "lightdb/emission.h"
#include "lightdb/geodesy.h"
#include "lightdb/photometry.h"
#include "lightdb/vector_math.h"

namespace seaglare::lightdb {

namespace {

constexpr double deg_per_rad = 180 / std::numbers::pi;

// A light in the scene: its pose with that of its body.
struct Pose {
    Vec3 position_m;
    const BodyPose* body;  // nullptr: none
};

Pose pose_of(const LightStore& store, const Light& light) {
    const BodyPose* const body = light.body_id != 0 ? store.body_pose(light.body_id) : nullptr;
    if (body == nullptr) return {light.position_m, nullptr};
    return {body->position_m + rotate(body->orientation, light.position_m), body};
}

bool is_unturned(const Quaternion& q) {
    return q[0] == 0 && q[1] == 0 && q[2] == 0;
}

bool is_finite(const Vec3& v) {
    return std::isfinite(v[0] + v[1] + v[2]);
}

// A direction of the scene in the light's own frame.
Vec3 turned_to_light(const Pose& pose, const Light& light, const Vec3& direction) {
    Vec3 result = direction;
    if (pose.body != nullptr) result = rotate(conjugate(pose.body->orientation), result);
    if (!is_unturned(light.orientation)) result = rotate(conjugate(normalised(light.orientation)), result);
    return result;
}

// Height above the water of a point of the scene.
double height_above_water_m(const Vec3& position_m, const Observer& observer) {
    double height_m = position_m[2] - observer.water_level_m;
    if (observer.round_earth) {
        height_m += (position_m[0] * position_m[0] + position_m[1] * position_m[1]) / (2 * earth_radius_m);
    }
    return height_m;
}

// Elevation of the eye in degrees above the light's own horizon.
double elevation_deg(const Vec3& to_eye_in_light_m, const Vec3& light_m, bool stands_on_earth,
                     const Observer& observer, double distance_m) {
    if (!(distance_m > 0)) return 0;
    double up_m = to_eye_in_light_m[2];
    if (stands_on_earth && observer.round_earth) {
        up_m += (to_eye_in_light_m[0] * light_m[0] + to_eye_in_light_m[1] * light_m[1]) / earth_radius_m;
    }
    return std::asin(std::clamp(up_m / distance_m, -1.0, 1.0)) * deg_per_rad;
}

bool is_switched_off(const Light& light, const Observer& observer) {
    return !light.on || !(light.visibility > 0) ||
           (light.day_off && observer.adaptation_luminance_cd_m2 > photometer_off_above_cd_m2);
}

Sightline sightline_of(const Light& light, const Pose& pose, const Vec3& to_eye_m, double distance_m,
                       const Observer& observer) {
    if (!has_direction(light)) return {};
    const Vec3 in_light_m = turned_to_light(pose, light, to_eye_m);
    const bool stands_on_earth = pose.body == nullptr && is_unturned(light.orientation);
    return {to_eye_m, in_light_m,
            elevation_deg(in_light_m, pose.position_m, stands_on_earth, observer, distance_m)};
}

Exposure exposure_of(const Observer& observer) {
    return {observer.time_s, observer.exposure_s, observer.seed};
}

// Narrowed for the renderer: finite, and 0 instead of a number too small to have all its digits.
float narrowed(double value) {
    const double magnitude = std::abs(value);
    if (!(magnitude >= static_cast<double>(std::numeric_limits<float>::min()))) return 0;
    constexpr double largest = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(value, -largest, largest));
}

// What evaluate() works with for all lights of a frame.
struct Palette {
    std::array<glare::UnitColour, colour_count> colours;
    Palette() {
        for (int c = 0; c < colour_count; ++c)
            colours[static_cast<std::size_t>(c)] = glare::navigation_colour(c);
    }
};

glare::PointSource make_source(const Vec3& from_eye_m, const Light& light, const Intensities& illuminance_lx,
                               const Observer& observer, const Palette& palette) {
    glare::PointSource source;
    const auto& view = observer.view_from_scene;
    for (std::size_t i = 0; i < 3; ++i) {
        source.position_view_m[i] =
            narrowed(view[i] * from_eye_m[0] + view[4 + i] * from_eye_m[1] + view[8 + i] * from_eye_m[2]);
    }
    source.radius_m = narrowed(light.radius_m);
    // Where colours grade into each other the brighter lends its pattern's shape.
    source.lamp = static_cast<std::uint32_t>(std::max_element(illuminance_lx.begin(), illuminance_lx.end()) -
                                             illuminance_lx.begin());
    Vec3 rgb{};
    double scotopic = 0;
    for (std::size_t c = 0; c < illuminance_lx.size(); ++c) {
        if (illuminance_lx[c] == 0) continue;
        const glare::UnitColour& colour = palette.colours[c];
        for (std::size_t i = 0; i < 3; ++i)
            rgb[i] += illuminance_lx[c] * static_cast<double>(colour.rgb[i]);
        scotopic += illuminance_lx[c] * static_cast<double>(colour.scotopic_per_photopic);
    }
    for (std::size_t i = 0; i < 3; ++i)
        source.illuminance_rgb_lx[i] = narrowed(rgb[i]);
    source.illuminance_scotopic_lx = narrowed(scotopic);
    return source;
}

}  // namespace

void evaluate(const LightStore& store, const Observer& observer, Evaluated& out) {
    static const Palette palette;  // constants: integrals over spectra, worked out once
    out.sources.clear();
    out.light.clear();
    out.total = static_cast<std::uint32_t>(store.size());
    out.dark = 0;
    out.below_horizon = 0;
    const Exposure exposure = exposure_of(observer);
    const double eye_height_m = height_above_water_m(observer.eye_m, observer);

    const std::span<const LightStore::Slot> slots = store.slots();
    for (std::size_t index = 0; index < slots.size(); ++index) {
        if (!slots[index].live) continue;
        const Light& light = slots[index].light;
        if (is_switched_off(light, observer)) {
            ++out.dark;
            continue;
        }
        const LitFractions lit = lit_during(light, exposure);
        if (is_dark(lit)) {
            ++out.dark;
            continue;
        }
        const Pose pose = pose_of(store, light);
        const Vec3 to_eye_m = observer.eye_m - pose.position_m;
        const double distance_m = length(to_eye_m);
        double unhidden = 1;
        if (observer.geographic_horizon) {
            unhidden = fraction_above_horizon(distance_m, height_above_water_m(pose.position_m, observer),
                                              light.radius_m, eye_height_m);
        }
        if (unhidden == 0) {
            ++out.below_horizon;
            continue;
        }
        Intensities lux =
            emitted_cd(light, lit, exposure, sightline_of(light, pose, to_eye_m, distance_m, observer));
        double brightest_lx = 0;
        for (double& value : lux) {
            value = illuminance_lx(value, distance_m, light.radius_m, observer.extinction_per_m) * unhidden *
                    static_cast<double>(light.visibility);
            brightest_lx = std::max(brightest_lx, value);
        }
        // One value that is not finite would poison an additive buffer; the comparison keeps it out.
        if (!(brightest_lx >= static_cast<double>(std::numeric_limits<float>::min())) ||
            !is_finite(to_eye_m)) {
            ++out.dark;
            continue;
        }
        const Vec3 from_eye_m = {-to_eye_m[0], -to_eye_m[1], -to_eye_m[2]};
        out.sources.push_back(make_source(from_eye_m, light, lux, observer, palette));
        out.sources.back().tag = static_cast<std::uint32_t>(index);
        out.light.push_back(static_cast<LightIndex>(index));
    }
}

std::array<double, colour_count> intensity_towards_cd(const LightStore& store, const Light& light,
                                                      const Observer& observer) {
    if (is_switched_off(light, observer)) return {};
    const Exposure exposure = exposure_of(observer);
    const Pose pose = pose_of(store, light);
    const Vec3 to_eye_m = observer.eye_m - pose.position_m;
    return emitted_cd(light, lit_during(light, exposure), exposure,
                      sightline_of(light, pose, to_eye_m, length(to_eye_m), observer));
}

std::array<double, 3> scene_position_m(const LightStore& store, const Light& light) {
    return pose_of(store, light).position_m;
}

}  // namespace seaglare::lightdb
