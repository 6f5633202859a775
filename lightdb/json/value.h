// A JSON document (RFC 8259) as a tree of values, each of which knows where it stood in the text. Our own.
//
// A Document owns the text and the tree. A Value is a small view into it, as a std::string_view is into a
// string: copy it freely, but not beyond the Document's life. Strings without escapes point straight into the
// text, lines and columns are worked out only when somebody asks: reading a large file costs neither an
// allocation nor a count per value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

namespace seaglare::json {

struct Location {
    std::uint32_t line = 1;    // 1-based
    std::uint32_t column = 1;  // 1-based, counted in UTF-8 code points
    friend bool operator==(const Location&, const Location&) = default;
};

// What went wrong and where. what() is "FILE:LINE:COL: text", as compilers write it.
class Error : public std::runtime_error {
  public:
    Error(std::string_view file, Location where, std::string_view text);
    Location where() const { return where_; }

  private:
    Location where_;
};

enum class Kind : std::uint8_t { null, boolean, number, string, array, object };

// "null", "a boolean", "a number" …: for messages.
std::string_view kind_name(Kind kind);

class Member;
class Parser;
class Source;

// The accessors' precondition is the kind they are named for; for another kind they return false, 0 or empty.
class Value {
  public:
    Value() = default;  // a null that stands nowhere
    Kind kind() const { return static_cast<Kind>(kind_); }
    Location location() const;  // of the first character; reads the text up to it
    bool boolean() const { return kind() == Kind::boolean && payload_.boolean; }
    double number() const { return kind() == Kind::number ? payload_.number : 0; }
    std::string_view string() const;
    std::span<const Value> array() const;
    // Members in the order of the text. Duplicate keys are kept: validation reports them. Reads as pairs:
    // for (const auto& [name, value] : v.object()).
    std::span<const Member> object() const;
    const Value* find(std::string_view key) const;  // first member of that name, or nullptr

    // The error to throw when this value is not what was wanted: "FILE:LINE:COL: text" of this value.
    Error error(std::string_view text) const;

  private:
    friend class Parser;
    union Payload {
        double number = 0;
        bool boolean;
        const char* characters;
        const Value* values;
    };
    Payload payload_;
    std::uint32_t kind_ : 3 = 0;
    std::uint32_t size_ : 29 = 0;  // bytes, elements or members
    std::uint32_t offset_ = 0;     // into the text
    const Source* source_ = nullptr;
};

// One name and its value. The key is a Value, too, so that a message can point at it.
class Member {
  public:
    std::string_view name() const { return key_.string(); }
    const Value& key() const { return key_; }
    const Value& value() const { return value_; }
    template <std::size_t I>
    decltype(auto) get() const {
        if constexpr (I == 0) {
            return name();
        } else {
            return value();
        }
    }

  private:
    Value key_;
    Value value_;
};

inline std::string_view Value::string() const {
    return kind() == Kind::string ? std::string_view(payload_.characters, size_) : std::string_view();
}
inline std::span<const Value> Value::array() const {
    return kind() == Kind::array ? std::span<const Value>(payload_.values, size_) : std::span<const Value>();
}
inline std::span<const Member> Value::object() const {
    // A Member is two Values and nothing else, and the parser lays them out in turn.
    static_assert(sizeof(Member) == 2 * sizeof(Value));
    return kind() == Kind::object
               ? std::span<const Member>(reinterpret_cast<const Member*>(payload_.values), size_)
               : std::span<const Member>();
}

class Document {
  public:
    Document(Document&&) noexcept;
    Document& operator=(Document&&) noexcept;
    ~Document();
    const Value& root() const& { return root_; }
    const Value& root() const&& = delete;  // the values die with the Document: give it a name
    const std::string& file() const;       // as given to parse()

  private:
    friend class Parser;
    Document() = default;
    std::unique_ptr<Source> source_;
    Value root_;
};

inline constexpr int max_depth = 512;                         // of arrays and objects inside each other
inline constexpr std::uint32_t max_text_bytes = 0xFFFF'FFFF;  // 4 GiB less one
// Bytes of one string, elements of one array, members of one object.
inline constexpr std::uint32_t max_size = (1U << 29) - 1;

// Parses one document. `file` is used in messages only. Throws Error, with the place, for whatever RFC 8259 does not
// allow, and where it leaves the choice to us (section 9): a byte order mark, text that is not UTF-8, a lone surrogate
// escape, a nesting deeper than max_depth, more than max_text_bytes or max_size, and a number too large for a double
// (1e400): the nearest double would be infinity, which no light is and JSON cannot say again. One too small, 1e-400, is 0,
// which is as near as any double comes.
Document parse(std::string_view text, std::string_view file);
// Reads and parses a file. Throws Error (parse) or std::system_error (the file cannot be read; names the
// path).
Document parse_file(const std::string& path);

}  // namespace seaglare::json

template <>
struct std::tuple_size<seaglare::json::Member> : std::integral_constant<std::size_t, 2> {};
template <>
struct std::tuple_element<0, seaglare::json::Member> {
    using type = std::string_view;
};
template <>
struct std::tuple_element<1, seaglare::json::Member> {
    using type = const seaglare::json::Value&;
};
