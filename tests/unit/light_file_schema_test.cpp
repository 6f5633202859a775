// The schema beside the light files and the reader say the same, or an editor would mark what the product reads, or the
// product refuse what an editor offered.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "lightdb/json/writer.h"
#include "lightdb/light_file.h"
#include "lightdb/light_reader.h"
#include "tests/unit/random_light.h"
#include "tests/unit/schema_check.h"

namespace seaglare::lightdb {
namespace {

const json::Value& schema() {
    static const json::Document document =
        json::parse_file(SEAGLARE_SOURCE_DIR "/config/schema/lights.schema.json");
    return document.root();
}

std::string schema_error(const std::string& text) {
    const json::Document document = json::parse(text, "f.json");
    return json::SchemaCheck(schema()).error(document.root());
}

std::string reader_error(const std::string& text) {
    try {
        parse_light_file(text, "f.json");
    } catch (const json::Error& error) {
        return error.what();
    }
    return {};
}

const json::Value& properties_of(const char* definition) {
    return *schema().find("$defs")->find(definition)->find("properties");
}

TEST(LightFileSchema, NamesTheKeysOfALightThatAreRead) {
    std::set<std::string_view> in_schema;
    for (const auto& [key, rules] : properties_of("light").object())
        in_schema.insert(key);
    const std::set<std::string_view> read(light_keys().begin(), light_keys().end());
    EXPECT_EQ(in_schema, read);
}

// Wherever a key of the schema stands, and whatever is wrong with a null in its place, the reader knows the key.
TEST(LightFileSchema, TheReaderKnowsEveryKeyOfTheOtherObjects) {
    const auto expect_known = [](const json::Value& properties, const std::string& before,
                                 const std::string& after) {
        for (const auto& [key, rules] : properties.object()) {
            const std::string error = reader_error(before + "\"" + std::string(key) + "\": null" + after);
            EXPECT_EQ(error.find("unknown key"), std::string::npos) << error;
            EXPECT_EQ(error.find("stands twice"), std::string::npos) << error;
        }
    };
    const std::string light = R"({"lights": [{"name": "a", "position": [1, 2, 3], "intensity_cd": 5, )";
    expect_known(*schema().find("properties"), "{", "}");
    expect_known(properties_of("vessel"), R"({"vessels": [{)", "}]}");
    expect_known(properties_of("buoy"), R"({"buoys": [{)", "}]}");
    const json::Value& of_light = properties_of("light");
    expect_known(*of_light.find("sectors")->find("items")->find("properties"), light + R"("sectors": [{)",
                 "}]}]}");
    expect_known(*of_light.find("rotation")->find("properties"), light + R"("rotation": {)", "}}]}");
    expect_known(properties_of("horizontal_table"), light + R"("horizontal_profile": {)", "}}]}");
    for (const json::Value& form : of_light.find("phases")->find("items")->find("oneOf")->array())
        expect_known(*form.find("properties"), light + R"("phases": [{)", "}]}]}");
}

TEST(LightFileSchema, WhatIsSavedIsValid) {
    RandomLights random(7);
    for (int i = 0; i < 500; ++i) {
        LightFile file;
        file.origin = GeographicPoint{1, 2, 3};
        file.source = "s";
        file.lights.push_back(random.next());
        const std::string text = format_light_file(file);
        ASSERT_EQ(schema_error(text), "") << text;
    }
}

TEST(LightFileSchema, TheShippedLightFilesAreValid) {
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(SEAGLARE_SOURCE_DIR "/config/lights")) {
        if (entry.path().extension() != ".json") continue;
        const json::Document document = json::parse_file(entry.path().string());
        EXPECT_EQ(json::SchemaCheck(schema()).error(document.root()), "");
        ++files;
    }
    EXPECT_GE(files, 2);
}

// Each limit of the schema is the reader's, too: both take the limit, and both refuse what lies beyond.
TEST(LightFileSchema, LimitsAreTheReaders) {
    int limits = 0;
    for (const auto& [key, given] : properties_of("light").object()) {
        const json::Value* const reference = given.find("$ref");
        const json::Value& rules =
            reference == nullptr
                ? given
                : *schema().find("$defs")->find(reference->string().substr(sizeof "#/$defs/" - 1));
        for (const char* limit : {"minimum", "maximum"}) {
            const json::Value* const rule = rules.find(limit);
            if (rule == nullptr) continue;
            ++limits;
            const double sign = limit == std::string_view("minimum") ? -1 : 1;
            const double beyond = rule->number() + sign * std::max(1.0, std::abs(rule->number()) * 0.01);
            const auto text = [&, name = std::string(key)](double number) {
                json::Writer shown;
                shown.value(number);
                const std::string place = name == "lat"        ? R"("lon": 2, "height_m": 3)"
                                          : name == "lon"      ? R"("lat": 2, "height_m": 3)"
                                          : name == "height_m" ? R"("lat": 2, "lon": 3)"
                                                               : R"("position": [1, 2, 3])";
                return R"({"lights": [{"name": "a", "intensity_cd": 5, )" + place + ", \"" + name +
                       "\": " + shown.take() + "}]}";
            };
            EXPECT_EQ(reader_error(text(rule->number())), "") << key << " " << limit;
            EXPECT_EQ(schema_error(text(rule->number())), "") << key << " " << limit;
            EXPECT_NE(reader_error(text(beyond)), "") << key << " " << limit;
            EXPECT_NE(schema_error(text(beyond)), "") << key << " " << limit;
        }
    }
    EXPECT_GE(limits, 18);
}

TEST(LightFileSchema, BothTakeTheSameForms) {
    const std::string p = R"("name": "a", "position": [1, 2, 3])";
    const std::string bright = p + R"(, "intensity_cd": 5)";
    for (
        const std::string& members : std::vector<std::string>{
            p + R"(, "nominal_range_nm": {"W": 12, "red": 3})",
            R"("name": "a", "position": [1, 2], "height_m": 4, "intensity_cd": 5)",
            bright + R"(, "day_range_nm": 2)",
            bright + R"(, "day_intensity_cd": {"W": 900})",
            bright + R"x(, "sigseq": "00.8+(02.2)")x",
            bright + R"(, "phases": [{"lit": 1, "colour": "W", "level": 0.5}, {"eclipse": 2}])",
            bright +
                R"(, "sectors": [{"colour": "W", "from": 1, "to": 2, "from_elevation": -5, "to_elevation": 5}])",
            bright + R"(, "rotation": {"period_s": 20, "beams": 2, "width_deg": 1})",
            bright + R"(, "rotation": {"period_s": 20, "direction": "anticlockwise",
                        "beam": {"angle_deg": [-1, 0, 1], "factor": [0, 1, 0]}})",
            bright + R"(, "horizontal_profile": {"angle_deg": [0, 90], "factor": [1, 0.5]})",
            bright + R"(, "vertical_profile": "colreg_sail", "phase_key": "0123456789abcdef")",
            bright +
                R"(, "rise_s": 0.3, "fall_s": 0.2, "delay_s": -1, "sync_group": "g", "leading_bearing_deg": 9)",
        }) {
        const std::string text = "{\"lights\": [{" + members + "}]}";
        EXPECT_EQ(reader_error(text), "") << text;
        EXPECT_EQ(schema_error(text), "") << text;
    }
    for (const std::string& members : std::vector<std::string>{
             p + R"(, "intensity_cd": 5, "nominal_range_nm": 5)",
             bright + R"(, "day_range_nm": 2, "day_intensity_cd": 3)",
             bright + R"x(, "sigseq": "00.8+(02.2)", "phases": [])x",
             bright + R"(, "lat": 1, "lon": 2)",
             bright + R"(, "rotation": {"period_s": 20, "beams": 2})",
             bright + R"(, "rotation": {"period_s": 20})",
             bright + R"(, "rotation": {"period_s": 0, "beams": 2, "width_deg": 1})",
             bright + R"(, "sectors": [{"colour": "W", "from": 1, "to": 2, "from_elevation": -91}])",
             bright + R"(, "vertical_profile": "sabik")",
             bright + R"(, "phase_key": "x123456789abcdef")",
             bright + R"(, "day": "dim")",
             bright + R"(, "photometry": 3)",
         }) {
        const std::string text = "{\"lights\": [{" + members + "}]}";
        EXPECT_NE(reader_error(text), "") << text;
        EXPECT_NE(schema_error(text), "") << text;
    }
}

}  // namespace
}  // namespace seaglare::lightdb
