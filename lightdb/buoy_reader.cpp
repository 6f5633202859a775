#include "lightdb/buoy_reader.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "lightdb/json/reader.h"
#include "lightdb/light_store.h"

namespace seaglare::lightdb {

namespace {

using json::ObjectReader;

void read_mooring(ObjectReader& reader, Buoy& buoy) {
    const bool geographic = reader.has("lat") || reader.has("lon");
    if (geographic == reader.has("position"))
        throw reader.error("give the mooring either as 'lat' and 'lon' or as 'position' [east_m, north_m]");
    buoy.geographic = geographic;
    if (geographic) {
        buoy.latitude_deg = reader.number("lat", -90, 90);
        buoy.longitude_deg = reader.number("lon", -180, 180);
    } else {
        const auto place = reader.numbers<2>("position", -1e7, 1e7);
        buoy.position_m = {place[0], place[1], 0};
    }
}

// The same wherever and whenever the buoy is loaded: rhythms hang on it.
std::uint32_t made_up_body(const Buoy& buoy) {
    Light stand_in;
    stand_in.name = buoy.name;
    stand_in.geographic = buoy.geographic;
    stand_in.latitude_deg = buoy.latitude_deg;
    stand_in.longitude_deg = buoy.longitude_deg;
    stand_in.position_m = buoy.position_m;
    const std::uint64_t key = stable_key_of(stand_in);
    return first_made_up_body | static_cast<std::uint32_t>(key ^ (key >> 32));
}

double highest_m(const std::vector<Light>& lights, double otherwise_m) {
    if (lights.empty()) return otherwise_m;
    double highest_m = lights.front().position_m[2];
    for (const Light& light : lights)
        highest_m = std::max(highest_m, light.position_m[2]);
    return std::max(highest_m, lowest_focal_height_m);
}

// Appends the light unless it has mistakes.
void read_buoy_light(const json::Value& value, const std::string& source, LightFolder& folder,
                     Mistakes& mistakes, std::vector<std::string>& warnings, BuoyWithLights& into) {
    for (const char* key : {"body", "lat", "lon"})
        if (const json::Value* found = value.find(key))
            throw found->error(
                "a buoy's light has a 'position' in the buoy's frame, and no body but the buoy");
    Light light;
    if (!read_light(value, source, folder, mistakes, warnings, light)) return;
    light.body_id = into.buoy.body_id;
    if (!value.find("phase_key")) light.stable_key = stable_key_of(light);
    into.lights.push_back(std::move(light));
}

}  // namespace

BuoyWithLights read_buoy(const json::Value& value, const std::string& default_source, LightFolder& folder,
                         Mistakes& mistakes, std::vector<std::string>& warnings) {
    const json::Value* const name = value.find("name");
    ObjectReader reader(value, name != nullptr ? "buoy '" + std::string(name->string()) + "'" : "buoy");
    static constexpr std::string_view keys[] = {
        "name",           "lat",           "lon",           "position",     "focal_height_m",
        "heave_period_s", "heave_damping", "roll_period_s", "roll_damping", "max_tilt_deg",
        "body",           "lights",        "source"};
    reader.only(keys);
    BuoyWithLights result;
    Buoy& buoy = result.buoy;
    buoy.name = reader.string("name");
    read_mooring(reader, buoy);
    const auto body = static_cast<std::uint32_t>(reader.integer("body", 1, 0xFFFFFFFF, 0xFFFFFFFF));
    buoy.body_id = reader.has("body") ? body : made_up_body(buoy);
    const std::string source = reader.string("source", default_source);
    for (const json::Value& light : reader.optional_array("lights"))
        mistakes.attempt([&] { read_buoy_light(light, source, folder, mistakes, warnings, result); });
    buoy.focal_height_m = reader.number("focal_height_m", lowest_focal_height_m, highest_focal_height_m,
                                        highest_m(result.lights, buoy.focal_height_m));
    const auto oscillator = [&](const char* period_key, const char* damping_key) {
        Oscillator given;
        if (reader.has(period_key))
            given.period_s = reader.number(period_key, shortest_buoy_period_s, longest_buoy_period_s);
        if (reader.has(damping_key))
            given.damping = reader.number(damping_key, least_buoy_damping, most_buoy_damping);
        return given;
    };
    buoy.heave = oscillator("heave_period_s", "heave_damping");
    buoy.roll = oscillator("roll_period_s", "roll_damping");
    buoy.max_tilt_deg = reader.number("max_tilt_deg", 0, steepest_tilt_deg, buoy.max_tilt_deg);
    reader.finish();
    return result;
}

void write_buoy(json::Writer& writer, const Buoy& buoy) {
    writer.begin_object();
    writer.member("name", buoy.name);
    if (buoy.geographic) {
        writer.member("lat", buoy.latitude_deg);
        writer.member("lon", buoy.longitude_deg);
    } else {
        writer.key("position");
        writer.begin_array(json::Writer::Layout::line);
        writer.value(buoy.position_m[0]);
        writer.value(buoy.position_m[1]);
        writer.end_array();
    }
    writer.member("focal_height_m", buoy.focal_height_m);
    const auto optional = [&](const char* key, double value) {
        if (value > 0) writer.member(key, value);
    };
    optional("heave_period_s", buoy.heave.period_s);
    optional("heave_damping", buoy.heave.damping);
    optional("roll_period_s", buoy.roll.period_s);
    optional("roll_damping", buoy.roll.damping);
    if (buoy.max_tilt_deg != Buoy().max_tilt_deg) writer.member("max_tilt_deg", buoy.max_tilt_deg);
    writer.member("body", static_cast<double>(buoy.body_id));
    writer.end_object();
}

}  // namespace seaglare::lightdb
