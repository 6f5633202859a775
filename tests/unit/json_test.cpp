// RFC 8259, as a parser has to hold it: what it must take, what it must refuse and where, and what it must not change.
#include "lightdb/json/value.h"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <system_error>

namespace seaglare::json {
namespace {

using namespace std::string_literals;

double number_of(std::string_view text) {
    const Document document = parse(text, "t");
    EXPECT_EQ(document.root().kind(), Kind::number) << text;
    return document.root().number();
}

std::string string_of(std::string_view text) {
    const Document document = parse(text, "t");
    EXPECT_EQ(document.root().kind(), Kind::string) << text;
    return std::string(document.root().string());
}

std::string error_of(std::string_view text) {
    try {
        parse(text, "f.json");
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

TEST(Json, AcceptsEveryKindOfValueAtTheTop) {
    const auto kind_of = [](std::string_view text) {
        const Document document = parse(text, "t");
        return document.root().kind();
    };
    EXPECT_EQ(kind_of("null"), Kind::null);
    EXPECT_EQ(kind_of("true"), Kind::boolean);
    EXPECT_EQ(kind_of("false"), Kind::boolean);
    EXPECT_EQ(kind_of(" 12 "), Kind::number);
    EXPECT_EQ(kind_of("\"a\""), Kind::string);
    EXPECT_EQ(kind_of("[]"), Kind::array);
    EXPECT_EQ(kind_of("{}"), Kind::object);
    const Document both = parse("[true, false]", "t");
    EXPECT_TRUE(both.root().array()[0].boolean());
    EXPECT_FALSE(both.root().array()[1].boolean());
}

TEST(Json, AcceptsWhatTheGrammarAllows) {
    const std::string_view accepted[] = {
        "[]",
        "[ ]",
        "\t\r\n [1\n,\t2]\r\n",
        "{\"a\":{\"a\":{}}}",
        "[[],{},[[]],\"\",0]",
        "{\"\":0}",
        "{\"a\":1,\"a\":2}",
        "0",
        "-0",
        "0.0",
        "-0.0",
        "1e0",
        "1E+0",
        "1e-0",
        "1.5e10",
        "123456789012345678901234567890",
        "1e00001",
        "[1e1,1E1]",
        "\"\\u0000\"",
        "\"\\uD834\\uDD1E\"",
        "\"\\\"\\\\\\/\\b\\f\\n\\r\\t\"",
        "\"\x7F\"",
        "\"\xC2\x80\"",
        "\"\xED\x9F\xBF\"",
        "\"\xEE\x80\x80\"",
        "\"\xEF\xBF\xBF\"",
        "\"\xF0\x90\x80\x80\"",
        "\"\xF4\x8F\xBF\xBF\"",
        "\"\\uFFFF\"",
        "\"\\uD7FF\"",
        "\"\\uE000\"",
        "[null,true,false]",
        "\"// no comment\"",
        "1e-400",
        "0e999999999999",
        "\"\xE2\x80\xA8\"",
    };
    for (const std::string_view text : accepted)
        EXPECT_EQ(error_of(text), "accepted") << text;
}

TEST(Json, RefusesWhatTheGrammarDoesNotAllow) {
    const std::string refused[] = {
        "",
        " ",
        "[",
        "]",
        "{",
        "}",
        "[1",
        "[1,",
        "[1,]",
        "[,1]",
        "[1 2]",
        "[1,,2]",
        "{\"a\"}",
        "{\"a\":}",
        "{\"a\":1,}",
        "{\"a\" 1}",
        "{a:1}",
        "{'a':1}",
        "{1:1}",
        "{\"a\":1 \"b\":2}",
        "{,}",
        "{\"a\":1]",
        "[1}",
        "1 2",
        "[] []",
        "{}}",
        "[]]",
        "nul",
        "nulll",
        "True",
        "tru",
        "fals",
        "NaN",
        "Infinity",
        "-Infinity",
        "-",
        "--1",
        "+1",
        "01",
        "-01",
        "00",
        "1.",
        ".5",
        "-.5",
        "1.e5",
        "1e",
        "1e+",
        "1E-",
        "0x10",
        "1_000",
        "1,5",
        "1.2.3",
        "1e5.5",
        "\"",
        "\"a",
        "\"\\\"",
        "\"\\a\"",
        "\"\\u12\"",
        "\"\\u123g\"",
        "\"\\u+123\"",
        "\"\\U0041\"",
        "\"\\x41\"",
        "\"\\'\"",
        "'a'",
        "\"\n\"",
        "\"\t\"",
        "\"\x1F\"",
        "\"\0\""s,
        "[\0]"s,
        "1\0"s,
        "\"\\\n\"",
        "// c\n1",
        "/* c */1",
        "#\n1",
        "1;",
        "\v1",
        "\f1",
        "\xC2\xA0"s + "1",
        "\xE2\x80\x8B"s + "1",
        "undefined",
        "\"\\uD800\"",
        "\"\\uDC00\"",
        "\"\\uD800\\u0041\"",
        "\"\\uD800x\"",
        "\"\\uDC00\\uD800\"",
        "\"\\uD800\\uD800\"",
        "\"\\uD834\\\"",
        "\xEF\xBB\xBF"s + "1",
        "1e999",
        "-1e400",
        "[\"a\",\n4,]",
        "\\u0031",
        "\xFF",
        "[\x80]",
    };
    for (const std::string& text : refused)
        EXPECT_NE(error_of(text), "accepted") << text;
}

TEST(Json, RefusesTextThatIsNotUtf8) {
    const std::string sequences[] = {
        "\x80",
        "\xBF",
        "\xC0\x80",
        "\xC1\xBF",
        "\xC2",
        "\xC2\x22",
        "\xE0\x80\x80",
        "\xE0\x9F\xBF",
        "\xE1\x80",
        "\xED\xA0\x80",
        "\xED\xBF\xBF",
        "\xF0\x80\x80\x80",
        "\xF0\x8F\xBF\xBF",
        "\xF1\x80\x80",
        "\xF4\x90\x80\x80",
        "\xF5\x80\x80\x80",
        "\xFE",
        "\xFF",
        "\xC3\x28",
        "\xE2\x28\xA1",
        "\xE2\x82\x28",
        "\xF0\x28\x8C\xBC",
        "\xF8\x88\x80\x80\x80",
    };
    for (const std::string& bytes : sequences) {
        // With and without plain text before: the fast and the slow way through a string.
        for (const std::string& before : {""s, "0123456789abc"s, "\\n"s}) {
            EXPECT_NE(error_of("\"" + before + bytes + "\"").find("not UTF-8"), std::string::npos)
                << before << bytes;
        }
    }
}

TEST(Json, EveryCodePointSurvivesAsBytesAndAsEscapes) {
    for (char32_t c = 1; c <= 0x10FFFF; c += c < 0x3000 ? 1 : 61) {
        if (c >= 0xD800 && c <= 0xDFFF) continue;
        char escaped[32];
        if (c < 0x10000) {
            std::snprintf(escaped, sizeof escaped, "\"\\u%04X\"", static_cast<unsigned>(c));
        } else {
            std::snprintf(escaped, sizeof escaped, "\"\\u%04x\\u%04X\"",
                          static_cast<unsigned>(0xD7C0 + (c >> 10)),
                          static_cast<unsigned>(0xDC00 + (c & 0x3FF)));
        }
        const std::string utf8 = string_of(escaped);
        if (c >= 0x20 && c != '"' && c != '\\') {
            ASSERT_EQ(string_of("\"" + utf8 + "\""), utf8) << static_cast<unsigned>(c);
        }
    }
    EXPECT_EQ(string_of("\"\\u00e6\\u20AC\\uD834\\uDD1E\""), "\xC3\xA6\xE2\x82\xAC\xF0\x9D\x84\x9E");
    EXPECT_EQ(string_of("\"a\\u0000b\""), "a\0b"s);
}

TEST(Json, StringsOfEveryLengthKeepTheirCharacters) {
    for (std::size_t length = 0; length < 70; ++length) {
        std::string plain;
        for (std::size_t i = 0; i < length; ++i)
            plain += static_cast<char>('#' + i % 56);  // no quote, no backslash
        EXPECT_EQ(string_of("\"" + plain + "\""), plain);
        EXPECT_EQ(string_of("\"" + plain + "\\n" + plain + "\""), plain + "\n" + plain);
        EXPECT_EQ(string_of("\"" + plain + "\xC3\xB8" + plain + "\""), plain + "\xC3\xB8" + plain);
        EXPECT_NE(error_of("\"" + plain + "\x01" + plain + "\""), "accepted");
    }
}

TEST(Json, NumbersAreTheNearestDoubles) {
    EXPECT_EQ(number_of("0.1"), 0.1);
    EXPECT_EQ(number_of("-273.15"), -273.15);
    EXPECT_EQ(number_of("9007199254740993"), 9007199254740992.0);  // halfway: to even
    EXPECT_EQ(number_of("9007199254740993.00000000000000000001"), 9007199254740994.0);
    EXPECT_EQ(number_of("1.7976931348623157e308"), std::numeric_limits<double>::max());
    EXPECT_EQ(number_of("2.2250738585072011e-308"),
              0x0.fffffffffffffp-1022);  // the one that hung PHP and Java
    EXPECT_EQ(number_of("5e-324"), std::numeric_limits<double>::denorm_min());
    EXPECT_EQ(number_of("2e-324"), 0);
    EXPECT_EQ(number_of("1e23"), 1e23);
    EXPECT_EQ(number_of("8.5e22"), 8.5e22);
    EXPECT_EQ(number_of("0.000000000000000000000000000000000000000000000000000000000001e60"), 1);
    EXPECT_EQ(number_of("1" + std::string(400, '0') + "e-400"), 1);
    EXPECT_EQ(number_of("0." + std::string(400, '0') + "1e401"), 1);
    EXPECT_TRUE(std::signbit(number_of("-0")));
    EXPECT_TRUE(std::signbit(number_of("-1e-999")));
    EXPECT_FALSE(std::signbit(number_of("0")));
}

TEST(Json, EveryDoubleComesBackFromItsShortestAndItsLongText) {
    std::mt19937_64 random(7);
    for (int i = 0; i < 200000; ++i) {
        const std::uint64_t bits = random();
        double number = 0;
        std::memcpy(&number, &bits, sizeof number);
        if (!std::isfinite(number)) continue;
        char text[64];
        const auto end = std::to_chars(text, text + sizeof text, number).ptr;
        ASSERT_EQ(number_of({text, end}), number) << std::string(text, end);
        const int length = std::snprintf(text, sizeof text, "%.17e", number);
        ASSERT_EQ(number_of({text, static_cast<std::size_t>(length)}), number) << text;
        const double coordinate = std::round(static_cast<double>(random() % 3600000000)) / 1e7;
        const int digits = std::snprintf(text, sizeof text, "%.7f", coordinate);
        ASSERT_EQ(number_of({text, static_cast<std::size_t>(digits)}), coordinate) << text;
    }
}

TEST(Json, ANumberTooLargeIsNamedWhereItStands) {
    EXPECT_EQ(error_of("[1,\n 1e999]"), "f.json:2:2: 1e999 is too large for a double");
    EXPECT_NE(error_of("1e99999999999999999999"), "accepted");
    EXPECT_NE(error_of("0.00001e314"), "accepted");
    EXPECT_EQ(number_of("1e-99999999999999999999"), 0);
    EXPECT_EQ(number_of("100000e-500"), 0);
}

TEST(Json, ErrorsNameLineAndColumnInCodePoints) {
    EXPECT_EQ(error_of("[1,\n2,\n  x]").substr(0, 11), "f.json:3:3:");
    EXPECT_EQ(error_of("[1,\r\n2,\r\n  x]").substr(0, 11), "f.json:3:3:");
    EXPECT_EQ(error_of("[\"\xC3\xB8\xF0\x9D\x84\x9E\", x]").substr(0, 11), "f.json:1:8:");
    EXPECT_EQ(error_of("{\"a\": 1,}"), "f.json:1:9: a member must follow the comma, not '}'");
    EXPECT_EQ(error_of("[1, 2"), "f.json:1:6: expected ',' or ']', not the end of the text");
    EXPECT_EQ(error_of(""), "f.json:1:1: expected a value, not the end of the text");
    EXPECT_EQ(error_of("{} \xC3\xA6"), "f.json:1:4: unexpected '\xC3\xA6' after the end of the value");
    EXPECT_EQ(error_of("\"abc"), "f.json:1:1: this string has no closing quote");
}

TEST(Json, ValuesKnowWhereTheyStand) {
    const Document document = parse("{\n  \"a\": [1, \"\xC3\xA6\", {\"b\": null}],\n  \"a\": 2\n}\n", "t");
    const auto members = document.root().object();
    ASSERT_EQ(members.size(), 2U);
    EXPECT_EQ(members[0].key().location(), (Location{2, 3}));
    const auto elements = members[0].value().array();
    ASSERT_EQ(elements.size(), 3U);
    EXPECT_EQ(elements[0].location(), (Location{2, 9}));
    EXPECT_EQ(elements[1].location(), (Location{2, 12}));
    EXPECT_EQ(elements[2].location(), (Location{2, 17}));
    EXPECT_EQ(elements[2].find("b")->location(), (Location{2, 23}));
    EXPECT_EQ(document.root().find("a"), &members[0].value());  // the first of two
    EXPECT_EQ(members[1].value().number(), 2);
    EXPECT_EQ(document.root().find("c"), nullptr);
}

TEST(Json, MembersReadAsPairsInTheOrderOfTheText) {
    const Document document = parse(R"({"z":1,"\u0061":2,"m":3})", "t");
    std::string names;
    double sum = 0;
    for (const auto& [name, value] : document.root().object()) {
        names += name;
        sum += value.number();
    }
    EXPECT_EQ(names, "zam");
    EXPECT_EQ(sum, 6);
}

TEST(Json, NestingIsLimitedWithALocationAndNeverByTheStack) {
    const auto nested = [](int depth) { return std::string(depth, '[') + std::string(depth, ']'); };
    EXPECT_EQ(error_of(nested(max_depth)), "accepted");
    EXPECT_EQ(error_of(nested(max_depth + 1)), "f.json:1:513: arrays and objects are nested deeper than 512");
    EXPECT_NE(error_of(std::string(100000, '[')), "accepted");
    std::string objects;
    for (int i = 0; i < 100000; ++i)
        objects += "{\"a\":";
    EXPECT_NE(error_of(objects).find("nested deeper"), std::string::npos);
}

TEST(Json, EveryPrefixOfADocumentIsRefusedAndNoneCrashes) {
    const std::string text = "{\"a\":[1.5e-3,true,null,\"x\\u00e6\\uD834\\uDD1E\xC3\xA6\"],\"b\":{\"c\":-0}}";
    for (std::size_t length = 0; length < text.size(); ++length) {
        EXPECT_NE(error_of(std::string_view(text).substr(0, length)), "accepted") << length;
    }
    EXPECT_EQ(error_of(text), "accepted");
}

TEST(Json, AMovedDocumentKeepsItsValues) {
    Document first = parse("[\"a string that is long enough not to hide in the object itself\"]", "t");
    const Value& element = first.root().array()[0];
    const Document second = std::move(first);
    EXPECT_EQ(&second.root().array()[0], &element);
    EXPECT_EQ(element.string().size(), 61U);
    EXPECT_EQ(second.file(), "t");
}

TEST(Json, AccessorsOfAnotherKindAreEmpty) {
    const Document document = parse("[1,\"a\",true]", "t");
    const auto elements = document.root().array();
    EXPECT_TRUE(elements[0].string().empty());
    EXPECT_TRUE(elements[1].array().empty());
    EXPECT_EQ(elements[1].number(), 0);
    EXPECT_FALSE(elements[0].boolean());
    EXPECT_TRUE(elements[2].object().empty());
    EXPECT_EQ(elements[2].find("a"), nullptr);
}

TEST(Json, AFileThatCannotBeReadIsASystemErrorThatNamesIt) {
    try {
        parse_file("/nonexistent/lights.json");
        FAIL() << "read";
    } catch (const std::system_error& error) {
        EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory);
        EXPECT_NE(std::string(error.what()).find("/nonexistent/lights.json"), std::string::npos);
    }
    EXPECT_THROW(parse_file("/"), std::system_error);  // a folder
}

}  // namespace
}  // namespace seaglare::json
