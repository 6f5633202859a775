#include "lightdb/light_reader.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include "lightdb/character.h"
#include "lightdb/json/reader.h"
#include "lightdb/light_file.h"
#include "lightdb/light_store.h"
#include "lightdb/photometry.h"
#include "lightdb/profile.h"
#include "lightdb/sector.h"
#include "lightdb/vector_math.h"

namespace seaglare::lightdb {

namespace {

using json::ObjectReader;
using ColourSet = std::array<bool, colour_count>;

// The extremes that evaluation is tested for.
constexpr double farthest_m = 1e7;
constexpr double brightest_cd = 1e8;
constexpr double longest_range_nm = 38;  // 1e8 cd by the nominal range's formula
constexpr double longest_phase_s = 3600;
constexpr double shortest_phase_s = 1e-3;
constexpr double period_tolerance_s = 0.051;  // of sums of durations that were rounded to tenths

struct ColourName {
    std::string_view letters;
    std::string_view name;
    Colour colour;
};
constexpr ColourName colour_names[] = {
    {"W", "white", Colour::white},    {"R", "red", Colour::red},    {"G", "green", Colour::green},
    {"Y", "yellow", Colour::yellow},  {"Bu", "blue", Colour::blue}, {"Or", "orange", Colour::orange},
    {"Vi", "violet", Colour::violet},
};

std::size_t index_of(Colour colour) {
    return static_cast<std::size_t>(colour);
}

Colour read_colour(const json::Value& value) {
    const std::string name = json::checked_string(value, "colour");
    if (const auto colour = colour_from_name(name)) return *colour;
    throw value.error("'" + name + "' is no colour: use W, R, G, Y, Bu, Or, Vi or white, red, green, …");
}

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

void read_phases(std::span<const json::Value> phases, Rhythm& rhythm) {
    rhythm.phases.clear();
    rhythm.period_s = 0;
    for (const json::Value& value : phases) {
        ObjectReader reader(value, "phase");
        Phase phase;
        phase.lit = reader.has("lit");
        if (phase.lit == reader.has("eclipse"))
            throw reader.error("give either 'lit' or 'eclipse', in seconds");
        phase.duration_s = reader.number(phase.lit ? "lit" : "eclipse", shortest_phase_s, longest_phase_s);
        if (phase.lit) {
            if (const json::Value* colour = reader.find("colour")) phase.colour = read_colour(*colour);
            phase.level = reader.number("level", 0, 1, 1);
        }
        reader.finish();
        rhythm.period_s += phase.duration_s;
        rhythm.phases.push_back(phase);
    }
}

std::vector<Sector> read_sectors(std::span<const json::Value> sectors) {
    std::vector<Sector> result;
    for (const json::Value& value : sectors) {
        ObjectReader reader(value, "sector");
        Sector sector;
        const json::Value& colour = reader.require("colour");
        if (colour.kind() != json::Kind::null && colour.string() != "obscured")
            sector.colour = read_colour(colour);
        sector.from_deg = reader.number("from", -360, 360);
        sector.to_deg = reader.number("to", -360, 720);
        sector.intensity_factor = reader.number("intensity_factor", 0, 100, 1);
        sector.transition_deg = reader.number("transition_deg", 0, 90, 0);
        reader.finish();
        if (sector_width_deg(sector) == 0)
            throw value.error("the sector has no width: 'from' and 'to' are equal");
        result.push_back(sector);
    }
    return result;
}

AngleTable read_vertical_profile(const json::Value& value) {
    if (value.kind() == json::Kind::string) {
        if (auto profile = named_vertical_profile(value.string())) return *std::move(profile);
        std::string text = "there is no vertical profile '" + std::string(value.string()) + "', only";
        for (const std::string_view name : vertical_profile_names())
            text += " '" + std::string(name) + "'";
        throw value.error(text);
    }
    ObjectReader reader(value, "vertical_profile");
    AngleTable table{reader.number_list("angle_deg", -90, 90), reader.number_list("factor", 0, 10)};
    reader.finish();
    if (table.angle_deg.empty()) throw value.error("'angle_deg' has no numbers");
    if (table.angle_deg.size() != table.factor.size()) {
        throw value.error("'angle_deg' has " + std::to_string(table.angle_deg.size()) +
                          " numbers and 'factor' " + std::to_string(table.factor.size()));
    }
    for (std::size_t i = 1; i < table.angle_deg.size(); ++i) {
        if (table.angle_deg[i] <= table.angle_deg[i - 1]) throw value.error("'angle_deg' must ascend");
    }
    return table;
}

// The colours that the light shows somewhere at some time, or that its character names.
struct Colours {
    ColourSet shown{};
    ColourSet named{};
};

Colours colours_of(const Light& light, const std::optional<Character>& character) {
    Colours colours;
    if (character) {
        for (const Colour colour : character->colours)
            colours.named[index_of(colour)] = true;
    }
    for (const Sector& sector : light.sectors) {
        if (sector.colour) colours.shown[index_of(*sector.colour)] = true;
    }
    if (light.sectors.empty()) {
        for (const Phase& phase : light.rhythm.phases) {
            if (phase.lit) colours.shown[index_of(phase.colour)] = true;
        }
        if (light.rhythm.phases.empty()) {
            colours.shown[index_of(character ? character->colours.front() : Colour::white)] = true;
        }
    }
    for (std::size_t c = 0; c < colour_count; ++c)
        colours.named[c] = colours.named[c] || colours.shown[c];
    return colours;
}

// A number for every colour, or an object with one for each. `given` marks the colours that have a value.
std::array<double, colour_count> read_per_colour(const json::Value& value, std::string_view key, double max,
                                                 const Colours& colours, ColourSet& given) {
    std::array<double, colour_count> result{};
    if (value.kind() == json::Kind::number) {
        result.fill(json::checked_number(value, key, 0, max));
        given = colours.named;
        return result;
    }
    ObjectReader reader(value, key);
    for (const ColourName& colour : colour_names) {
        const bool by_letters = reader.has(colour.letters);
        if (by_letters && reader.has(colour.name)) throw reader.error("the same colour twice");
        const auto number = reader.optional_number(by_letters ? colour.letters : colour.name, 0, max);
        if (!number) continue;
        result[index_of(colour.colour)] = *number;
        given[index_of(colour.colour)] = true;
    }
    reader.finish();
    return result;
}

// Ranges as a chart writes them. Without letters "12-9M" runs from the first colour's, the largest, to the smallest.
std::array<double, colour_count> charted_ranges_nm(const Character& character, ColourSet& given) {
    std::array<double, colour_count> result{};
    const auto& ranges = character.range_nm;
    const auto set = [&](Colour colour, double range_nm) {
        result[index_of(colour)] = range_nm;
        given[index_of(colour)] = true;
    };
    for (std::size_t i = 0; i < character.colours.size() && !ranges.empty(); ++i) {
        set(character.colours[i], ranges[std::min(i, ranges.size() - 1)].second);
    }
    for (const auto& [colour, range_nm] : ranges) {
        if (colour) set(*colour, range_nm);
    }
    return result;
}

void read_intensity(ObjectReader& reader, const std::optional<Character>& character, Light& light) {
    const Colours colours = colours_of(light, character);
    ColourSet given{};
    const json::Value* const intensity = reader.find("intensity_cd");
    const json::Value* const range = reader.find("nominal_range_nm");
    if (intensity != nullptr && range != nullptr) {
        throw range->error("give either 'intensity_cd' or 'nominal_range_nm', not both");
    }
    std::array<double, colour_count> values{};
    if (intensity != nullptr) {
        values = read_per_colour(*intensity, "intensity_cd", brightest_cd, colours, given);
    } else {
        if (range != nullptr) {
            values = read_per_colour(*range, "nominal_range_nm", longest_range_nm, colours, given);
        } else if (character && !character->range_nm.empty()) {
            values = charted_ranges_nm(*character, given);
        } else {
            throw reader.error(
                "'intensity_cd' or 'nominal_range_nm' is missing, and 'character' has no range");
        }
        for (double& value : values)
            value = intensity_for_range_cd(value);
    }
    for (std::size_t c = 0; c < colour_count; ++c) {
        light.intensity_cd[c] = given[c] ? values[c] : 0;
        if (colours.shown[c] && !given[c]) {
            throw reader.error("the light shows " + std::string(colour_names[c].name) +
                               ", but has no intensity for it");
        }
    }
}

std::optional<Character> read_character(ObjectReader& reader, Light& light,
                                        std::vector<std::string>& warnings) {
    const json::Value* const value = reader.find("character");
    if (value == nullptr) return std::nullopt;
    light.character = json::checked_string(*value, "character");
    try {
        Character character = parse_character(light.character);
        for (const std::string& warning : character.warnings)
            warnings.emplace_back(value->error(warning).what());
        light.rhythm = character.rhythm;
        return character;
    } catch (const CharacterError& error) {
        throw value->error("the character '" + light.character + "' cannot be read at its character " +
                           std::to_string(error.offset + 1) + ": " + error.what());
    }
}

void read_rhythm(ObjectReader& reader, const std::optional<Character>& character, Light& light,
                 std::vector<std::string>& warnings) {
    if (const json::Value* phases = reader.find("phases")) {
        read_phases(reader.array("phases"), light.rhythm);
        if (character && character->period_s &&
            std::abs(*character->period_s - light.rhythm.period_s) > period_tolerance_s) {
            warnings.emplace_back(phases
                                      ->error("the phases last " + std::to_string(light.rhythm.period_s) +
                                              " s, the character's period is " +
                                              std::to_string(*character->period_s) + " s: the phases hold")
                                      .what());
        }
    }
    light.rhythm.sync_group = reader.string("sync_group", "");
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

Light read_light(const json::Value& value, const std::string& default_source,
                 std::vector<std::string>& warnings) {
    const json::Value* const name = value.find("name");
    ObjectReader reader(value, name != nullptr ? "light '" + std::string(name->string()) + "'" : "light");
    static constexpr std::string_view keys[] = {"name",
                                                "lat",
                                                "lon",
                                                "position",
                                                "height_m",
                                                "character",
                                                "phases",
                                                "intensity_cd",
                                                "nominal_range_nm",
                                                "sectors",
                                                "sector_reference",
                                                "vertical_profile",
                                                "radius_m",
                                                "spectrum",
                                                "body",
                                                "day",
                                                "true_north_deg",
                                                "orientation",
                                                "sync_group",
                                                "source"};
    reader.only(keys);
    Light light;
    light.name = reader.string("name");

    const std::optional<Character> character = read_character(reader, light, warnings);
    read_rhythm(reader, character, light, warnings);
    read_position(reader, character ? character->height_m : std::nullopt, light);
    light.sectors = read_sectors(reader.optional_array("sectors"));
    static constexpr json::Choice<SectorReference> references[] = {
        {"from_seaward", SectorReference::from_seaward},
        {"outward_from_ahead", SectorReference::outward_from_ahead},
    };
    light.sector_reference = reader.choice("sector_reference", references, SectorReference::from_seaward);
    read_intensity(reader, character, light);
    if (const json::Value* profile = reader.find("vertical_profile"))
        light.vertical = read_vertical_profile(*profile);
    light.radius_m = reader.number("radius_m", 1e-3, 100, light.radius_m);
    light.spectrum = reader.string("spectrum", "");
    light.body_id = static_cast<std::uint32_t>(reader.integer("body", 0, 0xFFFFFFFF, 0));
    static constexpr json::Choice<bool> days[] = {{"on", false}, {"off", true}};
    light.day_off = reader.choice("day", days, false);
    if (const json::Value* north = reader.find("true_north_deg")) {
        if (light.geographic)
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
    light.source = reader.string("source", default_source);
    reader.finish();

    if (light.geographic && light.body_id != 0) {
        throw reader.error("a light on a body has a 'position' on it, not 'lat' and 'lon'");
    }
    warn_of_missing_sectors(reader, character, light, warnings);
    light.stable_key = stable_key_of(light);
    return light;
}

}  // namespace seaglare::lightdb
