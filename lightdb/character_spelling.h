// How classes, colours and remarks are spelled: IHO INT 1 section P, the NGA List of Lights, and the older English forms.
// Internal to lightdb/character*.cpp and phase_list.cpp.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "lightdb/character.h"

namespace seaglare::lightdb {

struct ClassSpelling {
    std::string_view pattern;  // '.': dots and blanks may stand here
    ClassKind kind;
    bool old_form = false;  // no longer written: INT 1 has another abbreviation
};
std::span<const ClassSpelling> class_spellings();  // a longer one before those that it begins with

struct ColourSpelling {
    std::string_view word;
    Colour colour;
};
std::span<const ColourSpelling> colour_spellings();  // likewise

// A whole word: "R", "red", "Bu". Nothing: no colour.
std::optional<Colour> spelled_colour(std::string_view word);

// A remark in brackets.
struct RemarkSpelling {
    std::string_view word;          // in small letters, without dots and blanks
    std::string_view abbreviation;  // as format_character() writes it
    std::string_view assumption;    // what it says that a rhythm cannot show; empty: nothing
};
std::span<const RemarkSpelling> remark_spellings();

}  // namespace seaglare::lightdb
