// How bright: candela or ranges, by night and by day, for each colour that the light shows.
#include <algorithm>

#include "lightdb/light_file.h"
#include "lightdb/light_reader_parts.h"
#include "lightdb/photometry.h"

namespace seaglare::lightdb {

namespace {

using json::ObjectReader;
using PerColour = std::array<double, colour_count>;

// A number for every colour, or an object with one for each. `given` marks the colours that have a value.
PerColour read_per_colour(const json::Value& value, std::string_view key, double max, const Colours& colours,
                          ColourSet& given) {
    PerColour result{};
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
PerColour charted_ranges_nm(const Character& character, ColourSet& given) {
    PerColour result{};
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

// The two ways to say how bright, and by which threshold a range is meant.
struct Keys {
    std::string_view intensity;
    std::string_view range;
    double longest_nm;
    double threshold_lx;
    std::string_view what;
};
constexpr Keys by_night = {"intensity_cd", "nominal_range_nm", longest_range_nm, night_threshold_lx,
                           "intensity"};
constexpr Keys by_day = {"day_intensity_cd", "day_range_nm", longest_day_range_nm, day_threshold_lx,
                         "intensity by day"};

void throw_if_both(ObjectReader& reader, const Keys& keys) {
    if (!reader.has(keys.intensity) || !reader.has(keys.range)) return;
    throw reader.require(keys.range)
        .error("give either '" + std::string(keys.intensity) + "' or '" + std::string(keys.range) +
               "', not both");
}

// Candela from whichever key is there; nothing when neither is.
std::optional<PerColour> read_pair(ObjectReader& reader, const Keys& keys, const Colours& colours,
                                   ColourSet& given) {
    throw_if_both(reader, keys);
    if (const json::Value* intensity = reader.find(keys.intensity))
        return read_per_colour(*intensity, keys.intensity, brightest_cd, colours, given);
    const json::Value* const range = reader.find(keys.range);
    if (range == nullptr) return std::nullopt;
    PerColour values = read_per_colour(*range, keys.range, keys.longest_nm, colours, given);
    for (double& value : values)
        value = intensity_for_range_cd(value, keys.threshold_lx);
    return values;
}

// Keeps what was given and sees that every colour that is shown has something.
PerColour checked(const ObjectReader& reader, const Keys& keys, const Colours& colours,
                  const PerColour& values, const ColourSet& given) {
    PerColour result{};
    for (std::size_t c = 0; c < colour_count; ++c) {
        if (given[c]) result[c] = values[c];
        if (colours.shown[c] && !given[c]) {
            throw reader.error("the light shows " + std::string(colour_names[c].name) + ", but has no " +
                               std::string(keys.what) + " for it");
        }
    }
    return result;
}

bool all_zero(const PerColour& values) {
    return std::all_of(values.begin(), values.end(), [](double value) { return value == 0; });
}

}  // namespace

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

void read_intensities(ObjectReader& reader, const std::optional<Character>& character, Light& light) {
    const Colours colours = colours_of(light, character);
    ColourSet given{};
    std::optional<PerColour> night_cd = read_pair(reader, by_night, colours, given);
    if (!night_cd && character && !character->range_nm.empty()) {
        night_cd = charted_ranges_nm(*character, given);
        for (double& value : *night_cd)
            value = intensity_for_range_cd(value);
    }
    if (!night_cd && light.photometry) {
        night_cd.emplace().fill(light.photometry->reference_cd);  // the file's candela hold as they are
        given = colours.named;
    }
    if (!night_cd) {
        throw reader.error("'intensity_cd' or 'nominal_range_nm' is missing, and 'character' has no range");
    }
    light.intensity_cd = checked(reader, by_night, colours, *night_cd, given);

    ColourSet given_by_day{};
    const std::optional<PerColour> day_cd = read_pair(reader, by_day, colours, given_by_day);
    if (!day_cd) return;
    const json::Value& place = reader.require(reader.has(by_day.intensity) ? by_day.intensity : by_day.range);
    if (light.day_off) throw place.error("the light is off by day ('day'), and yet has an intensity by day");
    light.day_intensity_cd = checked(reader, by_day, colours, *day_cd, given_by_day);
    if (all_zero(light.day_intensity_cd))
        throw place.error("a light without intensity by day is switched off then: \"day\": \"off\"");
}

}  // namespace seaglare::lightdb
