// Checking a light file: its author sees every mistake in one run, each where it stands.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "lightdb/light_file.h"
#include "lightdb/mistakes.h"
#include "lightdb/tool/commands.h"

namespace seaglare::lightdb {
namespace {

namespace fs = std::filesystem;

class LightFileCheckFolder : public testing::Test {
  protected:
    void SetUp() override {
        folder_ =
            fs::path(testing::TempDir()) /
            (std::string("seaglare_check_") + testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return (folder_ / name).string();
    }
    // Where the errors of a file stand, and their texts without that.
    static std::vector<std::string> errors_of(const std::string& path) {
        std::vector<std::string> result;
        for (const std::string& error : check_light_file(path).errors) {
            EXPECT_EQ(error.rfind(path + ":", 0), 0U) << error;
            result.push_back(error.substr(std::min(path.size() + 1, error.size())));
        }
        return result;
    }
    fs::path folder_;
};

TEST_F(LightFileCheckFolder, EveryMistakeOfEveryLightIsTold) {
    const std::string path = write("a.json", R"({"origin": {"lat": 95, "lon": 1},
"lights": [
{"name": "good", "position": [1, 2, 3], "intensity_cd": 5},
{"name": "b", "position": [1, 2], "intensity_cd": -5},
{"name": "c", "position": [1, 2, 3], "intensity_cd": 5, "radius": 3},
{"name": "d", "position": [1, 2, 3], "intensity_cd": 5, "day": "dim", "rotation": 4,
  "vertical_profile": "none", "orientation": [1, 1, 0, 0], "body": -1},
7,
{"name": "e", "position": [1, 2, 3], "character": "Flash", "intensity_cd": 5}
]})");
    const auto errors = errors_of(path);
    const auto told = [&](const std::string& where, const std::string& text) {
        EXPECT_TRUE(std::any_of(errors.begin(), errors.end(),
                                [&](const std::string& e) {
                                    return e.rfind(where, 0) == 0 && e.find(text) != std::string::npos;
                                }))
            << where << text << "\n"
            << testing::PrintToString(errors);
    };
    told("1:20:", "'lat' must be from -90 to 90");
    told("4:1:", "'height_m' is needed");
    told("4:51:", "'intensity_cd' must be from 0");
    told("5:57:", "did you mean 'radius_m'?");
    told("6:", "one of 'on', 'off'");
    told("6:", "rotation must be an object");
    told("7:", "there is no vertical profile 'none'");
    told("7:", "'body' must be from 0");
    told("8:1:", "light must be an object");
    told("9:", "'Flash'");
    EXPECT_EQ(check_light_file(path).light_count, 1U);
    EXPECT_THROW(load_light_file(path), json::Error);
}

TEST_F(LightFileCheckFolder, OneMistakeIsToldOnce) {
    const std::string path = write("a.json", R"({"lights": [
{"name": "a", "position": [1, 2, 3], "nominal_rang_nm": 5},
{"name": "b", "position": [1, 2, 3], "character": "?", "sectors": [{"colour": "R", "from": 1, "to": 2}]}]})");
    const auto errors = errors_of(path);
    ASSERT_EQ(errors.size(), 2U) << testing::PrintToString(errors);
    EXPECT_EQ(errors[0].rfind("2:", 0), 0U);
    EXPECT_EQ(errors[1].rfind("3:", 0), 0U);
}

TEST_F(LightFileCheckFolder, ARepeatedKeyIsToldWithBothPlaces) {
    const auto errors = errors_of(write("a.json",
                                        "{\"lights\": [{\"name\": \"a\", \"position\": [1, 2, 3],\n"
                                        "\"intensity_cd\": 5, \"name\": \"b\"}]}"));
    ASSERT_EQ(errors.size(), 1U);
    EXPECT_EQ(errors[0], "2:20: key 'name' stands twice in light 'a', first in line 1, column 14");
}

TEST_F(LightFileCheckFolder, TornTextAndWhatIsNoNumberAreToldWhereTheyStand) {
    EXPECT_EQ(errors_of(write("torn.json", "{\"lights\": [\n{\"name\": \"a"))[0].rfind("2:", 0), 0U);
    EXPECT_EQ(errors_of(write("nan.json", "{\"lights\": [\n {\"radius_m\": NaN}]}"))[0].rfind("2:15:", 0),
              0U);
    EXPECT_EQ(errors_of(write("empty.json", ""))[0].rfind("1:1:", 0), 0U);
    EXPECT_EQ(errors_of(write("list.json", "\n []"))[0].rfind("2:2:", 0), 0U);
}

