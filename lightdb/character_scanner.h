// Reads a light's character from left to right, for what takes it apart. Internal to lightdb/character*.cpp and phase_list.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightdb/phase_list.h"

namespace seaglare::lightdb {

// Typographical dashes, decimal points on the middle of the line ("7·5s", as British lists print) and hard spaces read as
// their plain forms; places are counted in the text as it was given.
class Scanner {
  public:
    explicit Scanner(std::string_view text);

    std::size_t at() const { return at_; }
    bool at_end() const { return at_ >= text_.size(); }
    char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
    bool at_digit() const;
    bool at_letter() const;
    void advance(std::size_t count = 1) { at_ += count; }
    void go_back(std::size_t place) { at_ = place; }
    std::string_view between(std::size_t from, std::size_t to) const;
    std::string_view rest() const { return std::string_view(text_).substr(at_); }

    void skip_blanks();
    void skip_separators();  // blanks, dots, commas and semicolons

    // Whether the text goes on like the pattern, whatever the case; a '.' in the pattern stands for any dots and blanks.
    bool goes_on(std::string_view pattern) const;
    bool take(std::string_view pattern);
    bool take_word(std::string_view word);    // no letter follows it
    bool take_exact(std::string_view piece);  // with its case

    // Decimal, without exponent or sign. Throws CharacterError.
    double read_number();

    [[noreturn]] void fail(std::size_t where, const std::string& text) const;
    [[noreturn]] void fail_here(const std::string& text) const { fail(at_, text); }
    // A place of the scanner in the text as it was given.
    std::size_t given_place(std::size_t where) const;

  private:
    std::size_t match(std::string_view pattern) const;

    std::string text_;
    std::vector<std::size_t> given_;  // where each byte stood; one more for the end
    std::size_t at_ = 0;
};

bool is_letter(char c);
bool is_digit(char c);
char lower(char c);

// "fl. 0.5s", "lt. 4.0s", "ec. 1.5s", in small letters; else nothing is read. Throws CharacterError.
std::optional<ListedPhase> take_listed_phase(Scanner& scanner);

}  // namespace seaglare::lightdb
