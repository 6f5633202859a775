// Between the host's world, as declared once in create(), and the scene that everything inside uses: East, North, Up in
// metres, right-handed, with z = 0 at the origin's height above the water. Pure functions of double precision.
//
// Frames of bodies and lights have the same axes as the world with ahead for north and starboard for east: where the
// world is East-Up-South, a body is starboard-up-astern; where it is North-East-Down, ahead-starboard-down; in an
// Earth-centred world, starboard-ahead-up. The identity quaternion is then upright and heading north (or, in an
// Earth-centred world, aligned with the Earth's axes). Inside, a body is starboard-ahead-up.
#pragma once

#include <array>

#include "plugin_api/seaglare.h"

namespace seaglare::plugin {

using Vec3 = std::array<double, 3>;
using Quaternion = std::array<double, 4>;  // x, y, z, w; destination_from_source
using Mat4 = std::array<double, 16>;       // column-major

class World {
  public:
    World() = default;
    explicit World(const seaglare_create_info& info);

    Vec3 scene_from_host(const double host_m[3]) const;
    Vec3 host_from_scene(const Vec3& scene_m) const;
    // A point in a body's frame.
    Vec3 body_from_host_body(const double host_body_m[3]) const;
    // Scene from body, given the host's world from body.
    Quaternion scene_from_body(const double host_from_body[4]) const;
    // The inverse: what set_body_pose would be given for this.
    Quaternion host_from_body(const Quaternion& scene_from_body) const;
    // Body from light, given the same in the host's axes.
    Quaternion body_from_light(const double host_body_from_light[4]) const;
    Mat4 view_from_scene(const double view_from_host[16]) const;

    double origin_latitude_deg() const { return latitude_deg_; }
    double origin_longitude_deg() const { return longitude_deg_; }
    double origin_height_m() const { return height_m_; }
    bool round_earth() const { return round_; }

  private:
    using Mat3 = std::array<Vec3, 3>;  // rows
    Mat3 scene_axes_from_host_{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    Mat3 body_axes_from_host_{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    Vec3 origin_host_m_{};  // the scene's origin in host coordinates
    double latitude_deg_ = 0, longitude_deg_ = 0, height_m_ = 0;
    bool round_ = false;
};

// Where a rigid view_from_world has its eye.
Vec3 eye_of_view(const Mat4& view_from_world);

}  // namespace seaglare::plugin
