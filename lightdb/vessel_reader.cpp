#include "lightdb/vessel_reader.h"

#include <cmath>
#include <numbers>

#include "lightdb/colreg.h"
#include "lightdb/json/reader.h"
#include "lightdb/light_store.h"
#include "lightdb/vector_math.h"

namespace seaglare::lightdb {

namespace {

using json::ObjectReader;

VesselKind read_kind(ObjectReader& reader) {
    const json::Value& value = reader.require("kind");
    const std::string name = json::checked_string(value, "kind");
    const auto names = vessel_kind_names();
    for (std::size_t i = 0; i < names.size(); ++i)
        if (names[i] == name) return static_cast<VesselKind>(i);
    std::string text = "'" + name + "' is no kind of vessel: use";
    for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? " " : ", ") + std::string(names[i]);
    throw value.error(text);
}

// Ranges are check_vessel()'s, whose error is then shown at the key; what is read here only has to be a number.
Vessel read_numbers_and_options(ObjectReader& reader) {
    constexpr double any = 1e9;
    Vessel vessel;
    vessel.name = reader.string("name");
    vessel.kind = read_kind(reader);
    vessel.length_m = reader.number("length_m", -any, any);
    vessel.breadth_m = reader.number("breadth_m", -any, any);
    vessel.body_id = static_cast<std::uint32_t>(reader.integer("body", 0, 0xFFFFFFFF, 0));
    vessel.making_way = reader.boolean("making_way", true);
    vessel.at_anchor = reader.boolean("at_anchor", false);
    vessel.tow_length_m = reader.number("tow_length_m", -any, any, 0);
    vessel.restricted_by_tow = reader.boolean("restricted_by_tow", false);
    static constexpr json::Choice<Side> sides[] = {
        {"none", Side::none}, {"port", Side::port}, {"starboard", Side::starboard}};
    vessel.obstruction_side = reader.choice("obstruction_side", sides, Side::none);
    vessel.gear_extent_m = reader.number("gear_extent_m", -any, any, 0);
    vessel.gear_bearing_deg = reader.number("gear_bearing_deg", -any, any, vessel.gear_bearing_deg);
    static constexpr json::Choice<FishingSignal> signals[] = {{"none", FishingSignal::none},
                                                              {"shooting_nets", FishingSignal::shooting_nets},
                                                              {"hauling_nets", FishingSignal::hauling_nets},
                                                              {"nets_fast", FishingSignal::nets_fast},
                                                              {"purse_seine", FishingSignal::purse_seine}};
    vessel.fishing_signal = reader.choice("fishing_signal", signals, FishingSignal::none);
    vessel.second_masthead = reader.boolean("second_masthead", false);
    vessel.all_round_white = reader.boolean("all_round_white", false);
    vessel.no_sidelights = reader.boolean("no_sidelights", false);
    vessel.combined_sidelights = reader.boolean("combined_sidelights", false);
    vessel.tricolour = reader.boolean("tricolour", false);
    vessel.red_over_green = reader.boolean("red_over_green", false);
    vessel.two_anchor_lights = reader.boolean("two_anchor_lights", false);
    vessel.deck_lights_cd = reader.optional_number("deck_lights_cd", -any, any);
    vessel.deck_height_m = reader.number("deck_height_m", -any, any, 0);
    vessel.mast_height_m = reader.number("mast_height_m", -any, any, 0);
    vessel.mast_separation_m = reader.number("mast_separation_m", -any, any, 0);
    vessel.amidships_m = reader.numbers<3>("amidships", -any, any, {0, 0, 0});
    vessel.intensity_factor = reader.number("intensity_factor", -any, any, 1);
    vessel.radius_m = reader.number("radius_m", -any, any, vessel.radius_m);
    static constexpr json::Choice<bool> days[] = {{"on", false}, {"off", true}};
    vessel.day_off = reader.choice("day", days, false);
    return vessel;
}

// Where a vessel without a body lies.
struct Berth {
    bool geographic = false;
    double latitude_deg = 0;
    double longitude_deg = 0;
    double east_m = 0;
    double north_m = 0;
    double heading_deg = 0;
};

std::optional<Berth> read_berth(ObjectReader& reader, std::uint32_t body_id) {
    const bool local = reader.has("position");
    const bool geographic = reader.has("lat") || reader.has("lon");
    if (body_id != 0) {
        for (const char* key : {"position", "lat", "lon", "heading_deg"})
            if (const json::Value* value = reader.find(key))
                throw value->error(
                    "a vessel on a body has no place or heading of her own: the body moves her");
        return std::nullopt;
    }
    if (local == geographic) {
        throw reader.error(
            "give a 'body' that the host moves, or where she lies: 'position' [east_m, north_m] or 'lat' and "
            "'lon'");
    }
    Berth berth;
    berth.geographic = geographic;
    berth.heading_deg = reader.number("heading_deg", -360, 360);
    if (geographic) {
        berth.latitude_deg = reader.number("lat", -89.9, 89.9);
        berth.longitude_deg = reader.number("lon", -180, 180);
    } else {
        const auto place = reader.numbers<2>("position", -1e7, 1e7);
        berth.east_m = place[0];
        berth.north_m = place[1];
    }
    return berth;
}

// Degrees of latitude and longitude per metre north and east: radii of curvature of WGS 84.
struct DegreesPerMetre {
    double latitude;
    double longitude;
    explicit DegreesPerMetre(double latitude_deg) {
        constexpr double a = 6378137, e2 = 0.00669437999014;
        constexpr double deg = 180 / std::numbers::pi;
        const double s = std::sin(latitude_deg / deg);
        const double w2 = 1 - e2 * s * s;
        latitude = deg / (a * (1 - e2) / (w2 * std::sqrt(w2)));
        longitude = deg / (a / std::sqrt(w2) * std::cos(latitude_deg / deg));
    }
};

void lay_at(const Berth& berth, std::vector<Light>& lights) {
    const double half_rad = berth.heading_deg * std::numbers::pi / 360;
    const Quaternion heading = {0, 0, -std::sin(half_rad), std::cos(half_rad)};  // clockwise seen from above
    const DegreesPerMetre per_metre(berth.latitude_deg);
    for (Light& light : lights) {
        const Vec3 offset_m = rotate(heading, light.position_m);
        light.orientation = heading;
        light.height_m = offset_m[2];
        if (berth.geographic) {
            light.geographic = true;
            light.latitude_deg = berth.latitude_deg + offset_m[1] * per_metre.latitude;
            light.longitude_deg = berth.longitude_deg + offset_m[0] * per_metre.longitude;
            light.position_m = {};
        } else {
            light.position_m = {berth.east_m + offset_m[0], berth.north_m + offset_m[1], offset_m[2]};
        }
    }
}

}  // namespace

