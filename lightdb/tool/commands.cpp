#include "lightdb/tool/commands.h"

#include <fstream>
#include <ostream>
#include <string_view>
#include <system_error>

#include "lightdb/character.h"
#include "lightdb/json/value.h"
#include "lightdb/json/writer.h"
#include "lightdb/light_file.h"

namespace seaglare::lights_tool {
namespace {

// Errors of the input are 1, of the file system 2.
template <class Work>
int guarded(std::ostream& err, const Work& work) {
    try {
        return work();
    } catch (const std::system_error& error) {
        err << "seaglare-lights: " << error.what() << "\n";
        return 2;
    } catch (const json::Error& error) {
        err << error.what() << "\n";
        return 1;
    }
}

bool write_file(const std::string& path, const std::string& text, std::ostream& err) {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file << text;
    file.close();
    if (file) return true;
    err << "seaglare-lights: cannot write " << path << "\n";
    return false;
}

void write_strings(json::Writer& writer, std::string_view key, const std::vector<std::string>& strings) {
    writer.key(key);
    writer.begin_array();
    for (const std::string& text : strings)
        writer.value(text);
    writer.end_array();
}

void write_phases(json::Writer& writer, const lightdb::Rhythm& rhythm) {
    writer.key("phases");
    writer.begin_array();
    for (const lightdb::Phase& phase : rhythm.phases) {
        writer.begin_object(json::Writer::Layout::line);
        writer.member(phase.lit ? "lit" : "eclipse", phase.duration_s);
        if (phase.lit) writer.member("colour", lightdb::colour_letter(phase.colour));
        if (phase.lit && phase.level != 1) writer.member("level", phase.level);
        writer.end_object();
    }
    writer.end_array();
}

void write_ranges(json::Writer& writer, const lightdb::Character& character) {
    writer.key("nominal_range_nm");
    const bool per_colour = character.range_nm.front().first.has_value();
    if (per_colour) {
        writer.begin_object(json::Writer::Layout::line);
        for (const auto& [colour, range_nm] : character.range_nm)
            writer.member(lightdb::colour_letter(*colour), range_nm);
        writer.end_object();
        return;
    }
    writer.begin_array(json::Writer::Layout::line);
    for (const auto& [colour, range_nm] : character.range_nm)
        writer.value(range_nm);
    writer.end_array();
}

}  // namespace

int validate(const std::vector<std::string>& files, std::ostream& out, std::ostream& err) {
    int status = 0;
    for (const std::string& file : files) {
        const int result = guarded(err, [&] {
            const lightdb::LightFile loaded = lightdb::load_light_file(file);
            for (const std::string& warning : loaded.warnings)
                err << warning << " (warning)\n";
            out << file << ": " << loaded.lights.size() << " lights, " << loaded.warnings.size()
                << " warnings\n";
            return 0;
        });
        status = std::max(status, result);
    }
    return status;
}

int check_json(const std::string& file, std::ostream& err) {
    return guarded(err, [&] {
        json::parse_file(file);
        return 0;
    });
}

int explain_character(const std::string& text, std::ostream& out, std::ostream& err) {
    lightdb::Character character;
    try {
        character = lightdb::parse_character(text);
    } catch (const lightdb::CharacterError& error) {
        err << "'" << text << "', at its character " << error.offset + 1 << ": " << error.what() << "\n";
        return 1;
    }
    json::Writer writer;
    writer.begin_object();
    writer.member("notation", lightdb::format_character(character));
    writer.member("class", character.light_class);
    writer.key("colours");
    writer.begin_array(json::Writer::Layout::line);
    for (const lightdb::Colour colour : character.colours)
        writer.value(lightdb::colour_letter(colour));
    writer.end_array();
    writer.member("period_s", character.rhythm.period_s);
    write_phases(writer, character.rhythm);
    if (character.height_m) writer.member("height_m", *character.height_m);
    if (!character.range_nm.empty()) write_ranges(writer, character);
    if (character.lamp_count > 1) writer.member("lamps", static_cast<double>(character.lamp_count));
    if (!character.arrangement.empty()) writer.member("arrangement", character.arrangement);
    write_strings(writer, "assumptions", character.assumptions);
    write_strings(writer, "warnings", character.warnings);
    writer.end_object();
    out << writer.take();
    return 0;
}

int import_nga(const ImportRequest& request, std::ostream& out, std::ostream& err) {
    return guarded(err, [&] {
        const auto progress = [&](std::string_view text) {
            if (request.show_progress) err << "\r\x1b[K" << text << std::flush;
        };
        progress("reading the List of Lights");
        const json::Document document = json::parse_file(request.file);
        progress("importing");
        const lightdb::nga::Import import =
            lightdb::nga::import_list(document.root(), request.file, request.area);
        progress("");
        const std::string lights = lightdb::nga::light_file_text(import);
        const std::string report = lightdb::nga::report_text(import);
        if (request.output.empty()) {
            out << lights;
        } else if (!write_file(request.output, lights, err)) {
            return 2;
        }
        if (request.report.empty()) {
            err << report.substr(0, report.find("\n\n") + 1);
        } else if (!write_file(request.report, report, err)) {
            return 2;
        }
        return 0;
    });
}

}  // namespace seaglare::lights_tool
