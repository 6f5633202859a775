#include "plugin_api/world.h"

#include <cmath>

#include "lightdb/geodesy.h"

namespace seaglare::plugin {

namespace {

using Mat3 = std::array<Vec3, 3>;

Vec3 multiply(const Mat3& m, const Vec3& v) {
    Vec3 result;
    for (std::size_t row = 0; row < 3; ++row)
        result[row] = m[row][0] * v[0] + m[row][1] * v[1] + m[row][2] * v[2];
    return result;
}

Vec3 multiply_transposed(const Mat3& m, const Vec3& v) {
    Vec3 result;
    for (std::size_t column = 0; column < 3; ++column)
        result[column] = m[0][column] * v[0] + m[1][column] * v[1] + m[2][column] * v[2];
    return result;
}

Mat3 multiply(const Mat3& a, const Mat3& b) {
    Mat3 result;
    for (std::size_t row = 0; row < 3; ++row)
        result[row] = multiply_transposed(b, a[row]);
    return result;
}

Mat3 transposed(const Mat3& m) {
    Mat3 result;
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
            result[row][column] = m[column][row];
    return result;
}

Mat3 rotation(const double xyzw[4]) {
    const double norm = xyzw[0] * xyzw[0] + xyzw[1] * xyzw[1] + xyzw[2] * xyzw[2] + xyzw[3] * xyzw[3];
    const double s = 2 / norm;
    const double x = xyzw[0], y = xyzw[1], z = xyzw[2], w = xyzw[3];
    return {{{1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)},
             {s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)},
             {s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)}}};
}

// Shepperd 1978: the largest of the four squares divides the others, so nothing cancels.
Quaternion quaternion(const Mat3& m) {
    const double trace = m[0][0] + m[1][1] + m[2][2];
    const std::array<double, 4> square = {m[0][0], m[1][1], m[2][2], trace};
    std::size_t largest = 0;
    for (std::size_t i = 1; i < 4; ++i)
        if (square[i] > square[largest]) largest = i;
    Quaternion q;
    if (largest == 3) {
        q = {m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1], 1 + trace};
    } else {
        const std::size_t i = largest;
        const std::size_t j = (i + 1) % 3;
        const std::size_t k = (i + 2) % 3;
        q[i] = 1 - trace + 2 * m[i][i];
        q[j] = m[j][i] + m[i][j];
        q[k] = m[k][i] + m[i][k];
        q[3] = m[k][j] - m[j][k];
    }
    const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    for (double& component : q)
        component /= length;
    return q;
}

}  // namespace

World::World(const seaglare_create_info& info)
    : latitude_deg_(info.origin_latitude_deg),
      longitude_deg_(info.origin_longitude_deg),
      height_m_(info.origin_height_m),
      round_(info.earth == SEAGLARE_EARTH_ROUND || info.axes == SEAGLARE_AXES_EARTH_CENTRED) {
    switch (info.axes) {
        case SEAGLARE_AXES_EAST_UP_SOUTH:
            scene_axes_from_host_ = {{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}};
            break;
        case SEAGLARE_AXES_EAST_UP_NORTH:
            scene_axes_from_host_ = {{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}};
            break;
        case SEAGLARE_AXES_NORTH_EAST_DOWN:
            scene_axes_from_host_ = {{{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}};
            break;
        case SEAGLARE_AXES_EARTH_CENTRED: {
            const lightdb::LocalFrame frame({latitude_deg_, longitude_deg_, height_m_});
            scene_axes_from_host_ = {frame.east, frame.north, frame.up};
            origin_host_m_ = frame.origin_m;
            return;  // bodies are starboard-ahead-up as they come
        }
        default:
            break;
    }
    body_axes_from_host_ = scene_axes_from_host_;
}

Vec3 World::scene_from_host(const double host_m[3]) const {
    return multiply(scene_axes_from_host_, Vec3{host_m[0] - origin_host_m_[0], host_m[1] - origin_host_m_[1],
                                                host_m[2] - origin_host_m_[2]});
}

Vec3 World::host_from_scene(const Vec3& scene_m) const {
    Vec3 host = multiply_transposed(scene_axes_from_host_, scene_m);
    for (std::size_t i = 0; i < 3; ++i)
        host[i] += origin_host_m_[i];
    return host;
}

Vec3 World::body_from_host_body(const double host_body_m[3]) const {
    return multiply(body_axes_from_host_, Vec3{host_body_m[0], host_body_m[1], host_body_m[2]});
}

Quaternion World::scene_from_body(const double host_from_body[4]) const {
    return quaternion(multiply(multiply(scene_axes_from_host_, rotation(host_from_body)),
                               transposed(body_axes_from_host_)));
}

Quaternion World::host_from_body(const Quaternion& scene_from_body) const {
    return quaternion(multiply(multiply(transposed(scene_axes_from_host_), rotation(scene_from_body.data())),
                               body_axes_from_host_));
}

Quaternion World::body_from_light(const double host_body_from_light[4]) const {
    return quaternion(multiply(multiply(body_axes_from_host_, rotation(host_body_from_light)),
                               transposed(body_axes_from_host_)));
}

Mat4 World::view_from_scene(const double view_from_host[16]) const {
    Mat4 result{};
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 3; ++column) {
            double sum = 0;
            for (std::size_t k = 0; k < 3; ++k)
                sum += view_from_host[4 * k + row] * scene_axes_from_host_[column][k];
            result[4 * column + row] = sum;
        }
        double translation = view_from_host[12 + row];
        for (std::size_t k = 0; k < 3; ++k)
            translation += view_from_host[4 * k + row] * origin_host_m_[k];
        result[12 + row] = translation;
    }
    result[15] = 1;
    return result;
}

Vec3 eye_of_view(const Mat4& view_from_world) {
    Vec3 eye{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t row = 0; row < 3; ++row)
            eye[i] -= view_from_world[4 * i + row] * view_from_world[12 + row];
    }
    return eye;
}

}  // namespace seaglare::plugin
