// Reading configuration: ranges, kinds, unknown and repeated keys, always with the place.
#include "lightdb/json/reader.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace seaglare::json {
namespace {

std::string error_of(std::string_view text, const std::function<void(ObjectReader&)>& read) {
    try {
        const Document document = parse(text, "f.json");
        ObjectReader reader(document.root(), "thing");
        read(reader);
        reader.finish();
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

enum class Tone { photographic, linear };
constexpr Choice<Tone> tones[] = {{"photographic", Tone::photographic}, {"linear", Tone::linear}};

TEST(JsonReader, ReadsWhatIsThereAndDefaultsWhatIsNot) {
    const Document document = parse(
        R"({"$schema": "s.json", "n": 2.5, "i": -3, "b": true, "s": "x", "p": [1, 2, 3], "l": [4], "t": "linear",
            "o": {"m": 1}, "a": [true]})",
        "t");
    ObjectReader reader(document.root(), "thing");
    EXPECT_EQ(reader.number("n", 0, 3), 2.5);
    EXPECT_EQ(reader.number("absent", 0, 1, 0.25), 0.25);
    EXPECT_EQ(reader.optional_number("absent", 0, 1), std::nullopt);
    EXPECT_EQ(reader.integer("i", -5, 5), -3);
    EXPECT_EQ(reader.integer("absent", 0, 9, 7), 7);
    EXPECT_TRUE(reader.boolean("b"));
    EXPECT_TRUE(reader.boolean("absent", true));
    EXPECT_EQ(reader.string("s"), "x");
    EXPECT_EQ(reader.string("absent", "d"), "d");
    EXPECT_EQ(reader.optional_string("absent"), std::nullopt);
    EXPECT_EQ((reader.numbers<3>("p", 0, 9)), (std::array<double, 3>{1, 2, 3}));
    EXPECT_EQ((reader.numbers<2>("absent", 0, 9, {5, 6})), (std::array<double, 2>{5, 6}));
    EXPECT_EQ(reader.number_list("l", 0, 9), std::vector<double>{4});
    EXPECT_EQ(reader.choice("t", tones), Tone::linear);
    EXPECT_EQ(reader.choice("absent", tones, Tone::photographic), Tone::photographic);
    EXPECT_EQ(reader.array("a").size(), 1U);
    EXPECT_TRUE(reader.optional_array("absent").empty());
    auto child = reader.optional_object("o");
    ASSERT_TRUE(child.has_value());
    EXPECT_EQ(child->number("m", 0, 1), 1);
    child->finish();
    EXPECT_FALSE(reader.optional_object("absent").has_value());
    EXPECT_NO_THROW(reader.finish());
}

TEST(JsonReader, AnUnknownKeyIsNamedWithTheNearestKnownOne) {
    const auto read = [](ObjectReader& reader) { reader.optional_number("nominal_range_nm", 0, 40); };
    EXPECT_EQ(error_of("{\n  \"nominal_rang_nm\": 3}", read),
              "f.json:2:3: unknown key 'nominal_rang_nm' in thing, did you mean 'nominal_range_nm'?");
    EXPECT_EQ(error_of("{\"weather\": 3}", read), "f.json:1:2: unknown key 'weather' in thing");
}

TEST(JsonReader, AMistypedKeyIsNamedBeforeItIsMissed) {
    const auto read = [](ObjectReader& reader) {
        static constexpr std::string_view keys[] = {"height_m"};
        reader.only(keys);
        reader.number("height_m", 0, 9);
    };
    EXPECT_EQ(error_of("{\"heigth_m\": 3}", read),
              "f.json:1:2: unknown key 'heigth_m' in thing, did you mean 'height_m'?");
    EXPECT_EQ(error_of("{\"$schema\": \"x\"}", read), "f.json:1:1: thing needs 'height_m'");
}

TEST(JsonReader, ARepeatedKeyIsAnErrorWhereItStandsAgain) {
    EXPECT_EQ(error_of("{\"a\": 1,\n \"\\u0061\": 2}", [](ObjectReader& r) { r.has("a"); }),
              "f.json:2:2: key 'a' stands twice in thing, first in line 1, column 2");
}

TEST(JsonReader, RangesHoldTheirLimits) {
    const auto read = [](ObjectReader& reader) { reader.number("x", 0, 2); };
    EXPECT_EQ(error_of("{\"x\": 0}", read), "accepted");
    EXPECT_EQ(error_of("{\"x\": 2}", read), "accepted");
    EXPECT_EQ(error_of("{\"x\": 2.5}", read), "f.json:1:7: 'x' must be from 0 to 2, not 2.5");
    EXPECT_EQ(error_of("{\"x\": -1e-9}", read), "f.json:1:7: 'x' must be from 0 to 2, not -1e-09");
    EXPECT_EQ(error_of("{}", read), "f.json:1:1: thing needs 'x'");
    EXPECT_EQ(error_of("{\"x\": \"1\"}", read), "f.json:1:7: 'x' must be a number, not a string");
    EXPECT_EQ(error_of("{\"x\": null}", read), "f.json:1:7: 'x' must be a number, not null");
}

TEST(JsonReader, KindsAreChecked) {
    EXPECT_EQ(error_of("[]", [](ObjectReader&) {}), "f.json:1:1: thing must be an object, not an array");
    EXPECT_NE(error_of("{\"x\":1.5}", [](ObjectReader& r) { r.integer("x", 0, 9); }).find("whole"),
              std::string::npos);
    EXPECT_NE(error_of("{\"x\":1}", [](ObjectReader& r) { r.boolean("x"); }).find("true or false"),
              std::string::npos);
    EXPECT_NE(error_of("{\"x\":1}", [](ObjectReader& r) { r.string("x"); }).find("a string"),
              std::string::npos);
    EXPECT_NE(error_of("{\"x\":1}", [](ObjectReader& r) { r.array("x"); }).find("an array"),
              std::string::npos);
    EXPECT_EQ(error_of("{\"x\":[]}", [](ObjectReader& r) { r.object("x"); }),
              "f.json:1:6: 'x' must be an object, not an array");
    EXPECT_EQ(error_of("{\"x\":[1,2]}", [](ObjectReader& r) { r.numbers<3>("x", 0, 9); }),
              "f.json:1:6: 'x' must have 3 numbers, not 2");
    EXPECT_EQ(error_of("{\"x\":[1,20,3]}", [](ObjectReader& r) { r.numbers<3>("x", 0, 9); }),
              "f.json:1:9: 'x[1]' must be from 0 to 9, not 20");
    EXPECT_EQ(error_of("{\"x\":\"log\"}", [](ObjectReader& r) { r.choice("x", tones); }),
              "f.json:1:6: 'x' must be one of 'photographic', 'linear', not 'log'");
}

TEST(JsonReader, NearestNameKnowsTyposFromOtherWords) {
    const std::string_view names[] = {"height_m", "radius_m", "sectors", "body"};
    EXPECT_EQ(nearest_name("heigth_m", names), "height_m");  // swapped neighbours are one mistake
    EXPECT_EQ(nearest_name("sector", names), "sectors");
    EXPECT_EQ(nearest_name("bdy", names), "body");
    EXPECT_EQ(nearest_name("colour", names), "");
    EXPECT_EQ(nearest_name(std::string(1000, 'x'), names), "");
    EXPECT_EQ(nearest_name("", names), "");
}

}  // namespace
}  // namespace seaglare::json
