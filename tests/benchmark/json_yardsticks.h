// The parsers that ours is measured beside, each behind the same two functions. One source file each: their headers are
// theirs alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace seaglare::benchmark {

// What a document holds, so that parsers can be compared: all numbers in the order of the text, and a fingerprint of all
// names and strings.
struct Contents {
    std::vector<double> numbers;
    std::size_t strings = 0;  // names included
    std::size_t string_bytes = 0;
    std::uint64_t string_hash = 0xCBF29CE484222325U;  // FNV-1a, 64 bits

    void add(std::string_view string) {
        ++strings;
        string_bytes += string.size();
        for (const char c : string)
            string_hash = (string_hash ^ static_cast<unsigned char>(c)) * 0x100000001B3U;
        string_hash = (string_hash ^ 0xFFU) * 0x100000001B3U;  // where it ends
    }
};

struct JsonParser {
    const char* name;
    bool (*parse)(std::string_view text);         // builds the tree and drops it; false: refused
    Contents (*contents)(std::string_view text);  // parses and walks the tree
};

// Ours, as every file is read.
extern const JsonParser our_parser;
// Every number's token by strtod: the judge of the numbers. Its strings are not read.
extern const JsonParser c_library;
// RapidJSON's DOM with kParseFullPrecisionFlag | kParseValidateEncodingFlag, UTF-8; the second with SSE2.
extern const JsonParser rapidjson_parser;
extern const JsonParser rapidjson_sse2_parser;
// simdjson's DOM; the second keeps one parser, with its buffers, for all documents.
extern const JsonParser simdjson_parser;
extern const JsonParser simdjson_reused_parser;

}  // namespace seaglare::benchmark
