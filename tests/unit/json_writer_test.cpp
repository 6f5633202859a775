// Writing JSON: what is written reads back as the same, and looks the same every time.
#include "lightdb/json/writer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>

namespace seaglare::json {
namespace {

std::string rewritten(const std::string& text) {
    const Document document = parse(text, "t");
    Writer writer;
    writer.value(document.root());
    return writer.take();
}

TEST(JsonWriter, LaysOutBlocksAndLines) {
    Writer writer;
    writer.begin_object();
    writer.member("name", "a\"b\\\n\x01\x7F\xC3\xA6");
    writer.key("position");
    writer.begin_array(Writer::Layout::line);
    writer.value(1.0);
    writer.value(-0.1);
    writer.begin_object();
    writer.member("on", true);
    writer.end_object();
    writer.end_array();
    writer.key("empty");
    writer.begin_array();
    writer.end_array();
    writer.key("none");
    writer.null();
    writer.end_object();
    EXPECT_EQ(
        writer.take(),
        "{\n  \"name\": \"a\\\"b\\\\\\n\\u0001\x7F\xC3\xA6\",\n  \"position\": [1, -0.1, {\"on\": true}],\n"
        "  \"empty\": [],\n  \"none\": null\n}\n");
}

TEST(JsonWriter, RewritingIsStable) {
    const std::string once = rewritten(R"([{"a":[1,2.50,{"b":null}],"c":"\u00e6\u0000"},true,-0,1e300])");
    EXPECT_EQ(rewritten(once), once);
}

TEST(JsonWriter, EveryDoubleReadsBackAsItself) {
    std::mt19937_64 random(3);
    for (int i = 0; i < 100000; ++i) {
        const std::uint64_t bits = random();
        double number = 0;
        std::memcpy(&number, &bits, sizeof number);
        if (!std::isfinite(number)) continue;
        Writer writer;
        writer.value(number);
        const Document document = parse(writer.take(), "t");
        ASSERT_EQ(document.root().number(), number);
    }
}

TEST(JsonWriter, WhatJsonCannotSayBecomesNullOrTheReplacementCharacter) {
    Writer writer;
    writer.begin_array(Writer::Layout::line);
    writer.value(std::numeric_limits<double>::quiet_NaN());
    writer.value(-std::numeric_limits<double>::infinity());
    writer.value(std::string_view("a\xFF\xC3"));
    writer.end_array();
    EXPECT_EQ(writer.take(), "[null, null, \"a\xEF\xBF\xBD\xEF\xBF\xBD\"]\n");
}

}  // namespace
}  // namespace seaglare::json
