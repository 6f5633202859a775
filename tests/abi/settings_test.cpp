// The configuration as values: what is built in, what the files say, and the time-of-day table between its rows.
#include "plugin_api/settings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <string>

#include "lightdb/json/value.h"
#include "tests/abi/loaded_plugin.h"

namespace {

using namespace seaglare;

void expect_equal(const plugin::Settings& a, const plugin::Settings& b) {
    EXPECT_EQ(a.eye.age_years, b.eye.age_years);
    EXPECT_EQ(a.eye.pigmentation, b.eye.pigmentation);
    EXPECT_EQ(a.eye.fixed_pupil_mm, b.eye.fixed_pupil_mm);
    EXPECT_EQ(a.eye.hippus_amplitude_mm, b.eye.hippus_amplitude_mm);
    EXPECT_EQ(a.eye.hippus_period_s, b.eye.hippus_period_s);
    EXPECT_EQ(a.eye.cie_tail, b.eye.cie_tail);
    EXPECT_EQ(a.eye.gratings.count, b.eye.gratings.count);
    EXPECT_EQ(a.eye.gratings.inner_radius_mm, b.eye.gratings.inner_radius_mm);
    EXPECT_EQ(a.eye.gratings.outer_radius_mm, b.eye.gratings.outer_radius_mm);
    EXPECT_EQ(a.eye.gratings.duty, b.eye.gratings.duty);
    EXPECT_EQ(a.eye.gratings.depth, b.eye.gratings.depth);
    ASSERT_EQ(a.eye.particles.size(), b.eye.particles.size());
    for (std::size_t i = 0; i < a.eye.particles.size(); ++i) {
        EXPECT_EQ(a.eye.particles[i].count, b.eye.particles[i].count);
        EXPECT_EQ(a.eye.particles[i].min_diameter_um, b.eye.particles[i].min_diameter_um);
        EXPECT_EQ(a.eye.particles[i].max_diameter_um, b.eye.particles[i].max_diameter_um);
        EXPECT_EQ(a.eye.particles[i].exponent, b.eye.particles[i].exponent);
        EXPECT_EQ(a.eye.particles[i].field_radius_mm, b.eye.particles[i].field_radius_mm);
        EXPECT_EQ(a.eye.particles[i].drift_um, b.eye.particles[i].drift_um);
        EXPECT_EQ(a.eye.particles[i].drift_period_s, b.eye.particles[i].drift_period_s);
    }
    EXPECT_EQ(a.pattern.transform_size, b.pattern.transform_size);
    EXPECT_EQ(a.pattern.plane_width_mm, b.pattern.plane_width_mm);
    EXPECT_EQ(a.pattern.wavelengths, b.pattern.wavelengths);
    EXPECT_EQ(a.pattern.wavelength_step_px, b.pattern.wavelength_step_px);
    EXPECT_EQ(a.pattern.angular_scale, b.pattern.angular_scale);
    EXPECT_EQ(a.pattern.max_radius_nodes, b.pattern.max_radius_nodes);
    EXPECT_EQ(a.pattern.layer_radii_px, b.pattern.layer_radii_px);
    EXPECT_EQ(a.pattern.core_radius_nodes, b.pattern.core_radius_nodes);
    EXPECT_EQ(a.pattern.spectra, b.pattern.spectra);
    EXPECT_EQ(a.pattern.max_lamps_in_view, b.pattern.max_lamps_in_view);
    EXPECT_EQ(a.tone.white, b.tone.white);
    EXPECT_EQ(a.tone.mode, b.tone.mode);
    EXPECT_EQ(a.tone.blue_shift, b.tone.blue_shift);
    EXPECT_EQ(a.pattern.wide_field_size, b.pattern.wide_field_size);
    EXPECT_EQ(a.pattern.wide_field_interval_s, b.pattern.wide_field_interval_s);
    EXPECT_EQ(a.tone.dither, b.tone.dither);
    EXPECT_EQ(a.tone.threshold_codes, b.tone.threshold_codes);
    ASSERT_EQ(a.adaptation.entries.size(), b.adaptation.entries.size());
    for (std::size_t i = 0; i < a.adaptation.entries.size(); ++i) {
        EXPECT_EQ(a.adaptation.entries[i].hour, b.adaptation.entries[i].hour);
        EXPECT_EQ(a.adaptation.entries[i].luminance_cd_m2, b.adaptation.entries[i].luminance_cd_m2);
    }
    EXPECT_EQ(a.default_time_of_day_h, b.default_time_of_day_h);
    EXPECT_EQ(a.geographic_horizon, b.geographic_horizon);
}

TEST(Settings, BuiltInDefaultsAreThoseOfTheDefaultFile) {
    expect_equal(plugin::default_settings(),
                 plugin::load_settings(SEAGLARE_SOURCE_DIR "/config/quality/default.json"));
    expect_equal(plugin::default_settings(), plugin::load_settings(SEAGLARE_SOURCE_DIR "/config"));
}

glare::PatternSettings pattern_of(const std::string& text) {
    const std::string path = testing::TempDir() + "seaglare_wide_field.json";
    std::ofstream(path) << text;
    return plugin::load_settings(path).pattern;
}

TEST(Settings, AWideFieldIsLargerThanTheTransformOfEveryFrame) {
    const auto two = pattern_of(
        R"({"pattern": {"transform_size": 1024, "wide_field": {"transform_size": 2048, "interval_s": 1.5}}})");
    EXPECT_EQ(two.transform_size, 1024);
    EXPECT_EQ(two.wide_field_size, 2048);
    EXPECT_EQ(two.wide_field_interval_s, 1.5);
    // A file that names one transform means one.
    EXPECT_EQ(pattern_of(R"({"pattern": {"transform_size": 4096}})").wide_field_size, 0);
    EXPECT_EQ(pattern_of(R"({"pattern": {"wavelengths": 40}})").wide_field_size, 4096);
    for (const char* wrong :
         {R"({"pattern": {"transform_size": 2048, "wide_field": {"transform_size": 2048}}})",
          R"({"pattern": {"wide_field": {"transform_size": 3000}}})",
          R"({"pattern": {"wide_field": {"interval_s": 0}}})", R"({"pattern": {"wide_field": {"size": 1}}})"})
        EXPECT_THROW(pattern_of(wrong), json::Error) << wrong;
}

// One preset, whether a program asks for it or an operator does.
TEST(Settings, TheThesisFileIsTheThesisPreset) {
    plugin::Settings preset = plugin::default_settings();
    preset.eye = glare::thesis_eye();
    preset.pattern = glare::thesis_settings();
    preset.tone.mode = glare::CompositeMode::plain;
    expect_equal(preset, plugin::load_settings(SEAGLARE_SOURCE_DIR "/config/quality/thesis.json"));
}

TEST(Settings, TheEyeFileOfSixtyYearsIsThatEye) {
    plugin::Settings expected = plugin::default_settings();
    expected.eye = glare::sixty_year_eye();
    const test::TemporaryFile quality("sixty.json",
                                      R"({"eye": ")" SEAGLARE_SOURCE_DIR R"(/config/eye/sixty.json"})");
    expect_equal(expected, plugin::load_settings(quality.path()));
}

TEST(Settings, MoreDiscLayersThanAreDrawnAreRefused) {
    const test::TemporaryFile eight("eight.json", R"({"pattern": {"layer_radii_px": [0,1,2,3,4,5,6,7]}})");
    EXPECT_EQ(plugin::load_settings(eight.path()).pattern.layer_radii_px.size(), 8U);
    const test::TemporaryFile nine("nine.json", R"({"pattern": {"layer_radii_px": [0,1,2,3,4,5,6,7,8]}})");
    EXPECT_THROW(plugin::load_settings(nine.path()), json::Error);
    const json::Document schema = json::parse_file(SEAGLARE_SOURCE_DIR "/config/schema/quality.schema.json");
    const json::Value* pattern = schema.root().find("properties")->find("pattern")->find("properties");
    EXPECT_EQ(pattern->find("layer_radii_px")->find("maxItems")->number(), glare::most_layers);
}

// The keys of an object of the schema against those that a file with every key has.
void expect_same_keys(const json::Value& schema, const json::Value& file, const std::string& where) {
    const json::Value* properties = schema.find("properties");
    ASSERT_NE(properties, nullptr) << where;
    std::set<std::string> known, used;
    for (const auto& [name, value] : properties->object()) {
        if (value.find("deprecated") == nullptr) known.insert(std::string(name));
    }
    for (const auto& [name, value] : file.object()) {
        used.insert(std::string(name));
        const json::Value* inner = properties->find(name);
        if (inner != nullptr && value.kind() == json::Kind::object)
            expect_same_keys(*inner, value, where + "/" + std::string(name));
    }
    EXPECT_EQ(known, used) << where;
}

TEST(Settings, ABridgeHasTheDefaultsAndPinsTheCostsToWhatTheyAreWithoutMeasurement) {
    const plugin::Settings bridge = plugin::load_settings(SEAGLARE_SOURCE_DIR "/config/quality/bridge.json");
    expect_equal(plugin::default_settings(), bridge);
    glare::DeviceCosts costs;
    costs.pinned = true;
    EXPECT_EQ(bridge.pinned_costs, costs);
    EXPECT_FALSE(plugin::default_settings().pinned_costs.has_value());
}

TEST(Settings, TheSchemasKnowTheKeysOfFullFiles) {
    const std::string config = SEAGLARE_SOURCE_DIR "/config/";
    for (const auto& [schema_name, file_name] :
         {std::pair{"quality", "quality/bridge"}, {"display", "display/monitor"}, {"eye", "eye/young"}}) {
        const json::Document schema = json::parse_file(config + "schema/" + schema_name + ".schema.json");
        const json::Document file = json::parse_file(config + file_name + ".json");
        expect_same_keys(schema.root(), file.root(), schema_name);
    }
}

TEST(TimeOfDay, PassesThroughItsRowsAndInterpolatesTheLogarithm) {
    const plugin::TimeOfDayTable table{{{6, 0.01}, {8, 100}}};
    EXPECT_NEAR(table.luminance_cd_m2(6), 0.01, 1e-12);
    EXPECT_NEAR(table.luminance_cd_m2(7), 1, 1e-12);
    EXPECT_NEAR(table.luminance_cd_m2(8), 100, 1e-9);
}

TEST(TimeOfDay, RunsThroughMidnight) {
    const plugin::TimeOfDayTable table{{{2, 1}, {22, 1e-4}}};
    EXPECT_NEAR(table.luminance_cd_m2(0), 0.01, 1e-9);
    EXPECT_NEAR(table.luminance_cd_m2(24), 0.01, 1e-9);
    EXPECT_NEAR(table.luminance_cd_m2(23), 1e-3, 1e-9);
}

TEST(TimeOfDay, IsContinuousAndPositiveAllDay) {
    const plugin::TimeOfDayTable table = plugin::default_settings().adaptation;
    double last = table.luminance_cd_m2(0);
    for (int minute = 1; minute <= 24 * 60; ++minute) {
        const double now = table.luminance_cd_m2(minute / 60.0);
        EXPECT_GT(now, 0);
        EXPECT_LT(std::abs(std::log10(now / last)), 0.1) << "at minute " << minute;
        last = now;
    }
    EXPECT_NEAR(last, table.luminance_cd_m2(0), 1e-12);
}

TEST(TimeOfDay, OfOneRowIsConstant) {
    const plugin::TimeOfDayTable table{{{12, 5}}};
    for (const double hour : {0.0, 11.9, 12.0, 23.0})
        EXPECT_NEAR(table.luminance_cd_m2(hour), 5, 1e-12);
}

}  // namespace
