// Three-vectors and quaternions in double precision: the little that positions and poses need.
#pragma once

#include <array>
#include <cmath>

namespace seaglare::lightdb {

using Vec3 = std::array<double, 3>;
using Quaternion = std::array<double, 4>;  // x y z w

constexpr Vec3 operator+(const Vec3& a, const Vec3& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
constexpr Vec3 operator-(const Vec3& a, const Vec3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
constexpr double dot(const Vec3& a, const Vec3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline double length(const Vec3& v) {
    return std::sqrt(dot(v, v));
}
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// The quaternion of length 1; zero or not finite: no rotation.
inline Quaternion normalised(const Quaternion& q) {
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 0) || !std::isfinite(length)) return {0, 0, 0, 1};
    return {q[0] / length, q[1] / length, q[2] / length, q[3] / length};
}

constexpr Quaternion conjugate(const Quaternion& q) {
    return {-q[0], -q[1], -q[2], q[3]};
}

// v turned by the unit quaternion q.
constexpr Vec3 rotate(const Quaternion& q, const Vec3& v) {
    const Vec3 axis = {q[0], q[1], q[2]};
    const Vec3 t = cross(axis, v);
    const Vec3 u = cross(axis, t);
    return {v[0] + 2 * (q[3] * t[0] + u[0]), v[1] + 2 * (q[3] * t[1] + u[1]),
            v[2] + 2 * (q[3] * t[2] + u[2])};
}

}  // namespace seaglare::lightdb
