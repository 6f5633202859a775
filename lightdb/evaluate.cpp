#include "lightdb/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lightdb/culling.h"
#include "lightdb/emission.h"
#include "lightdb/geodesy.h"
#include "lightdb/photometry.h"
#include "lightdb/vector_math.h"

namespace seaglare::lightdb {

namespace {

constexpr double deg_per_rad = 180 / std::numbers::pi;
// A source below it has no digits left in single precision.
constexpr double faintest_lx = std::numeric_limits<float>::min();

// A light in the scene: its pose with that of its body.
struct Pose {
    Vec3 position_m;
    const BodyPose* body;  // nullptr: none
};

Pose pose_of(const LightStore& store, const Vec3& position_m, std::uint32_t body_id) {
    const BodyPose* const body = body_id != 0 ? store.body_pose(body_id) : nullptr;
    if (body == nullptr) return {position_m, nullptr};
    return {body->position_m + rotate(body->orientation, position_m), body};
}

bool is_unturned(const Quaternion& q) {
    return q[0] == 0 && q[1] == 0 && q[2] == 0;
}

bool is_finite(const Vec3& v) {
    return std::isfinite(v[0] + v[1] + v[2]);
}

// A direction of the scene in the light's own frame. The orientation is normalised.
Vec3 turned_to_light(const Pose& pose, const Quaternion& orientation, const Vec3& direction) {
    Vec3 result = direction;
    if (pose.body != nullptr) result = rotate(conjugate(pose.body->orientation), result);
    if (!is_unturned(orientation)) result = rotate(conjugate(orientation), result);
    return result;
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

Sightline sightline_of(const Quaternion& orientation, const Pose& pose, const Vec3& to_eye_m,
                       double distance_m, const Observer& observer) {
    const Vec3 in_light_m = turned_to_light(pose, orientation, to_eye_m);
    const bool stands_on_earth = pose.body == nullptr && is_unturned(orientation);
    return {to_eye_m, in_light_m,
            elevation_deg(in_light_m, pose.position_m, stands_on_earth, observer, distance_m)};
}

Exposure exposure_of(const Observer& observer) {
    Exposure exposure;
    exposure.end_s = observer.time_s;
    exposure.duration_s = observer.exposure_s;
    exposure.seed = observer.seed;
    exposure.is_day = observer.is_day;
    return exposure;
}

CullingEye culling_eye(const Observer& observer) {
    CullingEye eye;
    eye.eye_m = observer.eye_m;
    // Below the smallest normal float a light is dark. Not a number: everything counts.
    eye.least_lx =
        std::max(faintest_lx, std::isnan(observer.least_illuminance_lx) ? 0 : observer.least_illuminance_lx);
    eye.extinction_per_m = observer.extinction_per_m;
    eye.geographic_horizon = observer.geographic_horizon;
    eye.round_earth = observer.round_earth;
    eye.water_level_m = observer.water_level_m;
    eye.height_m = height_above_water_m(observer.eye_m, eye);
    eye.is_day = observer.is_day;
    return eye;
}

// Narrowed for the renderer: finite, and 0 instead of a number too small to have all its digits.
float narrowed(double value) {
    const double magnitude = std::abs(value);
    if (!(magnitude >= static_cast<double>(std::numeric_limits<float>::min()))) return 0;
    constexpr double largest = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(value, -largest, largest));
}

glare::PointSource make_source(const Vec3& from_eye_m, double radius_m, const Intensities& illuminance_lx,
                               const Observer& observer, const LampRegistry& lamps,
                               const std::array<LampRegistry::Index, colour_count>& lamp_of) {
    glare::PointSource source;
    const auto& view = observer.view_from_scene;
    for (std::size_t i = 0; i < 3; ++i) {
        source.position_view_m[i] =
            narrowed(view[i] * from_eye_m[0] + view[4 + i] * from_eye_m[1] + view[8 + i] * from_eye_m[2]);
    }
    source.radius_m = narrowed(radius_m);
    // Where colours grade into each other the brighter lends its pattern's shape.
    const auto brightest = std::max_element(illuminance_lx.begin(), illuminance_lx.end());
    source.lamp = lamps[lamp_of[static_cast<std::size_t>(brightest - illuminance_lx.begin())]].lamp;
    Vec3 rgb{};
    double scotopic = 0;
    for (std::size_t c = 0; c < illuminance_lx.size(); ++c) {
        if (illuminance_lx[c] == 0) continue;
        const glare::UnitColour& colour = lamps[lamp_of[c]].colour;
        for (std::size_t i = 0; i < 3; ++i)
            rgb[i] += illuminance_lx[c] * static_cast<double>(colour.rgb[i]);
        scotopic += illuminance_lx[c] * static_cast<double>(colour.scotopic_per_photopic);
    }
    for (std::size_t i = 0; i < 3; ++i)
        source.illuminance_rgb_lx[i] = narrowed(rgb[i]);
    source.illuminance_scotopic_lx = narrowed(scotopic);
    return source;
}

// One evaluation: what is the same for all lights of a frame.
class Evaluation {
  public:
    Evaluation(const LightStore& store, const Observer& observer, const CullingEye& eye, Evaluated& out)
        : store_(store),
          lamps_(store.lamps()),
          lights_(store.arrays()),
          observer_(observer),
          eye_(eye),
          exposure_(exposure_of(observer)),
          out_(out) {}

