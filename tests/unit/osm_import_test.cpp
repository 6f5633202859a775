// OpenSeaMap's tags as the OpenStreetMap wiki describes them (Seamarks/Lights), one trap each.
#include "lightdb/import/osm.h"

#include <gtest/gtest.h>

#include "lightdb/character.h"
#include "lightdb/import/charted_light.h"
#include "lightdb/light_file.h"
#include "lightdb/photometry.h"

namespace seaglare::lightdb::osm {
namespace {

Import import_text(const std::string& text) {
    const json::Document document = json::parse(text, "osm.json");
    return import_elements(document.root(), "osm.json");
}

// "character=Fl colour=white" becomes the seamark:light tags of a node at 54 N 11 E.
Import import_tags(const std::vector<std::pair<std::string, std::string>>& tags,
                   const std::string& more = "") {
    std::string text =
        "{\"elements\": [{\"type\": \"node\", \"id\": 123, \"lat\": 54, \"lon\": 11, \"tags\": "
        "{\"seamark:type\": \"light_minor\"" +
        more;
    for (const auto& [key, value] : tags)
        text += ", \"seamark:light:" + key + "\": \"" + value + "\"";
    return import_text(text + "}}]}");
}

TEST(OsmImport, ASimpleLightKeepsItsCharacterDurationsRangeAndHeight) {
    const Import import = import_tags({{"character", "Fl"},
                                       {"group", "2"},
                                       {"colour", "red"},
                                       {"period", "6"},
                                       {"sequence", "00.5+(01.0)+00.5+(04.0)"},
                                       {"height", "14"},
                                       {"range", "12"}},
                                      ", \"seamark:name\": \"Mole\"");
    ASSERT_EQ(import.lights.size(), 1U);
    const ImportedLight& light = import.lights[0];
    EXPECT_EQ(light.name, "Mole");
    EXPECT_EQ(light.character, "Fl(2) R 6s fl. 0.5s, ec. 1s, fl. 0.5s, ec. 4s");
    EXPECT_DOUBLE_EQ(light.height_m, 14);
    EXPECT_DOUBLE_EQ(light.nominal_range_nm.at(0).second, 12);
    EXPECT_EQ(light.source, "OpenStreetMap node 123 (ODbL)");
    EXPECT_TRUE(import.records.at(0).doubts.empty());
}

TEST(OsmImport, NumberedLightsOfOneCharacterAreSectorsOfOneLight) {
    const Import import = import_tags({{"1:character", "Oc"},
                                       {"1:colour", "red"},
                                       {"1:period", "5"},
                                       {"1:sector_start", "350"},
                                       {"1:sector_end", "10"},
                                       {"1:range", "9"},
                                       {"2:character", "Oc"},
                                       {"2:colour", "white"},
                                       {"2:period", "5"},
                                       {"2:sector_start", "10"},
                                       {"2:sector_end", "20.5"},
                                       {"2:range", "12"}});
    ASSERT_EQ(import.lights.size(), 1U);
    const ImportedLight& light = import.lights[0];
    EXPECT_EQ(light.character, "Oc RW 5s");
    ASSERT_EQ(light.sectors.size(), 2U);
    EXPECT_EQ(light.sectors[0].colour, Colour::red);
    EXPECT_DOUBLE_EQ(light.sectors[0].from_deg, 350);
    EXPECT_DOUBLE_EQ(light.sectors[0].to_deg, 10);
    EXPECT_DOUBLE_EQ(light.sectors[1].to_deg, 20.5);
}

TEST(OsmImport, NumberedLightsOfDifferentCharactersAreLightsOfTheirOwn) {
    const Import import = import_tags({{"1:character", "Fl"},
                                       {"1:colour", "white"},
                                       {"1:period", "10"},
                                       {"2:character", "F"},
                                       {"2:colour", "red"},
                                       {"2:sector_start", "10"},
                                       {"2:sector_end", "20"}});
    ASSERT_EQ(import.lights.size(), 2U);
    EXPECT_EQ(import.lights[0].character, "Fl W 10s");
    EXPECT_EQ(import.lights[1].character, "F R");
    EXPECT_NE(import.lights[0].name, import.lights[1].name);
}

// One colour shown at two ranges: the weaker sector has the intensity of its own range.
TEST(OsmImport, ASectorOfShorterRangeIsWeakerByAllardsLaw) {
    const Import import = import_tags({{"1:character", "F"},
                                       {"1:colour", "white"},
                                       {"1:sector_start", "0"},
                                       {"1:sector_end", "90"},
                                       {"1:range", "10"},
                                       {"2:character", "F"},
                                       {"2:colour", "white"},
                                       {"2:sector_start", "90"},
                                       {"2:sector_end", "180"},
                                       {"2:range", "5"}});
    ASSERT_EQ(import.lights.size(), 1U);
    EXPECT_NEAR(import.lights[0].sectors.at(1).intensity_factor,
                intensity_for_range_cd(5) / intensity_for_range_cd(10), 5e-4);
}

TEST(OsmImport, CompositeGroupsMorseAndSumsAreRead) {
    const auto character = [](const std::string& light_class, const std::string& group) {
        const Import import = import_tags(
            {{"character", light_class}, {"group", group}, {"colour", "white"}, {"period", "15"}});
        return import.lights.size() == 1 ? import.lights[0].character : "not one light";
    };
    EXPECT_EQ(character("Fl", "2+1"), "Fl(2+1) W 15s");
    EXPECT_EQ(character("Mo", "A"), "Mo(A) W 15s");
    EXPECT_EQ(character("Q+LFl", "6"), "Q(6)+LFl W 15s");
    EXPECT_EQ(character("VQ+LFl", "(6)(1)"), "VQ(6)+LFl W 15s");
    EXPECT_EQ(character("Q", "1"), "Q W 15s");
    EXPECT_EQ(import_tags({{"character", "Al.Fl"}, {"colour", "white;red"}, {"period", "10"}})
                  .lights.at(0)
                  .character,
              "Al Fl WR 10s");
}

TEST(OsmImport, LeadingLightsKeepTheBearingOfTheirLine) {
    const Import leading = import_tags(
        {{"character", "Oc"}, {"period", "4"}, {"category", "leading;front"}, {"orientation", "269.5"}});
    ASSERT_EQ(leading.lights.size(), 1U);
    EXPECT_DOUBLE_EQ(leading.lights[0].leading_bearing_deg.value(), 269.5);
    EXPECT_TRUE(leading.lights[0].sectors.empty());
    const LightFile file = parse_light_file(light_file_text(leading), "out.json");
    EXPECT_DOUBLE_EQ(file.lights[0].leading_bearing_deg.value(), 269.5);
    EXPECT_FALSE(import_tags({{"character", "F"}, {"orientation", "90"}}).lights[0].leading_bearing_deg);
}

TEST(OsmImport, AGroupOfASumMayCountBothClasses) {
    EXPECT_EQ(class_with_group("VQ+LFl", "6+1"), "VQ(6)+LFl");
    EXPECT_EQ(class_with_group("Fl+LFl", "3+2"), "Fl(3)+LFl(2)");
    EXPECT_EQ(class_with_group("Q+LFl", "(6)(1)"), "Q(6)+LFl");
    EXPECT_EQ(class_with_group("Fl", "2+1"), "Fl(2+1)");
}

TEST(OsmImport, WaysStandAtTheirCentreGeometryOrNodes) {
    const std::string tags =
        "\"tags\": {\"seamark:light:character\": \"F\", \"seamark:light:colour\": \"green\"}";
    const Import import = import_text(
        "{\"elements\": [{\"type\": \"way\", \"id\": 1, \"center\": {\"lat\": 54.5, \"lon\": 11}, " + tags +
        "}, {\"type\": \"way\", \"id\": 2, \"geometry\": [{\"lat\": 54, \"lon\": 11}, {\"lat\": 55, \"lon\": "
        "11}], " +
        tags + "}, {\"type\": \"way\", \"id\": 3, \"nodes\": [7, 8], " + tags +
        "}, {\"type\": \"node\", \"id\": 7, \"lat\": 54.4, \"lon\": 11}, {\"type\": \"node\", \"id\": 8, "
        "\"lat\": "
        "54.6, \"lon\": 11}, {\"type\": \"way\", \"id\": 4, " +
        tags + "}]}");
    ASSERT_EQ(import.lights.size(), 3U);
    for (const ImportedLight& light : import.lights)
        EXPECT_NEAR(light.latitude_deg, 54.5, 1e-9);
    EXPECT_FALSE(import.records.at(3).imported);
    EXPECT_EQ(import.records[3].reason, "no position");
}

TEST(OsmImport, UnitsAreReadAndWhatIsNotUnderstoodIsReportedWithTheElement) {
    const Import import = import_tags({{"character", "Fl"},
                                       {"colour", "white;pink"},
                                       {"period", "4 s"},
                                       {"height", "10 ft"},
                                       {"range", "far"},
                                       {"sector_start", "shore"},
                                       {"bulb", "LED"}});
    ASSERT_EQ(import.lights.size(), 1U);
    EXPECT_NEAR(import.lights[0].height_m, 3.048, 1e-9);
    EXPECT_EQ(import.records.at(0).id, "node 123");
    std::string all;
    for (const std::string& doubt : import.records[0].doubts)
        all += doubt + "\n";
    for (const char* part : {"pink", "'far'", "'shore'", "'bulb'"})
        EXPECT_NE(all.find(part), std::string::npos) << part << " in " << all;
}

TEST(OsmImport, EveryElementWithALightIsImportedOrHasAReason) {
    const Import import = import_text(
        "{\"elements\": [{\"type\": \"node\", \"id\": 1, \"lat\": 54, \"lon\": 11, \"tags\": "
        "{\"seamark:type\": "
        "\"light_major\"}}, 7, null, {\"tags\": 5}, {\"type\": \"node\", \"id\": 1e300, \"tags\": "
        "{\"seamark:light:colour\": \"red\"}}, {\"type\": \"node\", \"id\": 3, \"lat\": 54, \"lon\": 11, "
        "\"tags\": "
        "{\"seamark:light:character\": \"Wobble\", \"seamark:light:colour\": \"red\"}}, {\"type\": \"node\", "
        "\"id\": "
        "4, \"lat\": 54, \"lon\": 11, \"tags\": {\"seamark:light:character\": \"F\", "
        "\"seamark:light:status\": "
        "\"not_in_use\"}}]}");
    EXPECT_TRUE(import.lights.empty());
    ASSERT_EQ(import.records.size(), 4U);
    for (const ElementReport& record : import.records)
        EXPECT_FALSE(record.reason.empty()) << record.id;
    EXPECT_THROW(import_text("{\"features\": []}"), json::Error);
}

// Found by fuzzing: there was no intensity for the yellow, and the light file did not load.
TEST(OsmImport, ACharacterThatNamesAnotherColourIsRefused) {
    const Import import = import_tags({{"character", "Fl Y"}, {"colour", "white"}, {"period", "5"}});
    EXPECT_TRUE(import.lights.empty());
    ASSERT_EQ(import.records.size(), 1U);
    EXPECT_NE(import.records[0].reason.find("a colour besides W"), std::string::npos)
        << import.records[0].reason;
    EXPECT_EQ(import_tags({{"character", "Fl W"}, {"colour", "white"}, {"period", "5"}}).lights.size(), 1U);
}

TEST(OsmImport, TheLightFileLoads) {
    const Import import = import_tags({{"character", "Oc+Fl"},
                                       {"colour", "white"},
                                       {"period", "10"},
                                       {"sequence", "(01.0)+04.0+(01.0)+04.0"},
                                       {"multiple", "2"},
                                       {"category", "vertical"}});
    const LightFile file = parse_light_file(light_file_text(import), "out.json");
    ASSERT_EQ(file.lights.size(), 2U) << "two lamps above each other";
    EXPECT_DOUBLE_EQ(file.lights[0].height_m - file.lights[1].height_m, 1);
    EXPECT_DOUBLE_EQ(file.lights[0].rhythm.period_s, 10);
}

}  // namespace
}  // namespace seaglare::lightdb::osm
