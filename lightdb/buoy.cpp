#include "lightdb/buoy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seaglare::lightdb {

namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

constexpr double default_heave_damping = 0.3;
constexpr double default_roll_damping = 0.1;

double pendulum_period_s(double length_m) {
    return 2 * pi * std::sqrt(std::max(length_m, lowest_focal_height_m) / gravity_m_s2);
}

Oscillator or_default(const Oscillator& given, double period_s, double damping) {
    return {given.period_s > 0 ? given.period_s : period_s, given.damping > 0 ? given.damping : damping};
}

// How one wave moves a buoy: factors on exp(-i w t) whose real parts are heave and filtered slope.
struct Motion {
    Complex heave_m;
    Complex slope_east;
    Complex slope_north;
};

Motion motion_of(const Buoy& buoy, const Oscillator& heave, const Oscillator& roll,
                 const WaveComponent& wave) {
    const double direction_rad = wave.direction_deg * pi / 180;
    const double k_east = wave.wavenumber_rad_m * std::sin(direction_rad);
    const double k_north = wave.wavenumber_rad_m * std::cos(direction_rad);
    const double phase = k_east * buoy.position_m[0] + k_north * buoy.position_m[1] + wave.phase_rad;
    const Complex elevation = std::polar(wave.amplitude_m, phase);
    const Complex leaning = response(roll, wave.angular_frequency_rad_s) * Complex(0, 1) * elevation;
    return {response(heave, wave.angular_frequency_rad_s) * elevation, k_east * leaning, k_north * leaning};
}

Complex carrier_of(const WaveComponent& wave, double time_s) {
    return std::polar(1.0, -wave.angular_frequency_rad_s * time_s);
}

double real_of_product(const Complex& a, const Complex& b) {
    return a.real() * b.real() - a.imag() * b.imag();
}

Quaternion product(const Quaternion& a, const Quaternion& b) {
    const Vec3 av = {a[0], a[1], a[2]};
    const Vec3 bv = {b[0], b[1], b[2]};
    const Vec3 c = cross(av, bv);
    return {a[3] * bv[0] + b[3] * av[0] + c[0], a[3] * bv[1] + b[3] * av[1] + c[1],
            a[3] * bv[2] + b[3] * av[2] + c[2], a[3] * b[3] - dot(av, bv)};
}

// The turn that tips the z axis away from where the slope rises.
Quaternion leaning(double slope_east, double slope_north, double max_tilt_deg) {
    const double slope = std::hypot(slope_east, slope_north);
    if (!(slope > 0)) return {0, 0, 0, 1};
    const double half_rad = std::min(std::atan(slope), max_tilt_deg * pi / 180) / 2;
    const double s = std::sin(half_rad) / slope;
    return {s * slope_north, -s * slope_east, 0, std::cos(half_rad)};
}

BodyPose pose_of(const Buoy& buoy, double heave_m, double slope_east, double slope_north) {
    const Vec3 up = rotate(buoy.upright, {0, 0, heave_m});
    return {buoy.position_m + up, product(buoy.upright, leaning(slope_east, slope_north, buoy.max_tilt_deg))};
}

// The turn from the z axis to a unit vector that is not its opposite.
Quaternion turn_from_z(const Vec3& up) {
    return normalised({-up[1], up[0], 0, 1 + up[2]});
}

double finite_or_zero(double time_s) {
    return std::isfinite(time_s) ? time_s : 0;
}

}  // namespace

Oscillator heave_of(const Buoy& buoy) {
    return or_default(buoy.heave, pendulum_period_s(buoy.focal_height_m / 2), default_heave_damping);
}

Oscillator roll_of(const Buoy& buoy) {
    return or_default(buoy.roll, pendulum_period_s(buoy.focal_height_m), default_roll_damping);
}

Complex response(const Oscillator& oscillator, double angular_frequency_rad_s) {
    const double natural_rad_s = 2 * pi / oscillator.period_s;
    const double ratio = angular_frequency_rad_s / natural_rad_s;
    return 1.0 / Complex(1 - ratio * ratio, -2 * oscillator.damping * ratio);
}

