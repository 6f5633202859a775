// Saving: whatever a light is, its text reads back as the same light to the last bit, and saves as the same text.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "lightdb/light_file.h"
#include "tests/unit/random_light.h"

namespace seaglare::lightdb {
namespace {

namespace fs = std::filesystem;

std::string saved_light(const std::string& members) {
    const std::string text = R"({"lights": [{"name": "a", "position": [1, 2, 3], )" + members + "}]}";
    return format_light_file(parse_light_file(text, "f.json"));
}

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(LightFileSaved, AnyLightReadsBackAsTheSameAndSavesAsTheSameText) {
    RandomLights random(20240611);
    for (int i = 0; i < 3000; ++i) {
        LightFile file;
        file.lights.push_back(random.next());
        const std::string text = format_light_file(file);
        LightFile back;
        ASSERT_NO_THROW(back = parse_light_file(text, "saved")) << text;
        ASSERT_EQ(back.lights.size(), 1U);
        ASSERT_TRUE(back.lights[0] == file.lights[0]) << i << "\n" << text << format_light_file(back);
        ASSERT_EQ(format_light_file(back), text);
    }
}

TEST(LightFileSaved, AnAuthorsRangeStaysARangeAndCandelaStayCandela) {
    EXPECT_TRUE(holds(saved_light(R"("nominal_range_nm": 12)"), R"("nominal_range_nm": {"W": 12})"));
    EXPECT_TRUE(holds(saved_light(R"("nominal_range_nm": 5.66)"), R"("nominal_range_nm": {"W": 5.66})"));
    EXPECT_TRUE(holds(saved_light(R"("intensity_cd": 1500)"), R"("intensity_cd": {"W": 1500})"));
    EXPECT_TRUE(
        holds(saved_light(R"("intensity_cd": 50, "day_range_nm": 1.2)"), R"("day_range_nm": {"W": 1.2})"));
    EXPECT_TRUE(holds(saved_light(R"("intensity_cd": 50, "day_intensity_cd": 9000)"),
                      R"("day_intensity_cd": {"W": 9000})"));
}

TEST(LightFileSaved, WhatHasANameIsSavedByIt) {
    EXPECT_TRUE(holds(saved_light(R"("intensity_cd": 5, "vertical_profile": "sabik_vp")"),
                      R"("vertical_profile": "sabik_vp")"));
    const std::string turning = saved_light(
        R"("intensity_cd": 5, "rotation": {"period_s": 20, "beams": 3, "width_deg": 1.7, "direction": "anticlockwise"})");
    EXPECT_TRUE(holds(turning, R"("beams": 3)")) << turning;
    EXPECT_TRUE(holds(turning, R"("width_deg": 1.7)")) << turning;
    EXPECT_TRUE(holds(turning, R"("anticlockwise")")) << turning;
}

TEST(LightFileSaved, ALightThatKeepsThePhaseOfAnotherPlaceSaysSo) {
    Light light =
        parse_light_file(
            R"({"lights": [{"name": "a", "position": [1, 2, 3], "character": "Iso 4s", "intensity_cd": 5}]})",
            "f.json")
            .lights[0];
    LightFile file;
    file.lights.push_back(light);
    EXPECT_FALSE(holds(format_light_file(file), "phase_key"));
    file.lights[0].position_m[0] = 100;  // moved by a host: its rhythm went on
    const LightFile back = parse_light_file(format_light_file(file), "saved");
    EXPECT_EQ(back.lights[0].stable_key, light.stable_key);
    EXPECT_THROW(
        parse_light_file(
            R"({"lights": [{"name": "a", "position": [1, 2, 3], "phase_key": "12", "intensity_cd": 5}]})",
            "f"),
        json::Error);
}

class LightFileSavedFolder : public testing::Test {
  protected:
    void SetUp() override {
        folder_ =
            fs::path(testing::TempDir()) /
            (std::string("seaglare_saved_") + testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::create_directories(folder_ / "inner");
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::string text_of(const std::string& name) const {
        std::ifstream file(folder_ / name);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    fs::path folder_;
};

TEST_F(LightFileSavedFolder, ALightThatNoFileMayHoldLeavesTheOldFile) {
    std::ofstream(path("lights.json")) << "old";
    LightFile file;
    file.lights.emplace_back();
    file.lights[0].intensity_cd[0] = 1e11;
    EXPECT_THROW(save_light_file(file, path("lights.json")), json::Error);
    EXPECT_EQ(text_of("lights.json"), "old");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()),
              2);  // it, and "inner"
}

TEST_F(LightFileSavedFolder, WhatIsOddInAPhotometricFileIsToldOnce) {
    // The candela add up to some 1000 lm, the file states one lamp of 5 lm.
    std::ofstream(path("lantern.ies"))
        << "IESNA:LM-63-2002\n[TEST] none\n[TESTLAB] none\n[ISSUEDATE] none\n[MANUFAC] none\n"
           "TILT=NONE\n1 5 1 3 1 1 2 0 0 0\n1 1 10\n0 90 180\n0\n100 80 50\n";
    std::ofstream(path("a.json"))
        << R"({"lights": [{"name": "a", "position": [1, 2, 3], "photometry": "lantern.ies"},
        {"name": "b", "position": [1, 2, 3], "photometry": "lantern.ies", "intensity_cd": 7}]})";
    const LightFile file = load_light_file(path("a.json"));
    ASSERT_EQ(file.warnings.size(), 1U);
    EXPECT_TRUE(holds(file.warnings[0], path("lantern.ies") + ":")) << file.warnings[0];
}

