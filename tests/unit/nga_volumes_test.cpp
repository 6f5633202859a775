// Records in the shape of the List's other volumes: southern and western positions, other kinds of aid, other prose.
#include <gtest/gtest.h>

#include <array>

#include "lightdb/import/nga.h"
#include "lightdb/import/nga_text.h"
#include "lightdb/light_file.h"

namespace seaglare::lightdb::nga {
namespace {

constexpr const char* start = R"([{"volumeNumber": "PUB 111", "aidType": "Lighted Aids", "featureNumber": )";

Import import_text(const std::string& text) {
    const json::Document document = json::parse(text, "pub.json");
    return import_list(document.root(), "pub.json");
}

TEST(NgaVolumes, ABareListFromTheSouthWithNumbersForTexts) {
    const Import import =
        import_text(std::string(start) + R"(2472, "name": "Segunda Angostura.", "unknown": {"a": []},
        "position": "52°44'06\"S \n70°10'54\"W", "charNo": "1", "characteristic": "Fl.W.\nperiod 10s \nfl. 0.7s, ec. 9.3s \n",
        "heightFeetMeters": "66\n20", "range": 9, "remarks": "Visible 086°-278°.\n", "noticeYear": 2015,
        "noticeWeek": 7, "removeFromList": "N"}])");
    ASSERT_EQ(import.lights.size(), 1U);
    const ImportedLight& light = import.lights[0];
    EXPECT_NEAR(light.latitude_deg, -52.735, 1e-6);
    EXPECT_NEAR(light.longitude_deg, -(70 + 10.9 / 60), 1e-6);
    EXPECT_DOUBLE_EQ(light.nominal_range_nm.at(0).second, 9);
    EXPECT_EQ(light.source, "NGA Pub. 111 (2015/7), 2472");
    ASSERT_EQ(light.sectors.size(), 1U);
    EXPECT_DOUBLE_EQ(light.sectors[0].to_deg, 278);
    EXPECT_TRUE(import.records.at(0).phase_list_adds_up);
    const std::string text = light_file_text(import);
    EXPECT_NE(text.find("Pub. 111;"), std::string::npos);
    EXPECT_EQ(parse_light_file(text, "out.json").lights.size(), 1U);
}

TEST(NgaVolumes, OtherAidsAndRemovedRecordsAreListedWithTheirReason) {
    const Import import = import_text(
        R"({"ngalol": [{"volumeNumber": "PUB 110", "aidType": "Radiobeacons", "featureNumber": 10, "name": "Kulusuk",
        "position": "65°31'59.99\"N \n37°10'00\"W", "characteristic": "KK\n(- • -   - • - ).\n"},
        {"aidType": "Differential GPS Stations", "featureNumber": 6.0, "range": 100},
        {"aidType": "Lighted Aids", "featureNumber": "8", "position": "60°03'31.4\"N \n43°09'27.4\"W",
         "characteristic": "F.R.\n", "removeFromList": "Y"}, {"featureNumber": null}, 5, [], "x"]})");
    EXPECT_EQ(import.count(Outcome::no_light), 2U);
    EXPECT_EQ(import.count(Outcome::removed), 1U);
    EXPECT_EQ(import.records.size(), 7U);
    for (const RecordReport& record : import.records)
        EXPECT_FALSE(record.reason.empty()) << record.index;
    EXPECT_NE(report_text(import).find("of a kind that shows no light"), std::string::npos);
}

TEST(NgaVolumes, PositionsWithDecimalMinutesRangesWithCommasAndHeightsWithUnits) {
    const auto position = read_position("52\xC2\xB0 44.1' S 70\xC2\xB0 10.9' W");
    ASSERT_TRUE(position.has_value());
    EXPECT_NEAR(position->first, -52.735, 1e-9);
    const auto ranges = read_ranges_nm("W. 12, R. 9M; G. 8.5");
    ASSERT_EQ(ranges.size(), 3U);
    EXPECT_DOUBLE_EQ(ranges[1].second, 9);
    EXPECT_EQ(ranges[2].first, Colour::green);
    EXPECT_EQ(read_heights_m("36 ft\n11 m"), std::vector<double>{11});
    EXPECT_EQ(read_heights_m("11 m"), std::vector<double>{11});
    EXPECT_NEAR(read_heights_m("36").at(0), 10.9728, 1e-9);
}

TEST(NgaVolumes, CharacteristicsOfOtherWatersAreRead) {
    constexpr std::array texts = {"Aero Al.Fl.W.G.\\nperiod 10s", "Mo.(U)R.\\nperiod 15s",
                                  "Q.(6)+L.Fl.W.\\nperiod 15s",   "V.Q.(9)W.\\nperiod 10s",
                                  "F.Fl.W.\\nperiod 30s",         "Fl.(2+1)W.\\nperiod 15s ",
                                  "Al.Fl.W.R.\\nperiod 10s",      "Oc.(1+2)W.\\nperiod 12s",
                                  "I.Q.W.\\nperiod 10s",          "2 F.R. (horiz.)",
                                  "Al.Bu.Y.\\nperiod 3s"};
    for (const char* text : texts) {
        const Import import =
            import_text(std::string(start) + R"("1", "name": "X.", "position": "1°00'00\"S \n2°00'00\"W", )" +
                        "\"characteristic\": \"" + text + "\"}]");
        EXPECT_GE(import.lights.size(), 1U) << text << ": " << import.records.at(0).reason;
    }
}

}  // namespace
}  // namespace seaglare::lightdb::nga
