// One pass over the text with a stack of our own: nesting costs memory, never the thread's stack. Children
// are collected on one scratch stack and copied to the arena, side by side, when their array or object
// closes.
#include <charconv>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

#include "lightdb/json/read_source.h"
#include "lightdb/json/source.h"
#include "lightdb/json/text_scan.h"
#include "lightdb/json/value.h"

namespace seaglare::json {

namespace {

constexpr bool is_digit(char c) {
    return static_cast<unsigned char>(c - '0') < 10;
}

// Powers of ten that a double holds exactly.
constexpr double exact_power_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                         1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                         1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr int largest_exact_power = 22;
constexpr std::uint64_t largest_exact_integer = std::uint64_t{1} << 53;

// Whether the decimal number at [begin, end), which is not zero, lies above 1: tells an overflow from an
// underflow.
bool is_above_one(const char* begin, const char* end) {
    const char* p = *begin == '-' ? begin + 1 : begin;
    long long exponent = 0;  // of the first significant digit
    bool point = false;
    bool significant = false;
    for (; p != end && *p != 'e' && *p != 'E'; ++p) {
        if (*p == '.') {
            point = true;
            continue;
        }
        if (!significant && *p != '0') {
            significant = true;
            exponent = point ? exponent - 1 : 0;
        } else if (!significant && point) {
            --exponent;
        } else if (significant && !point) {
            ++exponent;
        }
    }
    if (p != end) {
        ++p;
        const bool negative = *p == '-';
        if (*p == '-' || *p == '+') ++p;
        long long written = 0;
        for (; p != end; ++p) {
            // The text's own length bounds the mantissa's exponent far below this cap.
            if (written < 1'000'000'000'000) written = written * 10 + (*p - '0');
        }
        exponent += negative ? -written : written;
    }
    return exponent >= 0;
}

std::string quoted(char32_t c) {
    if (c >= 0x20 && c < 0x7F) return std::string("'") + static_cast<char>(c) + "'";
    char text[16];
    std::snprintf(text, sizeof text, "U+%04X", static_cast<unsigned>(c));
    return text;
}

}  // namespace

class Parser {
  public:
    explicit Parser(std::unique_ptr<Source> source)
        : source_(std::move(source)),
          begin_(source_->text().data()),
          end_(begin_ + source_->text().size()),
          p_(begin_) {}

    Document parse() {
        if (std::memcmp(begin_, "\xEF\xBB\xBF", 3) == 0)
            fail(begin_, "a byte order mark is not allowed here");
        parse_tree();
        p_ = skip_whitespace(p_);
        if (p_ != end_) fail(p_, "unexpected " + seen(p_) + " after the end of the value");
        Document document;
        document.root_ = scratch_.front();
        document.source_ = std::move(source_);
        return document;
    }

  private:
    // An array or object whose end has not come yet; its children lie on the scratch stack from first_child
    // on.
    struct Open {
        std::size_t first_child;
        std::uint32_t offset;
        Kind kind;
    };

    void parse_tree() {
        for (;;) {
            // A value begins here.
            p_ = skip_whitespace(p_);
            if (*p_ == '[') {
                open(Kind::array);
                if (*p_ != ']') continue;
                close();
            } else if (*p_ == '{') {
                open(Kind::object);
                if (*p_ != '}') {
                    key();
                    continue;
                }
                close();
            } else {
                scalar();
            }
            // A value has ended.
            for (;;) {
                if (open_.empty()) return;
                p_ = skip_whitespace(p_);
                const bool in_object = open_.back().kind == Kind::object;
                if (*p_ == ',') {
                    ++p_;
                    if (in_object) {
                        p_ = skip_whitespace(p_);
                        if (*p_ == '}') fail(p_, "a member must follow the comma, not '}'");
                        key();
                    } else {
                        p_ = skip_whitespace(p_);
                        if (*p_ == ']') fail(p_, "a value must follow the comma, not ']'");
                    }
                    break;
                }
                if (*p_ != (in_object ? '}' : ']')) {
                    fail(p_,
                         std::string("expected ',' or '") + (in_object ? '}' : ']') + "', not " + seen(p_));
                }
                close();
            }
        }
    }

    void open(Kind kind) {
        if (open_.size() == max_depth) {
            fail(p_, "arrays and objects are nested deeper than " + std::to_string(max_depth));
        }
        open_.push_back({scratch_.size(), offset(p_), kind});
        p_ = skip_whitespace(p_ + 1);
    }

