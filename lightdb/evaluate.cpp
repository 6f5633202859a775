#include "lightdb/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "glare/colour/navigation_colours.h"
#include "lightdb/geodesy.h"
#include "lightdb/photometry.h"
#include "lightdb/profile.h"
#include "lightdb/rhythm.h"
#include "lightdb/sector.h"
#include "lightdb/vector_math.h"

namespace seaglare::lightdb {

namespace {

constexpr double deg_per_rad = 180 / std::numbers::pi;
using Intensities = std::array<double, colour_count>;

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

// The colour of a light whose rhythm names none: the first it has an intensity for.
std::size_t main_colour(const Light& light) {
    const auto found =
        std::find_if(light.intensity_cd.begin(), light.intensity_cd.end(), [](double i) { return i > 0; });
    return found != light.intensity_cd.end() ? static_cast<std::size_t>(found - light.intensity_cd.begin())
                                             : 0;
}

// Candela of each colour in the light's rhythm, before sectors. All zero: dark.
Intensities shown_cd(const Light& light, const LitFractions& lit, const SectorFactors& sectors) {
    Intensities shown{};
    if (light.sectors.empty()) {
        if (!has_colours(light.rhythm)) {
            const std::size_t colour = main_colour(light);
            shown[colour] = light.intensity_cd[colour];
            return shown;
        }
        for (std::size_t c = 0; c < shown.size(); ++c) {
            if (lit[c] == 0) continue;
            // A phase in a colour that the light has no intensity for shows the colour that it has.
            const std::size_t colour = light.intensity_cd[c] > 0 ? c : main_colour(light);
            shown[colour] += lit[c] * light.intensity_cd[colour];
        }
        return shown;
    }
    double lit_in_all = 0;
    for (const double fraction : lit)
        lit_in_all += fraction;
    for (std::size_t c = 0; c < shown.size(); ++c)
        shown[c] = sectors[c] * lit_in_all * light.intensity_cd[c];
    return shown;
}

bool is_switched_off(const Light& light, const Observer& observer) {
    return !light.on || !(light.visibility > 0) ||
           (light.day_off && observer.adaptation_luminance_cd_m2 > photometer_off_above_cd_m2);
}

LitFractions lit_now(const Light& light, const Observer& observer) {
    if (!(light.rhythm.period_s > 0)) return mean_lit(light.rhythm, 0, 0);
    const double offset_s = phase_offset_s(light.rhythm, light.stable_key, observer.seed);
    return exposed_lit(light.rhythm, observer.time_s + offset_s, observer.exposure_s);
}

bool is_dark(const LitFractions& lit) {
    return std::all_of(lit.begin(), lit.end(), [](double fraction) { return fraction == 0; });
}

// Sectors, profile and rhythm put together; `to_eye_m` in the scene.
Intensities towards_eye_cd(const Light& light, const Pose& pose, const LitFractions& lit,
                           const Vec3& to_eye_m, double distance_m, const Observer& observer) {
    const bool outward = light.sector_reference == SectorReference::outward_from_ahead;
    SectorFactors sectors{};
    if (!light.sectors.empty() && !outward) {
        const Vec3 to_light_m = {-to_eye_m[0], -to_eye_m[1], -to_eye_m[2]};
        sectors = sector_factors(light.sectors, bearing_from_seaward_deg(to_light_m, light.true_north_deg));
    }
    double profile = 1;
    const bool has_profile = !light.vertical.angle_deg.empty();
    if (has_profile || (outward && !light.sectors.empty())) {
        const Vec3 in_light_m = turned_to_light(pose, light, to_eye_m);
        if (outward && !light.sectors.empty()) {
            sectors = sector_factors(light.sectors, bearing_from_ahead_deg(in_light_m));
        }
        const bool stands_on_earth = pose.body == nullptr && is_unturned(light.orientation);
        if (has_profile) {
            profile = clamped_factor(light.vertical, elevation_deg(in_light_m, pose.position_m,
                                                                   stands_on_earth, observer, distance_m));
        }
    }
    Intensities result = shown_cd(light, lit, sectors);
    for (double& intensity_cd : result)
        intensity_cd *= profile;
    return result;
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
    const double eye_height_m = height_above_water_m(observer.eye_m, observer);

    const std::span<const LightStore::Slot> slots = store.slots();
    for (std::size_t index = 0; index < slots.size(); ++index) {
        if (!slots[index].live) continue;
        const Light& light = slots[index].light;
        if (is_switched_off(light, observer)) {
            ++out.dark;
            continue;
        }
        const LitFractions lit = lit_now(light, observer);
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
        Intensities lux = towards_eye_cd(light, pose, lit, to_eye_m, distance_m, observer);
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
    const LitFractions lit = lit_now(light, observer);
    const Pose pose = pose_of(store, light);
    const Vec3 to_eye_m = observer.eye_m - pose.position_m;
    return towards_eye_cd(light, pose, lit, to_eye_m, length(to_eye_m), observer);
}

std::array<double, 3> scene_position_m(const LightStore& store, const Light& light) {
    return pose_of(store, light).position_m;
}

}  // namespace seaglare::lightdb
