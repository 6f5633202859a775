#include "lightdb/character_spelling.h"

#include <array>

#include "lightdb/character_scanner.h"

namespace seaglare::lightdb {
namespace {

constexpr std::array<ClassSpelling, 34> classes{{
    {"Interrupted.quick", ClassKind::interrupted_quick},
    {"Long.flashing", ClassKind::long_flashing},
    {"Very.quick", ClassKind::very_quick},
    {"Flashing", ClassKind::flashing},
    {"Occulting", ClassKind::occulting},
    {"Isophase", ClassKind::isophase},
    {"Quick", ClassKind::quick},
    {"Fixed", ClassKind::fixed},
    {"Int.V.Qk.Fl", ClassKind::interrupted_very_quick, true},
    {"I.V.Qk.Fl", ClassKind::interrupted_very_quick, true},
    {"Int.U.Qk.Fl", ClassKind::interrupted_ultra_quick, true},
    {"Int.Qk.Fl", ClassKind::interrupted_quick, true},
    {"I.Qk.Fl", ClassKind::interrupted_quick, true},
    {"V.Qk.Fl", ClassKind::very_quick, true},
    {"U.Qk.Fl", ClassKind::ultra_quick, true},
    {"Qk.Fl", ClassKind::quick, true},
    {"Int.Qk", ClassKind::interrupted_quick, true},
    {"V.Qk", ClassKind::very_quick, true},
    {"Qk", ClassKind::quick, true},
    {"E.Int", ClassKind::isophase, true},
    {"Occ", ClassKind::occulting, true},
    {"Isoph", ClassKind::isophase, true},
    {"I.U.Q", ClassKind::interrupted_ultra_quick},
    {"I.V.Q", ClassKind::interrupted_very_quick},
    {"I.Q", ClassKind::interrupted_quick},
    {"U.Q", ClassKind::ultra_quick},
    {"V.Q", ClassKind::very_quick},
    {"Q", ClassKind::quick},
    {"L.Fl", ClassKind::long_flashing},
    {"Fl", ClassKind::flashing},
    {"Iso", ClassKind::isophase},
    {"Oc", ClassKind::occulting},
    {"Mo", ClassKind::morse},
    {"F", ClassKind::fixed},
}};

constexpr std::array<ColourSpelling, 19> colours{{
    {"white", Colour::white},   {"red", Colour::red},       {"green", Colour::green},
    {"yellow", Colour::yellow}, {"amber", Colour::yellow},  {"orange", Colour::orange},
    {"blue", Colour::blue},     {"violet", Colour::violet}, {"Bu", Colour::blue},
    {"Bl", Colour::blue},       {"Or", Colour::orange},     {"Vi", Colour::violet},
    {"Am", Colour::yellow},     {"W", Colour::white},       {"R", Colour::red},
    {"G", Colour::green},       {"Y", Colour::yellow},      {"B", Colour::blue},
    {"V", Colour::violet},
}};

constexpr std::array<RemarkSpelling, 17> remarks{{
    {"neon", "neon", ""},
    {"occas", "occas", "it is shown occasionally: taken as always shown"},
    {"occasional", "occas", "it is shown occasionally: taken as always shown"},
    {"fog", "fog", "it is shown in fog: taken as always shown"},
    {"exting", "exting", "it is extinguished: taken as burning"},
    {"sync", "sync", "it is synchronised with others that the notation does not name"},
    {"priv", "priv", ""},
    {"private", "priv", ""},
    {"t", "T", ""},
    {"temp", "T", ""},
    {"p", "P", ""},
    {"u", "U", ""},
    {"unwatched", "U", ""},
    {"strip", "strip", ""},
    {"illum", "illum", ""},
    {"floodlit", "illum", ""},
    {"obstr", "obstr", ""},
}};

}  // namespace

std::span<const ClassSpelling> class_spellings() {
    return classes;
}
std::span<const ColourSpelling> colour_spellings() {
    return colours;
}
std::span<const RemarkSpelling> remark_spellings() {
    return remarks;
}

std::optional<Colour> spelled_colour(std::string_view word) {
    for (const ColourSpelling& spelling : colours) {
        if (spelling.word.size() != word.size()) continue;
        bool same = true;
        for (std::size_t i = 0; i < word.size(); ++i)
            same = same && lower(word[i]) == lower(spelling.word[i]);
        if (same) return spelling.colour;
    }
    return std::nullopt;
}

std::string_view colour_letter(Colour colour) {
    switch (colour) {
        case Colour::white:
            return "W";
        case Colour::red:
            return "R";
        case Colour::green:
            return "G";
        case Colour::yellow:
            return "Y";
        case Colour::blue:
            return "Bu";
        case Colour::orange:
            return "Or";
        case Colour::violet:
            return "Vi";
    }
    return "";
}

std::string_view class_abbreviation(ClassKind kind) {
    switch (kind) {
        case ClassKind::fixed:
            return "F";
        case ClassKind::occulting:
            return "Oc";
        case ClassKind::isophase:
            return "Iso";
        case ClassKind::flashing:
            return "Fl";
        case ClassKind::long_flashing:
            return "LFl";
        case ClassKind::quick:
            return "Q";
        case ClassKind::very_quick:
            return "VQ";
        case ClassKind::ultra_quick:
            return "UQ";
        case ClassKind::interrupted_quick:
            return "IQ";
        case ClassKind::interrupted_very_quick:
            return "IVQ";
        case ClassKind::interrupted_ultra_quick:
            return "IUQ";
        case ClassKind::morse:
            return "Mo";
    }
    return "";
}

}  // namespace seaglare::lightdb
