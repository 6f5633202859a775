// A scene file: where and when the observer stands, the weather, the channel, the land about him and the
// lights. Read once, pure data, no GL. The format is described by config/schema/scene.schema.json and
// channel.schema.json.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host_stub/geodesy.h"

namespace seaglare::host {

// What the host's framebuffer holds; the plug-in is told the same.
enum class TargetFormat { rgba8_srgb_values, srgb8_alpha8, rgba16f_linear };

// One picture: its size, its frustum and where it looks from the ship.
struct Channel {
    std::string name = "default";
    int width_px = 1280;
    int height_px = 720;
    // Angles from the axis to the picture's edges; left and down are negative in a symmetric frustum.
    double left_deg = 0, right_deg = 0, down_deg = 0, up_deg = 0;
    double yaw_deg = 0;    // clockwise from the ship's head
    double pitch_deg = 0;  // up
    double roll_deg = 0;   // clockwise: the horizon sinks on the left
    TargetFormat target = TargetFormat::rgba8_srgb_values;

    // Keeps the vertical field and the pixels square. For --size and for a resized window.
    void resize(int width, int height);
};

struct Observer {
    std::string name;
    glm::dvec2 position_m{};  // east, north of the scene's origin
    double eye_height_m = 10;
    double heading_deg = 0;  // true
    double pitch_deg = 0;
    double speed_kn = 0;
};

struct Sky {
    SkyDirection sun{-40, 0};  // at the scene's local time
    std::optional<SkyDirection> moon;
    double moon_illuminated = 1;  // fraction of the disc
    double night_luminance_cd_m2 = 3e-4;
    bool stars = true;
};

struct Town {
    std::string name;
    glm::dvec2 position_m{};
    double luminance_cd_m2 = 0;
    double width_deg = 15;
    double height_deg = 5;
};

// Land: a shoreline, a beach, and hills behind it on its left hand as the points go. Not surveyed: the
// silhouette is noise, of the height and in the place the scene says.
struct Coast {
    std::string name;
    std::vector<glm::dvec2> shore_m;
    double height_m = 20;    // of the hills
    double setback_m = 400;  // from the shoreline to the hills
    double roughness = 0.5;  // 0: a level ridge, 1: hills down to the beach
    std::uint32_t seed = 1;
};

// A straight solid between two points: a pier, a breakwater, a pylon, a bridge's deck.
struct Structure {
    std::string name;
    glm::dvec2 from_m{}, to_m{};
    double width_m = 10;  // at the bottom
    double top_width_m = 10;
    double bottom_m = -1;  // at `from`
    double top_m = 3;
    double to_bottom_m = -1;  // at `to`: a ramp
    double to_top_m = 3;
    double sag_m = 0;             // hangs this much lower in the middle, as a cable does
    double pillar_spacing_m = 0;  // stands on pillars this far apart; 0: on nothing
    double pillar_width_m = 6;
    double albedo = 0.15;
};

// Lights made up at random, for load: spread over the field of view of the scene's channel.
struct Crowd {
    std::uint32_t count = 0;
    std::uint32_t seed = 1;
    double distance_min_m = 200, distance_max_m = 8000;    // log-uniform
    double intensity_min_cd = 5, intensity_max_cd = 2000;  // log-uniform
    double radius_min_m = 0.03, radius_max_m = 0.15;
    double margin = 0;    // part of the field left free at its edges
    double sway_m = 0;    // each light swings by this, so that every frame updates them all
    double flashing = 0;  // part of them that flash
};

struct Scene {
    std::string name;
    std::string description;
    std::filesystem::path file;
    GeoPoint origin;
    double local_time_h = 0;
    double start_s = 0;  // the absolute time of the first frame
    Sky sky;
    std::optional<double> adaptation_cd_m2;  // else from the sky
    std::optional<double> visibility_m;      // meteorological; else clear air
    double wind_speed_m_s = 4;
    double wind_from_deg = 250;
    std::vector<Observer> observers;  // at least one; the first is the default
    std::vector<Channel> channels;    // at least one; the first is the default
    std::vector<std::filesystem::path> light_files;
    std::filesystem::path quality_file;  // empty: the plug-in's own defaults
    std::vector<Town> towns;
    std::vector<Coast> coasts;
    std::vector<Structure> structures;
    std::optional<Crowd> crowd;
    std::uint64_t seed = 1;

    // nullptr when there is none of that name; the first when it is empty.
    const Observer* find_observer(std::string_view wanted) const;
    const Channel* find_channel(std::string_view wanted) const;
};

// Throws json::Error ("FILE:LINE:COL: text") for what the schema does not allow, std::system_error for a file
// that cannot be read. Paths in a file are relative to it. Light and quality files are named, not read: that
// is the plug-in's.
Scene load_scene(const std::filesystem::path& path);
Channel load_channel(const std::filesystem::path& path);

}  // namespace seaglare::host
