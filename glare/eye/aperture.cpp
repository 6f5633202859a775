#include "glare/eye/aperture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "glare/eye/noise.h"

namespace seaglare::glare {

namespace {

// Inverse of the distribution function of a density d^-exponent between two diameters.
double diameter_um(const ParticleFamily& family, double u) {
    const double low = family.min_diameter_um;
    const double high = std::max(family.max_diameter_um, low);
    const double power = 1 - family.exponent;
    if (std::abs(power) < 1e-9) return low * std::pow(high / low, u);
    const double from = std::pow(low, power);
    return std::pow(from + u * (std::pow(high, power) - from), 1 / power);
}

// Multiples of the golden ratio modulo 1: of any run of n neighbours each part of 0 ... 1 gets its share, but for some
// log n (Niederreiter 1992, "Random Number Generation and Quasi-Monte Carlo Methods", section 3.1).
double even_share(double first, std::uint64_t i) {
    const double value = first + (std::numbers::phi - 1) * static_cast<double>(i);
    return value - std::floor(value);
}

struct TileRange {
    int first;
    int last;  // inclusive; before first: none
};

struct Bounds {
    float left;
    float right;
    float low;
    float high;
};

Bounds bounds_of(const Disc& disc) {
    return {disc.x - disc.radius, disc.x + disc.radius, disc.y - disc.radius, disc.y + disc.radius};
}

Bounds bounds_of(const Quad& q) {
    const auto [left, right] = std::minmax({q.xy[0], q.xy[2], q.xy[4], q.xy[6]});
    const auto [low, high] = std::minmax({q.xy[1], q.xy[3], q.xy[5], q.xy[7]});
    return {left, right, low, high};
}

TileRange tiles_touched(float low, float high, int tiles) {
    const double from = std::floor(static_cast<double>(low) / TileLists::tile_side);
    const double to = std::floor(static_cast<double>(high) / TileLists::tile_side);
    return {static_cast<int>(std::clamp(from, 0.0, static_cast<double>(tiles))),
            static_cast<int>(std::clamp(to, -1.0, tiles - 1.0))};
}

template <typename Shape, typename Visit>
void for_each_tile(const Shape& shape, int tiles, Visit visit) {
    const Bounds b = bounds_of(shape);
    const TileRange columns = tiles_touched(b.left, b.right, tiles);
    const TileRange rows = tiles_touched(b.low, b.high, tiles);
    for (int row = rows.first; row <= rows.last; ++row)
        for (int column = columns.first; column <= columns.last; ++column)
            visit(static_cast<std::size_t>(row) * static_cast<std::size_t>(tiles) +
                  static_cast<std::size_t>(column));
}

}  // namespace

ApertureParts::ApertureParts(const EyeModel& eye, std::uint64_t seed) : gratings_(eye.gratings), seed_(seed) {
    for (std::size_t f = 0; f < eye.particles.size(); ++f) {
        const ParticleFamily& family = eye.particles[f];
        const int count = family.min_diameter_um > 0 ? std::max(family.count, 0) : 0;
        const double first_area = uniform(seed, f, 0, 0);
        for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(count); ++i) {
            const double radius = family.field_radius_mm * std::sqrt(even_share(first_area, i));
            const double azimuth = 2 * std::numbers::pi * uniform(seed, f, i, 1);
            x_mm_.push_back(radius * std::cos(azimuth));
            y_mm_.push_back(radius * std::sin(azimuth));
            radius_mm_.push_back(diameter_um(family, (static_cast<double>(i) + 0.5) / count) / 2000);
        }
        families_.push_back({x_mm_.size(), family.drift_um / 1000,
                             family.drift_period_s > 0 ? family.drift_period_s : 1, family.site});
    }
}

void ApertureParts::place(double time_s, int n, double plane_width_mm, std::vector<Disc>& discs) const {
    EyeInstant instant;
    instant.time_s = time_s;
    place(instant, n, plane_width_mm, discs);
}

