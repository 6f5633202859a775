// Where the picture is taken from: the matrices of one channel aboard a ship, in double precision.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "host_stub/scene.h"

namespace seaglare::host {

// The world is east, north, up in metres. View space is OpenGL's: x right, y up, looking along -z.
struct Camera {
    glm::dvec3 eye_m{};
    glm::dmat4 view_from_world{1};
    glm::dmat4 clip_from_view{1};

    static constexpr double near_m = 1;
    static constexpr double far_m = 100e3;
};

// Looking from `eye_m`, the channel's own angles added to the ship's heading and pitch.
Camera make_camera(const Channel& channel, glm::dvec3 eye_m, double heading_deg, double pitch_deg);

// Row of the horizon, counted in pixels from the picture's lower edge; for a level channel without roll.
double horizon_row_px(const Channel& channel, const Camera& camera);

// Where a point of the world falls, in pixels from the lower left corner; z is the distance ahead, negative
// behind.
glm::dvec3 project_px(const Channel& channel, const Camera& camera, glm::dvec3 point_m);

// What the depth buffer holds for a point `ahead_m` in front of the eye.
double depth_at(const Camera& camera, double ahead_m);

}  // namespace seaglare::host
