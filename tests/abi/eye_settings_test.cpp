// Eye files: the presets equal the built-in eyes, every key is read and held to its limits.
#include "plugin_api/eye_settings.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <set>
#include <string>
#include <utility>

#include "lightdb/json/value.h"
#include "plugin_api/settings.h"
#include "tests/abi/loaded_plugin.h"

namespace seaglare::plugin {
namespace {

glare::EyeModel eye_of_file(const std::string& name) {
    const json::Document document = json::parse_file(SEAGLARE_SOURCE_DIR "/config/eye/" + name + ".json");
    return read_eye(document.root(), glare::young_eye());
}

glare::EyeModel eye_of_text(const std::string& text) {
    const json::Document document = json::parse(text, "eye.json");
    return read_eye(document.root(), glare::young_eye());
}

// One preset, whether a program asks for it or an operator does.
TEST(EyeSettings, EveryFileIsTheBuiltInEyeOfItsName) {
    const std::array<std::pair<const char*, glare::EyeModel (*)()>, 6> presets = {
        {{"young", glare::young_eye},
         {"sixty", glare::sixty_year_eye},
         {"thesis", glare::thesis_eye},
         {"young_lashes", glare::young_eye_with_lashes},
         {"no_lash", glare::no_lash_eye},
         {"circular_pupil", glare::circular_pupil_eye}}};
    std::set<std::string> names;
    for (const auto& [name, built_in] : presets) {
        EXPECT_TRUE(eye_of_file(name) == built_in()) << name;
        names.insert(std::string(name) + ".json");
    }
    for (const auto& file : std::filesystem::directory_iterator(SEAGLARE_SOURCE_DIR "/config/eye"))
        EXPECT_TRUE(names.contains(file.path().filename().string())) << file.path() << " is not in this list";
}

TEST(EyeSettings, EveryKeyReachesItsPlace) {
    const glare::EyeModel eye = eye_of_text(R"({
        "age_years": 61, "pigmentation": 1, "fixed_pupil_mm": 4, "pupil_shrinks_with_age": true,
        "hippus_amplitude_mm": 0.3, "hippus_period_s": 2, "cie_tail": false, "calibrate": "cie_1999", "defocus_dioptre": -0.75,
        "vitreous_drag_per_s": 5, "adapts": true,
        "gratings": {"count": 5, "inner_radius_mm": 1, "outer_radius_mm": 2, "duty": 0.25, "depth": 0.5},
        "eyelashes": {"count": 7, "mean_angle_deg": 3, "spread_deg": 12, "width_um": 60, "length_mm": 6,
                      "curvature_per_mm": 0.2, "seed": 9, "streak_turn_deg": 4, "streak_bend_per_rad": -2},
        "lids": {"closure": 0.1, "blink_interval_s": 5, "blink_duration_s": 0.2, "squint": 0.4,
                 "squint_half_cd_m2": 100, "upper_margin_mm": 3, "lower_margin_mm": 4, "lower_share": 0.2,
                 "edge_radius_mm": 20},
        "accommodation": {"slow_dioptre": 0.3, "quick_dioptre": 0.1, "lens_strain_per_dioptre": 0.01,
                          "moves_focus": true},
        "particles": [{"count": 3, "min_diameter_um": 5, "max_diameter_um": 6, "exponent": 1,
                       "field_radius_mm": 2, "drift_um": 7, "drift_period_s": 8, "site": "vitreous"}]})");
    glare::EyeModel expected;
    expected.age_years = 61;
    expected.pigmentation = 1;
    expected.fixed_pupil_mm = 4;
    expected.pupil_shrinks_with_age = true;
    expected.hippus_amplitude_mm = 0.3;
    expected.hippus_period_s = 2;
    expected.cie_tail = false;
    expected.cie_calibrated = true;
    expected.defocus_dioptre = -0.75;
    expected.vitreous_drag_per_s = 5;
    expected.adapts = true;
    expected.gratings = {5, 1, 2, 0.25, 0.5};
    expected.eyelashes = {7, 3, 12, 60, 6, 0.2, 9, 4, -2};
    expected.lids = {0.1, {5, 0.2, 0.4, 100}, 3, 4, 0.2, 20};
    expected.accommodation = {0.3, 0.1, 0.01};
    expected.accommodation_moves_focus = true;
    expected.particles = {{3, 5, 6, 1, 2, 7, 8, glare::ParticleSite::vitreous}};
    EXPECT_TRUE(eye == expected);
}

TEST(EyeSettings, WhatIsOutOfRangeOrUnknownIsRefusedWithItsPlace) {
    for (const char* text :
         {R"({"eyelashes": {"count": -1}})", R"({"eyelashes": {"count": 65}})",
          R"({"eyelashes": {"width_um": 0}})", R"({"eyelashes": {"colour": 1}})", R"({"eyelashes": 4})",
          R"({"lids": {"closure": 1.5}})", R"({"lids": {"edge_radius_mm": 0}})",
          R"({"lids": {"blink_duration_s": 0}})", R"({"defocus_dioptre": 3.5})",
          R"({"accommodation": {"moves_focus": 1}})", R"({"accommodation": {"slow": 1}})",
          R"({"vitreous_drag_per_s": -1})", R"({"adapts": "yes"})",
          R"({"particles": [{"count": 1, "min_diameter_um": 1, "max_diameter_um": 2, "site": "iris"}]})"}) {
        try {
            eye_of_text(text);
            FAIL() << text;
        } catch (const json::Error& error) {
            EXPECT_EQ(std::string(error.what()).rfind("eye.json:1:", 0), 0U) << error.what();
        }
    }
}

}  // namespace
}  // namespace seaglare::plugin
