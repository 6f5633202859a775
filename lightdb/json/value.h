// A JSON document as a tree of values, each of which knows where it stood in the text. Our own, RFC 8259.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace seaglare::json {

struct Location {
    std::uint32_t line = 1;    // 1-based
    std::uint32_t column = 1;  // 1-based, counted in UTF-8 code points
};

enum class Kind : std::uint8_t { null, boolean, number, string, array, object };

class Value {
  public:
    Kind kind() const { return kind_; }
    Location location() const { return location_; }
    bool boolean() const { return boolean_; }
    double number() const { return number_; }
    const std::string& string() const { return string_; }
    const std::vector<Value>& array() const { return array_; }
    // Members in the order of the text. Duplicate keys are kept: validation reports them.
    const std::vector<std::pair<std::string, Value>>& object() const { return object_; }
    const Value* find(std::string_view key) const;  // first member of that name, or nullptr

  private:
    friend class Parser;
    Kind kind_ = Kind::null;
    bool boolean_ = false;
    Location location_;
    double number_ = 0;
    std::string string_;
    std::vector<Value> array_;
    std::vector<std::pair<std::string, Value>> object_;
};

// What went wrong and where. what() is "FILE:LINE:COL: text", as compilers write it.
class Error : public std::runtime_error {
  public:
    Error(std::string_view file, Location where, std::string_view text);
    Location where() const { return where_; }

  private:
    Location where_;
};

inline constexpr int max_depth = 512;

// Parses one document. `file` is used in messages only. Throws Error.
Value parse(std::string_view text, std::string_view file);
// Reads and parses a file. Throws Error (parse) or std::system_error (file cannot be read).
Value parse_file(const std::string& path);

}  // namespace seaglare::json
