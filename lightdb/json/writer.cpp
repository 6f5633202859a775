#include "lightdb/json/writer.h"

#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "lightdb/json/text_scan.h"

namespace seaglare::json {

void Writer::key(std::string_view name) {
    assert(!levels_.empty() && !after_key_);
    before_value();
    quote(name);
    text_ += ": ";
    after_key_ = true;
}

void Writer::value(double number) {
    if (!std::isfinite(number)) {
        null();
        return;
    }
    before_value();
    char digits[32];
    text_.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

void Writer::value(std::string_view text) {
    before_value();
    quote(text);
}

void Writer::value(bool boolean) {
    before_value();
    text_ += boolean ? "true" : "false";
}

void Writer::null() {
    before_value();
    text_ += "null";
}

void Writer::value(const Value& tree) {
    switch (tree.kind()) {
        case Kind::null:
            null();
            return;
        case Kind::boolean:
            value(tree.boolean());
            return;
        case Kind::number:
            value(tree.number());
            return;
        case Kind::string:
            value(tree.string());
            return;
        case Kind::array:
            begin_array();
            for (const Value& element : tree.array())
                value(element);
            end_array();
            return;
        case Kind::object:
            begin_object();
            for (const auto& [name, of] : tree.object())
                member(name, of);
            end_object();
            return;
    }
}

std::string Writer::take() {
    assert(levels_.empty() && !after_key_);
    text_ += '\n';
    std::string result = std::move(text_);
    text_.clear();
    return result;
}

void Writer::begin(char bracket, Layout layout) {
    before_value();
    text_ += bracket;
    const bool inside_line = !levels_.empty() && levels_.back().inline_;
    levels_.push_back({inside_line || layout == Layout::line, true});
}

void Writer::end(char bracket) {
    assert(!levels_.empty() && !after_key_);
    const Level level = levels_.back();
    levels_.pop_back();
    if (!level.empty && !level.inline_) line_break();
    text_ += bracket;
}

void Writer::before_value() {
    if (after_key_) {
        after_key_ = false;
        return;
    }
    if (levels_.empty()) return;
    Level& level = levels_.back();
    if (!level.empty) text_ += level.inline_ ? ", " : ",";
    if (!level.inline_) line_break();
    level.empty = false;
}

void Writer::line_break() {
    text_ += '\n';
    text_.append(2 * levels_.size(), ' ');
}

void Writer::quote(std::string_view text) {
    text_ += '"';
    // The scans look ahead: a copy with zeros behind it, as they ask for.
    std::string padded(text);
    padded.append(8, '\0');
    const char* p = padded.data();
    const char* const end = p + text.size();
    while (p < end) {
        const char* const plain = skip_plain(p);
        text_.append(p, plain);
        p = plain;
        if (p == end) break;
        const auto c = static_cast<unsigned char>(*p);
        if (c >= 0x80) {
            const int length = utf8_sequence_length(p);
            if (length == 0) {
                text_ += "\xEF\xBF\xBD";
                ++p;
            } else {
                text_.append(p, static_cast<std::size_t>(length));
                p += length;
            }
            continue;
        }
        ++p;
        switch (c) {
            case '"':
                text_ += "\\\"";
                break;
            case '\\':
                text_ += "\\\\";
                break;
            case '\b':
                text_ += "\\b";
                break;
            case '\f':
                text_ += "\\f";
                break;
            case '\n':
                text_ += "\\n";
                break;
            case '\r':
                text_ += "\\r";
                break;
            case '\t':
                text_ += "\\t";
                break;
            default: {
                char escape[8];
                std::snprintf(escape, sizeof escape, "\\u%04x", c);
                text_ += escape;
            }
        }
    }
    text_ += '"';
}

}  // namespace seaglare::json
