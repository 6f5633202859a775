// The small grammars of the NGA List of Lights' fields. Internal to lightdb/import/nga*.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lightdb/light.h"

namespace seaglare::lightdb::nga {

// A position in a text, moved by what is read from it. Degree signs come as UTF-8 or as '^'.
class Cursor {
  public:
    explicit Cursor(std::string_view text) : text_(text) {}

    bool at_end() const { return at_ >= text_.size(); }
    std::size_t at() const { return at_; }
    void go_to(std::size_t at) { at_ = at; }
    char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
    void step() { ++at_; }
    std::string_view rest() const { return text_.substr(at_); }
    void skip_blanks();
    bool take(char c);                 // with blanks before it
    bool take(std::string_view word);  // in any case, with blanks before it
    std::optional<double> number();    // unsigned decimal
    bool degree_sign();

    // A bearing: "178°", "224°42`", "230°54", "196.5°", "073`" or, where three digits stand, "223". Not moved on failure.
    std::optional<double> bearing_deg();
    // "W." "R" "Or.", with blanks before it.
    std::optional<Colour> colour();

  private:
    std::string_view text_;
    std::size_t at_ = 0;
};

// Latitude and longitude in degrees from 59°03'38.11"N 11°09'21.8"E.
std::optional<std::pair<double, double>> read_position(std::string_view text);

// Heights in metres: every second line, the first of each pair being feet. Several for lamps above each other.
std::vector<double> read_heights_m(std::string_view text);

// "W. 6 \nR. 5" or "7" or "7 \n5": nautical miles, with their colour where it stands.
std::vector<std::pair<std::optional<Colour>, double>> read_ranges_nm(std::string_view text);

// "4\nC0277" as "4 / C0277".
std::string read_number(std::string_view text);

// "KORSOR HAVN:" as "Korsor Havn", "Pier, head.\n" as "Pier, head", '^' as a degree sign.
std::string tidy_name(std::string_view text);

// Number of dashes a name starts with, and the rest.
std::pair<int, std::string_view> name_depth(std::string_view text);

}  // namespace seaglare::lightdb::nga
