#include "host_stub/camera.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace seaglare::host {
namespace {
constexpr double deg = std::numbers::pi / 180;
}

Camera make_camera(const Channel& channel, glm::dvec3 eye_m, double heading_deg, double pitch_deg) {
    Camera c;
    c.eye_m = eye_m;
    // At rest the camera looks north: view x is east, view y is up, view -z is north.
    const glm::dmat4 view_from_ship(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 1, 0, 0),
                                    glm::dvec4(0, 0, 0, 1));
    glm::dmat4 world_to_view(1);
    world_to_view = glm::rotate(world_to_view, -channel.roll_deg * deg, glm::dvec3(0, 0, 1));
    world_to_view = glm::rotate(world_to_view, -(channel.pitch_deg + pitch_deg) * deg, glm::dvec3(1, 0, 0));
    world_to_view = world_to_view * view_from_ship;
    world_to_view = glm::rotate(world_to_view, (channel.yaw_deg + heading_deg) * deg, glm::dvec3(0, 0, 1));
    c.view_from_world = glm::translate(world_to_view, -eye_m);
    c.clip_from_view = glm::frustum(
        Camera::near_m * std::tan(channel.left_deg * deg), Camera::near_m * std::tan(channel.right_deg * deg),
        Camera::near_m * std::tan(channel.down_deg * deg), Camera::near_m * std::tan(channel.up_deg * deg),
        Camera::near_m, Camera::far_m);
    return c;
}

glm::dvec3 project_px(const Channel& channel, const Camera& camera, glm::dvec3 point_m) {
    const glm::dvec4 view = camera.view_from_world * glm::dvec4(point_m, 1);
    const glm::dvec4 clip = camera.clip_from_view * view;
    return {(clip.x / clip.w * 0.5 + 0.5) * channel.width_px,
            (clip.y / clip.w * 0.5 + 0.5) * channel.height_px, -view.z};
}

double horizon_row_px(const Channel& channel, const Camera& camera) {
    // A point at eye height, straight ahead and as good as infinitely far.
    const glm::dmat4& v = camera.view_from_world;
    const glm::dvec3 ahead(-v[0][2], -v[1][2], 0);
    return project_px(channel, camera, camera.eye_m + 1e7 * ahead).y;
}

double depth_at(const Camera& camera, double ahead_m) {
    const glm::dmat4& p = camera.clip_from_view;
    return ((p[2][2] * -ahead_m + p[3][2]) / ahead_m) * 0.5 + 0.5;
}

}  // namespace seaglare::host