    void close() {
        ++p_;
        const Open container = open_.back();
        open_.pop_back();
        const std::size_t count = scratch_.size() - container.first_child;
        Value* children = nullptr;
        if (count != 0) {
            children = static_cast<Value*>(source_->arena().allocate(count * sizeof(Value), alignof(Value)));
            std::memcpy(static_cast<void*>(children), scratch_.data() + container.first_child,
                        count * sizeof(Value));
            scratch_.resize(container.first_child);
        }
        const std::size_t size = container.kind == Kind::object ? count / 2 : count;
        if (size > max_size) {
            fail(begin_ + container.offset, "more than " + std::to_string(max_size) + " values side by side");
        }
        Value& value = push(container.kind, container.offset);
        value.payload_.values = children;
        value.size_ = size & max_size;
    }

    void key() {
        if (*p_ != '"') fail(p_, "a member's name in double quotes must stand here, not " + seen(p_));
        string();
        p_ = skip_whitespace(p_);
        if (*p_ != ':') fail(p_, "expected ':' after the member's name, not " + seen(p_));
        ++p_;
    }

    void scalar() {
        switch (*p_) {
            case '"':
                string();
                return;
            case 't':
                word("true");
                push(Kind::boolean, offset(p_)).payload_.boolean = true;
                p_ += 4;
                return;
            case 'f':
                word("false");
                push(Kind::boolean, offset(p_)).payload_.boolean = false;
                p_ += 5;
                return;
            case 'n':
                word("null");
                push(Kind::null, offset(p_));
                p_ += 4;
                return;
            default:
                if (*p_ == '-' || is_digit(*p_)) {
                    number();
                    return;
                }
                fail(p_, "expected a value, not " + seen(p_));
        }
    }

    void word(std::string_view expected) {
        if (std::memcmp(p_, expected.data(), expected.size()) != 0) {
            fail(p_, "expected a value; is this meant to be '" + std::string(expected) + "'?");
        }
    }