TEST_F(LightFileCheckFolder, IncludesThatAreMissingTornOrGoRoundAreToldAndTheRestIsChecked) {
    write("torn.json", "{\"lights\": [");
    write("round.json", "{\"include\": [\"a.json\"]}");
    const std::string path = write("a.json",
                                   "{\"include\": [\"missing.json\",\n \"torn.json\", \"round.json\"],\n"
                                   "\"lights\": [{\"name\": \"a\", \"position\": 3, \"intensity_cd\": 5}]}");
    const auto check = check_light_file(path);
    ASSERT_EQ(check.errors.size(), 4U) << testing::PrintToString(check.errors);
    EXPECT_EQ(check.errors[0].rfind(path + ":1:14:", 0), 0U);
    EXPECT_EQ(check.errors[1].rfind((folder_ / "torn.json").string() + ":1:", 0), 0U);
    EXPECT_NE(check.errors[2].find("includes itself"), std::string::npos);
    EXPECT_EQ(check.errors[3].rfind(path + ":3:", 0), 0U);
    EXPECT_THROW(check_light_file((folder_ / "none.json").string()), std::system_error);
}

TEST_F(LightFileCheckFolder, AFloodOfMistakesEnds) {
    std::string text = "{\"lights\": [{}";
    for (int i = 0; i < 1000; ++i)
        text += ",\n{}";
    const auto check = check_light_file(write("a.json", text + "]}"));
    EXPECT_EQ(check.errors.size(), Mistakes::most_collected);
    EXPECT_FALSE(check.complete);
}

TEST_F(LightFileCheckFolder, TheToolEndsWithStatus1) {
    const std::string path = write("a.json", "{\"lights\": [{}, {\"name\": 3}]}");
    std::ostringstream out;
    std::ostringstream err;
    EXPECT_EQ(lights_tool::validate({path}, out, err), 1);
    EXPECT_NE(err.str().find(path + ":1:13:"), std::string::npos) << err.str();
    EXPECT_NE(err.str().find(path + ":1:26:"), std::string::npos) << err.str();
}

TEST_F(LightFileCheckFolder, PhasesWithoutAColourTakeTheCharactersOwn) {
    const auto phases_of = [](const std::string& members) {
        const std::string text =
            R"({"lights": [{"name": "a", "position": [1, 2, 3], "intensity_cd": 5, )" + members + "}]}";
        return parse_light_file(text, "f.json").lights[0].rhythm.phases;
    };
    const auto red = phases_of(R"("character": "Fl R 3s", "phases": [{"lit": 0.5}, {"eclipse": 2.5}])");
    EXPECT_EQ(red[0], (Phase{0.5, true, Colour::red}));
    EXPECT_EQ(red[1], (Phase{2.5, false}));
    const auto in_turn = phases_of(R"("character": "Al WR 4s", "phases": [{"lit": 1}, {"lit": 3}])");
    EXPECT_EQ(in_turn[0], (Phase{1, true, Colour::white}));
    EXPECT_EQ(in_turn[1], (Phase{3, true, Colour::red}));
    EXPECT_EQ(phases_of(R"("phases": [{"lit": 1}, {"eclipse": 1}])")[0], (Phase{1, true, Colour::white}));
    EXPECT_TRUE(phases_of(R"("character": "Fl R 3s", "phases": [])").empty());
}

TEST_F(LightFileCheckFolder, PhasesOfS57ThatMissThePeriodAreReported) {
    const LightFile file = parse_light_file(
        R"x({"lights": [{"name": "a", "position": [1, 2, 3], "intensity_cd": 5, "character": "Fl R 5s",
        "sigseq": "00.8+(02.2)"}]})x",
        "f.json");
    ASSERT_EQ(file.warnings.size(), 1U);
    EXPECT_EQ(file.warnings[0].rfind("f.json:2:", 0), 0U) << file.warnings[0];
    EXPECT_NE(file.warnings[0].find("add up to 3 s, the period is 5 s"), std::string::npos);
}

TEST_F(LightFileCheckFolder, PhasesOfS57TakeTheCharactersColour) {
    const std::string before = R"({"lights": [{"name": "a", "position": [1, 2, 3], "intensity_cd": 5,)";
    const LightFile file =
        parse_light_file(before + R"x("character": "Fl R 3s", "sigseq": "00.8+(02.2)"}]})x", "f.json");
    const Rhythm& rhythm = file.lights[0].rhythm;
    ASSERT_EQ(rhythm.phases.size(), 2U);
    EXPECT_EQ(rhythm.phases[0], (Phase{0.8, true, Colour::red}));
    EXPECT_EQ(rhythm.phases[1].duration_s, 2.2);
    EXPECT_FALSE(rhythm.phases[1].lit);
    const auto error = errors_of(write("a.json", before + "\n\"sigseq\": \"00.8+02.2)\"}]}"));
    ASSERT_EQ(error.size(), 1U);
    EXPECT_EQ(error[0].rfind("2:11:", 0), 0U) << error[0];
}

}  // namespace
}  // namespace seaglare::lightdb
