// Light files: what operators write is understood, what they mistype is named where it stands, and what is saved reads
// back as the same.
#include "lightdb/light_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "lightdb/json/value.h"
#include "lightdb/photometry.h"

namespace seaglare::lightdb {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t white = static_cast<std::size_t>(Colour::white);
constexpr std::size_t red = static_cast<std::size_t>(Colour::red);
constexpr std::size_t green = static_cast<std::size_t>(Colour::green);

LightFile parsed(const std::string& text) {
    return parse_light_file(text, "f.json");
}

Light light_of(const std::string& members) {
    const LightFile file = parsed("{\"lights\": [{" + members + "}]}");
    EXPECT_EQ(file.lights.size(), 1U);
    return file.lights.at(0);
}

std::string error_of(const std::string& text) {
    try {
        parsed(text);
    } catch (const json::Error& error) {
        return error.what();
    }
    return "accepted";
}

std::string light_error_of(const std::string& members) {
    return error_of("{\"lights\": [\n{" + members + "}]}");
}

const std::string place = R"("name": "a", "position": [1, 2, 3])";

class LightFileFolder : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) /
                  (std::string("seaglare_") + testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::create_directories(folder_ / "inner");
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return path(name);
    }
    std::string error_of_file(const std::string& name) const {
        try {
            load_light_file(path(name));
        } catch (const json::Error& error) {
            return error.what();
        }
        return "accepted";
    }
    fs::path folder_;
};

TEST(LightFile, AnHarbourAuthorsLightIsUnderstood) {
    const LightFile file = parsed(R"({
        "$schema": "../schema/lights.schema.json",
        "origin": {"lat": 55.3, "lon": 11},
        "source": "a list of lights",
        "lights": [{
            "name": "Rev", "lat": 55.33, "lon": 11.03, "height_m": 14,
            "character": "Fl(2) WRG 10s", "nominal_range_nm": {"W": 12, "red": 9, "G": 8},
            "sectors": [{"colour": "R", "from": 259, "to": 292},
                        {"colour": "white", "from": 292, "to": 20, "transition_deg": 0.5},
                        {"colour": null, "from": 20, "to": 100}, {"colour": "obscured", "from": 100, "to": 120},
                        {"colour": "G", "from": 120, "to": 259, "intensity_factor": 0.5}],
            "vertical_profile": "sabik_vp", "radius_m": 0.2, "spectrum": "tungsten", "day": "off",
            "sync_group": "line"
        }]})");
    EXPECT_EQ(file.origin, (GeographicPoint{55.3, 11, 0}));
    EXPECT_TRUE(file.warnings.empty());
    ASSERT_EQ(file.lights.size(), 1U);
    const Light& light = file.lights[0];
    EXPECT_EQ(light.name, "Rev");
    EXPECT_TRUE(light.geographic);
    EXPECT_EQ(light.latitude_deg, 55.33);
    EXPECT_EQ(light.longitude_deg, 11.03);
    EXPECT_EQ(light.height_m, 14);
    EXPECT_EQ(light.character, "Fl(2) WRG 10s");
    EXPECT_NEAR(light.rhythm.period_s, 10, 1e-12);
    EXPECT_NEAR(light.intensity_cd[white], intensity_for_range_cd(12), 1e-9);
    EXPECT_NEAR(light.intensity_cd[red], intensity_for_range_cd(9), 1e-9);
    EXPECT_NEAR(light.intensity_cd[green], intensity_for_range_cd(8), 1e-9);
    ASSERT_EQ(light.sectors.size(), 5U);
    EXPECT_EQ(light.sectors[0], (Sector{Colour::red, 259, 292}));
    EXPECT_EQ(light.sectors[1], (Sector{Colour::white, 292, 20, 1, 0.5}));
    EXPECT_EQ(light.sectors[2], (Sector{std::nullopt, 20, 100}));
    EXPECT_EQ(light.sectors[3], (Sector{std::nullopt, 100, 120}));
    EXPECT_EQ(light.sectors[4], (Sector{Colour::green, 120, 259, 0.5}));
    EXPECT_EQ(light.vertical.factor.size(), 5U);
    EXPECT_EQ(light.radius_m, 0.2);
    ASSERT_TRUE(light.spectrum);
    EXPECT_EQ(light.spectrum->choice[0].source, "tungsten");
    EXPECT_TRUE(light.day_off);
    EXPECT_EQ(light.rhythm.sync_group, "line");
    EXPECT_EQ(light.source, "a list of lights");
    EXPECT_NE(light.stable_key, 0U);
}

