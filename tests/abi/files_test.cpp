// Files an operator breaks: the error says where, and what was loaded before stays.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/abi/loaded_plugin.h"

namespace {

using namespace seaglare::test;

constexpr const char* two_lights = R"({"lights": [
  {"name": "one", "position": [0, 1000, 10], "character": "Iso 4s", "intensity_cd": 100},
  {"name": "two", "position": [50, 1000, 10], "character": "F R", "intensity_cd": 50}
]})";

class Files : public ::testing::Test {
  protected:
    std::vector<seaglare_light_id> ids() const {
        std::uint32_t count = 0;
        plugin_->list_lights(context_, nullptr, 0, &count);
        std::vector<seaglare_light_id> all(count);
        plugin_->list_lights(context_, all.data(), count, &count);
        return all;
    }
    void expect_refused(const std::string& text, seaglare_result code, const std::string& place) {
        const TemporaryFile file("lights.json", text);
        const auto before = ids();
        EXPECT_EQ(plugin_->load_lights(context_, file.path()), code) << text;
        const std::string error = plugin_.last_error(context_);
        EXPECT_NE(error.find(file.path() + place), std::string::npos) << error;
        EXPECT_EQ(ids(), before);
    }

    LoadedPlugin plugin_;
    QuickContext context_{plugin_};
};

TEST_F(Files, GoodLightsAreAddedInTheirOrder) {
    const TemporaryFile file("lights.json", two_lights);
    ASSERT_EQ(plugin_->load_lights(context_, file.path()), SEAGLARE_OK) << plugin_.last_error(context_);
    const auto first = ids();
    EXPECT_EQ(first.size(), 2U);
    ASSERT_EQ(plugin_->load_lights(context_, file.path()), SEAGLARE_OK);
    const auto both = ids();
    ASSERT_EQ(both.size(), 4U);
    EXPECT_EQ(std::vector<seaglare_light_id>(both.begin(), both.begin() + 2), first);
}

TEST_F(Files, ABadFileLeavesTheOldLightsLit) {
    const TemporaryFile good("lights.json", two_lights);
    ASSERT_EQ(plugin_->load_lights(context_, good.path()), SEAGLARE_OK) << plugin_.last_error(context_);
    expect_refused("{\"lights\": [\n  {\"name\": \"torn", SEAGLARE_ERROR_PARSE, ":2:");
    expect_refused(R"({"lights": [{"name": "x", "position": [0,0,0], "intensity_cd": 1, "heigth_m": 3}]})",
                   SEAGLARE_ERROR_PARSE, ":1:");
    // The first light is good, the second is not: neither is taken.
    expect_refused(R"({"lights": [{"name": "a", "position": [0,0,0], "intensity_cd": 1},
{"name": "b", "position": [0,0], "intensity_cd": 1}]})",
                   SEAGLARE_ERROR_PARSE, ":2:");
    EXPECT_EQ(ids().size(), 2U);
}

TEST_F(Files, AMissingFileIsNamed) {
    EXPECT_EQ(plugin_->load_lights(context_, "/nonexistent/lights.json"), SEAGLARE_ERROR_FILE);
    EXPECT_NE(plugin_.last_error(context_).find("/nonexistent/lights.json"), std::string::npos);
    EXPECT_EQ(plugin_->load_config(context_, "/nonexistent/quality.json"), SEAGLARE_ERROR_FILE);
}

TEST_F(Files, AnUnknownKeyOfTheConfigurationHasASuggestion) {
    const TemporaryFile file("quality.json", "{\n  \"pattern\": { \"transfrom_size\": 512 }\n}");
    EXPECT_EQ(plugin_->load_config(context_, file.path()), SEAGLARE_ERROR_PARSE);
    const std::string error = plugin_.last_error(context_);
    EXPECT_NE(error.find(std::string(file.path()) + ":2:"), std::string::npos) << error;
    EXPECT_NE(error.find("transform_size"), std::string::npos) << error;
}

TEST_F(Files, AConfigurationOutOfRangeIsRefused) {
    for (const char* text :
         {R"({"pattern": {"transform_size": 1000}})", R"({"pattern": {"layer_radii_px": [1, 2]}})",
          R"({"pattern": {"layer_radii_px": [0, 2, 2]}})", R"({"tone": {"threshold_codes": -1}})",
          R"({"adaptation": {"by_time_of_day": []}})", R"({"eye": {"age_years": 1e9}})",
          R"({"eye": "no_such_eye.json"})", R"([])"}) {
        const TemporaryFile file("quality.json", text);
        const seaglare_result result = plugin_->load_config(context_, file.path());
        EXPECT_TRUE(result == SEAGLARE_ERROR_PARSE || result == SEAGLARE_ERROR_FILE)
            << text << ": " << result;
    }
}

TEST_F(Files, ABadConfigurationMakesNoContext) {
    const TemporaryFile file("quality.json", "{,}");
    auto info = sized<seaglare_create_info>();
    info.flags = SEAGLARE_CREATE_NO_OPENCL;
    info.config_path = file.path();
    seaglare_context* context = nullptr;
    EXPECT_EQ(plugin_->create(&info, &context), SEAGLARE_ERROR_PARSE);
    EXPECT_EQ(context, nullptr);
    EXPECT_NE(plugin_.last_error(nullptr).find(":1:2:"), std::string::npos) << plugin_.last_error(nullptr);
}

TEST_F(Files, TheShippedConfigurationLoads) {
    for (const auto& entry : std::filesystem::directory_iterator(SEAGLARE_SOURCE_DIR "/config/quality")) {
        EXPECT_EQ(plugin_->load_config(context_, entry.path().c_str()), SEAGLARE_DEGRADED)
            << plugin_.last_error(context_);
    }
    EXPECT_EQ(plugin_->load_config(context_, SEAGLARE_SOURCE_DIR "/config"), SEAGLARE_DEGRADED);
    int light_files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(SEAGLARE_SOURCE_DIR "/config/lights")) {
        if (entry.path().extension() != ".json") continue;
        EXPECT_EQ(plugin_->load_lights(context_, entry.path().c_str()), SEAGLARE_OK)
            << plugin_.last_error(context_);
        ++light_files;
    }
    EXPECT_GT(light_files, 0);
}

}  // namespace
