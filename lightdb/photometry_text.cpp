#include "lightdb/photometry_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "lightdb/photometry_file.h"

namespace seaglare::lightdb {

namespace {

constexpr char end_of_file_mark = '\x1A';  // CP/M and DOS wrote it behind the text

bool is_line_end(char c) {
    return c == '\n' || c == '\r';
}

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == end_of_file_mark || is_line_end(c);
}

// A piece of the file for a message: short, and without what a terminal would act on.
std::string quoted(std::string_view text) {
    constexpr std::size_t longest = 40;
    std::string result = "'";
    for (const char c : text.substr(0, longest)) {
        const auto byte = static_cast<unsigned char>(c);
        result += byte < 0x20 || byte >= 0x7F ? '?' : c;
    }
    return result + (text.size() > longest ? "…'" : "'");
}

struct Place {
    std::size_t line = 1;
    std::size_t column = 1;
};

Place place_of(std::string_view text, std::size_t offset) {
    Place place;
    std::size_t line_begin = 0;
    for (std::size_t i = 0; i < std::min(offset, text.size()); ++i) {
        if (!is_line_end(text[i])) continue;
        if (text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n') continue;
        ++place.line;
        line_begin = i + 1;
    }
    place.column = offset - std::min(offset, line_begin) + 1;
    return place;
}

}  // namespace

PhotometryText::PhotometryText(std::string_view text, std::string file, Comma comma)
    : text_(text), file_(std::move(file)), comma_(comma) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text_.substr(0, 3) == byte_order_mark) at_ = 3;
}

std::string_view PhotometryText::line(std::string_view what) {
    last_ = at_;
    if (at_end()) fail("the file ends where " + std::string(what) + " should stand");
    std::size_t end = at_;
    while (end < text_.size() && !is_line_end(text_[end]))
        ++end;
    const std::string_view result = text_.substr(at_, end - at_);
    at_ = end;
    if (at_ < text_.size() && text_[at_] == '\r') ++at_;
    if (at_ < text_.size() && text_[at_] == '\n' && (at_ == end || text_[at_ - 1] == '\r')) ++at_;
    return result;
}

double PhotometryText::line_number(std::string_view what, std::optional<double> blank) {
    const std::string_view text = trimmed(line(what));
    if (!text.empty()) return parsed(text, what);
    if (!blank) fail("the line is blank where " + std::string(what) + " should stand");
    return *blank;
}

std::string_view PhotometryText::token() {
    const auto parts = [this](char c) { return is_blank(c) || (c == ',' && comma_ == Comma::parts_numbers); };
    while (at_ < text_.size() && parts(text_[at_]))
        ++at_;
    last_ = at_;
    while (at_ < text_.size() && !parts(text_[at_]))
        ++at_;
    return text_.substr(last_, at_ - last_);
}

double PhotometryText::parsed(std::string_view token, std::string_view what) const {
    if (token.empty()) fail("the file ends where " + std::string(what) + " should stand");
    // The longest that means anything: no copy of what a hostile file makes long.
    std::array<char, 64> digits{};
    const std::string_view unsigned_token = token.front() == '+' ? token.substr(1) : token;
    double value = 0;
    bool is_number = unsigned_token.size() < digits.size();
    if (is_number) {
        std::copy(unsigned_token.begin(), unsigned_token.end(), digits.begin());
        if (comma_ == Comma::decimal_point) std::replace(digits.begin(), digits.end(), ',', '.');
        const char* const end = digits.data() + unsigned_token.size();
        const auto [stopped, error] = std::from_chars(digits.data(), end, value);
        is_number = error == std::errc() && stopped == end && std::isfinite(value);
    }
    if (!is_number) fail(quoted(token) + " is no number: " + std::string(what) + " should stand here");
    return value;
}

double PhotometryText::number(std::string_view what) {
    return parsed(token(), what);
}

double PhotometryText::number(std::string_view what, double min, double max) {
    const double value = number(what);
    if (!(value >= min && value <= max)) {
        fail(std::string(what) + " is " + short_number(value) + ", not " + short_number(min) + " to " +
             short_number(max));
    }
    return value;
}

std::size_t PhotometryText::count(std::string_view what, std::size_t min) {
    constexpr double largest = 1e9;
    const double value = number(what, static_cast<double>(min), largest);
    if (value != std::floor(value))
        fail(std::string(what) + " is " + short_number(value) + ", no whole number");
    return static_cast<std::size_t>(value);
}

void PhotometryText::check_room(double how_many, std::string_view what) const {
    // Each number takes a digit and what parts it from the next.
    const double room = static_cast<double>(text_.size() - std::min(at_, text_.size())) / 2 + 1;
    if (how_many > room) {
        fail("the file is too short for the " + short_number(how_many) + " " + std::string(what) +
             " it states");
    }
}

std::vector<double> PhotometryText::ascending(std::size_t how_many, std::string_view what, double min,
                                              double max) {
    check_room(static_cast<double>(how_many), std::string(what) + "s");
    std::vector<double> result;
    result.reserve(how_many);
    for (std::size_t i = 0; i < how_many; ++i) {
        const double value = number(what, min, max);
        if (!result.empty() && value <= result.back()) {
            fail(std::string(what) + " " + short_number(value) + " does not lie above the one before it, " +
                 short_number(result.back()));
        }
        result.push_back(value);
    }
    return result;
}

void PhotometryText::expect_end(std::string_view what) {
    const std::string_view rest = token();
    if (!rest.empty()) fail("nothing should follow " + std::string(what) + ", but there is " + quoted(rest));
}

void PhotometryText::fail(const std::string& text) const {
    const Place place = place_of(text_, last_);
    throw PhotometryFileError(file_, place.line, place.column, text);
}

std::string PhotometryText::warning(const std::string& text) const {
    return file_ + ":" + std::to_string(place_of(text_, last_).line) + ": " + text;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back()))
        text.remove_suffix(1);
    return text;
}

std::string short_number(double value) {
    std::array<char, 32> text{};
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() ? std::string(text.data(), end) : std::string("?");
}

}  // namespace seaglare::lightdb
