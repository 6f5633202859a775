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

struct TileRange {
    int first;
    int last;  // inclusive; before first: none
};

TileRange tiles_touched(double centre, double radius, int tiles) {
    const double from = std::floor((centre - radius) / TileLists::tile_side);
    const double to = std::floor((centre + radius) / TileLists::tile_side);
    return {static_cast<int>(std::clamp(from, 0.0, static_cast<double>(tiles))),
            static_cast<int>(std::clamp(to, -1.0, tiles - 1.0))};
}

template <typename Visit>
void for_each_tile(const Disc& disc, int tiles, Visit visit) {
    const TileRange columns = tiles_touched(disc.x, disc.radius, tiles);
    const TileRange rows = tiles_touched(disc.y, disc.radius, tiles);
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
        for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(count); ++i) {
            const double radius = family.field_radius_mm * std::sqrt(uniform(seed, f, i, 0));
            const double azimuth = 2 * std::numbers::pi * uniform(seed, f, i, 1);
            x_mm_.push_back(radius * std::cos(azimuth));
            y_mm_.push_back(radius * std::sin(azimuth));
            radius_mm_.push_back(diameter_um(family, uniform(seed, f, i, 2)) / 2000);
        }
        families_.push_back(
            {x_mm_.size(), family.drift_um / 1000, family.drift_period_s > 0 ? family.drift_period_s : 1});
    }
}

void ApertureParts::place(double time_s, int n, double plane_width_mm, std::vector<Disc>& discs) const {
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
            const double phase = time_s / family.drift_period_s;
            dx = family.drift_mm * smooth_noise(hash(seed_, drift_stream, f, 0), phase);
            dy = family.drift_mm * smooth_noise(hash(seed_, drift_stream, f, 1), phase);
        }
        for (; i < family.end; ++i) {
            discs[i] = {static_cast<float>(axis + (x_mm_[i] + dx) * samples_per_mm),
                        static_cast<float>(axis + (y_mm_[i] + dy) * samples_per_mm),
                        static_cast<float>(radius_mm_[i] * samples_per_mm), 0};
        }
    }
}

GratingShape ApertureParts::gratings(int n, double plane_width_mm) const {
    if (gratings_.count <= 0 || !(gratings_.depth > 0) || !(gratings_.duty > 0)) return {};
    const double samples_per_mm = n / plane_width_mm;
    return {static_cast<float>(gratings_.count),
            static_cast<float>(std::max(gratings_.inner_radius_mm, 0.0) * samples_per_mm),
            static_cast<float>(gratings_.outer_radius_mm * samples_per_mm),
            static_cast<float>(std::min(gratings_.duty, 1.0)),
            static_cast<float>(std::min(gratings_.depth, 1.0))};
}

void TileLists::sort(const std::vector<Disc>& discs, int n) {
    const int tiles = n / tile_side;
    const auto count = static_cast<std::size_t>(tiles) * static_cast<std::size_t>(tiles);
    begin_.assign(count + 1, 0);
    for (const Disc& disc : discs)
        for_each_tile(disc, tiles, [this](std::size_t tile) { ++begin_[tile + 1]; });
    for (std::size_t t = 0; t < count; ++t)
        begin_[t + 1] += begin_[t];
    next_.assign(begin_.begin(), begin_.end() - 1);
    sorted_.resize(static_cast<std::size_t>(begin_[count]));
    for (const Disc& disc : discs)
        for_each_tile(disc, tiles,
                      [&](std::size_t tile) { sorted_[static_cast<std::size_t>(next_[tile]++)] = disc; });
}

std::size_t TileLists::worst_case(const std::vector<Disc>& discs) {
    std::size_t total = 0;
    for (const Disc& disc : discs) {
        const auto side = static_cast<std::size_t>(2.0 * static_cast<double>(disc.radius) / tile_side) + 2;
        total += side * side;
    }
    return total;
}

}  // namespace seaglare::glare
