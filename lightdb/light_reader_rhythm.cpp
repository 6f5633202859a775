// When a light shines: its character, and phases where they are written out.
#include <cmath>

#include "lightdb/light_file.h"
#include "lightdb/light_reader_parts.h"
#include "lightdb/phase_list.h"

namespace seaglare::lightdb {

namespace {

using json::ObjectReader;

constexpr double period_tolerance_s = 0.051;  // of sums of durations that were rounded to tenths
constexpr double shortest_s = 1e-3;
constexpr double longest_s = 3600;
constexpr double slowest_lamp_s = 60;

void read_phases(std::span<const json::Value> phases, Rhythm& rhythm) {
    rhythm.phases.clear();
    rhythm.period_s = 0;
    for (const json::Value& value : phases) {
        ObjectReader reader(value, "phase");
        Phase phase;
        phase.lit = reader.has("lit");
        if (phase.lit == reader.has("eclipse"))
            throw reader.error("give either 'lit' or 'eclipse', in seconds");
        phase.duration_s = reader.number(phase.lit ? "lit" : "eclipse", shortest_s, longest_s);
        if (phase.lit) {
            if (const json::Value* colour = reader.find("colour")) phase.colour = read_colour(*colour);
            phase.level = reader.number("level", 0, 1, 1);
        }
        reader.finish();
        rhythm.period_s += phase.duration_s;
        rhythm.phases.push_back(phase);
    }
}

// In the colour that the character gives, in white without one.
void read_sigseq(const json::Value& value, bool has_character, Light& light) {
    const std::string text = json::checked_string(value, "sigseq");
    try {
        const std::vector<ListedPhase> phases = parse_sigseq(text);
        if (has_character) {
            light.rhythm = parse_character(light.character, phases).rhythm;
            return;
        }
        light.rhythm = {};
        for (const ListedPhase& phase : phases) {
            light.rhythm.period_s += phase.duration_s;
            light.rhythm.phases.push_back({phase.duration_s, phase.lit, Colour::white, phase.level});
        }
    } catch (const CharacterError& error) {
        throw value.error("the phases '" + text + "' cannot be read at their character " +
                          std::to_string(error.offset + 1) + ": " + error.what());
    }
}

void warn_of_another_period(const json::Value& place, std::string_view what, const Rhythm& rhythm,
                            const std::optional<Character>& character, std::vector<std::string>& warnings) {
    if (!character || !character->period_s ||
        std::abs(*character->period_s - rhythm.period_s) <= period_tolerance_s)
        return;
    const std::string text = "the " + std::string(what) + " last " + std::to_string(rhythm.period_s) +
                             " s, the character's period is " + std::to_string(*character->period_s) +
                             " s: the " + std::string(what) + " hold";
    warnings.emplace_back(place.error(text).what());
}

}  // namespace

Colour read_colour(const json::Value& value) {
    const std::string name = json::checked_string(value, "colour");
    if (const auto colour = colour_from_name(name)) return *colour;
    throw value.error("'" + name + "' is no colour: use W, R, G, Y, Bu, Or, Vi or white, red, green, …");
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
    Rhythm& rhythm = light.rhythm;
    if (const json::Value* phases = reader.find("phases")) {
        read_phases(reader.array("phases"), rhythm);
        warn_of_another_period(*phases, "phases", rhythm, character, warnings);
    }
    if (const json::Value* sequence = reader.find("sigseq")) {
        if (reader.has("phases")) throw sequence->error("give either 'phases' or 'sigseq', not both");
        read_sigseq(*sequence, character.has_value(), light);
        warn_of_another_period(*sequence, "phases", rhythm, character, warnings);
    }
    rhythm.sync_group = reader.string("sync_group", "");
    rhythm.delay_s = reader.number("delay_s", -longest_s, longest_s, 0);
    rhythm.rise_s = reader.number("rise_s", 0, slowest_lamp_s, 0);
    rhythm.fall_s = reader.number("fall_s", 0, slowest_lamp_s, 0);
}

}  // namespace seaglare::lightdb