std::vector<Light> read_vessel(const json::Value& value, const std::string& default_source,
                               std::vector<std::string>& warnings) {
    const json::Value* const name = value.find("name");
    ObjectReader reader(value, name != nullptr ? "vessel '" + std::string(name->string()) + "'" : "vessel");
    static constexpr std::string_view keys[] = {"name",
                                                "kind",
                                                "length_m",
                                                "breadth_m",
                                                "body",
                                                "position",
                                                "lat",
                                                "lon",
                                                "heading_deg",
                                                "making_way",
                                                "at_anchor",
                                                "tow_length_m",
                                                "restricted_by_tow",
                                                "obstruction_side",
                                                "gear_extent_m",
                                                "gear_bearing_deg",
                                                "fishing_signal",
                                                "second_masthead",
                                                "all_round_white",
                                                "no_sidelights",
                                                "combined_sidelights",
                                                "tricolour",
                                                "red_over_green",
                                                "two_anchor_lights",
                                                "deck_lights_cd",
                                                "deck_height_m",
                                                "mast_height_m",
                                                "mast_separation_m",
                                                "amidships",
                                                "intensity_factor",
                                                "radius_m",
                                                "day",
                                                "source"};
    reader.only(keys);
    const Vessel vessel = read_numbers_and_options(reader);
    const std::optional<Berth> berth = read_berth(reader, vessel.body_id);
    const std::string source = reader.string("source", default_source);
    reader.finish();

    std::vector<Light> lights;
    try {
        lights = colreg_lights(vessel);
    } catch (const VesselError& error) {
        const json::Value* const culprit = value.find(error.field());
        throw culprit != nullptr ? culprit->error(error.what()) : reader.error(error.what());
    }
    for (const std::string& note : colreg_notes(vessel))
        warnings.emplace_back(reader.error(note).what());
    if (berth) lay_at(*berth, lights);
    for (Light& light : lights) {
        if (!source.empty()) light.source = source + "; " + light.source;
        light.stable_key = stable_key_of(light);
    }
    return lights;
}

}  // namespace seaglare::lightdb