    void add(LightIndex light) {
        if (!lights_.is(light, light_flag::awake)) return;  // counted all together
        if (observer_.is_day && lights_.is(light, light_flag::day_off)) {
            ++out_.dark;
            return;
        }
        const Pose pose = pose_of(store_, lights_[light].position_m, lights_[light].body_id);
        const Vec3 to_eye_m = observer_.eye_m - pose.position_m;
        const double distance_m = length(to_eye_m);
        const auto radius_m = static_cast<double>(lights_[light].radius_m);
        double unhidden = 1;
        if (observer_.geographic_horizon) {
            unhidden = fraction_above_horizon(distance_m, height_above_water_m(pose.position_m, eye_),
                                              radius_m, eye_.height_m);
        }
        if (unhidden == 0) {
            ++out_.below_horizon;
            return;
        }
        const double most_lx = illuminance_lx(static_cast<double>(lights_[light].peak_cd), distance_m, 0,
                                              observer_.extinction_per_m);
        if (most_lx < eye_.least_lx) {
            ++out_.too_faint;
            out_.too_faint_lx += most_lx;
            return;
        }
        const LightKinds::Kind& kind = store_.kind(light);
        exposure_.stable_key = store_.stable_key(light);
        const LitFractions lit = lit_during(kind.light, exposure_);
        if (is_dark(lit)) {
            ++out_.dark;
            return;
        }
        Sightline sightline;
        if (kind.has_direction)
            sightline = sightline_of(store_.orientation(light), pose, to_eye_m, distance_m, observer_);
        Intensities lux = emitted_cd(kind.light, lit, exposure_, sightline);
        const double scale = lights_[light].intensity_scale * static_cast<double>(lights_[light].visibility);
        double brightest_lx = 0;
        double sum_lx = 0;
        for (double& value : lux) {
            if (value == 0) continue;
            value =
                illuminance_lx(value, distance_m, radius_m, observer_.extinction_per_m) * unhidden * scale;
            brightest_lx = std::max(brightest_lx, value);
            sum_lx += value;
        }
        // One value that is not finite would poison an additive buffer; the comparison keeps it out.
        if (!(brightest_lx >= static_cast<double>(std::numeric_limits<float>::min())) ||
            !is_finite(to_eye_m)) {
            ++out_.dark;
            return;
        }
        if (sum_lx < eye_.least_lx) {
            ++out_.too_faint;
            out_.too_faint_lx += sum_lx;
            return;
        }
        const Vec3 from_eye_m = {-to_eye_m[0], -to_eye_m[1], -to_eye_m[2]};
        out_.sources.push_back(make_source(from_eye_m, radius_m, lux, observer_, lamps_, kind.lamp));
        out_.sources.back().tag = light;
        out_.light.push_back(light);
    }

  private:
    const LightStore& store_;
    const LampRegistry& lamps_;
    const LightArrays& lights_;
    const Observer& observer_;
    const CullingEye& eye_;
    Exposure exposure_;
    Evaluated& out_;
};

}  // namespace

namespace {

void evaluate_above(const CullingEye& eye, const LightStore& store, const Observer& observer, Evaluated& out,
                    Culling culling) {
    out.sources.clear();
    out.light.clear();
    out.total = static_cast<std::uint32_t>(store.size());
    out.dark = store.asleep();
    out.below_horizon = 0;
    out.too_faint = 0;
    out.too_faint_lx = 0;
    Evaluation evaluation(store, observer, eye, out);
    if (culling == Culling::by_index) {
        LeftOutCounts left_out;
        out.marks.resize(store.slot_count());
        store.index().collect(eye, out.marks, left_out);
        out.marks.take_all([&](LightIndex light) { evaluation.add(light); });
        out.dark += left_out.off_by_day;
        out.below_horizon += left_out.below_horizon;
        out.too_faint += left_out.too_faint;
        out.too_faint_lx += left_out.too_faint_lx;
    } else {
        for (LightIndex light = 0; light < store.slot_count(); ++light)
            evaluation.add(light);
    }
}

}  // namespace

void evaluate(const LightStore& store, const Observer& observer, Evaluated& out, Culling culling) {
    CullingEye eye = culling_eye(observer);
    evaluate_above(eye, store, observer, out, culling);
    // In a crowd each may give less. Twice at most by what the sum asks for, then no light is too faint.
    constexpr int most_tries = 2;
    for (int tries = 0; out.too_faint > 0 && out.too_faint_lx > observer.most_left_out_lx; ++tries) {
        const double asked_for = observer.most_left_out_lx / out.too_faint_lx / 2;
        eye.least_lx = std::max(tries < most_tries ? eye.least_lx * asked_for : 0, faintest_lx);
        evaluate_above(eye, store, observer, out, culling);
        if (eye.least_lx <= faintest_lx) break;
    }
    if (!(observer.least_illuminance_lx > 0)) {
        out.dark += out.too_faint;
        out.too_faint = 0;
    }
}

std::array<double, colour_count> intensity_towards_cd(const LightStore& store, const Light& light,
                                                      const Observer& observer) {
    if (!light.on || !(light.visibility > 0) || (light.day_off && observer.is_day)) return {};
    const Exposure exposure = exposure_of(observer);
    const Pose pose = pose_of(store, light.position_m, light.body_id);
    const Vec3 to_eye_m = observer.eye_m - pose.position_m;
    return emitted_cd(
        light, lit_during(light, exposure), exposure,
        sightline_of(normalised(light.orientation), pose, to_eye_m, length(to_eye_m), observer));
}

std::array<double, 3> scene_position_m(const LightStore& store, const Light& light) {
    return pose_of(store, light.position_m, light.body_id).position_m;
}

std::array<double, 3> scene_position_m(const LightStore& store, LightIndex slot) {
    return pose_of(store, store.arrays()[slot].position_m, store.arrays()[slot].body_id).position_m;
}

}  // namespace seaglare::lightdb
