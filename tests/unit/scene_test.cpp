// Scene and channel files: what is read, and where a mistake is reported.
#include "host_stub/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "lightdb/json/value.h"

namespace seaglare::host {
namespace {

const std::filesystem::path config = std::filesystem::path(SEAGLARE_SOURCE_DIR) / "config";

class SceneFile : public testing::Test {
  protected:
    void SetUp() override {
        folder = std::filesystem::temp_directory_path() /
                 ("seaglare_scene_test_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
                  "_" + testing::UnitTest::GetInstance()->current_test_info()->name());
        std::filesystem::create_directories(folder);
        write("channel.json", R"({"name": "c", "width_px": 1280, "height_px": 720, "vertical_fov_deg": 45})");
    }
    void TearDown() override { std::filesystem::remove_all(folder); }
    std::filesystem::path write(const char* name, const std::string& text) const {
        std::ofstream(folder / name) << text;
        return folder / name;
    }
    // A valid scene with `extra` members at its end, which stand on line 4.
    std::filesystem::path scene(const std::string& extra) const {
        return write("scene.json",
                     "{\"name\": \"s\", \"origin\": {\"lat\": 55, \"lon\": 11}, \"local_time_h\": 23,\n"
                     "\"sky\": {\"sun\": {\"elevation_deg\": -20, \"azimuth_deg\": 0}},\n"
                     "\"channels\": [\"channel.json\"],\n" +
                         extra + "}");
    }
    std::string error_of(const std::filesystem::path& path) const {
        try {
            load_scene(path);
        } catch (const json::Error& e) {
            return e.what();
        }
        return "no error";
    }
    std::filesystem::path folder;
    static constexpr const char* observers =
        "\"observers\": {\"o\": {\"lat\": 55, \"lon\": 11, \"heading_deg\": 90}}";
};

TEST_F(SceneFile, FourScenesOfTheProjectLoad) {
    for (const char* name :
         {"great_belt_night", "sonderborg_leading_line", "storebaelt_dusk", "thesis_many_lights"}) {
        const Scene s = load_scene(config / "scenes" / (std::string(name) + ".json"));
        EXPECT_EQ(s.name, name);
        EXPECT_FALSE(s.observers.empty());
        for (const auto& file : s.light_files)
            EXPECT_TRUE(std::filesystem::exists(file)) << file;
    }
}

TEST_F(SceneFile, ThesisSceneIsTheWorstCaseOf2012) {
    const Scene s = load_scene(config / "scenes/thesis_many_lights.json");
    ASSERT_TRUE(s.crowd);
    EXPECT_EQ(s.crowd->count, 1000U);
    EXPECT_EQ(s.channels.front().width_px, 1280);
    EXPECT_EQ(s.channels.front().height_px, 720);
    EXPECT_DOUBLE_EQ(s.channels.front().up_deg - s.channels.front().down_deg, 45);
}

TEST_F(SceneFile, MinimalSceneHasDefaultsAndItsOriginAtZero) {
    const Scene s = load_scene(scene(observers));
    ASSERT_EQ(s.observers.size(), 1U);
    EXPECT_NEAR(s.observers[0].position_m.x, 0, 1e-6);
    EXPECT_NEAR(s.observers[0].position_m.y, 0, 1e-6);
    EXPECT_FALSE(s.visibility_m);
    EXPECT_FALSE(s.adaptation_cd_m2);
    EXPECT_EQ(s.find_observer("nobody"), nullptr);
    EXPECT_EQ(s.find_observer(""), &s.observers[0]);
}

TEST_F(SceneFile, UnknownKeyIsReportedAtItsLineAndColumnWithTheNearestName) {
    const std::string e = error_of(scene(std::string(observers) + ", \"wether\": {}"));
    EXPECT_NE(e.find("scene.json:4:64:"), std::string::npos) << e;
    EXPECT_NE(e.find("'weather'"), std::string::npos) << e;
}

TEST_F(SceneFile, MissingObserversAreReported) {
    const std::string e = error_of(scene("\"seed\": 1"));
    EXPECT_NE(e.find("scene.json:"), std::string::npos) << e;
    EXPECT_NE(e.find("observers"), std::string::npos) << e;
}

TEST_F(SceneFile, ValueOutOfRangeIsReportedWhereItStands) {
    const std::string e =
        error_of(scene("\"observers\": {\"o\": {\"lat\": 95, \"lon\": 11, \"heading_deg\": 90}}"));
    EXPECT_NE(e.find("scene.json:4:28:"), std::string::npos) << e;
}

TEST_F(SceneFile, PlaceFarFromTheOriginIsRefused) {
    const std::string e =
        error_of(scene("\"observers\": {\"o\": {\"lat\": 59, \"lon\": 11, \"heading_deg\": 90}}"));
    EXPECT_NE(e.find("200 km"), std::string::npos) << e;
}

TEST_F(SceneFile, TornJsonIsReportedWithItsPlace) {
    const std::string e = error_of(write("scene.json", "{\"name\": \"s\",\n  \"origin\": {"));
    EXPECT_NE(e.find("scene.json:2:"), std::string::npos) << e;
}

TEST_F(SceneFile, MissingFileNamesThePath) {
    try {
        load_scene(folder / "nothing.json");
        FAIL();
    } catch (const std::system_error& e) {
        EXPECT_NE(std::string(e.what()).find("nothing.json"), std::string::npos) << e.what();
    }
}

TEST_F(SceneFile, ErrorInAChannelFileNamesTheChannelFile) {
    write("channel.json", "{\"name\": \"c\", \"width_px\": 0, \"height_px\": 720, \"vertical_fov_deg\": 45}");
    const std::string e = error_of(scene(observers));
    EXPECT_NE(e.find("channel.json:1:"), std::string::npos) << e;
}

TEST_F(SceneFile, StructureUpsideDownIsRefused) {
    const std::string e =
        error_of(scene(std::string(observers) +
                       ", \"structures\": [{\"name\": \"p\", \"from\": {\"lat\": 55, \"lon\": 11}, "
                       "\"to\": {\"lat\": 55.01, \"lon\": 11}, \"bottom_m\": 5, \"top_m\": 2}]"));
    EXPECT_NE(e.find("top_m must be above bottom_m"), std::string::npos) << e;
}

TEST(Channel, ResizingKeepsTheVerticalFieldAndSquarePixels) {
    constexpr double deg = std::numbers::pi / 180;
    Channel c = load_channel(config / "channels/bridge_45deg.json");
    c.resize(600, 800);
    EXPECT_DOUBLE_EQ(c.up_deg - c.down_deg, 45);
    const double focal_x = 600 / (std::tan(c.right_deg * deg) - std::tan(c.left_deg * deg));
    const double focal_y = 800 / (std::tan(c.up_deg * deg) - std::tan(c.down_deg * deg));
    EXPECT_NEAR(focal_x, focal_y, 1e-9 * focal_y);
}

}  // namespace
}  // namespace seaglare::host
