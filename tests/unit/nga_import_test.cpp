// The importer against records as the NGA prints them (Pub. 116), one trap each.
#include "lightdb/import/nga.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "lightdb/character.h"
#include "lightdb/json/writer.h"
#include "lightdb/light_file.h"
#include "lightdb/photometry.h"

namespace seaglare::lightdb::nga {
namespace {

struct Record {
    std::string number = "1\nC1";
    std::string name = "Light.";
    std::string characteristic = "F.R.\n";
    std::string range = "4";
    std::string height = "16\n5";
    std::string remarks;
    std::string position =
        "55\xC2\xB0"
        "00'00\"N \n11\xC2\xB0"
        "00'00\"E";
    std::string region;
    std::string subregion;
    int char_no = 1;
};

Import import_records(const std::vector<Record>& records, const Area& area = {}) {
    json::Writer writer;
    const auto text = [&](const char* key, const std::string& value) {
        writer.key(key);
        if (value.empty()) {
            writer.null();
        } else {
            writer.value(value);
        }
    };
    writer.begin_object();
    writer.key("ngalol");
    writer.begin_array();
    for (const Record& record : records) {
        writer.begin_object();
        text("featureNumber", record.number);
        text("name", record.name);
        text("characteristic", record.characteristic);
        text("range", record.range);
        text("heightFeetMeters", record.height);
        text("remarks", record.remarks);
        text("position", record.position);
        text("regionHeading", record.region);
        text("subregionHeading", record.subregion);
        writer.member("charNo", static_cast<double>(record.char_no));
        writer.member("deleteFlag", "Y");  // on most live records
        writer.member("noticeYear", "2015");
        writer.member("noticeWeek", "18");
        writer.end_object();
    }
    writer.end_array();
    writer.end_object();
    const json::Document document = json::parse(writer.take(), "test.json");
    return import_list(document.root(), "test.json", area);
}

// "G 177.9-204.7, W ...": colours, limits and, where it is not 1, the factor.
std::string sectors(const ImportedLight& light) {
    std::string out;
    for (const Sector& sector : light.sectors) {
        char text[64];
        std::snprintf(text, sizeof text, "%s%s %g-%g", out.empty() ? "" : ", ",
                      sector.colour ? std::string(colour_letter(*sector.colour)).c_str() : "dark",
                      sector.from_deg, sector.to_deg);
        out += text;
        if (sector.intensity_factor != 1) {
            std::snprintf(text, sizeof text, " x%g", sector.intensity_factor);
            out += text;
        }
    }
    return out;
}

std::string sectors_of(const std::string& characteristic, const std::string& remarks,
                       const std::string& range = "4") {
    Record record;
    record.characteristic = characteristic;
    record.remarks = remarks;
    record.range = range;
    const Import import = import_records({record});
    return import.lights.size() == 1 ? sectors(import.lights[0]) : "not one light";
}

double range_of(const ImportedLight& light, Colour colour) {
    for (const auto& [of, range_nm] : light.nominal_range_nm)
        if (of == colour) return range_nm;
    return 0;
}

bool noted(const ImportedLight& light, std::string_view part) {
    for (const std::string& note : light.notes)
        if (note.find(part) != std::string::npos) return true;
    return false;
}

constexpr const char* degree = "\xC2\xB0";
std::string deg(std::string text) {  // '^' stands for the degree sign
    for (std::size_t at = text.find('^'); at != std::string::npos; at = text.find('^', at))
        text.replace(at, 1, degree);
    return text;
}

// No. 4, Kattholmen.
TEST(NgaImport, ReadsAWholeRecord) {
    Record record;
    record.number = "4\nC0277";
    record.name = "Kattholmen.";
    record.position = deg("59^03'38.11\"N \n11^09'21.8\"E");
    record.characteristic = "Fl.W.R.G.\nperiod 3s \n";
    record.height = "31\n9";
    record.range = "W. 6 \nR. 5 \nG. 4";
    record.remarks =
        deg("G. 177^54`-204^42`, W.-224^42`, R.-297^18`, G.-022^48`, W.-026^18`, R.-054^42`, G.-082^18`.\n");
    const Import import = import_records({record});
    ASSERT_EQ(import.lights.size(), 1U);
    const ImportedLight& light = import.lights[0];
    EXPECT_EQ(light.name, "Kattholmen");
    EXPECT_NEAR(light.latitude_deg, 59 + 3 / 60.0 + 38.11 / 3600, 1e-7);
    EXPECT_NEAR(light.longitude_deg, 11 + 9 / 60.0 + 21.8 / 3600, 1e-7);
    EXPECT_DOUBLE_EQ(light.height_m, 9);
    EXPECT_EQ(light.character, "Fl WRG 3s");
    EXPECT_DOUBLE_EQ(range_of(light, Colour::white), 6);
    EXPECT_DOUBLE_EQ(range_of(light, Colour::green), 4);
    EXPECT_EQ(
        sectors(light),
        "G 177.9-204.7, W 204.7-224.7, R 224.7-297.3, G 297.3-22.8, W 22.8-26.3, R 26.3-54.7, G 54.7-82.3");
    EXPECT_EQ(light.source, "NGA Pub. 116 (2015/18), 4 / C0277");
    EXPECT_TRUE(light.notes.empty());
}

TEST(NgaImport, DegreeAndMinuteSignsVary) {
    EXPECT_EQ(sectors_of("F.W.R.G.\n", "G. 016^-246^30', W.-355^, R.-016^.\n"),
              "G 16-246.5, W 246.5-355, R 355-16");
    EXPECT_EQ(sectors_of("F.W.R.\n", deg("W. 030^06-040^, R.-041^30.\n")), "W 30.1-40, R 40-41.5");
}

TEST(NgaImport, SectorsContinueWhereTheLastOneEnded) {
    EXPECT_EQ(sectors_of("Oc.W.R.G.\nperiod 5s \n", deg("W. 204^-095^, R.-100^, W. 110^-120^, G.-130^.\n")),
              "W 204-95, R 95-100, W 110-120, G 120-130");
}

// Nos. 28, 472, 4940, 9402, 9664, 9888, 9292: slips of the pen in the List.
TEST(NgaImport, SlipsOfThePenAreRead) {
    EXPECT_EQ(sectors_of("F.W.R.G.\n", deg("G. (unintensified)-222^-233^, W.-040^, R.078^.\n"),
                         "W. 6 \nR. 5 \nG. 4"),
              "G 222-233 x0.25, W 233-40, R 40-78");
    EXPECT_EQ(sectors_of("F.W.R.G.\n",
                         deg("R.200^-288^, G.-008.3^, W.-011.9^, R.-090^ Synchronized with front.\n")),
              "R 200-288, G 288-8.3, W 8.3-11.9, R 11.9-90");
    EXPECT_EQ(sectors_of("F.W.R.G.\n", deg("W.-357^30`-009^, R.-021^.\n")), "W 357.5-9, R 9-21");
    EXPECT_EQ(sectors_of("F.W.R.G.\n", deg("W. 105^24`-130^30`, G.-285^12`-289^48`, W.-293^.\n")),
              "W 105.4-130.5, G 285.2-289.8, W 289.8-293");
    EXPECT_EQ(sectors_of("F.W.R.G.\n", deg("G. 249^30`-252^30`, R.-260.\nRadar Reflector. \n")),
              "G 249.5-252.5, R 252.5-260");
    EXPECT_EQ(sectors_of("F.W.R.G.\n", deg("R. 051^-094^, G.230^54`, W-248^.\n")),
              "R 51-94, G 94-230.9, W 230.9-248");
    EXPECT_EQ(sectors_of("F.W.R.G.\n", deg("G. 010^-020^, W.-030^. R.-040^, G.-050^\n")),
              "G 10-20, W 20-30, R 30-40, G 40-50");
    EXPECT_EQ(sectors_of("F.W.R.G.\n", "R\n" + deg("010^-020^, G.-030^.\n")), "R 10-20, G 20-30");
}

TEST(NgaImport, ObscuredPartsOfAChainAreDark) {
    EXPECT_EQ(sectors_of("F.W.G.\n", deg("W. 010^-020^, obsc.-030^, G.-040^.\n")),
              "W 10-20, dark 20-30, G 30-40");
    EXPECT_EQ(sectors_of("F.W.R.\n", deg("W. 010^-180^, R.-350^.  Obscured 093^-120^ and 130^-140^.\n")),
              "W 10-180, R 180-350, dark 93-120, dark 130-140");
    EXPECT_EQ(sectors_of("F.R.\n", deg("Obscured by Omo 093^-120^.\n")), "R 0-360, dark 93-120");
}

TEST(NgaImport, VisibleArcsHoldTheOnlyColour) {
    EXPECT_EQ(sectors_of("F.G.\n", deg("Visible 206^30`-276^30`.  Shown 24 hours.\n")), "G 206.5-276.5");
    EXPECT_EQ(sectors_of("F.G.\n", deg("Visible 010^-020^ and 030^-040^.\n")), "G 10-20, G 30-40");
    EXPECT_EQ(sectors_of("F.G.\n", deg("Visible 110^114^.\n")), "G 110-114");
}

// Nos. 12532 and 12765: sectors of given ranges.
TEST(NgaImport, ArcsWithRangesKeepThem) {
    const double factor = intensity_for_range_cd(5) / intensity_for_range_cd(7);
    char expected[64];
    std::snprintf(expected, sizeof expected, "W 95-135 x%.3g, W 135-145, W 145-185 x%.3g", factor, factor);
    EXPECT_EQ(
        sectors_of("Iso.W.\nperiod 2s \n", deg("Visible (5M) 095^-135^, (7M)-145^, (5M)-185^.\n"), "7 \n5"),
        expected);
}

TEST(NgaImport, UnintensifiedSectorsAreDimmedByTheSecondRangeOrAQuarter) {
    EXPECT_EQ(sectors_of("F.W.G.\n", deg("W. 010^-020^, G. (unintensified)-030^.\n")),
              "W 10-20, G 20-30 x0.25");
    const double factor = intensity_for_range_cd(8) / intensity_for_range_cd(10);
    char expected[64];
    std::snprintf(expected, sizeof expected, "W 10-20, R 20-30 x%.3g, R 30-40", factor);
    EXPECT_EQ(sectors_of("F.W.R.\n", deg("W. 010^-020^, R.(unintensified)-030^, R.-040^.\n"),
                         "W. 12 \nR. 10 \nR. 8"),
              expected);
    EXPECT_EQ(sectors_of("F.R.\n", deg("Intensified 010^-020^.\n")), "R 0-360 x0.25, R 10-20");
}

// Found by fuzzing: each arc doubled the sectors.
TEST(NgaImport, WhereUnintensifiedArcsOverlapTheLightIsWeakOnce) {
    EXPECT_EQ(sectors_of("F.R.\n", deg("Unintensified 010^-030^, 020^-040^.\n")),
              "R 0-360, R 10-30 x0.25, R 20-40 x0.25");
}

// Found by fuzzing: the light file that was written did not load.
TEST(NgaImport, AnArcWithoutWidthIsLeftOutAndReported) {
    Record record;
    record.characteristic = "F.R.\n";
    record.remarks = deg("Unintensified 020^-020^.\nIntensified 030^-030^.\nObscured 040^-040^.\n");
    const Import import = import_records({record});
    ASSERT_EQ(import.lights.size(), 1U);
    EXPECT_EQ(sectors(import.lights[0]), "");
    const auto& doubts = import.records[0].doubts;
    for (const char* what : {"an unintensified arc", "an intensified arc", "a sector"}) {
        EXPECT_NE(std::find(doubts.begin(), doubts.end(), std::string(what) + " has no width"), doubts.end())
            << what;
    }
}

// Viten: R. 10 and R. 8.
TEST(NgaImport, OfSeveralRangesOfOneColourTheLargestIsTakenAndNoted) {
    Record record;
    record.characteristic = "Fl.W.R.\nperiod 5s \n";
    record.range = "W. 14 \nR. 10 \nR. 8";
    const Import import = import_records({record});
    EXPECT_DOUBLE_EQ(range_of(import.lights.at(0), Colour::red), 10);
    EXPECT_TRUE(noted(import.lights.at(0), "8 to 10 M"));
}

TEST(NgaImport, AMissingRangeOrHeightIsAssumedAndSaid) {
    Record record;
    record.range.clear();
    record.height.clear();
    const ImportedLight light = import_records({record}).lights.at(0);
    EXPECT_DOUBLE_EQ(range_of(light, Colour::red), 3);
    EXPECT_TRUE(noted(light, "no range is given: 3 M assumed"));
    EXPECT_TRUE(noted(light, "no height is given"));
}

TEST(NgaImport, NamesAreMadeFullFromTheDashesBeforeThem) {
    std::vector<Record> records(7);
    records[0].name = "Vejle, N. mole, head.";
    records[0].number = "1";
    records[1].region = records[2].region = records[3].region = records[4].region = "KORSOR HAVN:";
    records[1].name = "-Entrance Range, front.";
    records[1].number = "2";
    records[2].name = "--Rear, 198 meters 073^30' from front.";
    records[2].number = "3";
    records[3].name = "-Detached breakwater, N. head.";
    records[3].number = "4";
    records[4].name = "--S. head.";
    records[4].number = "5";
    records[5].name = "Sprogo.\n";
    records[5].number = "6";
    records[6].name = "";
    records[6].number = "6";
    records[6].char_no = 2;
    records[6].characteristic = "F.G.\n";
    const Import import = import_records(records);
    ASSERT_EQ(import.lights.size(), 7U);
    EXPECT_EQ(import.lights[0].name, "Vejle, N. mole, head");
    EXPECT_EQ(import.lights[1].name, "Korsor Havn, Entrance Range, front");
    EXPECT_EQ(import.lights[2].name, deg("Korsor Havn, Entrance Range, Rear, 198 meters 073^30' from front"));
    EXPECT_EQ(import.lights[3].name, "Korsor Havn, Detached breakwater, N. head");
    EXPECT_EQ(import.lights[4].name, "Korsor Havn, Detached breakwater, S. head");
    EXPECT_EQ(import.lights[5].name, "Sprogo");
    EXPECT_EQ(import.lights[6].name, "Sprogo (2)");
}

TEST(NgaImport, ARangeLineIsVisibleOnItsBearingFromSeaward) {
    std::vector<Record> records(2);
    records[0].number = "10";
    records[0].name = "Haven Range, front.";
    records[0].remarks = "Visible on range line only. \n";
    records[1].number = "11";
    records[1].name = "-Rear, 340 meters 288^ from front.";
    records[1].remarks = "Visible on range line only. \nSynchronized with front.\n";
    const Import import = import_records(records);
    ASSERT_EQ(import.lights.size(), 2U);
    EXPECT_EQ(sectors(import.lights[0]), "R 285-291");
    EXPECT_EQ(sectors(import.lights[1]), "R 285-291");
    EXPECT_EQ(import.lights[0].sync_group, "NGA 10");
    EXPECT_EQ(import.lights[1].sync_group, "NGA 10");
    EXPECT_TRUE(noted(import.lights[0], "range line"));
}

TEST(NgaImport, SynchronizedLightsByNumberShareAGroup) {
    std::vector<Record> records(4);
    for (std::size_t i = 0; i < records.size(); ++i) {
        records[i].number = std::to_string(20 + i);
        records[i].characteristic = "Iso.W.\nperiod 2s \n";
    }
    records[2].remarks = "Shown 24 hours.  Synchronized with 20 and 21.\n";
    const Import import = import_records(records);
    EXPECT_EQ(import.lights[0].sync_group, "NGA 20");
    EXPECT_EQ(import.lights[1].sync_group, "NGA 20");
    EXPECT_EQ(import.lights[2].sync_group, "NGA 20");
    EXPECT_EQ(import.lights[3].sync_group, "");
    EXPECT_TRUE(import.lights[2].all_day);
    EXPECT_FALSE(import.lights[1].all_day);
}

// No. 3690, the west pylon of the Great Belt bridge.
TEST(NgaImport, LampsAboveEachOtherAreLightsOfTheirOwn) {
    Record record;
    record.characteristic = "3 Fl.W. (vert.)\nperiod 1.5s \n";
    record.height = "846\n258\n522\n159\n203\n62";
    record.range = "10";
    const Import import = import_records({record});
    ASSERT_EQ(import.lights.size(), 3U);
    EXPECT_DOUBLE_EQ(import.lights[0].height_m, 258);
    EXPECT_DOUBLE_EQ(import.lights[1].height_m, 159);
    EXPECT_DOUBLE_EQ(import.lights[2].height_m, 62);
    EXPECT_EQ(import.lights[0].character, "Fl W 1.5s");
    EXPECT_EQ(import.records[0].light_count, 3);
}

TEST(NgaImport, RedOverWhiteIsARedAndAWhiteLamp) {
    Record record;
    record.characteristic = "F.R.W. (vert.)\n";
    const Import import = import_records({record});
    ASSERT_EQ(import.lights.size(), 2U);
    EXPECT_EQ(import.lights[0].character, "F R");
    EXPECT_EQ(import.lights[1].character, "F W");
    EXPECT_GT(import.lights[0].height_m, import.lights[1].height_m);
    EXPECT_EQ(import.lights[0].nominal_range_nm.size(), 1U);
}

// No. 6627: sectors of different rhythms, alternating ones among them.
TEST(NgaImport, ADirectionalLightOfSeveralRhythmsBecomesLightsInStep) {
    Record record;
    record.number = "6627";
    record.characteristic = "Dir.W.R.G.\n";
    record.range = "W. 8 \nR. 6 \nG. 6";
    record.remarks = deg("F.G. 198^-201^, Al.W.G.-202^, F.W.-204^, F.R.-208^.\n");
    const Import import = import_records({record});
    ASSERT_EQ(import.lights.size(), 5U);
    int white_at_201_5 = 0;
    for (const ImportedLight& light : import.lights) {
        EXPECT_EQ(light.sync_group, "NGA 6627");
        ASSERT_EQ(light.sectors.size(), 1U);
        if (light.sectors[0].from_deg != 201) continue;
        const Character character = parse_character(light.character);
        EXPECT_DOUBLE_EQ(character.rhythm.period_s, 4);
        const bool white = *light.sectors[0].colour == Colour::white;
        white_at_201_5 += white ? 1 : 0;
        EXPECT_EQ(character.rhythm.phases[0].lit, white) << "white and green take turns";
    }
    EXPECT_EQ(white_at_201_5, 1);
}

TEST(NgaImport, DirectionalSectorsNameTheClass) {
    Record record;
    record.characteristic = "Dir.W.R.G.\nperiod 6s \nfl. 5.0s, ec. 1.0s \n";
    record.remarks = deg("Oc.R.345^48`-348^18`, Oc.W.-349^18`, Oc.G.-351^48`.\n");
    const ImportedLight light = import_records({record}).lights.at(0);
    EXPECT_EQ(light.character, "Dir Oc WRG 6s fl. 5s, ec. 1s");
    EXPECT_EQ(sectors(light), "R 345.8-348.3, W 348.3-349.3, G 349.3-351.8");
}

TEST(NgaImport, EveryRecordHasAnOutcomeAndAReason) {
    std::vector<Record> records(6);
    for (std::size_t i = 0; i < records.size(); ++i)
        records[i].number = std::to_string(30 + i);
    records[1].name = "-RACON";
    records[1].characteristic = "T(- )\n";
    records[2].characteristic = "K(- \xE2\x80\xA2 - )\n";
    records[3].position = " \n";
    records[4].characteristic = "Zz.W.\n";
    records[5] = records[0];
    const Import import = import_records(records);
    EXPECT_EQ(import.records.size(), records.size());
    EXPECT_EQ(import.count(Outcome::imported), 1U);
    EXPECT_EQ(import.count(Outcome::racon), 2U);
    EXPECT_EQ(import.count(Outcome::no_position), 1U);
    EXPECT_EQ(import.count(Outcome::not_understood), 1U);
    EXPECT_EQ(import.count(Outcome::duplicate), 1U);
    for (const RecordReport& record : import.records)
        EXPECT_EQ(record.reason.empty(), record.outcome == Outcome::imported);
    EXPECT_NE(report_text(import).find("'Zz.W': 'Zz' is neither a class nor a colour of light"),
              std::string::npos);
}

// No. 3864: its position is that of another harbour, 61 km from its rear light.
TEST(NgaImport, APositionFarFromItsOwnRangeIsLeftOut) {
    std::vector<Record> records(3);
    records[0].number = "40";
    records[0].position = deg("55^02'00\"N \n10^40'00\"E");
    records[1].number = "41";
    records[1].name = "Grasten Range, front.";
    records[1].position = deg("55^31'02.1\"N \n11^07'16.4\"E");
    records[2].number = "42";
    records[2].name = "-Rear, 178 meters 105^ from front.";
    records[2].position = deg("55^02'06\"N \n10^40'18\"E");
    const Import import = import_records(records);
    EXPECT_EQ(import.records[1].outcome, Outcome::no_position);
    EXPECT_EQ(import.records[2].outcome, Outcome::imported);
}

TEST(NgaImport, ImpossibleFiguresAreLeftOutAndReported) {
    Record record;
    record.range = "4000";
    record.height = "31\n90000";
    const Import import = import_records({record});
    EXPECT_EQ(import.records.at(0).doubts.size(), 2U);
    EXPECT_DOUBLE_EQ(range_of(import.lights.at(0), Colour::red), 3);
    EXPECT_EQ(parse_light_file(light_file_text(import), "out.json").lights.size(), 1U);
}

TEST(NgaImport, AreasAreBoxesOrCircles) {
    std::vector<Record> records(2);
    records[1].number = "2";
    records[1].position = deg("55^10'00\"N \n11^00'00\"E");
    Area box;
    box.north_deg = 55.1;
    EXPECT_EQ(import_records(records, box).lights.size(), 1U);
    Area circle;
    circle.centre_deg = std::pair{55.0, 11.0};
    circle.radius_nm = 9.9;
    EXPECT_EQ(import_records(records, circle).lights.size(), 1U);
    circle.radius_nm = 10.1;
    EXPECT_EQ(import_records(records, circle).lights.size(), 2U);
}

TEST(NgaImport, ABoxMayGoOverThe180thMeridian) {
    Area fiji;
    fiji.west_deg = 175;
    fiji.east_deg = -175;
    EXPECT_TRUE(fiji.contains(-17, 179));
    EXPECT_TRUE(fiji.contains(-17, -179));
    EXPECT_FALSE(fiji.contains(-17, 170));
    EXPECT_FALSE(fiji.contains(-17, 0));
}

TEST(NgaImport, WhatIsNoListOfLightsIsRefused) {
    const json::Document document = json::parse("{\"lights\": []}", "x.json");
    EXPECT_THROW(import_list(document.root(), "x.json"), json::Error);
    const json::Document odd = json::parse("{\"ngalol\": [7, null, {}, {\"name\": 5}]}", "x.json");
    EXPECT_EQ(import_list(odd.root(), "x.json").records.size(), 4U) << "odd records are reported, not thrown";
}

TEST(NgaImport, RemarksThatAreNotReadAreListed) {
    Record record;
    record.remarks =
        deg("R. 010^-020^.  Shown 24 hours.  Radar Reflector.  Range 3M by day.\nShown May 1 to Nov. 1.\n");
    const Import import = import_records({record});
    EXPECT_EQ(import.records[0].unread,
              (std::vector<std::string>{"Range 3M by day", "Shown May 1 to Nov. 1"}));
    EXPECT_TRUE(import.records[0].doubts.empty()) << import.records[0].doubts[0];
    EXPECT_NE(report_text(import).find("1 / C1, Light: Range 3M by day. Shown May 1 to Nov. 1."),
              std::string::npos)
        << report_text(import);
}

TEST(NgaImport, TheLightFileLoadsWithoutWarnings) {
    Record record;
    record.characteristic = "Fl.(2)W.R.G.\nperiod 6s \nfl. 0.5s, ec. 1.0s \nfl. 0.5s, ec. 4.0s \n";
    record.range = "W. 6 \nR. 5 \nG. 4";
    record.remarks = deg("G. 010^-020^, W.-030^, R.-040^, obsc.-050^.  Seasonal.\n");
    const LightFile file = parse_light_file(light_file_text(import_records({record})), "out.json");
    ASSERT_EQ(file.lights.size(), 1U);
    EXPECT_TRUE(file.warnings.empty());
    EXPECT_EQ(file.lights[0].sectors.size(), 4U);
    EXPECT_NEAR(file.lights[0].intensity_cd[0], intensity_for_range_cd(6), 1e-9);
    EXPECT_TRUE(file.lights[0].day_off);
}

// The whole List, where it is at hand.
TEST(NgaImport, TheWholeListIsAccountedFor) {
    const std::string path = std::string(SEAGLARE_SHARED_DIR) + "/data/nga/pub116.json";
    if (!std::ifstream(path)) GTEST_SKIP() << "the List of Lights is not at hand";
    const json::Document document = json::parse_file(path);
    const Import import = import_list(document.root(), path);
    EXPECT_EQ(import.records.size(), 4238U);
    std::size_t sum = 0;
    for (const Outcome outcome : {Outcome::imported, Outcome::racon, Outcome::duplicate, Outcome::no_position,
                                  Outcome::not_understood, Outcome::outside_area})
        sum += import.count(outcome);
    EXPECT_EQ(sum, import.records.size());
    EXPECT_EQ(import.count(Outcome::racon), 174U);
    EXPECT_EQ(import.count(Outcome::not_understood), 0U);
    int lights = 0;
    for (const RecordReport& record : import.records)
        lights += record.light_count;
    EXPECT_EQ(static_cast<std::size_t>(lights), import.lights.size());
    const LightFile file = parse_light_file(light_file_text(import), "all.json");
    EXPECT_EQ(file.lights.size(), import.lights.size());
}

TEST(NgaImport, TheCommittedFilesAreWhatTheListGives) {
    const std::string path = std::string(SEAGLARE_SHARED_DIR) + "/data/nga/pub116.json";
    if (!std::ifstream(path)) GTEST_SKIP() << "the List of Lights is not at hand";
    const json::Document document = json::parse_file(path);
    const auto committed = [](const char* name) {
        std::ifstream file(std::string(SEAGLARE_SOURCE_DIR) + "/config/lights/" + name, std::ios::binary);
        std::ostringstream text;
        text << file.rdbuf();
        return text.str();
    };
    Area great_belt;
    great_belt.south_deg = 55.2;
    great_belt.west_deg = 10.6;
    great_belt.north_deg = 55.9;
    great_belt.east_deg = 11.3;
    EXPECT_EQ(light_file_text(import_list(document.root(), path, great_belt)), committed("great_belt.json"));
    Area sonderborg;
    sonderborg.south_deg = 54.8;
    sonderborg.west_deg = 9.6;
    sonderborg.north_deg = 55.0;
    sonderborg.east_deg = 10.0;
    EXPECT_EQ(light_file_text(import_list(document.root(), path, sonderborg)), committed("sonderborg.json"));
}

}  // namespace
}  // namespace seaglare::lightdb::nga
