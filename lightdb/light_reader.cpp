#include "lightdb/light_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "lightdb/light_file.h"
#include "lightdb/light_reader_parts.h"
#include "lightdb/light_store.h"

namespace seaglare::lightdb {

namespace {

using json::ObjectReader;

constexpr std::string_view keys[] = {"name",
                                     "lat",
                                     "lon",
                                     "position",
                                     "height_m",
                                     "body",
                                     "orientation",
                                     "true_north_deg",
                                     "character",
                                     "phases",
                                     "sigseq",
                                     "sync_group",
                                     "delay_s",
                                     "rise_s",
                                     "fall_s",
                                     "intensity_cd",
                                     "nominal_range_nm",
                                     "day",
                                     "day_intensity_cd",
                                     "day_range_nm",
                                     "sectors",
                                     "sector_reference",
                                     "leading_bearing_deg",
                                     "horizontal_profile",
                                     "vertical_profile",
                                     "photometry",
                                     "rotation",
                                     "radius_m",
                                     "spectrum",
                                     "phase_key",
                                     "source"};

void read_position(ObjectReader& reader, const std::optional<double>& charted_height_m, Light& light) {
    const bool has_latitude = reader.has("lat");
    const std::span<const json::Value> local = reader.optional_array("position");
    if (has_latitude == reader.has("position")) {
        throw reader.error(
            "give the place either as 'lat' and 'lon' or as 'position' [east_m, north_m, up_m]");
    }
    const std::optional<double> height_m = reader.optional_number("height_m", -500, 5000);
    if (has_latitude) {
        light.geographic = true;
        light.latitude_deg = reader.number("lat", -90, 90);
        light.longitude_deg = reader.number("lon", -180, 180);
        if (!height_m && !charted_height_m)
            throw reader.error("'height_m' is missing, and 'character' has no height");
        light.height_m = height_m ? *height_m : *charted_height_m;
        return;
    }
    if (local.size() == 2) {
        const auto place = reader.numbers<2>("position", -farthest_m, farthest_m);
        if (!height_m && !charted_height_m) {
            throw reader.error("'position' has no third number, so 'height_m' is needed");
        }
        light.height_m = height_m ? *height_m : *charted_height_m;
        light.position_m = {place[0], place[1], light.height_m};
    } else {
        light.position_m = reader.numbers<3>("position", -farthest_m, farthest_m);
        light.height_m = light.position_m[2];
        if (height_m && *height_m != light.height_m) {
            throw reader.require("height_m")
                .error("'height_m' and the third number of 'position' differ: give one");
        }
    }
}

void read_attachment(ObjectReader& reader, Light& light) {
    light.body_id = static_cast<std::uint32_t>(reader.integer("body", 0, 0xFFFFFFFF, 0));
    if (light.body_id != 0 && reader.has("lat"))
        throw reader.error("a light on a body has a 'position' on it, not 'lat' and 'lon'");
    if (const json::Value* north = reader.find("true_north_deg")) {
        if (reader.has("lat"))
            throw north->error("'true_north_deg' follows from 'lat' and 'lon': leave it out");
        light.true_north_deg = json::checked_number(*north, "true_north_deg", -360, 360);
    }
    if (const json::Value* turn = reader.find("orientation")) {
        const auto orientation = reader.numbers<4>("orientation", -1, 1);
        const double length_squared = orientation[0] * orientation[0] + orientation[1] * orientation[1] +
                                      orientation[2] * orientation[2] + orientation[3] * orientation[3];
        if (std::abs(length_squared - 1) > 1e-3) {
            throw turn->error("'orientation' must be a quaternion [x, y, z, w] of length 1");
        }
        light.orientation = orientation;
    }
}

void read_lamp(ObjectReader& reader, Light& light) {
    light.radius_m = reader.number("radius_m", 1e-3, 100, default_radius_m(light));
    static constexpr json::Choice<bool> days[] = {{"on", false}, {"off", true}};
    light.day_off = reader.choice("day", days, false);
}

// What the rhythm's phase hangs on: 16 hexadecimal digits, because a JSON number holds 53 bits.
std::uint64_t read_phase_key(const json::Value& value) {
    const std::string text = json::checked_string(value, "phase_key");
    std::uint64_t key = 0;
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), key, 16);
    if (text.size() != 16 || failed != std::errc() || end != text.data() + text.size() || key == 0)
        throw value.error("'phase_key' must be 16 hexadecimal digits, not all 0");
    return key;
}

