// LIGHTS objects by the S-57 object catalogue (IHO S-57 3.1 Appendix A chapter 2), and cells where the build reads them.
#include "lightdb/import/s57.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "lightdb/character.h"
#include "lightdb/light_file.h"

namespace seaglare::lightdb::s57 {
namespace {

Feature feature(const std::string& id, Attributes attributes, double latitude_deg = 55) {
    Feature result;
    result.id = "LIGHTS FIDN " + id;
    result.latitude_deg = latitude_deg;
    result.longitude_deg = 11;
    result.attributes = std::move(attributes);
    return result;
}
std::string character_of(const Attributes& attributes) {
    const Import import = import_features({feature("1", attributes)}, "cell");
    return import.lights.size() == 1 ? import.lights[0].character : "not one light";
}

TEST(S57Import, ObjectsAtOnePointBecomeSectorsOfOneLight) {
    const Attributes common = {{"LITCHR", "8"}, {"SIGPER", "5"}, {"SIGSEQ", "(01.0)+04.0"}, {"HEIGHT", "27"}};
    const auto with = [&](Attributes more) {
        more.insert(common.begin(), common.end());
        return more;
    };
    const Import import = import_features(
        {feature("1", with({{"COLOUR", "3"}, {"SECTR1", "355"}, {"SECTR2", "10"}, {"VALNMR", "10"}})),
         feature("2", with({{"COLOUR", "1"}, {"SECTR1", "10"}, {"SECTR2", "20"}, {"VALNMR", "12"}})),
         feature("3", with({{"COLOUR", "4"}, {"SECTR1", "20"}, {"SECTR2", "30"}, {"VALNMR", "9"}}))},
        "cell");
    ASSERT_EQ(import.lights.size(), 1U);
    const ImportedLight& light = import.lights[0];
    EXPECT_EQ(light.character, "Oc RWG 5s ec. 1s, fl. 4s") << "occulting: SIGSEQ begins with the eclipse";
    ASSERT_EQ(light.sectors.size(), 3U);
    EXPECT_DOUBLE_EQ(light.sectors[0].from_deg, 355);
    EXPECT_DOUBLE_EQ(light.height_m, 27);
    EXPECT_EQ(light.nominal_range_nm.size(), 3U);
    for (const FeatureReport& record : import.records)
        EXPECT_TRUE(record.imported && record.doubts.empty());
    EXPECT_EQ(parse_light_file(light_file_text(import, "cell"), "out.json").lights.size(), 1U);
}

TEST(S57Import, EveryCharacterOfTheCatalogueIsRead) {
    EXPECT_EQ(character_of({{"LITCHR", "2"}, {"SIGGRP", "(2+1)"}, {"COLOUR", "1"}, {"SIGPER", "10"}}),
              "Fl(2+1) W 10s");
    EXPECT_EQ(character_of({{"LITCHR", "12"}, {"SIGGRP", "(A)"}, {"COLOUR", "1"}, {"SIGPER", "8"}}),
              "Mo(A) W 8s");
    EXPECT_EQ(character_of({{"LITCHR", "13"}, {"SIGGRP", "()(1)"}, {"COLOUR", "1"}, {"SIGPER", "10"}}),
              "FFl W 10s");
    EXPECT_EQ(character_of({{"LITCHR", "25"}, {"SIGGRP", "(6)(1)"}, {"COLOUR", "1"}, {"SIGPER", "15"}}),
              "Q(6)+LFl W 15s");
    EXPECT_EQ(character_of({{"LITCHR", "28"}, {"COLOUR", "1,3"}, {"SIGPER", "4"}}), "Al WR 4s");
    std::set<std::string> seen;
    for (int code = 1; code <= 29; ++code) {
        if (code >= 21 && code <= 24) continue;  // withdrawn
        const Import import = import_features({feature("1", {{"LITCHR", std::to_string(code)},
                                                             {"COLOUR", "1,3"},
                                                             {"SIGPER", "12"},
                                                             {"SIGGRP", code == 12 ? "(A)" : "(2)"},
                                                             {"SIGSEQ", "01.0+(05.0)+01.0+(05.0)"}})},
                                              "cell");
        EXPECT_EQ(import.lights.size(), 1U) << code;
    }
}

// Attribute 75: 2 is black and no light, 3 is red.
TEST(S57Import, ColoursFollowTheCatalogue) {
    EXPECT_EQ(character_of({{"LITCHR", "1"}, {"COLOUR", "3"}}), "F R");
    EXPECT_EQ(character_of({{"LITCHR", "1"}, {"COLOUR", "4"}}), "F G");
    EXPECT_EQ(character_of({{"LITCHR", "1"}, {"COLOUR", "5"}}), "F Bu");
    EXPECT_EQ(character_of({{"LITCHR", "1"}, {"COLOUR", "6"}}), "F Y");
    EXPECT_EQ(character_of({{"LITCHR", "1"}, {"COLOUR", "11"}}), "F Or");
    std::vector<std::string> doubts;
    read_light({{"COLOUR", "2"}}, doubts);
    EXPECT_EQ(doubts.size(), 1U);
}

TEST(S57Import, LightsAboveEachOtherAndDirectionLights) {
    const Import lamps = import_features(
        {feature("1",
                 {{"LITCHR", "1"}, {"COLOUR", "3"}, {"MLTYLT", "2"}, {"CATLIT", "20"}, {"HEIGHT", "8"}})},
        "cell");
    ASSERT_EQ(lamps.lights.size(), 2U);
    EXPECT_DOUBLE_EQ(lamps.lights[1].height_m, 7);
    const Import direction = import_features(
        {feature("1",
                 {{"LITCHR", "7"}, {"COLOUR", "1"}, {"SIGPER", "2"}, {"CATLIT", "1"}, {"ORIENT", "178.5"}})},
        "cell");
    ASSERT_EQ(direction.lights.at(0).sectors.size(), 1U);
    EXPECT_DOUBLE_EQ(direction.lights[0].sectors[0].from_deg, 175.5);
    EXPECT_EQ(direction.lights[0].character, "Dir Iso W 2s");
}

TEST(S57Import, EveryObjectIsImportedOrHasItsReason) {
    const Import import =
        import_features({feature("1", {{"LITCHR", "1"}, {"COLOUR", "1"}, {"STATUS", "11"}}),
                         feature("2", {{"LITCHR", "2"}, {"COLOUR", "1"}, {"EXCLIT", "2"}}),
                         feature("3", {{"LITCHR", "1"}, {"COLOUR", "1"}}, 1000),
                         feature("4", {{"LITCHR", "22"}, {"SIGPER", "x"}, {"COLOUR", "1"}}, 56)},
                        "cell");
    EXPECT_EQ(import.records.at(0).reason, "extinguished");
    EXPECT_EQ(import.records.at(1).reason, "it is shown by day only");
    EXPECT_EQ(import.records.at(2).reason, "no position");
    EXPECT_TRUE(import.records.at(3).imported);
    EXPECT_EQ(import.records[3].doubts.size(), 2U);
}

TEST(S57Import, ABuildWithoutGdalSaysHowToGetIt) {
    if (can_read_cells()) GTEST_SKIP() << "this build reads cells";
    try {
        read_cell("x.000");
        FAIL() << "nothing can have been read";
    } catch (const CellError& error) {
        EXPECT_NE(std::string(error.what()).find("SEAGLARE_S57"), std::string::npos);
    }
}

// An ISO 8211 file: tests/data/s57/README.md says what is in it.
TEST(S57Import, ACellIsRead) {
    if (!can_read_cells()) GTEST_SKIP() << "built without SEAGLARE_S57";
    const Cell cell = read_cell(SEAGLARE_SOURCE_DIR "/tests/data/s57/two_sectors.000");
    EXPECT_EQ(cell.name, "S-57 cell two_sectors");
    ASSERT_EQ(cell.features.size(), 2U);
    const Import import = import_features(cell.features, cell.name);
    ASSERT_EQ(import.lights.size(), 1U);
    const ImportedLight& light = import.lights[0];
    EXPECT_EQ(light.character, "Oc RW 5s ec. 1s, fl. 4s");
    EXPECT_NEAR(light.latitude_deg, 55.5, 1e-7);
    EXPECT_NEAR(light.longitude_deg, 11.25, 1e-7);
    ASSERT_EQ(light.sectors.size(), 2U);
    EXPECT_EQ(light.sectors[0].colour, Colour::red);
    EXPECT_DOUBLE_EQ(light.sectors[0].from_deg, 350);
    EXPECT_DOUBLE_EQ(light.sectors[1].to_deg, 20.5);
}

// A layer as GDAL gives it from a cell, from another of its formats.
TEST(S57Import, GdalsFeaturesAreRead) {
    if (!can_read_cells()) GTEST_SKIP() << "built without SEAGLARE_S57";
    const auto path = std::filesystem::temp_directory_path() / "seaglare_s57_lights.geojson";
    std::ofstream(path) << R"json({"type": "FeatureCollection", "name": "LIGHTS", "features": [
        {"type": "Feature", "properties": {"FIDN": 77, "LITCHR": 2, "COLOUR": ["3"], "SIGGRP": "(2)", "SIGPER": 6.0,
         "VALNMR": 5.0}, "geometry": {"type": "Point", "coordinates": [11.25, 55.5]}},
        {"type": "Feature", "properties": {"FIDN": 78, "LITCHR": 1, "COLOUR": ["1"]}, "geometry": null}]})json";
    const Cell cell = read_cell(path.string());
    std::filesystem::remove(path);
    const Import import = import_features(cell.features, cell.name);
    ASSERT_EQ(import.lights.size(), 1U);
    EXPECT_EQ(import.lights[0].character, "Fl(2) R 6s");
    EXPECT_DOUBLE_EQ(import.lights[0].latitude_deg, 55.5);
    EXPECT_EQ(import.records.at(0).id, "LIGHTS FIDN 77");
    EXPECT_EQ(import.records.at(1).reason, "no position");
    EXPECT_THROW(read_cell("/nowhere/at/all.000"), CellError);
}

}  // namespace
}  // namespace seaglare::lightdb::s57