TEST(LightFile, PlacesMayBeLocal) {
    EXPECT_EQ(light_of(place + R"(, "intensity_cd": 5)").position_m, (Vec3{1, 2, 3}));
    EXPECT_EQ(light_of(place + R"(, "intensity_cd": 5)").height_m, 3);
    const Light flat = light_of(R"("name": "a", "position": [1, 2], "height_m": 7, "intensity_cd": 5)");
    EXPECT_EQ(flat.position_m, (Vec3{1, 2, 7}));
    EXPECT_NE(light_error_of(R"("name": "a", "position": [1, 2], "intensity_cd": 5)").find("height_m"),
              std::string::npos);
    EXPECT_NE(light_error_of(place + R"(, "height_m": 4, "intensity_cd": 5)").find("differ"),
              std::string::npos);
    EXPECT_NE(light_error_of(place + R"(, "lat": 4, "lon": 5, "intensity_cd": 5)").find("either"),
              std::string::npos);
    EXPECT_NE(light_error_of(R"("name": "a", "intensity_cd": 5)").find("'position'"), std::string::npos);
}

TEST(LightFile, AShipsLightStandsOnItsBody) {
    const Light light =
        light_of(place + R"(, "body": 7, "intensity_cd": {"R": 52}, "orientation": [0, 0, 0.6, 0.8],
        "sectors": [{"colour": "R", "from": 247.5, "to": 2}], "sector_reference": "outward_from_ahead")");
    EXPECT_EQ(light.body_id, 7U);
    EXPECT_EQ(light.sector_reference, SectorReference::outward_from_ahead);
    EXPECT_EQ(light.orientation, (std::array<double, 4>{0, 0, 0.6, 0.8}));
    EXPECT_EQ(light.intensity_cd[red], 52);
    EXPECT_NE(
        light_error_of(R"("name": "a", "lat": 1, "lon": 2, "height_m": 3, "body": 7, "intensity_cd": 5)")
            .find("on a body"),
        std::string::npos);
    EXPECT_NE(
        light_error_of(place + R"(, "intensity_cd": 5, "orientation": [0, 0, 0, 0.5])").find("quaternion"),
        std::string::npos);
}

TEST(LightFile, OneIntensityHoldsForEveryColour) {
    const Light light = light_of(place + R"(, "character": "Iso RG 4s", "intensity_cd": 80,
        "sectors": [{"colour": "R", "from": 0, "to": 90}, {"colour": "G", "from": 90, "to": 180}])");
    EXPECT_EQ(light.intensity_cd[red], 80);
    EXPECT_EQ(light.intensity_cd[green], 80);
    EXPECT_EQ(light.intensity_cd[white], 0);
}

TEST(LightFile, AChartsHeightAndRangesServe) {
    const Light light = light_of(R"("name": "a", "lat": 55, "lon": 11, "character": "Fl(2+1)WRG.10s15m12-9M",
        "sectors": [{"colour": "W", "from": 0, "to": 90}, {"colour": "R", "from": 90, "to": 180},
                    {"colour": "G", "from": 180, "to": 270}])");
    EXPECT_EQ(light.height_m, 15);
    EXPECT_NEAR(light.intensity_cd[white], intensity_for_range_cd(12), 1e-9);
    EXPECT_NEAR(light.intensity_cd[red], intensity_for_range_cd(9), 1e-9);
    EXPECT_NEAR(light.intensity_cd[green], intensity_for_range_cd(9), 1e-9);
    EXPECT_NE(light_error_of(place + R"(, "character": "F R")").find("intensity_cd"), std::string::npos);
}

