// The public header: any compiler of a host takes it, and a released layout never changes.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <string>

#include "plugin_api/seaglare.h"

namespace {

// Compiles the header alone, in a language, with every padding byte an error.
int compile(const std::string& compiler, const std::string& language, const std::string& standard) {
    const std::string command =
        compiler + " -x " + language + " -std=" + standard +
        " -Wall -Wextra -Wpedantic -Wpadded -Wconversion -Werror -fsyntax-only " SEAGLARE_SOURCE_DIR
        "/plugin_api/seaglare.h";
    return std::system(command.c_str());
}

TEST(Header, CompilesAsC99WithoutPadding) {
    EXPECT_EQ(compile(SEAGLARE_C_COMPILER, "c", "c99"), 0);
}
TEST(Header, CompilesAsC11WithoutPadding) {
    EXPECT_EQ(compile(SEAGLARE_C_COMPILER, "c", "c11"), 0);
}
TEST(Header, CompilesAsCpp11WithoutPadding) {
    EXPECT_EQ(compile(SEAGLARE_CXX_COMPILER, "c++", "c++11"), 0);
}
TEST(Header, CompilesAsCpp20WithoutPadding) {
    EXPECT_EQ(compile(SEAGLARE_CXX_COMPILER, "c++", "c++20"), 0);
}

TEST(Header, IncludesStdintAndNothingElse) {
    std::ifstream file(SEAGLARE_SOURCE_DIR "/plugin_api/seaglare.h");
    ASSERT_TRUE(file);
    int includes = 0;
    for (std::string line; std::getline(file, line);) {
        if (!std::regex_search(line, std::regex(R"(^\s*#\s*include)"))) continue;
        ++includes;
        EXPECT_NE(line.find("<stdint.h>"), std::string::npos) << line;
    }
    EXPECT_EQ(includes, 1);
}

// ABI 1.0 on 64-bit machines, frozen: fields may be added at the end of a struct, nothing here may change.
#define EXPECT_OFFSET(type, field, bytes) \
    EXPECT_EQ(offsetof(type, field), std::size_t{bytes}) << #type "." #field

TEST(Layout, OfCreateInfoIsFrozen) {
    EXPECT_EQ(sizeof(seaglare_create_info), 72U);
    EXPECT_OFFSET(seaglare_create_info, struct_size, 0);
    EXPECT_OFFSET(seaglare_create_info, flags, 4);
    EXPECT_OFFSET(seaglare_create_info, axes, 8);
    EXPECT_OFFSET(seaglare_create_info, earth, 12);
    EXPECT_OFFSET(seaglare_create_info, origin_latitude_deg, 16);
    EXPECT_OFFSET(seaglare_create_info, origin_longitude_deg, 24);
    EXPECT_OFFSET(seaglare_create_info, origin_height_m, 32);
    EXPECT_OFFSET(seaglare_create_info, seed, 40);
    EXPECT_OFFSET(seaglare_create_info, config_path, 48);
    EXPECT_OFFSET(seaglare_create_info, log, 56);
    EXPECT_OFFSET(seaglare_create_info, log_user, 64);
}

TEST(Layout, OfLightIsFrozen) {
    EXPECT_EQ(sizeof(seaglare_light), 88U);  // 80 before there was a spectrum
    EXPECT_OFFSET(seaglare_light, struct_size, 0);
    EXPECT_OFFSET(seaglare_light, flags, 4);
    EXPECT_OFFSET(seaglare_light, position_m, 8);
    EXPECT_OFFSET(seaglare_light, intensity_cd, 32);
    EXPECT_OFFSET(seaglare_light, nominal_range_nm, 40);
    EXPECT_OFFSET(seaglare_light, radius_m, 48);
    EXPECT_OFFSET(seaglare_light, character, 56);
    EXPECT_OFFSET(seaglare_light, name, 64);
    EXPECT_OFFSET(seaglare_light, body_id, 72);
    EXPECT_OFFSET(seaglare_light, colour, 76);
    EXPECT_OFFSET(seaglare_light, spectrum, 80);
}

TEST(Layout, OfLightUpdateIsFrozen) {
    EXPECT_EQ(sizeof(seaglare_light_update), 88U);
    EXPECT_OFFSET(seaglare_light_update, struct_size, 0);
    EXPECT_OFFSET(seaglare_light_update, set, 4);
    EXPECT_OFFSET(seaglare_light_update, id, 8);
    EXPECT_OFFSET(seaglare_light_update, position_m, 16);
    EXPECT_OFFSET(seaglare_light_update, orientation, 40);
    EXPECT_OFFSET(seaglare_light_update, intensity_cd, 72);
    EXPECT_OFFSET(seaglare_light_update, visibility, 80);
    EXPECT_OFFSET(seaglare_light_update, on, 84);
}

TEST(Layout, OfViewInfoIsFrozen) {
    EXPECT_EQ(sizeof(seaglare_view_info), 32U);
    EXPECT_OFFSET(seaglare_view_info, struct_size, 0);
    EXPECT_OFFSET(seaglare_view_info, flags, 4);
    EXPECT_OFFSET(seaglare_view_info, get_proc, 8);
    EXPECT_OFFSET(seaglare_view_info, get_proc_user, 16);
    EXPECT_OFFSET(seaglare_view_info, channel_name, 24);
}

TEST(Layout, OfVisibilityQueryIsFrozen) {
    EXPECT_EQ(sizeof(seaglare_visibility_query), 40U);
    EXPECT_OFFSET(seaglare_visibility_query, id, 0);
    EXPECT_OFFSET(seaglare_visibility_query, position_m, 8);
    EXPECT_OFFSET(seaglare_visibility_query, visibility, 32);
    EXPECT_OFFSET(seaglare_visibility_query, reserved, 36);
}

TEST(Layout, OfFrameIsFrozen) {
    EXPECT_EQ(sizeof(seaglare_frame), 416U);
    EXPECT_OFFSET(seaglare_frame, struct_size, 0);
    EXPECT_OFFSET(seaglare_frame, flags, 4);
    EXPECT_OFFSET(seaglare_frame, target_fbo, 8);
    EXPECT_OFFSET(seaglare_frame, target_encoding, 12);
    EXPECT_OFFSET(seaglare_frame, viewport_px, 16);
    EXPECT_OFFSET(seaglare_frame, depth_source, 32);
    EXPECT_OFFSET(seaglare_frame, depth_object, 36);
    EXPECT_OFFSET(seaglare_frame, depth_convention, 40);
    EXPECT_OFFSET(seaglare_frame, depth_origin_px, 44);
    EXPECT_OFFSET(seaglare_frame, reserved, 52);
    EXPECT_OFFSET(seaglare_frame, depth_log_c, 56);
    EXPECT_OFFSET(seaglare_frame, depth_log_far_m, 64);
    EXPECT_OFFSET(seaglare_frame, view_from_world, 72);
    EXPECT_OFFSET(seaglare_frame, clip_from_view, 200);
    EXPECT_OFFSET(seaglare_frame, time_s, 328);
    EXPECT_OFFSET(seaglare_frame, frame_interval_s, 336);
    EXPECT_OFFSET(seaglare_frame, adaptation_luminance_cd_m2, 344);
    EXPECT_OFFSET(seaglare_frame, local_time_of_day_h, 352);
    EXPECT_OFFSET(seaglare_frame, ldr_white_luminance_cd_m2, 360);
    EXPECT_OFFSET(seaglare_frame, meteorological_visibility_m, 368);
    EXPECT_OFFSET(seaglare_frame, visibility, 376);
    EXPECT_OFFSET(seaglare_frame, visibility_user, 384);
    EXPECT_OFFSET(seaglare_frame, head_rate_rad_s, 392);
}

TEST(Layout, OfEyeStateIsFrozen) {
    EXPECT_EQ(sizeof(seaglare_eye_state), 120U);
    EXPECT_OFFSET(seaglare_eye_state, struct_size, 0);
    EXPECT_OFFSET(seaglare_eye_state, flags, 4);
    EXPECT_OFFSET(seaglare_eye_state, adaptation_luminance_cd_m2, 8);
    EXPECT_OFFSET(seaglare_eye_state, time_s, 16);
    EXPECT_OFFSET(seaglare_eye_state, is_day, 24);
    EXPECT_OFFSET(seaglare_eye_state, reserved, 28);
    EXPECT_OFFSET(seaglare_eye_state, adapted_luminance_cd_m2, 32);
    EXPECT_OFFSET(seaglare_eye_state, vitreous_orientation, 40);
    EXPECT_OFFSET(seaglare_eye_state, vitreous_spin_rad_s, 72);
    EXPECT_OFFSET(seaglare_eye_state, head_rate_rad_s, 96);
}

TEST(Layout, OfTheTableIsFrozen) {
    EXPECT_EQ(sizeof(seaglare_api), 152U);
    EXPECT_OFFSET(seaglare_api, struct_size, 0);
    EXPECT_OFFSET(seaglare_api, abi_minor, 4);
    EXPECT_OFFSET(seaglare_api, create, 8);
    EXPECT_OFFSET(seaglare_api, destroy, 16);
    EXPECT_OFFSET(seaglare_api, create_view, 24);
    EXPECT_OFFSET(seaglare_api, destroy_view, 32);
    EXPECT_OFFSET(seaglare_api, load_config, 40);
    EXPECT_OFFSET(seaglare_api, load_lights, 48);
    EXPECT_OFFSET(seaglare_api, clear_lights, 56);
    EXPECT_OFFSET(seaglare_api, add_light, 64);
    EXPECT_OFFSET(seaglare_api, update_lights, 72);
    EXPECT_OFFSET(seaglare_api, remove_light, 80);
    EXPECT_OFFSET(seaglare_api, set_body_pose, 88);
    EXPECT_OFFSET(seaglare_api, list_lights, 96);
    EXPECT_OFFSET(seaglare_api, get_eye_state, 104);
    EXPECT_OFFSET(seaglare_api, set_eye_state, 112);
    EXPECT_OFFSET(seaglare_api, render, 120);
    EXPECT_OFFSET(seaglare_api, copy_last_error, 128);
    EXPECT_OFFSET(seaglare_api, result_string, 136);
    EXPECT_OFFSET(seaglare_api, get_extension, 144);
}

TEST(Layout, OfStatsIsFrozen) {
    EXPECT_EQ(sizeof(seaglare_stats), 320U);
    EXPECT_OFFSET(seaglare_stats, struct_size, 0);
    EXPECT_OFFSET(seaglare_stats, degraded, 4);
    EXPECT_OFFSET(seaglare_stats, lights_total, 8);
    EXPECT_OFFSET(seaglare_stats, lights_drawn, 12);
    EXPECT_OFFSET(seaglare_stats, lights_dark, 16);
    EXPECT_OFFSET(seaglare_stats, lights_horizon, 20);
    EXPECT_OFFSET(seaglare_stats, lights_outside, 24);
    EXPECT_OFFSET(seaglare_stats, lights_below_threshold, 28);
    EXPECT_OFFSET(seaglare_stats, draw_calls, 32);
    EXPECT_OFFSET(seaglare_stats, kernel_launches, 36);
    EXPECT_OFFSET(seaglare_stats, pattern_size, 40);
    EXPECT_OFFSET(seaglare_stats, pattern_radius_px, 44);
    EXPECT_OFFSET(seaglare_stats, pattern_layers, 48);
    EXPECT_OFFSET(seaglare_stats, pattern_wavelengths, 52);
    EXPECT_OFFSET(seaglare_stats, pattern_angular_scale, 56);
    EXPECT_OFFSET(seaglare_stats, pupil_mm, 64);
    EXPECT_OFFSET(seaglare_stats, adaptation_luminance_cd_m2, 72);
    EXPECT_OFFSET(seaglare_stats, device_memory_bytes, 80);
    EXPECT_OFFSET(seaglare_stats, evaluate_ms, 88);
    EXPECT_OFFSET(seaglare_stats, pattern_ms, 96);
    EXPECT_OFFSET(seaglare_stats, upload_ms, 104);
    EXPECT_OFFSET(seaglare_stats, accumulate_ms, 112);
    EXPECT_OFFSET(seaglare_stats, composite_ms, 120);
    EXPECT_OFFSET(seaglare_stats, render_ms, 128);
    EXPECT_OFFSET(seaglare_stats, occlusion_ms, 136);
    EXPECT_OFFSET(seaglare_stats, gpu_upload_ms, 144);
    EXPECT_OFFSET(seaglare_stats, gpu_occlusion_ms, 152);
    EXPECT_OFFSET(seaglare_stats, gpu_accumulate_ms, 160);
    EXPECT_OFFSET(seaglare_stats, gpu_composite_ms, 168);
    EXPECT_OFFSET(seaglare_stats, gpu_ms, 176);
    EXPECT_OFFSET(seaglare_stats, gpu_frames_ago, 184);
    EXPECT_OFFSET(seaglare_stats, max_error_codes, 192);
    EXPECT_OFFSET(seaglare_stats, error_bound_codes, 200);
    EXPECT_OFFSET(seaglare_stats, time_budget_ms, 208);
    EXPECT_OFFSET(seaglare_stats, taken_ms, 216);
    EXPECT_OFFSET(seaglare_stats, quality_loss, 224);
    EXPECT_OFFSET(seaglare_stats, predicted_ms, 232);
    EXPECT_OFFSET(seaglare_stats, predicted_evaluate_ms, 240);
    EXPECT_OFFSET(seaglare_stats, predicted_pattern_ms, 248);
    EXPECT_OFFSET(seaglare_stats, predicted_upload_ms, 256);
    EXPECT_OFFSET(seaglare_stats, predicted_occlusion_ms, 264);
    EXPECT_OFFSET(seaglare_stats, predicted_accumulate_ms, 272);
    EXPECT_OFFSET(seaglare_stats, predicted_composite_ms, 280);
    EXPECT_OFFSET(seaglare_stats, accumulation, 288);
    EXPECT_OFFSET(seaglare_stats, omissions, 292);
    EXPECT_OFFSET(seaglare_stats, saved_ms, 296);
    EXPECT_OFFSET(seaglare_stats, could_save_ms, 304);
    EXPECT_OFFSET(seaglare_stats, given_up, 312);
    EXPECT_OFFSET(seaglare_stats, limiting_pass, 316);
}

TEST(Layout, OfMemoryIsFrozen) {
    EXPECT_EQ(sizeof(seaglare_memory), 96U);
    EXPECT_OFFSET(seaglare_memory, struct_size, 0);
    EXPECT_OFFSET(seaglare_memory, hdr_bytes, 8);
    EXPECT_OFFSET(seaglare_memory, coarse_grid_bytes, 16);
    EXPECT_OFFSET(seaglare_memory, background_bytes, 24);
    EXPECT_OFFSET(seaglare_memory, occlusion_bytes, 32);
    EXPECT_OFFSET(seaglare_memory, lights_bytes, 40);
    EXPECT_OFFSET(seaglare_memory, pattern_layers_bytes, 48);
    EXPECT_OFFSET(seaglare_memory, accumulation_bytes, 56);
    EXPECT_OFFSET(seaglare_memory, pattern_core_bytes, 64);
    EXPECT_OFFSET(seaglare_memory, pattern_wide_field_bytes, 72);
    EXPECT_OFFSET(seaglare_memory, pattern_screen_bytes, 80);
    EXPECT_OFFSET(seaglare_memory, total_bytes, 88);
    EXPECT_EQ(sizeof(seaglare_memory_api), 16U);
    EXPECT_OFFSET(seaglare_memory_api, get_memory, 8);
}

TEST(Layout, OfTheExtensionsIsFrozen) {
    EXPECT_EQ(sizeof(seaglare_stats_api), 24U);
    EXPECT_OFFSET(seaglare_stats_api, get_stats, 8);
    EXPECT_OFFSET(seaglare_stats_api, copy_plan, 16);
    EXPECT_EQ(sizeof(seaglare_hdr_api), 16U);
    EXPECT_OFFSET(seaglare_hdr_api, read, 8);
    EXPECT_EQ(sizeof(seaglare_lights_api), 24U);
    EXPECT_OFFSET(seaglare_lights_api, reload, 8);
    EXPECT_OFFSET(seaglare_lights_api, save, 16);
    EXPECT_EQ(sizeof(seaglare_reload_counts), 24U);
    EXPECT_OFFSET(seaglare_reload_counts, unchanged, 4);
    EXPECT_OFFSET(seaglare_reload_counts, changed, 8);
    EXPECT_OFFSET(seaglare_reload_counts, added, 12);
    EXPECT_OFFSET(seaglare_reload_counts, removed, 16);
    EXPECT_OFFSET(seaglare_reload_counts, reserved, 20);
}

TEST(Layout, OfVesselIsFrozen) {
    EXPECT_EQ(sizeof(seaglare_vessel), 144U);
    EXPECT_OFFSET(seaglare_vessel, struct_size, 0);
    EXPECT_OFFSET(seaglare_vessel, flags, 4);
    EXPECT_OFFSET(seaglare_vessel, kind, 8);
    EXPECT_OFFSET(seaglare_vessel, body_id, 12);
    EXPECT_OFFSET(seaglare_vessel, length_m, 16);
    EXPECT_OFFSET(seaglare_vessel, breadth_m, 24);
    EXPECT_OFFSET(seaglare_vessel, tow_length_m, 32);
    EXPECT_OFFSET(seaglare_vessel, gear_extent_m, 40);
    EXPECT_OFFSET(seaglare_vessel, gear_bearing_deg, 48);
    EXPECT_OFFSET(seaglare_vessel, deck_lights_cd, 56);
    EXPECT_OFFSET(seaglare_vessel, deck_height_m, 64);
    EXPECT_OFFSET(seaglare_vessel, mast_height_m, 72);
    EXPECT_OFFSET(seaglare_vessel, mast_separation_m, 80);
    EXPECT_OFFSET(seaglare_vessel, amidships_m, 88);
    EXPECT_OFFSET(seaglare_vessel, intensity_factor, 112);
    EXPECT_OFFSET(seaglare_vessel, radius_m, 120);
    EXPECT_OFFSET(seaglare_vessel, name, 128);
    EXPECT_OFFSET(seaglare_vessel, obstruction_side, 136);
    EXPECT_OFFSET(seaglare_vessel, fishing_signal, 140);
    EXPECT_EQ(sizeof(seaglare_vessels_api), 24U);
    EXPECT_OFFSET(seaglare_vessels_api, add_vessel, 8);
    EXPECT_OFFSET(seaglare_vessels_api, remove_vessel, 16);
}

TEST(Layout, OfWavesAndBuoysIsFrozen) {
    EXPECT_EQ(sizeof(seaglare_wave), 56U);
    EXPECT_OFFSET(seaglare_wave, struct_size, 0);
    EXPECT_OFFSET(seaglare_wave, flags, 4);
    EXPECT_OFFSET(seaglare_wave, amplitude_m, 8);
    EXPECT_OFFSET(seaglare_wave, direction_deg, 16);
    EXPECT_OFFSET(seaglare_wave, wavelength_m, 24);
    EXPECT_OFFSET(seaglare_wave, angular_frequency_rad_s, 32);
    EXPECT_OFFSET(seaglare_wave, phase_rad, 40);
    EXPECT_OFFSET(seaglare_wave, depth_m, 48);
    EXPECT_EQ(sizeof(seaglare_buoy), 88U);
    EXPECT_OFFSET(seaglare_buoy, struct_size, 0);
    EXPECT_OFFSET(seaglare_buoy, flags, 4);
    EXPECT_OFFSET(seaglare_buoy, body_id, 8);
    EXPECT_OFFSET(seaglare_buoy, reserved, 12);
    EXPECT_OFFSET(seaglare_buoy, position_m, 16);
    EXPECT_OFFSET(seaglare_buoy, focal_height_m, 40);
    EXPECT_OFFSET(seaglare_buoy, heave_period_s, 48);
    EXPECT_OFFSET(seaglare_buoy, heave_damping, 56);
    EXPECT_OFFSET(seaglare_buoy, roll_period_s, 64);
    EXPECT_OFFSET(seaglare_buoy, roll_damping, 72);
    EXPECT_OFFSET(seaglare_buoy, max_tilt_deg, 80);
    EXPECT_EQ(sizeof(seaglare_waves_api), 40U);
    EXPECT_OFFSET(seaglare_waves_api, set_waves, 8);
    EXPECT_OFFSET(seaglare_waves_api, set_buoy, 16);
    EXPECT_OFFSET(seaglare_waves_api, remove_buoy, 24);
    EXPECT_OFFSET(seaglare_waves_api, get_buoy_pose, 32);
}

}  // namespace
