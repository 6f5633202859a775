// `seaglare-lights character`: what a light's character means.
#include <ostream>
#include <string_view>

#include "lightdb/character.h"
#include "lightdb/json/writer.h"
#include "lightdb/tool/commands.h"

namespace seaglare::lights_tool {
namespace {

using lightdb::Character;
using Layout = json::Writer::Layout;

void write_strings(json::Writer& writer, std::string_view key, const std::vector<std::string>& strings,
                   Layout layout = Layout::block) {
    writer.key(key);
    writer.begin_array(layout);
    for (const std::string& text : strings)
        writer.value(text);
    writer.end_array();
}

// The class taken apart: what `seaglare-lights` prints as "class" and "group", for programs.
void write_parts(json::Writer& writer, const Character& character) {
    if (!character.prefixes.empty()) write_strings(writer, "prefixes", character.prefixes, Layout::line);
    if (character.alternating) writer.member("alternating", true);
    if (character.fixed_under) writer.member("fixed_under", true);
    writer.key("parts");
    writer.begin_array();
    for (const lightdb::ClassTerm& term : character.terms) {
        writer.begin_object(Layout::line);
        writer.member("class", lightdb::class_abbreviation(term.kind));
        if (!term.morse.empty()) writer.member("morse", term.morse);
        writer.key("group");
        writer.begin_array(Layout::line);
        for (const int count : term.groups)
            writer.value(static_cast<double>(count));
        writer.end_array();
        writer.end_object();
    }
    writer.end_array();
}

void write_phases(json::Writer& writer, std::string_view key, const std::vector<lightdb::Phase>& phases) {
    writer.key(key);
    writer.begin_array();
    for (const lightdb::Phase& phase : phases) {
        writer.begin_object(Layout::line);
        writer.member(phase.lit ? "lit" : "eclipse", phase.duration_s);
        if (phase.lit) writer.member("colour", lightdb::colour_letter(phase.colour));
        if (phase.lit && phase.level != 1) writer.member("level", phase.level);
        writer.end_object();
    }
    writer.end_array();
}

void write_ranges(json::Writer& writer, const Character& character) {
    writer.key("nominal_range_nm");
    const bool per_colour = character.range_nm.front().first.has_value();
    if (per_colour) {
        writer.begin_object(Layout::line);
        for (const auto& [colour, range_nm] : character.range_nm)
            writer.member(lightdb::colour_letter(*colour), range_nm);
        writer.end_object();
        return;
    }
    writer.begin_array(Layout::line);
    for (const auto& [colour, range_nm] : character.range_nm)
        writer.value(range_nm);
    writer.end_array();
}

std::string json_text(const Character& character) {
    json::Writer writer;
    writer.begin_object();
    writer.member("notation", lightdb::format_character(character));
    writer.member("class", character.light_class);
    writer.member("group", lightdb::group_text(character));
    write_parts(writer, character);
    writer.key("colours");
    writer.begin_array(Layout::line);
    for (const lightdb::Colour colour : character.colours)
        writer.value(lightdb::colour_letter(colour));
    writer.end_array();
    writer.member("period_s", character.rhythm.period_s);
    if (character.period_s && *character.period_s != character.rhythm.period_s)
        writer.member("written_period_s", *character.period_s);
    const bool written = !character.written_phases.empty();
    if (!character.rhythm.phases.empty()) {
        writer.member("phases_are",
                      written ? "written" : "assumed, but for what the class and the period say");
    }
    write_phases(writer, "phases", character.rhythm.phases);
    if (written) write_phases(writer, "written_phases", character.written_phases);
    if (character.height_m) writer.member("height_m", *character.height_m);
    if (!character.range_nm.empty()) write_ranges(writer, character);
    if (character.lamp_count > 1) writer.member("lamps", static_cast<double>(character.lamp_count));
    if (!character.arrangement.empty()) writer.member("arrangement", character.arrangement);
    if (character.direction_deg) writer.member("direction_deg", *character.direction_deg);
    if (!character.remarks.empty()) write_strings(writer, "remarks", character.remarks, Layout::line);
    write_strings(writer, "assumptions", character.assumptions);
    write_strings(writer, "warnings", character.warnings);
    writer.end_object();
    return writer.take();
}

// "'Fl(2', at its character 3: …"; characters are counted as the reader sees them, not in bytes.
void report(std::ostream& err, const std::string& text, const lightdb::CharacterError& error) {
    std::size_t place = 1;
    for (std::size_t i = 0; i < error.offset && i < text.size(); ++i)
        if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) ++place;
    err << "'" << text << "', at its character " << place << ": " << error.what() << "\n";
}

}  // namespace

int explain_character(const CharacterRequest& request, std::ostream& out, std::ostream& err) {
    std::vector<lightdb::ListedPhase> phases;
    const std::string& list = request.sigseq.empty() ? request.phases : request.sigseq;
    try {
        if (!list.empty()) {
            phases = request.sigseq.empty() ? lightdb::parse_phase_list(list) : lightdb::parse_sigseq(list);
        }
    } catch (const lightdb::CharacterError& error) {
        report(err, list, error);
        return 1;
    } catch (const json::Error& error) {
        err << error.what() << "\n";
        return 1;
    }
    try {
        const Character character = lightdb::parse_character(request.text, phases);
        if (request.format_only) {
            out << lightdb::format_character(character) << "\n";
            for (const std::string& warning : character.warnings)
                err << "'" << request.text << "': " << warning << " (warning)\n";
        } else {
            out << json_text(character);
        }
    } catch (const lightdb::CharacterError& error) {
        report(err, request.text, error);
        return 1;
    }
    return 0;
}

int explain_character(const std::string& text, std::ostream& out, std::ostream& err) {
    CharacterRequest request;
    request.text = text;
    return explain_character(request, out, err);
}

}  // namespace seaglare::lights_tool