TEST(LightFile, PhasesSayTheRhythmInSeconds) {
    const Light light = light_of(place + R"(, "intensity_cd": {"R": 5, "W": 6},
        "phases": [{"lit": 0.5, "colour": "R"}, {"eclipse": 2.5}, {"lit": 1, "level": 0.25}])");
    ASSERT_EQ(light.rhythm.phases.size(), 3U);
    EXPECT_EQ(light.rhythm.phases[0], (Phase{0.5, true, Colour::red}));
    EXPECT_EQ(light.rhythm.phases[1], (Phase{2.5, false}));
    EXPECT_EQ(light.rhythm.phases[2], (Phase{1, true, Colour::white, 0.25}));
    EXPECT_EQ(light.rhythm.period_s, 4);
    EXPECT_NE(
        light_error_of(place + R"(, "intensity_cd": 5, "phases": [{"lit": 1, "eclipse": 2}])").find("either"),
        std::string::npos);
    EXPECT_NE(
        light_error_of(place + R"(, "intensity_cd": 5, "phases": [{"lit": 0}])").find("'lit' must be from"),
        std::string::npos);
}

TEST(LightFile, PhasesThatMissTheirCharactersPeriodAreReported) {
    const std::string text = "{\"lights\": [{" + place + R"(, "intensity_cd": 5, "character": "Fl W 5s",
        "phases": [{"lit": 0.5}, {"eclipse": 4}]}]})";
    const LightFile file = parsed(text);
    ASSERT_EQ(file.warnings.size(), 1U);
    EXPECT_EQ(file.warnings[0].substr(0, 9), "f.json:2:");
    EXPECT_NEAR(file.lights[0].rhythm.period_s, 4.5, 1e-12);
}

TEST(LightFile, SeveralColoursWithoutSectorsAreReported) {
    const auto warnings_of = [](const std::string& members) {
        return parsed("{\"lights\": [{" + place + members + "}]}").warnings.size();
    };
    EXPECT_EQ(warnings_of(R"(, "character": "Fl WRG 5s", "intensity_cd": 5)"), 1U);
    EXPECT_EQ(warnings_of(R"(, "character": "Al WR 5s", "intensity_cd": 5)"), 0U);
    EXPECT_EQ(warnings_of(R"(, "character": "Fl R 5s", "intensity_cd": 5)"), 0U);
}

TEST(LightFile, MistakesAreNamedWhereTheyStand) {
    EXPECT_EQ(light_error_of(place + R"(, "nominal_rang_nm": 5)"),
              "f.json:2:38: unknown key 'nominal_rang_nm' in light 'a', did you mean 'nominal_range_nm'?");
    EXPECT_EQ(light_error_of(place),
              "f.json:2:1: light 'a': 'intensity_cd' or 'nominal_range_nm' is missing, and 'character' has "
              "no range");
    EXPECT_EQ(light_error_of(place + R"(, "intensity_cd": 5, "radius": 5)"),
              "f.json:2:57: unknown key 'radius' in light 'a', did you mean 'radius_m'?");
    EXPECT_EQ(light_error_of(place + R"(, "intensity_cd": -5)"),
              "f.json:2:54: 'intensity_cd' must be from 0 to 1e+08, not -5");
    EXPECT_EQ(light_error_of(R"("name": 5)"), "f.json:2:10: 'name' must be a string, not a number");
    EXPECT_NE(
        light_error_of(place + R"(, "character": "Flash W 5s", "intensity_cd": 5)").find("f.json:2:51:"),
        std::string::npos);
    EXPECT_NE(light_error_of(place + R"(, "intensity_cd": 5, "nominal_range_nm": 5)").find("not both"),
              std::string::npos);
    EXPECT_NE(light_error_of(place + R"(, "intensity_cd": {"X": 5})").find("unknown key 'X'"),
              std::string::npos);
    EXPECT_NE(light_error_of(place + R"(, "intensity_cd": {"W": 5, "white": 5})").find("twice"),
              std::string::npos);
    EXPECT_NE(
        light_error_of(place + R"(, "intensity_cd": {"W": 5}, "sectors": [{"colour":"R","from":0,"to":9}])")
            .find("shows red, but has no intensity"),
        std::string::npos);
    EXPECT_NE(light_error_of(place + R"(, "intensity_cd": 5, "sectors": [{"colour":"P","from":0,"to":9}])")
                  .find("'P' is no colour"),
              std::string::npos);
    EXPECT_NE(light_error_of(place + R"(, "intensity_cd": 5, "sectors": [{"colour":"R","from":9,"to":9}])")
                  .find("no width"),
              std::string::npos);
    EXPECT_NE(
        light_error_of(place + R"(, "intensity_cd": 5, "vertical_profile": "sabik")").find("'sabik_vp'"),
        std::string::npos);
    EXPECT_NE(
        light_error_of(place +
                       R"(, "intensity_cd": 5, "vertical_profile": {"angle_deg": [1, 1], "factor": [1, 1]})")
            .find("ascend"),
        std::string::npos);
    EXPECT_NE(light_error_of(
                  place + R"(, "intensity_cd": 5, "vertical_profile": {"angle_deg": [1], "factor": [1, 1]})")
                  .find("has 1 numbers and 'factor' 2"),
              std::string::npos);
    EXPECT_NE(light_error_of(place + R"(, "intensity_cd": 5, "day": "of")").find("one of 'on', 'off'"),
              std::string::npos);
    EXPECT_NE(error_of(R"({"light": []})").find("did you mean 'lights'?"), std::string::npos);
    EXPECT_NE(error_of("[]").find("must be an object"), std::string::npos);
    EXPECT_EQ(error_of("{}"), "accepted");
}