TEST_F(LightFileSavedFolder, APhotometricFileIsFoundFromWhereTheLightsAreSaved) {
    // ANSI/IES LM-63-2002: two vertical angles at one horizontal one, 100 cd down to the horizon, 50 up.
    std::ofstream(path("lantern.ies"))
        << "IESNA:LM-63-2002\n[TEST] none\n[TESTLAB] none\n[ISSUEDATE] none\n[MANUFAC] none\n"
           "TILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 10\n0 90 180\n0\n100 80 50\n";
    std::ofstream(path("a.json"))
        << R"({"lights": [{"name": "a", "position": [1, 2, 3], "photometry": "lantern.ies"},
        {"name": "b", "position": [1, 2, 3], "photometry": "lantern.ies", "intensity_cd": 7}]})";
    const LightFile file = load_light_file(path("a.json"));
    ASSERT_TRUE(file.lights[0].photometry);
    EXPECT_EQ(file.lights[0].intensity_cd[0], file.lights[0].photometry->reference_cd);
    EXPECT_EQ(file.lights[1].intensity_cd[0], 7);
    EXPECT_EQ(file.lights[0].photometry.get(), file.lights[1].photometry.get());
    save_light_file(file, path("inner/b.json"));
    EXPECT_TRUE(holds(text_of("inner/b.json"), R"("photometry": "../lantern.ies")"))
        << text_of("inner/b.json");
    EXPECT_TRUE(load_light_file(path("inner/b.json")).lights == file.lights);
    std::ofstream(path("lantern.ies")) << "IESNA:LM-63-2002\nTILT=NONE\n1 -1";
    try {
        load_light_file(path("a.json"));
        FAIL() << "a torn photometric file was taken";
    } catch (const json::Error& error) {
        EXPECT_TRUE(holds(error.what(), path("a.json") + ":1:")) << error.what();
        EXPECT_TRUE(holds(error.what(), path("lantern.ies") + ":")) << error.what();
    }
}

TEST_F(LightFileSavedFolder, BuoysAndVesselsAreSavedWithTheirLights) {
    std::ofstream(path("a.json")) << R"({
        "vessels": [{"name": "Ferry", "kind": "power_driven", "length_m": 100, "breadth_m": 20, "body": 7}],
        "buoys": [{"name": "S", "lat": 55, "lon": 11, "roll_period_s": 3.5, "lights":
            [{"name": "S", "position": [0, 0, 4], "character": "Q(6)+LFl 15s", "nominal_range_nm": 4}]}]})";
    const LightFile file = load_light_file(path("a.json"));
    EXPECT_GE(file.lights.size(), 6U);
    ASSERT_EQ(file.buoys.size(), 1U);
    save_light_file(file, path("b.json"));
    const LightFile back = load_light_file(path("b.json"));
    EXPECT_TRUE(back.buoys == file.buoys) << text_of("b.json");
    // Buoys come before lights in a file, so the order may be another than that of nested ones: here it is not.
    EXPECT_TRUE(back.lights == file.lights) << text_of("b.json");
    save_light_file(back, path("c.json"));
    EXPECT_EQ(text_of("c.json"), text_of("b.json"));
}

}  // namespace
}  // namespace seaglare::lightdb
