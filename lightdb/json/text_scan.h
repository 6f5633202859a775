// The inner loops over JSON text: eight bytes at a time where the text allows it. All of them read up to
// eight bytes past the last byte they accept, which the zeros behind a Source's text allow; a zero ends each
// of them.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>

namespace seaglare::json {

namespace scan_detail {

constexpr std::uint64_t each_byte(std::uint64_t byte) {
    return byte * 0x0101010101010101U;
}

inline std::uint64_t load8(const char* p) {
    std::uint64_t word = 0;
    std::memcpy(&word, p, sizeof word);
    return word;
}

// Index, in memory order, of the first byte whose top bit is set in `marks`.
inline int first_mark(std::uint64_t marks) {
    if constexpr (std::endian::native == std::endian::little) {
        return std::countr_zero(marks) / 8;
    } else {
        return std::countl_zero(marks) / 8;
    }
}

}  // namespace scan_detail

// The first byte at or after `p` that is not space, tab, line feed or carriage return.
inline const char* skip_whitespace(const char* p) {
    using namespace scan_detail;
    for (;;) {
        const auto c = static_cast<unsigned char>(*p);
        if (c > ' ') return p;
        if (c != ' ' && c != '\n' && c != '\r' && c != '\t') return p;
        ++p;
        // Indentation comes in runs of spaces.
        while (load8(p) == each_byte(' '))
            p += 8;
    }
}

// The first byte at or after `p` that a string cannot simply contain: a quote, a backslash, a control
// character, or one beyond ASCII.
inline const char* skip_plain(const char* p) {
    using namespace scan_detail;
    for (;;) {
        const std::uint64_t word = load8(p);
        const std::uint64_t quote = word ^ each_byte('"');
        const std::uint64_t backslash = word ^ each_byte('\\');
        // Exact for the lowest marked byte, which is all that is read; a byte above it may be marked in error
        // by the borrow. On a big-endian machine the first byte in memory is the highest, so there the slow
        // loop decides.
        const std::uint64_t marks =
            (word | (word - each_byte(0x20)) | (quote - each_byte(1)) | (backslash - each_byte(1))) &
            each_byte(0x80);
        if (marks == 0) {
            p += 8;
            continue;
        }
        if constexpr (std::endian::native == std::endian::little) {
            return p + first_mark(marks);
        } else {
            for (;; ++p) {
                const auto c = static_cast<unsigned char>(*p);
                if (c < 0x20 || c >= 0x80 || c == '"' || c == '\\') return p;
            }
        }
    }
}

// Length in bytes of the well-formed UTF-8 sequence at `p`, whose first byte is 0x80 or more; 0: it is none
// (Unicode table 3-7: no overlong form, no surrogate, nothing above U+10FFFF).
inline int utf8_sequence_length(const char* p) {
    const auto byte = [p](int i) { return static_cast<unsigned char>(p[i]); };
    const auto continues = [&byte](int i) { return (byte(i) & 0xC0) == 0x80; };
    const unsigned first = byte(0);
    if (first >= 0xC2 && first <= 0xDF) return continues(1) ? 2 : 0;
    if (first >= 0xE0 && first <= 0xEF) {
        const unsigned lowest = first == 0xE0 ? 0xA0 : 0x80;
        const unsigned highest = first == 0xED ? 0x9F : 0xBF;
        return byte(1) >= lowest && byte(1) <= highest && continues(2) ? 3 : 0;
    }
    if (first >= 0xF0 && first <= 0xF4) {
        const unsigned lowest = first == 0xF0 ? 0x90 : 0x80;
        const unsigned highest = first == 0xF4 ? 0x8F : 0xBF;
        return byte(1) >= lowest && byte(1) <= highest && continues(2) && continues(3) ? 4 : 0;
    }
    return 0;
}

inline void append_utf8(std::string& text, char32_t c) {
    const auto put = [&text](char32_t byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
    if (c < 0x80) {
        put(c);
    } else if (c < 0x800) {
        put(0xC0 | (c >> 6));
        put(0x80 | (c & 0x3F));
    } else if (c < 0x10000) {
        put(0xE0 | (c >> 12));
        put(0x80 | ((c >> 6) & 0x3F));
        put(0x80 | (c & 0x3F));
    } else {
        put(0xF0 | (c >> 18));
        put(0x80 | ((c >> 12) & 0x3F));
        put(0x80 | ((c >> 6) & 0x3F));
        put(0x80 | (c & 0x3F));
    }
}

}  // namespace seaglare::json
