#include "lightdb/character_scanner.h"

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "lightdb/character.h"

namespace seaglare::lightdb {
namespace {

constexpr std::array<std::pair<std::string_view, char>, 7> plain_forms{{
    {"\xC2\xB7", '.'},      // middle dot
    {"\xC2\xA0", ' '},      // no-break space
    {"\xE2\x80\xAF", ' '},  // narrow no-break space
    {"\xE2\x80\x90", '-'},  // hyphen
    {"\xE2\x80\x93", '-'},  // en dash
    {"\xE2\x80\x94", '-'},  // em dash
    {"\xE2\x88\x92", '-'},  // minus
}};

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

}  // namespace

// By hand: <cctype> hangs on the locale of the host.
bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

Scanner::Scanner(std::string_view text) {
    text_.reserve(text.size());
    given_.reserve(text.size() + 1);
    for (std::size_t i = 0; i < text.size();) {
        char c = text[i];
        std::size_t length = 1;
        for (const auto& [form, plain] : plain_forms) {
            if (text.substr(i, form.size()) == form) {
                c = plain;
                length = form.size();
            }
        }
        text_ += c;
        given_.push_back(i);
        i += length;
    }
    given_.push_back(text.size());
}

bool Scanner::at_digit() const {
    return is_digit(peek());
}
bool Scanner::at_letter() const {
    return is_letter(peek());
}

std::string_view Scanner::between(std::size_t from, std::size_t to) const {
    return std::string_view(text_).substr(from, to - from);
}

void Scanner::skip_blanks() {
    while (is_blank(peek()))
        ++at_;
}

void Scanner::skip_separators() {
    while (is_blank(peek()) || peek() == '.' || peek() == ',' || peek() == ';')
        ++at_;
}

// The end of `pattern` in the text from here, or npos.
std::size_t Scanner::match(std::string_view pattern) const {
    std::size_t i = at_;
    for (const char p : pattern) {
        if (p == '.') {
            while (i < text_.size() && (text_[i] == '.' || is_blank(text_[i])))
                ++i;
            continue;
        }
        if (i >= text_.size() || lower(text_[i]) != lower(p)) return std::string_view::npos;
        ++i;
    }
    return i;
}

bool Scanner::goes_on(std::string_view pattern) const {
    return match(pattern) != std::string_view::npos;
}

bool Scanner::take(std::string_view pattern) {
    const std::size_t end = match(pattern);
    if (end == std::string_view::npos) return false;
    at_ = end;
    return true;
}

bool Scanner::take_word(std::string_view word) {
    const std::size_t end = match(word);
    if (end == std::string_view::npos || (end < text_.size() && is_letter(text_[end]))) return false;
    at_ = end;
    return true;
}

bool Scanner::take_exact(std::string_view piece) {
    if (rest().substr(0, piece.size()) != piece) return false;
    at_ += piece.size();
    return true;
}

double Scanner::read_number() {
    double value = 0;
    const std::string_view text = rest();
    const auto [last, error] =
        std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
    if (error != std::errc{} || !std::isfinite(value) || value < 0) fail(at_, "expected a number");
    at_ += static_cast<std::size_t>(last - text.data());
    return value;
}

void Scanner::fail(std::size_t where, const std::string& text) const {
    throw CharacterError(given_place(where), text);
}

std::size_t Scanner::given_place(std::size_t where) const {
    return given_[where < given_.size() ? where : given_.size() - 1];
}

}  // namespace seaglare::lightdb
