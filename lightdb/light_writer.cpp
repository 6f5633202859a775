// Lights back to the text they could have been read from: the inverse of light_reader.cpp.
#include "lightdb/character.h"
#include "lightdb/json/writer.h"
#include "lightdb/light_file.h"

namespace seaglare::lightdb {

namespace {

using json::Writer;
using Layout = Writer::Layout;

void write_numbers(Writer& writer, std::string_view key, const auto& numbers) {
    writer.key(key);
    writer.begin_array(Layout::line);
    for (const double number : numbers)
        writer.value(number);
    writer.end_array();
}

void write_place(Writer& writer, const Light& light) {
    if (light.geographic) {
        writer.member("lat", light.latitude_deg);
        writer.member("lon", light.longitude_deg);
        writer.member("height_m", light.height_m);
    } else {
        write_numbers(writer, "position", light.position_m);
        if (light.true_north_deg != 0) writer.member("true_north_deg", light.true_north_deg);
    }
}

// Whether the character alone says all of the rhythm.
bool character_suffices(const Light& light) {
    if (light.character.empty()) return light.rhythm.phases.empty();
    try {
        return parse_character(light.character).rhythm.phases == light.rhythm.phases;
    } catch (const CharacterError&) {
        return false;
    }
}

void write_rhythm(Writer& writer, const Light& light) {
    if (!light.character.empty()) writer.member("character", light.character);
    if (!character_suffices(light)) {
        writer.key("phases");
        writer.begin_array();
        for (const Phase& phase : light.rhythm.phases) {
            writer.begin_object(Layout::line);
            writer.member(phase.lit ? "lit" : "eclipse", phase.duration_s);
            if (phase.lit && phase.colour != Colour::white)
                writer.member("colour", colour_letter(phase.colour));
            if (phase.lit && phase.level != 1) writer.member("level", phase.level);
            writer.end_object();
        }
        writer.end_array();
    }
    if (!light.rhythm.sync_group.empty()) writer.member("sync_group", light.rhythm.sync_group);
}

void write_intensity(Writer& writer, const Light& light) {
    // A colour that is shown at 0 cd must be written, too: reading asks for every colour that is shown. Naming all of
    // a dark light's colours is simpler than finding which.
    bool dark = false;
    for (const Sector& sector : light.sectors) {
        dark = dark || (sector.colour && light.intensity_cd[static_cast<std::size_t>(*sector.colour)] == 0);
    }
    for (const Phase& phase : light.rhythm.phases) {
        dark = dark || (phase.lit && light.intensity_cd[static_cast<std::size_t>(phase.colour)] == 0);
    }
    bool all_zero = true;
    for (const double intensity_cd : light.intensity_cd)
        all_zero = all_zero && intensity_cd == 0;
    writer.key("intensity_cd");
    writer.begin_object(Layout::line);
    for (int c = 0; c < colour_count; ++c) {
        const double intensity_cd = light.intensity_cd[static_cast<std::size_t>(c)];
        if (intensity_cd > 0 || dark || all_zero)
            writer.member(colour_letter(static_cast<Colour>(c)), intensity_cd);
    }
    writer.end_object();
}

void write_sectors(Writer& writer, const Light& light) {
    if (!light.sectors.empty()) {
        writer.key("sectors");
        writer.begin_array();
        for (const Sector& sector : light.sectors) {
            writer.begin_object(Layout::line);
            writer.key("colour");
            if (sector.colour) {
                writer.value(colour_letter(*sector.colour));
            } else {
                writer.null();
            }
            writer.member("from", sector.from_deg);
            writer.member("to", sector.to_deg);
            if (sector.intensity_factor != 1) writer.member("intensity_factor", sector.intensity_factor);
            if (sector.transition_deg != 0) writer.member("transition_deg", sector.transition_deg);
            writer.end_object();
        }
        writer.end_array();
    }
    if (light.sector_reference == SectorReference::outward_from_ahead) {
        writer.member("sector_reference", "outward_from_ahead");
    }
}

void write_light(Writer& writer, const Light& light, const std::string& default_source) {
    writer.begin_object();
    writer.member("name", light.name);
    write_place(writer, light);
    if (light.body_id != 0) writer.member("body", static_cast<double>(light.body_id));
    if (light.orientation != std::array<double, 4>{0, 0, 0, 1})
        write_numbers(writer, "orientation", light.orientation);
    write_rhythm(writer, light);
    write_intensity(writer, light);
    write_sectors(writer, light);
    if (!light.vertical.angle_deg.empty()) {
        writer.key("vertical_profile");
        writer.begin_object();
        write_numbers(writer, "angle_deg", light.vertical.angle_deg);
        write_numbers(writer, "factor", light.vertical.factor);
        writer.end_object();
    }
    if (light.radius_m != Light{}.radius_m) writer.member("radius_m", light.radius_m);
    if (!light.spectrum.empty()) writer.member("spectrum", light.spectrum);
    if (light.day_off) writer.member("day", "off");
    if (light.source != default_source) writer.member("source", light.source);
    writer.end_object();
}

}  // namespace

std::string format_light_file(const LightFile& file) {
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
    writer.key("lights");
    writer.begin_array();
    for (const Light& light : file.lights)
        write_light(writer, light, file.source);
    writer.end_array();
    writer.end_object();
    return writer.take();
}

}  // namespace seaglare::lightdb
