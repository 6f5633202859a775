#include "host_stub/scene.h"

#include <cmath>
#include <numbers>

#include "lightdb/json/reader.h"

namespace seaglare::host {
namespace {

using json::ObjectReader;
constexpr double deg = std::numbers::pi / 180;
constexpr double world_m = 200e3;  // farther than this from the origin a flat earth is no earth

// {"lat": …, "lon": …} or {"east_m": …, "north_m": …}.
glm::dvec2 read_place(ObjectReader& in, GeoPoint origin) {
    if (in.has("east_m") || in.has("north_m"))
        return {in.number("east_m", -world_m, world_m), in.number("north_m", -world_m, world_m)};
    const GeoPoint p{in.number("lat", -90, 90), in.number("lon", -180, 180)};
    const glm::dvec2 m = east_north_m(origin, p);
    if (std::abs(m.x) > world_m || std::abs(m.y) > world_m)
        throw in.require("lat").error(in.what() + " lies more than 200 km from the scene's origin");
    return m;
}

glm::dvec2 read_point(const json::Value& value, std::string_view what, GeoPoint origin) {
    ObjectReader in(value, what);
    const glm::dvec2 m = read_place(in, origin);
    in.finish();
    return m;
}

SkyDirection read_direction(ObjectReader& in) {
    return {in.number("elevation_deg", -90, 90), in.number("azimuth_deg", 0, 360)};
}

Sky read_sky(ObjectReader in) {
    Sky sky;
    ObjectReader sun = in.object("sun");
    sky.sun = read_direction(sun);
    sun.finish();
    if (auto moon = in.optional_object("moon")) {
        sky.moon = read_direction(*moon);
        sky.moon_illuminated = moon->number("illuminated", 0, 1, 1);
        moon->finish();
    }
    sky.night_luminance_cd_m2 = in.number("night_luminance_cd_m2", 1e-5, 1, sky.night_luminance_cd_m2);
    sky.stars = in.boolean("stars", true);
    in.finish();
    return sky;
}

Observer read_observer(const json::Value& value, std::string_view name, GeoPoint origin) {
    ObjectReader in(value, "observer '" + std::string(name) + "'");
    Observer o;
    o.name = name;
    o.position_m = read_place(in, origin);
    o.eye_height_m = in.number("eye_height_m", 0.5, 500, o.eye_height_m);
    o.heading_deg = in.number("heading_deg", 0, 360);
    o.pitch_deg = in.number("pitch_deg", -89, 89, 0);
    o.speed_kn = in.number("speed_kn", -60, 60, 0);
    in.finish();
    return o;
}

Town read_town(const json::Value& value, GeoPoint origin) {
    ObjectReader in(value, "town");
    Town t;
    t.name = in.string("name");
    t.position_m = read_place(in, origin);
    t.luminance_cd_m2 = in.number("luminance_cd_m2", 0, 10);
    t.width_deg = in.number("width_deg", 1, 180, t.width_deg);
    t.height_deg = in.number("height_deg", 0.2, 45, t.height_deg);
    in.finish();
    return t;
}

Coast read_coast(const json::Value& value, GeoPoint origin) {
    ObjectReader in(value, "coast");
    Coast c;
    c.name = in.string("name");
    for (const json::Value& point : in.array("shore"))
        c.shore_m.push_back(read_point(point, "shore point", origin));
    if (c.shore_m.size() < 2) throw in.require("shore").error("a shore needs two points or more");
    c.height_m = in.number("height_m", 0, 2000, c.height_m);
    c.setback_m = in.number("setback_m", 1, 20000, c.setback_m);
    c.roughness = in.number("roughness", 0, 1, c.roughness);
    c.seed = static_cast<std::uint32_t>(in.integer("seed", 0, 1LL << 31, 1));
    in.finish();
    return c;
}

Structure read_structure(const json::Value& value, GeoPoint origin) {
    ObjectReader in(value, "structure");
    Structure s;
    s.name = in.string("name");
    s.from_m = read_point(in.require("from"), "from", origin);
    s.to_m = read_point(in.require("to"), "to", origin);
    s.width_m = in.number("width_m", 0.1, 2000, s.width_m);
    s.top_width_m = in.number("top_width_m", 0, 2000, s.width_m);
    s.bottom_m = in.number("bottom_m", -10, 1000, s.bottom_m);
    s.top_m = in.number("top_m", -10, 1000);
    if (s.top_m <= s.bottom_m) throw in.require("top_m").error("top_m must be above bottom_m");
    s.to_bottom_m = in.number("to_bottom_m", -10, 1000, s.bottom_m);
    s.to_top_m = in.number("to_top_m", -10, 1000, s.to_bottom_m + s.top_m - s.bottom_m);
    if (s.to_top_m <= s.to_bottom_m) throw in.error("to_top_m must be above to_bottom_m");
    s.sag_m = in.number("sag_m", 0, 1000, 0);
    if (in.has("pillar_spacing_m")) s.pillar_spacing_m = in.number("pillar_spacing_m", 5, 5000);
    s.pillar_width_m = in.number("pillar_width_m", 0.2, 200, s.pillar_width_m);
    s.albedo = in.number("albedo", 0, 1, s.albedo);
    in.finish();
    return s;
}

Crowd read_crowd(ObjectReader in) {
    Crowd c;
    c.count = static_cast<std::uint32_t>(in.integer("count", 0, 1'000'000));
    c.seed = static_cast<std::uint32_t>(in.integer("seed", 0, 1LL << 31, 1));
    const auto range = [&](std::string_view key, double lowest, double& low, double& high) {
        const auto pair = in.numbers<2>(key, lowest, 1e8, {low, high});
        if (pair[0] > pair[1]) throw in.require(key).error(std::string(key) + " must be [smaller, larger]");
        low = pair[0];
        high = pair[1];
    };
    range("distance_m", 1, c.distance_min_m, c.distance_max_m);
    range("intensity_cd", 1e-3, c.intensity_min_cd, c.intensity_max_cd);
    range("radius_m", 1e-4, c.radius_min_m, c.radius_max_m);
    c.margin = in.number("margin", 0, 0.49, 0);
    c.sway_m = in.number("sway_m", 0, 100, 0);
    c.flashing = in.number("flashing", 0, 1, 0);
    in.finish();
    return c;
}

std::filesystem::path relative_to(const std::filesystem::path& file, const std::string& path) {
    return (file.parent_path() / path).lexically_normal();
}

}  // namespace

void Channel::resize(int width, int height) {
    const double old_aspect = static_cast<double>(width_px) / height_px;
    const double scale = static_cast<double>(width) / height / old_aspect;
    left_deg = std::atan(std::tan(left_deg * deg) * scale) / deg;
    right_deg = std::atan(std::tan(right_deg * deg) * scale) / deg;
    width_px = width;
    height_px = height;
}

const Observer* Scene::find_observer(std::string_view wanted) const {
    if (wanted.empty()) return &observers.front();
    for (const Observer& o : observers)
        if (o.name == wanted) return &o;
    return nullptr;
}

const Channel* Scene::find_channel(std::string_view wanted) const {
    if (wanted.empty()) return &channels.front();
    for (const Channel& c : channels)
        if (c.name == wanted) return &c;
    return nullptr;
}

Channel load_channel(const std::filesystem::path& path) {
    static constexpr json::Choice<TargetFormat> targets[] = {
        {"rgba8_srgb_values", TargetFormat::rgba8_srgb_values},
        {"srgb8_alpha8", TargetFormat::srgb8_alpha8},
        {"rgba16f_linear", TargetFormat::rgba16f_linear}};
    const json::Document document = json::parse_file(path.string());
    ObjectReader in(document.root(), "channel");
    Channel c;
    c.name = in.string("name");
    c.width_px = static_cast<int>(in.integer("width_px", 1, 16384));
    c.height_px = static_cast<int>(in.integer("height_px", 1, 16384));
    if (auto frustum = in.optional_object("frustum")) {
        c.left_deg = frustum->number("left_deg", -89, 89);
        c.right_deg = frustum->number("right_deg", -89, 89);
        c.down_deg = frustum->number("down_deg", -89, 89);
        c.up_deg = frustum->number("up_deg", -89, 89);
        if (c.left_deg >= c.right_deg) throw frustum->error("left_deg must be less than right_deg");
        if (c.down_deg >= c.up_deg) throw frustum->error("down_deg must be less than up_deg");
        frustum->finish();
        if (in.has("vertical_fov_deg"))
            throw in.require("vertical_fov_deg")
                .error("a channel has a frustum or vertical_fov_deg, not both");
    } else {
        c.up_deg = in.number("vertical_fov_deg", 0.1, 170) / 2;
        c.down_deg = -c.up_deg;
        c.right_deg = std::atan(std::tan(c.up_deg * deg) * c.width_px / c.height_px) / deg;
        c.left_deg = -c.right_deg;
    }
    c.yaw_deg = in.number("yaw_deg", -180, 360, 0);
    c.pitch_deg = in.number("pitch_deg", -90, 90, 0);
    c.roll_deg = in.number("roll_deg", -180, 180, 0);
    c.target = in.choice("target", targets, TargetFormat::rgba8_srgb_values);
    in.finish();
    return c;
}

Scene load_scene(const std::filesystem::path& path) {
    const json::Document document = json::parse_file(path.string());
    ObjectReader in(document.root(), "scene");
    Scene s;
    s.file = path;
    s.name = in.string("name");
    s.description = in.string("description", "");
    {
        ObjectReader origin = in.object("origin");
        s.origin = {origin.number("lat", -89, 89), origin.number("lon", -180, 180)};
        origin.finish();
    }
    s.local_time_h = in.number("local_time_h", 0, 24);
    s.start_s = in.number("start_s", 0, 1e9, 0);
    s.sky = read_sky(in.object("sky"));
    s.adaptation_cd_m2 = in.optional_number("adaptation_luminance_cd_m2", 1e-6, 1e6);
    if (auto weather = in.optional_object("weather")) {
        s.visibility_m = weather->optional_number("visibility_m", 1, 1e6);
        s.wind_speed_m_s = weather->number("wind_speed_m_s", 0, 30, s.wind_speed_m_s);
        s.wind_from_deg = weather->number("wind_from_deg", 0, 360, s.wind_from_deg);
        weather->finish();
    }
    for (const auto& [name, value] : in.require("observers").object())
        s.observers.push_back(read_observer(value, name, s.origin));
    if (s.observers.empty())
        throw in.require("observers").error("observers must be an object with one observer or more, by name");
    for (const json::Value& channel : in.array("channels"))
        s.channels.push_back(load_channel(relative_to(path, json::checked_string(channel, "channel"))));
    if (s.channels.empty()) throw in.require("channels").error("a scene needs a channel");
    for (const json::Value& file : in.optional_array("lights"))
        s.light_files.push_back(relative_to(path, json::checked_string(file, "lights")));
    if (const auto quality = in.optional_string("quality")) s.quality_file = relative_to(path, *quality);
    for (const json::Value& town : in.optional_array("towns"))
        s.towns.push_back(read_town(town, s.origin));
    for (const json::Value& coast : in.optional_array("coasts"))
        s.coasts.push_back(read_coast(coast, s.origin));
    for (const json::Value& structure : in.optional_array("structures"))
        s.structures.push_back(read_structure(structure, s.origin));
    if (auto crowd = in.optional_object("crowd")) s.crowd = read_crowd(*crowd);
    s.seed = static_cast<std::uint64_t>(in.integer("seed", 0, 1LL << 53, 1));
    in.finish();
    return s;
}

}  // namespace seaglare::host
