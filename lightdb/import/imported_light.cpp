#include "lightdb/import/imported_light.h"

#include <cmath>

#include "lightdb/character.h"
#include "lightdb/json/writer.h"
#include "lightdb/sector_writer.h"

namespace seaglare::lightdb {
namespace {

using Layout = json::Writer::Layout;

void write_phases(json::Writer& writer, const std::vector<Phase>& phases) {
    writer.key("phases");
    writer.begin_array();
    for (const Phase& phase : phases) {
        writer.begin_object(Layout::line);
        writer.member(phase.lit ? "lit" : "eclipse", phase.duration_s);
        if (phase.lit && phase.colour != Colour::white) writer.member("colour", colour_letter(phase.colour));
        if (phase.lit && phase.level != 1) writer.member("level", phase.level);
        writer.end_object();
    }
    writer.end_array();
}

void write_light(json::Writer& writer, const ImportedLight& light) {
    writer.begin_object();
    writer.member("name", light.name);
    writer.member("lat", light.latitude_deg);
    writer.member("lon", light.longitude_deg);
    writer.member("height_m", light.height_m);
    if (!light.character.empty()) writer.member("character", light.character);
    if (!light.phases.empty()) write_phases(writer, light.phases);
    writer.key("nominal_range_nm");
    writer.begin_object(Layout::line);
    for (const auto& [colour, range_nm] : light.nominal_range_nm)
        writer.member(colour_letter(colour), range_nm);
    writer.end_object();
    if (!light.sectors.empty()) {
        writer.key("sectors");
        writer.begin_array();
        for (const Sector& sector : light.sectors)
            write_sector(writer, sector);
        writer.end_array();
    }
    if (light.leading_bearing_deg) writer.member("leading_bearing_deg", *light.leading_bearing_deg);
    if (!light.sync_group.empty()) writer.member("sync_group", light.sync_group);
    writer.member("radius_m", light.radius_m);
    if (!light.all_day) writer.member("day", "off");
    std::string source = light.source;
    for (const std::string& note : light.notes)
        source += "; " + note;
    writer.member("source", source);
    writer.end_object();
}

}  // namespace

double lantern_radius_m(double range_nm) {
    if (range_nm < 5) return 0.1;
    if (range_nm < 10) return 0.15;
    if (range_nm < 18) return 0.25;
    return 0.5;
}

double tidy_position_deg(double value) {  // a hundredth of a second is 3e-6 degrees
    return std::round(value * 1e7) / 1e7;
}

double tidy_bearing_deg(double value) {
    double wrapped = std::fmod(value, 360.0);
    if (wrapped < 0) wrapped += 360;
    wrapped = std::round(wrapped * 1e4) / 1e4;
    return wrapped < 360 ? wrapped : 0;
}

double tidy_factor(double factor) {
    return std::round(factor * 1e3) / 1e3;
}

std::string plain_number(double value) {
    std::string text = std::to_string(value);
    while (text.back() == '0')
        text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text;
}

std::string imported_light_file_text(std::span<const ImportedLight> lights, std::string_view source) {
    json::Writer writer;
    writer.begin_object();
    writer.member("$schema", "../schema/lights.schema.json");
    writer.member("source", source);
    writer.key("lights");
    writer.begin_array();
    for (const ImportedLight& light : lights)
        write_light(writer, light);
    writer.end_array();
    writer.end_object();
    return writer.take();
}

}  // namespace seaglare::lightdb