    void number() {
        const char* const start = p_;
        const char* p = start;
        const bool negative = *p == '-';
        if (negative) ++p;
        const char* const digits = p;
        std::uint64_t mantissa = 0;  // may wrap: used only when there are at most 19 digits
        while (is_digit(*p))
            mantissa = mantissa * 10 + static_cast<std::uint64_t>(*p++ - '0');
        if (p == digits) fail(p, "a digit must follow the minus sign, not " + seen(p));
        if (*digits == '0' && p - digits > 1) fail(start, "a number must not begin with a zero");
        std::ptrdiff_t digit_count = p - digits;
        std::int64_t exponent = 0;
        if (*p == '.') {
            const char* const fraction = ++p;
            while (is_digit(*p))
                mantissa = mantissa * 10 + static_cast<std::uint64_t>(*p++ - '0');
            if (p == fraction) fail(p, "a digit must follow the decimal point, not " + seen(p));
            digit_count += p - fraction;
            exponent = fraction - p;
        }
        if (*p == 'e' || *p == 'E') {
            ++p;
            const bool negative_exponent = *p == '-';
            if (*p == '-' || *p == '+') ++p;
            const char* const exponent_digits = p;
            std::int64_t written = 0;
            while (is_digit(*p)) {
                if (written < 100'000) written = written * 10 + (*p - '0');
                ++p;
            }
            if (p == exponent_digits) fail(p, "a digit must follow the exponent's sign, not " + seen(p));
            exponent += negative_exponent ? -written : written;
        }
        p_ = p;
        Value& value = push(Kind::number, offset(start));
        // Both factors exact, so one rounding: the nearest double (Clinger 1990).
        if (digit_count <= 19 && mantissa <= largest_exact_integer && exponent >= -largest_exact_power &&
            exponent <= largest_exact_power) {
            double magnitude = static_cast<double>(mantissa);
            if (exponent < 0) {
                magnitude /= exact_power_of_ten[-exponent];
            } else {
                magnitude *= exact_power_of_ten[exponent];
            }
            value.payload_.number = negative ? -magnitude : magnitude;
            return;
        }
        const auto [last, code] = std::from_chars(start, p, value.payload_.number);
        if (code == std::errc::result_out_of_range) {
            if (is_above_one(start, p)) {
                fail(start,
                     std::string(start, p - start > 40 ? start + 40 : p) + " is too large for a double");
            }
            value.payload_.number = negative ? -0.0 : 0.0;
        }
    }

    void string() {
        const char* const quote = p_;
        const char* p = skip_plain(quote + 1);
        while (static_cast<unsigned char>(*p) >= 0x80)
            p = skip_plain(code_point(p));
        if (*p == '"') {  // no escapes: the text itself serves
            p_ = p + 1;
            finish_string(quote, quote + 1, static_cast<std::size_t>(p - quote - 1));
            return;
        }
        unescaped_.assign(quote + 1, p);
        for (;;) {
            const char* const run = p;
            if (*p == '"') break;
            if (*p == '\\') {
                p = escape(p);
                continue;
            }
            if (static_cast<unsigned char>(*p) >= 0x80) {
                p = code_point(p);
            } else if (static_cast<unsigned char>(*p) < 0x20) {
                if (p == end_) fail(quote, "this string has no closing quote");
                fail(p, "the control character " + seen(p) + " must be written as an escape in a string");
            } else {
                p = skip_plain(p);
            }
            unescaped_.append(run, p);
        }
        p_ = p + 1;
        char* const copy = static_cast<char*>(source_->arena().allocate(unescaped_.size(), 1));
        std::memcpy(copy, unescaped_.data(), unescaped_.size());
        finish_string(quote, copy, unescaped_.size());
    }

    void finish_string(const char* quote, const char* characters, std::size_t size) {
        if (size > max_size) fail(quote, "a string of more than " + std::to_string(max_size) + " bytes");
        Value& value = push(Kind::string, offset(quote));
        value.payload_.characters = characters;
        value.size_ = size & max_size;
    }

    // Past the UTF-8 sequence at `p`, which begins beyond ASCII.
    const char* code_point(const char* p) const {
        const int length = utf8_sequence_length(p);
        if (length == 0) fail(p, "this is not UTF-8");
        return p + length;
    }

    // Appends what the escape at `p` stands for, and returns what follows it.
    const char* escape(const char* p) {
        switch (p[1]) {
            case '"':
                unescaped_ += '"';
                return p + 2;
            case '\\':
                unescaped_ += '\\';
                return p + 2;
            case '/':
                unescaped_ += '/';
                return p + 2;
            case 'b':
                unescaped_ += '\b';
                return p + 2;
            case 'f':
                unescaped_ += '\f';
                return p + 2;
            case 'n':
                unescaped_ += '\n';
                return p + 2;
            case 'r':
                unescaped_ += '\r';
                return p + 2;
            case 't':
                unescaped_ += '\t';
                return p + 2;
            case 'u':
                break;
            default:
                fail(p, "unknown escape in a string");
        }
        char32_t c = hex4(p);
        if (c >= 0xDC00 && c <= 0xDFFF) fail(p, "the second half of a surrogate pair without its first");
        if (c >= 0xD800 && c <= 0xDBFF) {
            const bool pair = p[6] == '\\' && p[7] == 'u';
            const char32_t low = pair ? hex4(p + 6) : 0;
            if (low < 0xDC00 || low > 0xDFFF)
                fail(p, "the first half of a surrogate pair without its second");
            c = 0x10000 + ((c - 0xD800) << 10) + (low - 0xDC00);
            p += 6;
        }
        append_utf8(unescaped_, c);
        return p + 6;
    }

    char32_t hex4(const char* escape) const {
        char32_t value = 0;
        for (int i = 2; i < 6; ++i) {
            const char c = escape[i];
            const int lower = c | 0x20;
            if (is_digit(c)) {
                value = value * 16 + static_cast<char32_t>(c - '0');
            } else if (lower >= 'a' && lower <= 'f') {
                value = value * 16 + static_cast<char32_t>(lower - 'a' + 10);
            } else {
                fail(escape, "four hexadecimal digits must follow \\u");
            }
        }
        return value;
    }

    Value& push(Kind kind, std::uint32_t at) {
        Value& value = scratch_.emplace_back();
        value.kind_ = static_cast<std::uint32_t>(kind) & 7U;
        value.offset_ = at;
        value.source_ = source_.get();
        return value;
    }

    std::uint32_t offset(const char* p) const { return static_cast<std::uint32_t>(p - begin_); }

    std::string seen(const char* p) const {
        if (p == end_) return "the end of the text";
        if (static_cast<unsigned char>(*p) < 0x80) return quoted(static_cast<unsigned char>(*p));
        const int length = utf8_sequence_length(p);
        return length == 0 ? "a byte that is not UTF-8"
                           : "'" + std::string(p, static_cast<std::size_t>(length)) + "'";
    }

    [[noreturn]] void fail(const char* where, std::string_view text) const {
        throw Error(source_->file(), source_->location(static_cast<std::size_t>(where - begin_)), text);
    }

    std::unique_ptr<Source> source_;
    const char* begin_;
    const char* end_;
    const char* p_;
    std::vector<Value> scratch_;
    std::vector<Open> open_;
    std::string unescaped_;
};

namespace {

std::unique_ptr<Source> copied_source(std::string_view text, std::string_view file) {
    if (text.size() > max_text_bytes) throw too_large(file);
    Block buffer = Source::make_buffer(text.size());
    if (!text.empty()) std::memcpy(buffer.get(), text.data(), text.size());
    return std::make_unique<Source>(file, std::move(buffer), text.size());
}

}  // namespace

Document parse(std::string_view text, std::string_view file) {
    return Parser(copied_source(text, file)).parse();
}

Document parse_file(const std::string& path) {
    return Parser(read_source(path)).parse();
}

}  // namespace seaglare::json
