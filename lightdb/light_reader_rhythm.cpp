// When a light shines: its character, and phases where they are written out.
#include <algorithm>
#include <cmath>

#include "lightdb/character_notation.h"
#include "lightdb/light_file.h"
#include "lightdb/light_reader_parts.h"
#include "lightdb/phase_list.h"

namespace seaglare::lightdb {

namespace {

using json::ObjectReader;

constexpr double period_tolerance_s = 0.051;  // of sums of durations that were rounded to tenths
constexpr double longest_s = 3600;
constexpr double slowest_lamp_s = 60;

// A phase without a colour of its own has the character's, of an alternating light each flash the next; white without one.
Rhythm rhythm_of(const std::vector<ListedPhase>& phases, const std::optional<Character>& character) {
    static const std::vector<Colour> white{Colour::white};
    const std::vector<Colour>& colours = character ? character->colours : white;
    const std::size_t in_turn = character && character->alternating ? colours.size() : 1;
    Rhythm rhythm;
    std::size_t flash = 0;
    for (const ListedPhase& listed : phases) {
        Phase phase{listed.duration_s, listed.lit, Colour::white, listed.level};
        if (listed.lit) phase.colour = listed.colour.value_or(colours[flash++ % in_turn]);
        rhythm.period_s += phase.duration_s;
        rhythm.phases.push_back(phase);
    }
    return rhythm;
}

// Read as the character's own durations, so that what they contradict is said.
Rhythm read_sigseq(const json::Value& value, const std::optional<Character>& character,
                   const std::string& notation, std::vector<std::string>& warnings) {
    const std::string text = json::checked_string(value, "sigseq");
    try {
        const std::vector<ListedPhase> phases = parse_sigseq(text);
        if (!character) return rhythm_of(phases, character);
        const Character with_phases = parse_character(notation, phases);
        for (const std::string& warning : with_phases.warnings) {
            const auto& told = character->warnings;
            if (std::find(told.begin(), told.end(), warning) == told.end())
                warnings.emplace_back(value.error(warning).what());
        }
        return with_phases.rhythm;
    } catch (const CharacterError& error) {
        throw value.error("the phases '" + text + "' cannot be read at their character " +
                          std::to_string(error.offset + 1) + ": " + error.what());
    }
}

void warn_of_another_period(const json::Value& place, const Rhythm& rhythm,
                            const std::optional<Character>& character, std::vector<std::string>& warnings) {
    if (!character || !character->period_s ||
        std::abs(*character->period_s - rhythm.period_s) <= period_tolerance_s)
        return;
    warnings.emplace_back(place
                              .error("the phases last " + seconds_text(rhythm.period_s) +
                                     ", the character's period is " + seconds_text(*character->period_s) +
                                     ": the phases hold")
                              .what());
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
        // Empty: fixed.
        rhythm = reader.array("phases").empty() ? Rhythm{} : rhythm_of(phases_from_json(*phases), character);
        warn_of_another_period(*phases, rhythm, character, warnings);
    }
    if (const json::Value* sequence = reader.find("sigseq")) {
        if (reader.has("phases")) throw sequence->error("give either 'phases' or 'sigseq', not both");
        rhythm = read_sigseq(*sequence, character, light.character, warnings);
    }
    rhythm.sync_group = reader.string("sync_group", "");
    rhythm.delay_s = reader.number("delay_s", -longest_s, longest_s, 0);
    rhythm.rise_s = reader.number("rise_s", 0, slowest_lamp_s, 0);
    rhythm.fall_s = reader.number("fall_s", 0, slowest_lamp_s, 0);
}

}  // namespace seaglare::lightdb