void warn_of_missing_sectors(const ObjectReader& reader, const std::optional<Character>& character,
                             const Light& light, std::vector<std::string>& warnings) {
    if (!character || !light.sectors.empty() || character->colours.size() < 2) return;
    ColourSet in_phases{};
    for (const Phase& phase : light.rhythm.phases) {
        if (phase.lit) in_phases[index_of(phase.colour)] = true;
    }
    if (std::count(in_phases.begin(), in_phases.end(), true) > 1) return;  // it alternates
    warnings.emplace_back(
        reader
            .error("the character names several colours, but there are no sectors: one colour "
                   "shows all round")
            .what());
}

}  // namespace

std::optional<Colour> colour_from_name(std::string_view name) {
    for (const ColourName& colour : colour_names) {
        if (name == colour.letters || name == colour.name) return colour.colour;
    }
    return std::nullopt;
}

std::span<const std::string_view> light_keys() {
    return keys;
}

// Parts that need one that failed are left out, so that one mistake is told once.
bool read_light(const json::Value& value, const std::string& default_source, LightFolder& folder,
                Mistakes& mistakes, std::vector<std::string>& warnings, Light& light) {
    std::optional<ObjectReader> opened;
    const bool known = mistakes.attempt([&] {
        const json::Value* const name = value.find("name");
        opened.emplace(value, name != nullptr ? "light '" + std::string(name->string()) + "'" : "light");
        opened->only(keys);
    });
    if (!known) return false;
    ObjectReader& reader = *opened;
    bool good = mistakes.attempt([&] {
        light.name = reader.string("name");
        light.source = reader.string("source", default_source);
    });
    std::optional<Character> character;
    const bool has_character = mistakes.attempt([&] { character = read_character(reader, light, warnings); });
    const bool has_rhythm = mistakes.attempt([&] { read_rhythm(reader, character, light, warnings); });
    const bool has_sectors = mistakes.attempt([&] { read_sectors(reader, light); });
    if (character && character->direction_deg && !light.leading_bearing_deg)
        light.leading_bearing_deg = character->direction_deg;
    const bool has_photometry = mistakes.attempt([&] { read_photometry(reader, folder, light, warnings); });
    good = mistakes.attempt([&] { read_lamp(reader, light); }) && good;
    good = has_character && has_rhythm && has_sectors && has_photometry && good;
    if (has_character) {
        good = mistakes.attempt([&] {
            read_position(reader, character ? character->height_m : std::nullopt, light);
        }) && good;
    }
    if (has_character && has_rhythm && has_sectors && has_photometry) {
        good = mistakes.attempt([&] { read_intensities(reader, character, light); }) && good;
        warn_of_missing_sectors(reader, character, light, warnings);
        good = mistakes.attempt([&] { read_spectrum(reader, folder, light, warnings); }) && good;
    }
    good = mistakes.attempt([&] { read_attachment(reader, light); }) && good;
    good = mistakes.attempt([&] { read_profiles(reader, light); }) && good;
    good = mistakes.attempt([&] { read_rotation(reader, light); }) && good;
    good = mistakes.attempt([&] {
        const json::Value* const key = reader.find("phase_key");
        light.stable_key = key != nullptr ? read_phase_key(*key) : stable_key_of(light);
    }) && good;
    return good;
}

}  // namespace seaglare::lightdb
