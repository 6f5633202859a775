#include "glare/apply/light_instance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "glare/apply/footprint.h"
#include "glare/apply/glare_bound.h"
#include "glare/tone/operators.h"

namespace seaglare::glare {

namespace {

constexpr double quarter_turn_rad = std::numbers::pi / 2;

RectPx to_floats(const PixelRect& rect) {
    if (rect.empty()) return {0, 0, 0, 0};
    return {static_cast<float>(rect.left), static_cast<float>(rect.bottom), static_cast<float>(rect.right),
            static_cast<float>(rect.top)};
}

PixelRect united(const PixelRect& a, const PixelRect& b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    return {std::min(a.left, b.left), std::min(a.bottom, b.bottom), std::max(a.right, b.right),
            std::max(a.top, b.top)};
}

PixelRect grown(const ScreenGeometry& g, PixelRect rect, double by_px) {
    if (rect.empty() && rect.right < rect.left) return rect;
    rect.left = std::clamp(rect.left - by_px, 0.0, static_cast<double>(g.width_px));
    rect.right = std::clamp(rect.right + by_px, 0.0, static_cast<double>(g.width_px));
    rect.bottom = std::clamp(rect.bottom - by_px, 0.0, static_cast<double>(g.height_px));
    rect.top = std::clamp(rect.top + by_px, 0.0, static_cast<double>(g.height_px));
    return rect;
}

// Sets how far the skirt is drawn at full resolution.
void set_fade(const ScreenGeometry& g, const Pattern& pattern, const ReachSettings& reach,
              const GlareBound& bound, double lux, double radius_rad, LightInstance& instance) {
    const double last_nodes = pattern.layer_radius_nodes.empty() ? 0 : pattern.layer_radius_nodes.back();
    const double nodes = instance.disc_nodes;
    double window = std::max(pattern.window_outer, 3 * g.pitch);
    // Must agree with psf_of_disc in shaders/skirt.frag.glsl: a layer reaches farther than the point's skirt by its radius.
    if (nodes <= std::max(last_nodes, 0.25)) {
        const auto upper = std::lower_bound(pattern.layer_radius_nodes.begin(),
                                            pattern.layer_radius_nodes.end(), instance.disc_nodes);
        if (upper != pattern.layer_radius_nodes.end()) window += static_cast<double>(*upper) * pattern.pitch;
    } else {
        const double widening = std::max(1.0, 0.45 * nodes / std::max(last_nodes, 1.5));
        const double ring = std::sqrt((nodes * nodes - last_nodes * last_nodes) * 2 / 3);
        window = (window + last_nodes * pattern.pitch) * widening + ring * pattern.pitch;
    }
    const double crop_rad = bound.reach_rad(reach.threshold_cd_m2 / lux) + radius_rad;
    const double crop = std::max(crop_rad < quarter_turn_rad ? std::sin(crop_rad) : 1.0, 3 * g.pitch);
    double start = window;
    // The coarse grid must resolve the hand-over, unless the light has faded below the threshold there anyway.
    double width = std::max(5 * reach.cell_px * g.pitch, window / 3);
    if (crop < window) {
        start = crop;
        width = std::max(4 * g.pitch, crop / 4);
    }
    instance.fade_start = static_cast<float>(start);
    instance.fade_end = static_cast<float>(start + width);
}

// How far its finer nodes are drawn; 0: not at all. A larger disc than the next layer's has none.
double fine_reach_rad(const Pattern& pattern, const ReachSettings& reach, double lux, double node_pitch,
                      const LightInstance& instance) {
    if (pattern.fine.empty()) return 0;
    const auto slot = static_cast<std::size_t>(instance.lamp_slot);
    const double nodes =
        reach.fine != nullptr ? reach.fine->nodes(slot, reach.threshold_cd_m2 / lux) : fine_radius_nodes;
    return std::asin(std::min(nodes * node_pitch, 1.0));
}

PixelRect core_rect(const ScreenGeometry& g, const Appearance& light, bool ahead, double fine_rad,
                    const LightInstance& instance) {
    PixelRect rect;
    if (ahead) {
        const auto& j = instance.px_from_disc;
        const double disc_px = instance.disc_px;
        const double drawn = disc_px > point_until_px ? std::max(smallest_disc_px / disc_px, 1.0) : 1.0;
        const double reach_x = std::min(drawn * std::hypot(j[0], j[2]), 1e6) + kernel_reach_px + 0.5;
        const double reach_y = std::min(drawn * std::hypot(j[1], j[3]), 1e6) + kernel_reach_px + 0.5;
        rect = grown(g,
                     {instance.centre_px[0] - reach_x, instance.centre_px[1] - reach_y,
                      instance.centre_px[0] + reach_x, instance.centre_px[1] + reach_y},
                     0);
    }
    if (instance.disc_px > rows_until_px) {
        // The rim is soft over the kernel's reach; pixels differ in angle by no more than cos^2.
        const double margin_rad = 4 * g.pitch;
        rect = united(rect, cone_bounds_px(g, light.direction, light.radius_rad + margin_rad));
    }
    if (fine_rad > 0) rect = united(rect, cone_bounds_px(g, light.direction, fine_rad));
    return rect;
}

}  // namespace

double channel_bound_lx(const PointSource& source) {
    double largest = std::abs(source.illuminance_scotopic_lx) / d65_scotopic_ratio * rod_tint[2];
    for (const float channel : source.illuminance_rgb_lx) {
        largest = std::max(largest, static_cast<double>(std::abs(channel)));
    }
    return largest;
}

bool appearance_of(const ScreenGeometry& g, const PointSource& source, Appearance& appearance) {
    const Vec3 position = {source.position_view_m[0], source.position_view_m[1], source.position_view_m[2]};
    const double distance = length(position);
    const double lux = channel_bound_lx(source);
    if (!std::isfinite(distance) || !std::isfinite(lux) || !(lux > 0)) return false;
    for (const float channel : source.illuminance_rgb_lx) {
        if (!std::isfinite(channel)) return false;
    }
    appearance.distance_m = distance;
    // The eye in the very centre of a lamp has it ahead as much as anywhere.
    appearance.direction = distance > 0 ? scaled(position, 1 / distance) : g.forward;
    const double radius = source.radius_m > 0 ? static_cast<double>(source.radius_m) : 0.0;
    appearance.radius_rad = radius < distance ? std::asin(radius / distance) : quarter_turn_rad;
    if (!(radius > 0)) appearance.radius_rad = 0;
    return true;
}

int coarse_cell_px(const ScreenGeometry& g, const Pattern& pattern) {
    const double window_px = pattern.window_outer / g.pitch;
    return static_cast<int>(std::clamp(std::floor(window_px / 6), 1.0, 8.0));
}

PixelRect append_instances(const ScreenGeometry& g, const Pattern& pattern, const ReachSettings& reach,
                           std::span<const PointSource> sources, std::vector<LightInstance>& instances,
                           std::vector<std::uint32_t>* tags) {
    const GlareBound bound(pattern.tail_age_years, pattern.tail_pigmentation, pattern.angular_scale);
    const double node_pitch = pattern.pitch > 0 ? pattern.pitch : g.pitch;
    PixelRect touched;
    for (const PointSource& source : sources) {
        Appearance light;
        if (!appearance_of(g, source, light)) continue;
        LightInstance instance;
        const Vec3& d = light.direction;
        instance.direction = {static_cast<float>(d[0]), static_cast<float>(d[1]), static_cast<float>(d[2])};
        instance.distance_m = static_cast<float>(light.distance_m);
        instance.illuminance = {source.illuminance_rgb_lx[0], source.illuminance_rgb_lx[1],
                                source.illuminance_rgb_lx[2], source.illuminance_scotopic_lx};
        const double chord = 2 * std::sin(light.radius_rad / 2);
        instance.disc_chord = static_cast<float>(chord);
        instance.disc_nodes = static_cast<float>(std::sin(light.radius_rad) / node_pitch * reach.disc_scale);

        std::array<double, 2> centre{};
        const bool ahead = project_px(g, d, centre);
        if (ahead) {
            instance.centre_px = {static_cast<float>(std::clamp(centre[0], -1e6, 1e6)),
                                  static_cast<float>(std::clamp(centre[1], -1e6, 1e6))};
            const double solid_angle = pixel_solid_angle_sr(g, d);
            instance.disc_px =
                static_cast<float>(std::min(chord / std::sqrt(std::max(solid_angle, 1e-18)), 1e6));
            const Tangents tangents = pattern_tangents(g, d);
            const double tangent_radius = std::min(std::tan(light.radius_rad), 1e3);
            const auto along_u = pixel_derivative(g, d, tangents.u);
            const auto along_v = pixel_derivative(g, d, tangents.v);
            const auto px = [tangent_radius](double derivative) {
                return static_cast<float>(std::clamp(derivative * tangent_radius, -1e6, 1e6));
            };
            instance.px_from_disc = {px(along_u[0]), px(along_u[1]), px(along_v[0]), px(along_v[1])};
        } else {
            // Only the disc of a lamp as wide as the sky can still reach the picture.
            instance.disc_px = static_cast<float>(std::min(chord / g.pitch, 1e6));
        }
        if (source.lamp < pattern.slot_of_lamp.size())
            instance.lamp_slot = static_cast<float>(pattern.slot_of_lamp[source.lamp]);
        const double lux = channel_bound_lx(source);
        set_fade(g, pattern, reach, bound, lux, light.radius_rad, instance);

        const double fade_end_rad =
            instance.fade_end < 1 ? std::asin(static_cast<double>(instance.fade_end)) : quarter_turn_rad;
        const bool has_skirt = !pattern.skirt.empty() || pattern.tail_scale > 0;
        const PixelRect skirt = has_skirt ? cone_bounds_px(g, d, fade_end_rad) : PixelRect{};
        PixelRect tail;
        if (pattern.tail_scale > 0 && reach.tails) {
            const double tail_lux = lux * std::max(pattern.tail_scale, 1e-6);
            const double end_rad = bound.reach_rad(reach.tail_threshold_cd_m2 / tail_lux) + light.radius_rad;
            const double start_rad = instance.fade_start < 1
                                         ? std::asin(static_cast<double>(instance.fade_start))
                                         : quarter_turn_rad;
            if (end_rad > start_rad) tail = cone_bounds_px(g, d, end_rad);
        }
        const double fine_rad = fine_reach_rad(pattern, reach, lux, node_pitch, instance);
        const PixelRect core = core_rect(g, light, ahead, fine_rad, instance);
        const PixelRect any = united(united(skirt, tail), core);
        if (any.empty()) continue;
        instance.skirt_rect = to_floats(skirt);
        instance.tail_rect = to_floats(tail);
        instance.core_rect = to_floats(core);
        instances.push_back(instance);
        if (tags != nullptr) tags->push_back(source.tag);
        touched = united(touched, any);
    }
    return touched;
}

}  // namespace seaglare::glare