TEST(LightFile, WhatIsSavedReadsBackAsTheSame) {
    LightFile file;
    file.origin = GeographicPoint{55.3, 11.1, 2};
    file.source = "test";
    file.lights.push_back(
        light_of(R"("name": "\u00d8 \"q\"", "lat": 55.123456789012345, "lon": -0.1, "height_m": 12.7,
        "character": "Fl(2) WRG 10s", "nominal_range_nm": {"W": 12.3, "R": 9.1, "G": 0},
        "sectors": [{"colour": "R", "from": 259.3, "to": 292, "transition_deg": 0.3}, {"colour": null, "from": 0, "to": 9},
                    {"colour": "G", "from": 20, "to": 30, "intensity_factor": 0.1}],
        "vertical_profile": "sabik_vp", "radius_m": 0.13, "spectrum": "led_white", "day": "off", "sync_group": "s")"));
    file.lights.push_back(light_of(R"("name": "", "position": [0.1, -2e-5, 3e6], "body": 4294967295,
        "orientation": [0, 0, 0.6, 0.8], "true_north_deg": -0.123, "sector_reference": "outward_from_ahead",
        "phases": [{"lit": 0.1, "colour": "R", "level": 0.3}, {"lit": 0.7, "colour": "Vi"}, {"eclipse": 0.2}],
        "intensity_cd": {"R": 5.1, "Vi": 1e8}, "source": "elsewhere")"));
    file.lights.push_back(
        light_of(place + R"(, "character": "Q(6)+LFl 15s", "phases": [{"lit": 1}, {"eclipse": 14}],
        "intensity_cd": 0)"));
    file.lights.push_back(light_of(place + R"(, "intensity_cd": 3)"));
    file.lights.push_back(light_of(place + R"(, "character": "F Y", "intensity_cd": 3, "phases": [])"));
    file.lights.push_back(
        light_of(place + R"(, "character": "Al WR 7s", "intensity_cd": {"W": 3, "R": 0.1})"));

    const std::string text = format_light_file(file);
    const LightFile back = parsed(text);
    EXPECT_EQ(back.origin, file.origin);
    EXPECT_EQ(back.source, file.source);
    ASSERT_EQ(back.lights.size(), file.lights.size());
    for (std::size_t i = 0; i < file.lights.size(); ++i) {
        EXPECT_TRUE(back.lights[i] == file.lights[i]) << i << "\n" << text;
    }
    EXPECT_EQ(format_light_file(back), text);
}

TEST_F(LightFileFolder, SavingReplacesAFileWhole) {
    LightFile file;
    file.lights.push_back(light_of(place + R"(, "intensity_cd": 3)"));
    const std::string target = write("lights.json", "old");
    save_light_file(file, target);
    EXPECT_TRUE(load_light_file(target).lights == file.lights);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()),
              2);  // it, and "inner"
    EXPECT_THROW(save_light_file(file, path("no/such/folder.json")), std::system_error);
}

TEST_F(LightFileFolder, IncludesAreFoundBesideTheFileAndReadOnce) {
    write("inner/b.json",
          R"({"source": "b", "include": ["../c.json"], "lights": [{)" + place + R"(, "intensity_cd": 1}]})");
    write("c.json", R"({"origin": {"lat": 1, "lon": 2}, "lights": [{)" + place + R"(, "intensity_cd": 2}]})");
    write("a.json",
          R"({"source": "a", "include": ["inner/b.json", "c.json", "./inner/../c.json"], "lights": [{)" +
              place + R"(, "intensity_cd": 3}]})");
    const LightFile file = load_light_file(path("a.json"));
    ASSERT_EQ(file.lights.size(), 3U);
    EXPECT_EQ(file.lights[0].intensity_cd[white], 2);
    EXPECT_EQ(file.lights[0].source, "");
    EXPECT_EQ(file.lights[1].source, "b");
    EXPECT_EQ(file.lights[2].source, "a");
    EXPECT_EQ(file.source, "a");
    EXPECT_EQ(file.origin, (GeographicPoint{1, 2, 0}));
}

TEST_F(LightFileFolder, AFileThatIncludesItselfIsNamed) {
    write("a.json", "{\"include\":\n [\"b.json\"]}");
    write("b.json", "{\"include\": [\"a.json\"]}");
    EXPECT_EQ(error_of_file("a.json"),
              path("b.json") + ":1:14: 'a.json' includes itself, by this or over other files");
    write("self.json", "{\"include\": [\"self.json\"]}");
    EXPECT_NE(error_of_file("self.json"), "accepted");
}

TEST_F(LightFileFolder, AnIncludeThatCannotBeReadIsNamedWhereItIsAskedFor) {
    write("a.json", "{\"include\": [\n\"missing.json\"]}");
    const std::string error = error_of_file("a.json");
    EXPECT_EQ(error.substr(0, path("a.json").size() + 5), path("a.json") + ":2:1:");
    EXPECT_NE(error.find("No such file"), std::string::npos);
    write("torn.json", "{\"lights\": [");
    write("b.json", "{\"include\": [\"torn.json\"]}");
    EXPECT_EQ(error_of_file("b.json").substr(0, path("torn.json").size()), path("torn.json"));
    EXPECT_THROW(load_light_file(path("missing.json")), std::system_error);
}

TEST_F(LightFileFolder, TwoOriginsAreAnError) {
    write("b.json", R"({"origin": {"lat": 1, "lon": 2}})");
    write("a.json", R"({"origin": {"lat": 1, "lon": 3}, "include": ["b.json"]})");
    EXPECT_NE(error_of_file("a.json").find("origin"), std::string::npos);
    write("a.json", R"({"origin": {"lat": 1, "lon": 2}, "include": ["b.json"]})");
    EXPECT_EQ(error_of_file("a.json"), "accepted");
}

TEST(LightFile, EveryLightFileOfTheProjectLoads) {
    const fs::path folder = SEAGLARE_SOURCE_DIR "/config/lights";
    if (!fs::exists(folder)) GTEST_SKIP() << "there are no light files yet";
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".json") continue;
        LightFile file;
        ASSERT_NO_THROW(file = load_light_file(entry.path().string())) << entry.path();
        EXPECT_FALSE(file.lights.empty()) << entry.path();
        const LightFile again = parse_light_file(format_light_file(file), "again");
        EXPECT_TRUE(again.lights == file.lights) << entry.path();
    }
}

TEST(LightFile, ColoursHaveLettersAndNames) {
    EXPECT_EQ(colour_from_name("Bu"), Colour::blue);
    EXPECT_EQ(colour_from_name("violet"), Colour::violet);
    EXPECT_EQ(colour_from_name("w"), std::nullopt);
    EXPECT_EQ(colour_from_name(""), std::nullopt);
}

}  // namespace
}  // namespace seaglare::lightdb
