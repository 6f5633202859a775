// The budget of a quality file: one meaning under its new name and its old, and pinned costs.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "lightdb/json/value.h"
#include "plugin_api/settings.h"

namespace seaglare::plugin {
namespace {

class BudgetSettings : public testing::Test {
  protected:
    void SetUp() override {
        file_ = std::filesystem::temp_directory_path() /
                (std::string("seaglare_") + testing::UnitTest::GetInstance()->current_test_info()->name() +
                 ".json");
    }
    void TearDown() override { std::filesystem::remove(file_); }
    Settings load(const std::string& text) const {
        std::ofstream(file_) << text;
        return load_settings(file_.string());
    }
    std::filesystem::path file_;
};

TEST_F(BudgetSettings, DefaultsAreThoseOfTheShippedFile) {
    const Settings shipped = load_settings(SEAGLARE_SOURCE_DIR "/config/quality/default.json");
    const Settings built_in = default_settings();
    EXPECT_EQ(shipped.budget.max_error_codes, built_in.budget.max_error_codes);
    EXPECT_EQ(shipped.budget.time_ms, built_in.budget.time_ms);
    EXPECT_EQ(shipped.budget.most_error_codes, built_in.budget.most_error_codes);
    EXPECT_FALSE(shipped.pinned_costs.has_value());
    EXPECT_EQ(built_in.budget.max_error_codes, 0.5);
    EXPECT_EQ(built_in.budget.time_ms, 0);
}

TEST_F(BudgetSettings, TheOlderNameMeansTheSame) {
    const Settings older = load(R"({"tone": {"threshold_codes": 1.5}})");
    const Settings newer = load(R"({"budget": {"max_error_codes": 1.5}})");
    EXPECT_EQ(older.budget.max_error_codes, 1.5);
    EXPECT_EQ(newer.budget.max_error_codes, 1.5);
    EXPECT_EQ(load(R"({"tone": {"threshold_codes": 0}})").budget.max_error_codes, 0);
    EXPECT_EQ(load(R"({"tone": {"threshold_codes": 1.5}, "budget": {"time_ms": 8}})").budget.max_error_codes,
              1.5);
    try {
        load(R"({"tone": {"threshold_codes": 1}, "budget": {"max_error_codes": 1}})");
        FAIL() << "both names were taken";
    } catch (const json::Error& error) {
        EXPECT_NE(std::string(error.what()).find("max_error_codes"), std::string::npos);
    }
}

TEST_F(BudgetSettings, WhatIsOutOfRangeIsRefused) {
    EXPECT_EQ(load(R"({"budget": {"time_ms": 8}})").budget.time_ms, 8);
    EXPECT_THROW(load(R"({"budget": {"max_error_codes": -1}})"), json::Error);
    EXPECT_THROW(load(R"({"budget": {"max_error_codes": 17}})"), json::Error);
    EXPECT_THROW(load(R"({"budget": {"time_ms": -1}})"), json::Error);
    EXPECT_THROW(load(R"({"budget": {"milliseconds": 8}})"), json::Error);
}

TEST_F(BudgetSettings, PinnedCostsAreTheWholeList) {
    const Settings pinned = load(R"({"device_costs": {"gl_skirt_px_ns": 0.5, "cl_light_px_ns": 0.25}})");
    ASSERT_TRUE(pinned.pinned_costs.has_value());
    EXPECT_TRUE(pinned.pinned_costs->pinned);
    EXPECT_EQ(pinned.pinned_costs->of(glare::Work::gl_skirt_px), 0.5);
    EXPECT_EQ(pinned.pinned_costs->of(glare::Work::cl_light_px), 0.25);
    EXPECT_EQ(pinned.pinned_costs->of(glare::Work::cl_pass), glare::DeviceCosts{}.of(glare::Work::cl_pass));
    EXPECT_THROW(load(R"({"device_costs": {"gl_skirt_ns": 1}})"), json::Error);
    EXPECT_THROW(load(R"({"device_costs": {"gl_skirt_px_ns": -1}})"), json::Error);
}

// Of a file that names work there no longer is, the nearest name would be work of another kind.
TEST_F(BudgetSettings, WorkThatThereIsNotIsRefusedWithTheListOfWhatThereIs) {
    try {
        load("{\n  \"device_costs\": {\n    \"fft_pass_ns\": 1e6\n  }\n}");
        FAIL() << "it was taken";
    } catch (const json::Error& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find(":3:5: "), std::string::npos) << text;
        EXPECT_NE(text.find("'fft_pass_ns'"), std::string::npos) << text;
        EXPECT_EQ(text.find("did you mean"), std::string::npos) << text;
        for (std::size_t i = 0; i < glare::work_kinds; ++i) {
            const std::string name = std::string(glare::name_of(static_cast<glare::Work>(i))) + "_ns";
            EXPECT_NE(text.find("'" + name + "'"), std::string::npos) << text;
        }
    }
}

TEST(DeviceCosts, LearningGoesTowardsWhatFramesTake) {
    glare::DeviceCosts costs;
    const double before = costs.of(glare::Work::composite_px);
    for (int i = 0; i < 200; ++i) {
        const double predicted = costs.of(glare::Work::composite_px) / before;
        learn(costs, {glare::Work::composite_px}, predicted, 3);
    }
    EXPECT_NEAR(costs.of(glare::Work::composite_px) / before, 3, 0.01);
    // One hitch counts for little, and nothing that is no time counts.
    const glare::DeviceCosts learned = costs;
    learn(costs, {glare::Work::composite_px}, 3, 3000);
    EXPECT_LT(costs.of(glare::Work::composite_px), 1.08 * learned.of(glare::Work::composite_px));
    glare::DeviceCosts pinned = learned;
    pinned.pinned = true;
    const glare::DeviceCosts as_pinned = pinned;
    learn(pinned, {glare::Work::composite_px}, 1, 100);
    learn(pinned, {glare::Work::composite_px}, 0, -1);
    EXPECT_EQ(pinned, as_pinned);
}

}  // namespace
}  // namespace seaglare::plugin
