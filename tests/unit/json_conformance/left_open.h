// What RFC 8259 section 9 leaves to the parser (limits of size, depth, range), or only lets it accept (a byte order mark,
// section 8.1), and what ours does.
#pragma once

#include "tests/unit/json_conformance/cases.h"

namespace seaglare::json_conformance {

// clang-format off
inline std::vector<Case> left_open_cases() {
    using namespace std::string_literals;
    return {
    {"i_number_1e400", Verdict::ours_refuses, "1e400"s},
    {"i_number_minus_1e400", Verdict::ours_refuses, "-1e400"s},
    {"i_number_huge_exponent", Verdict::ours_refuses, "0.4e006699999999999999999999"s},
    {"i_number_huge_integer", Verdict::ours_refuses, "1"s + repeated("0"s, 309)},
    {"i_number_just_too_large", Verdict::ours_refuses, "1.7976931348623159e308"s},
    {"i_number_rounds_to_largest", Verdict::ours_accepts, "1.7976931348623158e308"s},
    {"i_number_huge_negative_exponent", Verdict::ours_accepts, "123.456e-9999999999"s},
    {"i_number_below_half_of_least", Verdict::ours_accepts, "2e-324"s},
    {"i_number_integer_beyond_64_bits", Verdict::ours_accepts, "-123123123123123123123123123123"s},
    {"i_structure_500_arrays", Verdict::ours_accepts, repeated("["s, 500) + repeated("]"s, 500)},
    {"i_structure_512_arrays", Verdict::ours_accepts, repeated("["s, 512) + repeated("]"s, 512)},
    {"i_structure_513_arrays", Verdict::ours_refuses, repeated("["s, 513) + repeated("]"s, 513)},
    {"i_structure_512_objects", Verdict::ours_accepts, repeated("{\"a\":"s, 511) + "{"s + repeated("}"s, 512)},
    {"i_structure_513_objects", Verdict::ours_refuses, repeated("{\"a\":"s, 512) + "{"s + repeated("}"s, 513)},
    {"i_structure_bom_empty_object", Verdict::ours_refuses, "\xEF\xBB\xBF{}"s},
    };
}
// clang-format on

}  // namespace seaglare::json_conformance
