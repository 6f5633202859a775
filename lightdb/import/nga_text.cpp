#include "lightdb/import/nga_text.h"

#include <cctype>
#include <charconv>
#include <cmath>

#include "lightdb/units.h"

namespace seaglare::lightdb::nga {
namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
char lower(char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}
bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}
bool is_minute_sign(char c) {
    return c == '`' || c == '\'';
}

// One of "59°03'38.11\"N", "59°03.6'N", "59° 03' N". Minutes and seconds may carry the decimals.
std::optional<double> read_angle(Cursor& cursor, std::string_view positive, std::string_view negative) {
    const auto degrees = cursor.number();
    cursor.skip_blanks();
    if (!degrees || !cursor.degree_sign()) return std::nullopt;
    double angle = *degrees;
    if (const auto minutes = cursor.number()) {
        cursor.skip_blanks();
        if (*minutes >= 60 || !is_minute_sign(cursor.peek())) return std::nullopt;
        cursor.step();
        angle += *minutes / 60;
        if (const auto seconds = cursor.number()) {
            if (*seconds >= 60 || !cursor.take('"')) return std::nullopt;
            angle += *seconds / 3600;
        }
    }
    if (cursor.take(positive)) return angle;
    if (cursor.take(negative)) return -angle;
    return std::nullopt;
}

}  // namespace

void Cursor::skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_]))
        ++at_;
}

bool Cursor::take(char c) {
    const std::size_t start = at_;
    skip_blanks();
    if (peek() == c) return ++at_, true;
    at_ = start;
    return false;
}

bool Cursor::take(std::string_view word) {
    const std::size_t start = at_;
    skip_blanks();
    for (const char c : word)
        if (lower(peek()) == lower(c)) {
            ++at_;
        } else {
            at_ = start;
            return false;
        }
    return true;
}

std::optional<double> Cursor::number() {
    const std::size_t start = at_;
    skip_blanks();
    if (!is_digit(peek())) return at_ = start, std::nullopt;
    double value = 0;
    const char* first = text_.data() + at_;
    const auto [end, error] =
        std::from_chars(first, text_.data() + text_.size(), value, std::chars_format::fixed);
    if (error != std::errc{}) return at_ = start, std::nullopt;
    at_ += static_cast<std::size_t>(end - first);
    if (text_[at_ - 1] == '.') --at_;  // the end of a sentence, not a decimal point
    return value;
}

bool Cursor::degree_sign() {
    if (peek() == '^') return ++at_, true;
    if (peek() == '\xC2' && peek(1) == '\xB0') return at_ += 2, true;
    return false;
}

std::optional<double> Cursor::bearing_deg() {
    const std::size_t start = at_;
    skip_blanks();
    const std::size_t first = at_;
    const auto degrees = number();
    const std::size_t digits = at_ - first;
    if (!degrees || *degrees > 360) return at_ = start, std::nullopt;
    bool sign = false;
    while (degree_sign())
        sign = true;
    if (!sign) {
        if (digits != 3) return at_ = start, std::nullopt;
        if (is_minute_sign(peek())) ++at_;
        return *degrees;
    }
    const std::size_t after_degrees = at_;
    const bool figure_next = is_digit(peek()) || (peek() == ' ' && is_digit(peek(1)) && is_digit(peek(2)) &&
                                                  is_minute_sign(peek(3)));
    const auto minutes = figure_next ? number() : std::nullopt;
    if (!minutes || *minutes >= 60) return at_ = after_degrees, *degrees;
    if (is_minute_sign(peek())) ++at_;
    double seconds = 0;
    const std::size_t after_minutes = at_;
    if (const auto figure = is_digit(peek()) ? number() : std::nullopt; figure && peek() == '"') {
        ++at_;
        seconds = *figure;
    } else {
        at_ = after_minutes;
    }
    while (degree_sign() || is_minute_sign(peek()))
        if (is_minute_sign(peek())) ++at_;
    return *degrees + *minutes / 60 + seconds / 3600;
}

