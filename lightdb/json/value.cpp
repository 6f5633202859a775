#include "lightdb/json/value.h"

#include <algorithm>

#include "lightdb/json/source.h"

namespace seaglare::json {

namespace {

std::string message(std::string_view file, Location where, std::string_view text) {
    std::string result(file);
    result += ':' + std::to_string(where.line) + ':' + std::to_string(where.column) + ": ";
    result += text;
    return result;
}

}  // namespace

Error::Error(std::string_view file, Location where, std::string_view text)
    : std::runtime_error(message(file, where, text)), where_(where) {}

std::string_view kind_name(Kind kind) {
    switch (kind) {
        case Kind::null:
            return "null";
        case Kind::boolean:
            return "a boolean";
        case Kind::number:
            return "a number";
        case Kind::string:
            return "a string";
        case Kind::array:
            return "an array";
        case Kind::object:
            return "an object";
    }
    return "nothing";
}

Location Source::location(std::size_t offset) const {
    const std::string_view before = text().substr(0, offset);
    const auto lines = std::count(before.begin(), before.end(), '\n');
    const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
    // Code points start with any byte that does not continue one.
    const auto columns = std::count_if(before.begin() + static_cast<std::ptrdiff_t>(line_start), before.end(),
                                       [](char c) { return (c & 0xC0) != 0x80; });
    return {static_cast<std::uint32_t>(lines + 1), static_cast<std::uint32_t>(columns + 1)};
}

Location Value::location() const {
    return source_ != nullptr ? source_->location(offset_) : Location{};
}

Error Value::error(std::string_view text) const {
    return {source_ != nullptr ? std::string_view(source_->file()) : std::string_view("(no file)"),
            location(), text};
}

const Value* Value::find(std::string_view key) const {
    for (const Member& member : object()) {
        if (member.name() == key) return &member.value();
    }
    return nullptr;
}

Document::Document(Document&&) noexcept = default;
Document& Document::operator=(Document&&) noexcept = default;
Document::~Document() = default;
const std::string& Document::file() const {
    return source_->file();
}

}  // namespace seaglare::json