void ApertureParts::place(const EyeInstant& instant, int n, double plane_width_mm,
                          std::vector<Disc>& discs) const {
    const double samples_per_mm = n / plane_width_mm;
    const double axis = n / 2.0;
    constexpr std::uint64_t drift_stream = 0x64726966;
    discs.resize(x_mm_.size());
    std::size_t i = 0;
    for (std::size_t f = 0; f < families_.size(); ++f) {
        const Family& family = families_[f];
        double dx = 0;
        double dy = 0;
        if (family.drift_mm > 0) {
            const double phase = instant.time_s / family.drift_period_s;
            dx = family.drift_mm * smooth_noise(hash(seed_, drift_stream, f, 0), phase);
            dy = family.drift_mm * smooth_noise(hash(seed_, drift_stream, f, 1), phase);
        }
        // Turned and scaled about the axis.
        double along = 1;
        double across = 0;
        if (family.site == ParticleSite::lens) along = instant.lens_scale;
        if (family.site == ParticleSite::vitreous && instant.vitreous_roll_rad != 0) {
            along = std::cos(instant.vitreous_roll_rad);
            across = std::sin(instant.vitreous_roll_rad);
        }
        for (; i < family.end; ++i) {
            const double x_mm = x_mm_[i] + dx;
            const double y_mm = y_mm_[i] + dy;
            discs[i] = {static_cast<float>(axis + (along * x_mm - across * y_mm) * samples_per_mm),
                        static_cast<float>(axis + (across * x_mm + along * y_mm) * samples_per_mm),
                        static_cast<float>(radius_mm_[i] * samples_per_mm), 0};
        }
    }
}

GratingShape ApertureParts::gratings(int n, double plane_width_mm, double lens_scale) const {
    if (gratings_.count <= 0 || !(gratings_.depth > 0) || !(gratings_.duty > 0)) return {};
    const double samples_per_mm = n / plane_width_mm * lens_scale;
    return {static_cast<float>(gratings_.count),
            static_cast<float>(std::max(gratings_.inner_radius_mm, 0.0) * samples_per_mm),
            static_cast<float>(gratings_.outer_radius_mm * samples_per_mm),
            static_cast<float>(std::min(gratings_.duty, 1.0)),
            static_cast<float>(std::min(gratings_.depth, 1.0))};
}

template <typename Shape>
void TileListsOf<Shape>::sort(const std::vector<Shape>& shapes, int n) {
    const int tiles = n / tile_side;
    const auto count = static_cast<std::size_t>(tiles) * static_cast<std::size_t>(tiles);
    begin_.assign(count + 1, 0);
    for (const Shape& shape : shapes)
        for_each_tile(shape, tiles, [this](std::size_t tile) { ++begin_[tile + 1]; });
    for (std::size_t t = 0; t < count; ++t)
        begin_[t + 1] += begin_[t];
    next_.assign(begin_.begin(), begin_.end() - 1);
    sorted_.resize(static_cast<std::size_t>(begin_[count]));
    for (const Shape& shape : shapes)
        for_each_tile(shape, tiles,
                      [&](std::size_t tile) { sorted_[static_cast<std::size_t>(next_[tile]++)] = shape; });
}

template <typename Shape>
std::size_t TileListsOf<Shape>::worst_case(const std::vector<Shape>& shapes) {
    std::size_t total = 0;
    for (const Shape& shape : shapes) {
        const Bounds b = bounds_of(shape);
        const auto tiles_across = [](float from, float to) {
            return static_cast<std::size_t>((static_cast<double>(to) - static_cast<double>(from)) /
                                            tile_side) +
                   2;
        };
        total += tiles_across(b.left, b.right) * tiles_across(b.low, b.high);
    }
    return total;
}

template class TileListsOf<Disc>;
template class TileListsOf<Quad>;

}  // namespace seaglare::glare
