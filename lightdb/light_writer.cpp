// Lights back to the text they could have been read from: the inverse of light_reader.cpp.
//
// What authors write in more than one way is written in the way they most likely did, wherever that is exact: candela that
// are those of a nominal range to the last bit as that range, a table that has a name by its name.
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "lightdb/buoy_reader.h"
#include "lightdb/json/writer.h"
#include "lightdb/light_file.h"
#include "lightdb/light_reader_parts.h"
#include "lightdb/light_store.h"
#include "lightdb/photometry.h"
#include "lightdb/profile.h"
#include "lightdb/sector_writer.h"

namespace seaglare::lightdb {

namespace {

using json::Writer;
using Layout = Writer::Layout;
using PerColour = std::array<double, colour_count>;

void write_numbers(Writer& writer, std::string_view key, const auto& numbers) {
    writer.key(key);
    writer.begin_array(Layout::line);
    for (const double number : numbers)
        writer.value(number);
    writer.end_array();
}

void write_table(Writer& writer, std::string_view key, const AngleTable& table) {
    writer.key(key);
    writer.begin_object();
    write_numbers(writer, "angle_deg", table.angle_deg);
    write_numbers(writer, "factor", table.factor);
    writer.end_object();
}

void write_place(Writer& writer, const Light& light) {
    if (light.geographic) {
        writer.member("lat", light.latitude_deg);
        writer.member("lon", light.longitude_deg);
        writer.member("height_m", light.height_m);
    } else {
        write_numbers(writer, "position", light.position_m);
    }
    if (light.body_id != 0) writer.member("body", static_cast<double>(light.body_id));
    if (light.orientation != Light{}.orientation) write_numbers(writer, "orientation", light.orientation);
    if (!light.geographic && light.true_north_deg != 0) writer.member("true_north_deg", light.true_north_deg);
}

std::optional<Character> character_of(const Light& light) {
    if (light.character.empty()) return std::nullopt;
    try {
        return parse_character(light.character);
    } catch (const CharacterError&) {
        return std::nullopt;
    }
}

void write_rhythm(Writer& writer, const Light& light, const std::optional<Character>& character) {
    const Rhythm& rhythm = light.rhythm;
    if (character) writer.member("character", light.character);
    const bool character_suffices =
        character ? character->rhythm.phases == rhythm.phases && character->rhythm.period_s == rhythm.period_s
                  : rhythm.phases.empty();
    if (!character_suffices) {
        writer.key("phases");
        writer.begin_array();
        for (const Phase& phase : rhythm.phases) {
            writer.begin_object(Layout::line);
            writer.member(phase.lit ? "lit" : "eclipse", phase.duration_s);
            if (phase.lit && (character || phase.colour != Colour::white))  // else it is the character's
                writer.member("colour", colour_letter(phase.colour));
            if (phase.lit && phase.level != 1) writer.member("level", phase.level);
            writer.end_object();
        }
        writer.end_array();
    }
    if (!rhythm.sync_group.empty()) writer.member("sync_group", rhythm.sync_group);
    if (rhythm.delay_s != 0) writer.member("delay_s", rhythm.delay_s);
    if (rhythm.rise_s != 0) writer.member("rise_s", rhythm.rise_s);
    if (rhythm.fall_s != 0) writer.member("fall_s", rhythm.fall_s);
}

// The shortest decimal whose nominal range is this intensity to the last bit; nothing when there is none of up to six
// decimals: then the author gave candela.
std::optional<double> exact_range_nm(double intensity_cd, double threshold_lx, double longest_nm) {
    if (intensity_cd == 0) return 0;
    const double range_nm = range_for_intensity_nm(intensity_cd, threshold_lx);
    for (int decimals = 0; decimals <= 6; ++decimals) {
        // Not printf: the host's locale may write a comma.
        char text[64];
        const auto end =
            std::to_chars(text, text + sizeof text, range_nm, std::chars_format::fixed, decimals).ptr;
        double candidate_nm = 0;
        std::from_chars(text, end, candidate_nm);
        if (candidate_nm <= longest_nm && intensity_for_range_cd(candidate_nm, threshold_lx) == intensity_cd)
            return candidate_nm;
    }
    return std::nullopt;
}

// Ranges for all colours that have an intensity, or nothing.
std::optional<PerColour> exact_ranges_nm(const PerColour& intensity_cd, double threshold_lx,
                                         double longest_nm) {
    PerColour ranges{};
    bool any = false;
    for (std::size_t c = 0; c < colour_count; ++c) {
        const auto range_nm = exact_range_nm(intensity_cd[c], threshold_lx, longest_nm);
        if (!range_nm) return std::nullopt;
        ranges[c] = *range_nm;
        any = any || intensity_cd[c] > 0;
    }
    return any ? std::optional(ranges) : std::nullopt;
}

// Every colour that has a value and, at 0, those that reading asks for.
void write_per_colour(Writer& writer, std::string_view key, const PerColour& values, const ColourSet& asked) {
    writer.key(key);
    writer.begin_object(Layout::line);
    for (const ColourName& colour : colour_names) {
        const std::size_t c = index_of(colour.colour);
        if (values[c] > 0 || asked[c]) writer.member(colour.letters, values[c]);
    }
    writer.end_object();
}

void write_intensities(Writer& writer, const Light& light, const std::optional<Character>& character) {
    ColourSet asked = colours_of(light, character).shown;
    // "{}" would be no intensity for an obscured light: say that it is dark.
    if (light.intensity_cd == PerColour{} && asked == ColourSet{}) asked[0] = true;
    if (const auto ranges = exact_ranges_nm(light.intensity_cd, night_threshold_lx, longest_range_nm)) {
        write_per_colour(writer, "nominal_range_nm", *ranges, asked);
    } else {
        write_per_colour(writer, "intensity_cd", light.intensity_cd, asked);
    }
    if (light.day_off) writer.member("day", "off");
    if (light.day_intensity_cd == PerColour{}) return;
    if (const auto ranges = exact_ranges_nm(light.day_intensity_cd, day_threshold_lx, longest_day_range_nm)) {
        write_per_colour(writer, "day_range_nm", *ranges, asked);
    } else {
        write_per_colour(writer, "day_intensity_cd", light.day_intensity_cd, asked);
    }
}

void write_sectors(Writer& writer, const Light& light) {
    if (!light.sectors.empty()) {
        writer.key("sectors");
        writer.begin_array();
        for (const Sector& sector : light.sectors)
            write_sector(writer, sector);
        writer.end_array();
    }
    if (light.sector_reference == SectorReference::outward_from_ahead) {
        writer.member("sector_reference", "outward_from_ahead");
    }
    if (light.leading_bearing_deg) writer.member("leading_bearing_deg", *light.leading_bearing_deg);
}

void write_profiles(Writer& writer, const Light& light) {
    if (!light.horizontal.angle_deg.empty()) write_table(writer, "horizontal_profile", light.horizontal);
    if (light.vertical.angle_deg.empty()) return;
    for (const std::string_view name : vertical_profile_names()) {
        if (named_vertical_profile(name) == light.vertical) {
            writer.member("vertical_profile", name);
            return;
        }
    }
    write_table(writer, "vertical_profile", light.vertical);
}

// How many beams of which width give this table, if any do.
std::optional<std::pair<int, double>> as_equal_beams(const AngleTable& table) {
    int beams = 0;
    for (const double factor : table.factor)
        beams += factor == 1 ? 1 : 0;
    if (beams == 0 || beams > most_beams || table.angle_deg.front() >= 0) return std::nullopt;
    const double width_deg = -table.angle_deg.front();
    if (width_deg < 0.05 || beams * width_deg > 180) return std::nullopt;
    if (equal_beams(beams, width_deg) != table) return std::nullopt;
    return std::pair(beams, width_deg);
}

void write_rotation(Writer& writer, const RotatingBeam& rotation) {
    if (rotation.period_s == 0) return;
    writer.key("rotation");
    writer.begin_object();
    writer.member("period_s", std::abs(rotation.period_s));
    if (rotation.period_s < 0) writer.member("direction", "anticlockwise");
    if (const auto beams = as_equal_beams(rotation.beam)) {
        writer.member("beams", static_cast<double>(beams->first));
        writer.member("width_deg", beams->second);
    } else {
        write_table(writer, "beam", rotation.beam);
    }
    writer.end_object();
}

void write_phase_key(Writer& writer, const Light& light) {
    if (light.stable_key == 0 || light.stable_key == stable_key_of(light)) return;
    char text[24];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(light.stable_key));
    writer.member("phase_key", text);
}

// The photometric file as found from `folder`; what is on another root stays absolute.
std::string path_from(const std::string& folder, const std::string& file) {
    namespace fs = std::filesystem;
    std::error_code failed;
    const fs::path base = folder.empty() ? fs::path(".") : fs::path(folder);
    const fs::path found = fs::proximate(file, base, failed);
    return failed ? file : found.generic_string();
}

void write_lamp(Writer& writer, std::string_view key, const LampChoice& choice, const std::string& folder) {
    const auto name = [&](const std::string& text) {
        return is_lamp_file(text) ? path_from(folder, text) : text;
    };
    if (choice.filter.empty()) {
        writer.member(key, name(choice.source));
        return;
    }
    writer.key(key);
    writer.begin_object(Layout::line);
    writer.member("source", name(choice.source));
    writer.member("filter", name(choice.filter));
    writer.end_object();
}

void write_spectrum(Writer& writer, const LightSpectrum& spectrum, const std::string& folder) {
    if (!spectrum.per_colour) {
        write_lamp(writer, "spectrum", spectrum.choice.front(), folder);
        return;
    }
    writer.key("spectrum");
    writer.begin_object();
    for (const ColourName& colour : colour_names) {
        const LampChoice& choice = spectrum.choice[index_of(colour.colour)];
        if (!choice.source.empty()) write_lamp(writer, colour.letters, choice, folder);
    }
    writer.end_object();
}

void write_light(Writer& writer, const Light& light, const LightFile& file, const std::string& folder) {
    const std::optional<Character> character = character_of(light);
    writer.begin_object();
    writer.member("name", light.name);
    write_place(writer, light);
    write_rhythm(writer, light, character);
    write_intensities(writer, light, character);
    write_sectors(writer, light);
    write_profiles(writer, light);
    write_rotation(writer, light.rotation);
    if (light.photometry) writer.member("photometry", path_from(folder, light.photometry->file));
    if (light.radius_m != default_radius_m(light)) writer.member("radius_m", light.radius_m);
    if (light.spectrum) write_spectrum(writer, *light.spectrum, folder);
    write_phase_key(writer, light);
    if (light.source != file.source) writer.member("source", light.source);
    writer.end_object();
}

}  // namespace

std::string format_light_file(const LightFile& file, const std::string& folder) {
    Writer writer;
    writer.begin_object();
    if (file.origin) {
        writer.key("origin");
        writer.begin_object(Layout::line);
        writer.member("lat", file.origin->latitude_deg);
        writer.member("lon", file.origin->longitude_deg);
        if (file.origin->height_m != 0) writer.member("height_m", file.origin->height_m);
        writer.end_object();
    }
    if (!file.source.empty()) writer.member("source", file.source);
    if (!file.buoys.empty()) {
        writer.key("buoys");
        writer.begin_array();
        for (const Buoy& buoy : file.buoys)
            write_buoy(writer, buoy);
        writer.end_array();
    }
    writer.key("lights");
    writer.begin_array();
    for (const Light& light : file.lights)
        write_light(writer, light, file, folder);
    writer.end_array();
    writer.end_object();
    return writer.take();
}

}  // namespace seaglare::lightdb
