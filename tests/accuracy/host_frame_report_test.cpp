// seaglare-report accuracy in its quick form on one small scene, and the parts it is made of.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "host_stub/headless.h"
#include "host_stub/report/commands.h"
#include "host_stub/report/frame_points.h"
#include "host_stub/report/progress.h"
#include "host_stub/report/quality_file.h"
#include "plugin_api/settings.h"

namespace seaglare::report {
namespace {

namespace fs = std::filesystem;

class FrameReport : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("seaglare_frame_report_" + std::to_string(getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
    }
    std::string read(const std::string& name) const {
        std::ifstream file(folder_ / name);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    // A small picture, an eye with a small pupil, lamps that are points: seconds instead of minutes.
    void write_small_scene() const {
        write("quality.json", R"({
      "eye": {"fixed_pupil_mm": 2, "hippus_amplitude_mm": 0, "gratings": {"count": 0}, "particles": [
        {"count": 300, "min_diameter_um": 20, "max_diameter_um": 100, "exponent": 2.5, "site": "cornea"}]},
      "display": {"white": 2, "composite": "difference"},
      "pattern": {"transform_size": 1024, "plane_width_mm": 4, "max_radius_nodes": 24, "layer_radii_px": [0, 1.5, 3]},
      "adaptation": {"by_time_of_day": [{"hour": 12, "luminance_cd_m2": 0.01}]}
    })");
        write("channel.json",
              R"({"name": "small", "width_px": 160, "height_px": 120, "vertical_fov_deg": 8})");
        write("scene.json", R"({
      "name": "small", "description": "A dozen lights.", "origin": {"lat": 55, "lon": 11},
      "local_time_h": 0, "start_s": 1,
      "sky": {"sun": {"elevation_deg": -26, "azimuth_deg": 5}, "night_luminance_cd_m2": 0.0005, "stars": false},
      "adaptation_luminance_cd_m2": 0.01,
      "weather": {"wind_speed_m_s": 4, "wind_from_deg": 250},
      "observers": {"bridge": {"east_m": 0, "north_m": 0, "eye_height_m": 100, "heading_deg": 0}},
      "channels": ["channel.json"], "quality": "quality.json",
      "crowd": {"count": 12, "seed": 3, "distance_m": [400, 4000], "intensity_cd": [20, 2000],
                "radius_m": [0.001, 0.002], "margin": 0.1, "sway_m": 0, "flashing": 0}
    })");
    }
    // Rows of a CSV by the names of its columns.
    std::vector<std::map<std::string, std::string>> rows(const std::string& name) const {
        std::istringstream text(read(name));
        const auto split = [](const std::string& line) {
            std::vector<std::string> fields;
            std::istringstream in(line);
            for (std::string field; std::getline(in, field, ',');)
                fields.push_back(field);
            return fields;
        };
        std::string line;
        std::getline(text, line);
        const std::vector<std::string> columns = split(line);
        std::vector<std::map<std::string, std::string>> result;
        while (std::getline(text, line)) {
            const std::vector<std::string> fields = split(line);
            auto& row = result.emplace_back();
            for (std::size_t i = 0; i < fields.size() && i < columns.size(); ++i)
                row[columns[i]] = fields[i];
        }
        return result;
    }
    fs::path folder_;
};

TEST_F(FrameReport, AChangedQualityIsTheOldOneButForTheChange) {
    const fs::path base = fs::path(SEAGLARE_SOURCE_DIR) / "config/quality/default.json";
    const plugin::Settings before = plugin::load_settings(base.string());
    write_quality(base,
                  {{"pattern.transform_size", "1024"},
                   {"pattern.wide_field", ""},
                   {"display.dither", "false"},
                   {"eye.age_years", "60"}},
                  folder_ / "changed.json");
    const plugin::Settings after = plugin::load_settings((folder_ / "changed.json").string());
    EXPECT_EQ(after.pattern.transform_size, 1024);
    EXPECT_EQ(after.pattern.wide_field_size, 0);
    EXPECT_EQ(after.pattern.wavelengths, before.pattern.wavelengths);
    EXPECT_FALSE(after.tone.dither);
    EXPECT_EQ(after.tone.white, before.tone.white);
    glare::EyeModel eye = before.eye;
    eye.age_years = 60;
    EXPECT_EQ(after.eye, eye);
}

TEST_F(FrameReport, TheTimeLeftIsToldWhenItCanBeKnown) {
    EXPECT_EQ(time_left(1, 0.5), "") << "too early";
    EXPECT_EQ(time_left(100, 0.01), "") << "too little is done";
    EXPECT_EQ(time_left(30, 0.5), ", about 30 s left");
    EXPECT_EQ(time_left(60, 0.25), ", about 3 min left");
    EXPECT_EQ(time_left(60, 1), ", about 0 s left");
}

TEST_F(FrameReport, TheFrontHasThePointsThatNoneBeats) {
    write_points(folder_, "points", {{"slow", 9, 1}, {"beaten", 9, 5}, {"fast", 1, 6}, {"middle", 4, 3}},
                 "ms", "codes");
    const auto front = rows("points_front.csv");
    ASSERT_EQ(front.size(), 3U);
    EXPECT_EQ(front[0].at("name"), "fast");
    EXPECT_EQ(front[1].at("name"), "middle");
    EXPECT_EQ(front[2].at("name"), "slow");
    EXPECT_EQ(rows("points.csv").size(), 4U);
}

TEST_F(FrameReport, AQuickReportOfASmallSceneKeepsItsBudgets) {
    write_small_scene();
    FrameOptions options;
    options.out = folder_ / "report";
    options.plugin = SEAGLARE_PLUGIN_FILE;
    options.step_nm = 40;
    options.quick = true;
    ASSERT_EQ(accuracy_command(options, {folder_ / "scene.json"}), 0);

    std::map<std::string, std::map<std::string, std::string>> by_value;
    for (const auto& row : rows("report/accuracy.csv"))
        by_value[row.at("value")] = row;
    ASSERT_TRUE(by_value.contains("as shipped"));
    const auto number = [&](const std::string& value, const std::string& column) {
        return std::stod(by_value.at(value).at(column));
    };
    // With nothing left out, the sum is that in double precision, to what halves of floats in the pattern cost.
    EXPECT_LT(number("0 codes", "sum max codes"), 0.15);
    EXPECT_NEAR(number("0 codes", "sum energy"), 1, 2e-3);
    // A budget is kept, and a larger one leaves out no less.
    EXPECT_LE(number("1 codes", "sum max codes"), 1);
    EXPECT_LE(number("4 codes", "sum max codes"), 4);
    EXPECT_LE(number("0 codes", "sum mean codes"), number("4 codes", "sum mean codes") + 1e-3);
    // Against what the eye would have, no budget helps beyond the pattern's own error; energy is right to a few per cent.
    EXPECT_NEAR(number("0 codes", "eye energy"), 1, 0.05);
    EXPECT_GT(number("0 codes", "eye max codes"), 0);
    EXPECT_LT(number("0 codes", "eye mean codes"), 2);
    // The bytes in the target differ by no more than the codes do, and rounding.
    EXPECT_LE(number("0 codes", "shown max"), number("0 codes", "eye max codes") + 1.5);

    EXPECT_TRUE(fs::exists(folder_ / "report/small_difference.png"));
    EXPECT_NE(read("report/index.html").find("small_reference.png"), std::string::npos);
    EXPECT_FALSE(fs::is_empty(folder_ / "report/cache"));
}

TEST_F(FrameReport, GrowthWithTheLightsStandsBesideTheSquaresOf2012) {
    write_small_scene();
    FrameOptions options;
    options.out = folder_ / "report";
    options.plugin = SEAGLARE_PLUGIN_FILE;
    options.quick = true;
    ASSERT_EQ(speed_command(options, {}, folder_ / "scene.json", {6, 12}), 0);
    std::map<std::string, int> rows_of;
    for (const auto& row : rows("report/lights.csv")) {
        const std::string& way = row.at("way");
        ++rows_of[way];
        EXPECT_GT(std::stod(row.at("frame ms")), 0) << way;
        EXPECT_FALSE(row.contains("remark")) << way << ": nothing is left out";
        if (way.starts_with("512")) continue;
        EXPECT_LE(std::stod(row.at("max codes")), 1) << way << ": the budget of a small quality file";
        EXPECT_GT(std::stod(row.at("x accumulation")), 0) << way;
    }
    for (const char* const way : {"512² billboards in RGBA32F", "512² billboards in RGBA16F",
                                  "the plan's choice", "GL billboards", "OpenCL tiles"})
        EXPECT_EQ(rows_of[way], 2) << way;
    EXPECT_NE(read("report/index.html").find("From 6 to 12 lights"), std::string::npos);
    EXPECT_EQ(read("report/index.html").find("or was interrupted"), std::string::npos)
        << "it came to its end";
}

}  // namespace
}  // namespace seaglare::report