Quaternion upright_at(const Vec3& position_m, const GeographicPoint& origin) {
    const LocalFrame frame(origin);
    const Vec3 p = frame.earth_centred_from_local(position_m);
    // The normal of an ellipsoid; squared ratio of the axes by the flattening of WGS 84.
    constexpr double ratio = 1 - 1 / 298.257223563;
    const Vec3 normal = {p[0], p[1], p[2] / (ratio * ratio)};
    const double size = length(normal);
    return turn_from_z(frame.turned_to_local({normal[0] / size, normal[1] / size, normal[2] / size}));
}

void place_buoy(Buoy& buoy, const GeographicPoint& origin, Earth earth) {
    buoy.upright = {0, 0, 0, 1};
    if (buoy.geographic) {
        buoy.position_m = scene_from_geographic({buoy.latitude_deg, buoy.longitude_deg, 0}, origin, earth);
    } else {
        buoy.position_m[2] = -origin.height_m;
        if (earth == Earth::round) {
            const Vec3& p = buoy.position_m;
            buoy.position_m[2] -= (p[0] * p[0] + p[1] * p[1]) / (2 * earth_radius_m);
        }
    }
    if (earth == Earth::round) buoy.upright = upright_at(buoy.position_m, origin);
}

BodyPose buoy_pose(const Buoy& buoy, std::span<const WaveComponent> waves, double time_s) {
    const Oscillator heave = heave_of(buoy);
    const Oscillator roll = roll_of(buoy);
    const double at_s = finite_or_zero(time_s);
    double heave_m = 0, slope_east = 0, slope_north = 0;
    for (const WaveComponent& wave : waves) {
        const Motion motion = motion_of(buoy, heave, roll, wave);
        const Complex carrier = carrier_of(wave, at_s);
        heave_m += real_of_product(motion.heave_m, carrier);
        slope_east += real_of_product(motion.slope_east, carrier);
        slope_north += real_of_product(motion.slope_north, carrier);
    }
    return pose_of(buoy, heave_m, slope_east, slope_north);
}

void BuoyField::prepare(Float& one) const {
    const Oscillator heave = heave_of(one.buoy);
    const Oscillator roll = roll_of(one.buoy);
    one.motion.clear();
    one.motion.reserve(3 * waves_.size());
    for (const WaveComponent& wave : waves_) {
        const Motion motion = motion_of(one.buoy, heave, roll, wave);
        one.motion.insert(one.motion.end(), {motion.heave_m, motion.slope_east, motion.slope_north});
    }
}

void BuoyField::set_waves(std::vector<WaveComponent> waves) {
    waves_ = std::move(waves);
    carrier_.resize(waves_.size());
    for (Float& one : floats_)
        prepare(one);
    at_rest_ = false;
}

void BuoyField::add(const Buoy& buoy) {
    Float one{buoy, {}};
    prepare(one);
    auto place =
        std::lower_bound(floats_.begin(), floats_.end(), buoy.body_id,
                         [](const Float& f, std::uint32_t body_id) { return f.buoy.body_id < body_id; });
    if (place == floats_.end() || place->buoy.body_id != buoy.body_id) place = floats_.emplace(place);
    *place = std::move(one);
    at_rest_ = false;
}

bool BuoyField::remove(std::uint32_t body_id) {
    return std::erase_if(floats_, [&](const Float& f) { return f.buoy.body_id == body_id; }) > 0;
}

void BuoyField::clear() {
    floats_.clear();
}

const Buoy* BuoyField::find(std::uint32_t body_id) const {
    const auto found = std::find_if(floats_.begin(), floats_.end(),
                                    [&](const Float& f) { return f.buoy.body_id == body_id; });
    return found != floats_.end() ? &found->buoy : nullptr;
}

void BuoyField::pose(double time_s, LightStore& store) {
    if (at_rest_ || floats_.empty()) return;
    const double at_s = finite_or_zero(time_s);
    for (std::size_t i = 0; i < waves_.size(); ++i)
        carrier_[i] = carrier_of(waves_[i], at_s);
    for (const Float& one : floats_) {
        double heave_m = 0, slope_east = 0, slope_north = 0;
        const Complex* motion = one.motion.data();
        for (const Complex& carrier : carrier_) {
            heave_m += real_of_product(motion[0], carrier);
            slope_east += real_of_product(motion[1], carrier);
            slope_north += real_of_product(motion[2], carrier);
            motion += 3;
        }
        store.set_body_pose(one.buoy.body_id, pose_of(one.buoy, heave_m, slope_east, slope_north));
    }
    at_rest_ = waves_.empty();
}

}  // namespace seaglare::lightdb
