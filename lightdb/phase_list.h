// Phases written out, which take the place of assumed ones. Three spellings: the List of Lights' ("fl. 0.8s, ec. 2.2s"), the
// attribute SIGSEQ of IHO S-57 ("00.8+(02.2)"; occulting lights begin with the eclipse) and a light file's JSON.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "lightdb/json/value.h"
#include "lightdb/light.h"

namespace seaglare::lightdb {

inline constexpr double longest_listed_phase_s = 3600;
// How far a list may miss its period: binary sums of decimal durations. A hundredth is a contradiction.
inline constexpr double sum_tolerance_s = 1e-6;

// A phase as a list gives it.
struct ListedPhase {
    double duration_s = 0;
    bool lit = false;
    std::optional<Colour> colour;  // JSON only; else from the light's character
    double level = 1;              // JSON only: share of the full intensity while lit
    friend bool operator==(const ListedPhase&, const ListedPhase&) = default;
};

// "fl. 0.8s, ec. 2.2s": light is "fl" or "lt", darkness "ec"; commas, dots and line breaks carry no meaning. Also reads JSON,
// when the text begins with '['. Throws CharacterError with the place, or json::Error.
std::vector<ListedPhase> parse_phase_list(std::string_view text);

// "00.8+(02.2)+00.8+(05.2)": light in figures, darkness in brackets, seconds. Throws CharacterError with the place.
std::vector<ListedPhase> parse_sigseq(std::string_view text);

// [{"lit": 0.8, "colour": "R", "level": 1}, {"eclipse": 2.2}], as in a light file. Throws json::Error.
std::vector<ListedPhase> phases_from_json(const json::Value& value);

}  // namespace seaglare::lightdb