std::optional<Colour> Cursor::colour() {
    const std::size_t start = at_;
    skip_blanks();
    std::optional<Colour> colour;
    const auto word = [&](std::string_view letters, Colour value) {
        if (colour || rest().substr(0, letters.size()) != letters || is_letter(peek(letters.size()))) return;
        at_ += letters.size();
        colour = value;
    };
    word("W", Colour::white);
    word("R", Colour::red);
    word("G", Colour::green);
    word("Y", Colour::yellow);
    word("Bu", Colour::blue);
    word("Or", Colour::orange);
    word("Vi", Colour::violet);
    if (!colour) return at_ = start, std::nullopt;
    if (peek() == '.') ++at_;
    return colour;
}

std::optional<std::pair<double, double>> read_position(std::string_view text) {
    Cursor cursor(text);
    const auto latitude = read_angle(cursor, "N", "S");
    if (!latitude) return std::nullopt;
    const auto longitude = read_angle(cursor, "E", "W");
    if (!longitude || std::abs(*latitude) > 90 || std::abs(*longitude) > 180) return std::nullopt;
    return std::pair{*latitude, *longitude};
}

std::vector<double> read_heights_m(std::string_view text) {
    Cursor cursor(text);
    std::vector<double> heights;
    while (const auto feet = cursor.number()) {
        const bool in_metres = !cursor.take("ft") && cursor.take("m");  // mostly without units
        if (in_metres) {
            heights.push_back(*feet);
            continue;
        }
        const auto metres = cursor.number();
        cursor.take("m");
        heights.push_back(metres ? *metres : *feet * metres_per_foot);
    }
    return heights;
}

std::vector<std::pair<std::optional<Colour>, double>> read_ranges_nm(std::string_view text) {
    Cursor cursor(text);
    std::vector<std::pair<std::optional<Colour>, double>> ranges;
    for (;;) {
        const auto colour = cursor.colour();
        const auto range = cursor.number();
        if (!range) return ranges;
        ranges.emplace_back(colour, *range);
        cursor.take('M');
        if (!cursor.take(',')) cursor.take(';');
    }
}

std::string read_number(std::string_view text) {
    std::string out;
    bool gap = false;
    for (const char c : text) {
        if (c == '\n') {
            out += " / ";
            gap = true;
        } else if (!is_blank(c)) {
            out += gap && c == 'c' ? 'C' : c;
        }
    }
    return out;
}

std::string tidy_name(std::string_view text) {
    bool shouted = true;
    for (const char c : text)
        shouted = shouted && !(c >= 'a' && c <= 'z');
    std::string out;
    std::size_t word = 0;  // where the current word starts in `out`
    const auto end_word = [&] {
        // "HAVN" becomes "Havn", but "NW", "DW" and "E" stay.
        if (shouted && out.size() - word > 2 && out.find_first_not_of("NSEW", word) != std::string::npos)
            for (std::size_t i = word + 1; i < out.size(); ++i)
                out[i] = lower(out[i]);
    };
    for (const char c : text) {
        if (is_letter(c) || c == '\'') {
            out += c;
            continue;
        }
        end_word();
        if (c == '^') {
            out += "\xC2\xB0";
        } else if (!is_blank(c)) {
            out += c;
        } else if (!out.empty() && out.back() != ' ') {
            out += ' ';
        }
        word = out.size();
    }
    end_word();
    while (!out.empty() && (out.back() == '.' || out.back() == ':' || out.back() == ',' || out.back() == ' '))
        out.pop_back();
    return out;
}

std::pair<int, std::string_view> name_depth(std::string_view text) {
    int depth = 0;
    std::size_t at = 0;
    for (; at < text.size() && (text[at] == '-' || is_blank(text[at])); ++at)
        if (text[at] == '-') ++depth;
    return {depth, text.substr(at)};
}

}  // namespace seaglare::lightdb::nga
