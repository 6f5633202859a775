#include "host_stub/land_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace seaglare::host {
namespace {

constexpr double forest_albedo = 0.05;  // conifers and wet grass; sand would be 0.3
constexpr double beach_albedo = 0.12;

double hash(std::uint32_t seed, std::int64_t cell) {
    std::uint64_t h =
        (static_cast<std::uint64_t>(cell) + 0x9E3779B97F4A7C15ULL * (seed + 1ULL)) * 0xBF58476D1CE4E5B9ULL;
    h ^= h >> 29;
    h *= 0x94D049BB133111EBULL;
    h ^= h >> 32;
    return static_cast<double>(h >> 11) * 0x1p-53;
}

// Smooth noise of unit wavelength in 0 … 1.
double noise(std::uint32_t seed, double x) {
    const double cell = std::floor(x), t = x - cell, s = t * t * (3 - 2 * t);
    const auto i = static_cast<std::int64_t>(cell);
    return hash(seed, i) * (1 - s) + hash(seed, i + 1) * s;
}

// Height of a ridge along its length: hills of kilometres, woods of hundreds of metres, treetops.
double ridge_m(const Coast& c, double along_m, std::uint32_t row) {
    const std::uint32_t seed = c.seed * 7919 + row * 104729;
    const double hills = 0.5 * noise(seed, along_m / 2600) + 0.3 * noise(seed + 1, along_m / 900) +
                         0.2 * noise(seed + 2, along_m / 310);
    const double level = 1 - c.roughness + c.roughness * std::clamp(2.2 * hills - 0.6, 0.0, 1.4);
    const double woods = std::clamp(3 * noise(seed + 3, along_m / 420) - 1.1, 0.0, 1.0);
    const double trees = woods * (9 + 4 * noise(seed + 4, along_m / 60) + 3 * noise(seed + 5, along_m / 17));
    return c.height_m * level + std::min(trees, 0.5 * c.height_m + 2);
}

void add_vertex(LandMesh& mesh, glm::dvec3 p, double albedo) {
    mesh.vertices.push_back({{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)},
                             static_cast<float>(albedo)});
}

void add_coast(LandMesh& mesh, const Coast& coast) {
    constexpr double step_m = 18;
    constexpr std::uint32_t rows = 4;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    std::uint32_t columns = 0;
    double along_m = 0, total_m = 0;
    for (std::size_t i = 0; i + 1 < coast.shore_m.size(); ++i)
        total_m += glm::distance(coast.shore_m[i], coast.shore_m[i + 1]);
    for (std::size_t i = 0; i + 1 < coast.shore_m.size(); ++i) {
        const glm::dvec2 a = coast.shore_m[i], b = coast.shore_m[i + 1];
        const double length_m = glm::distance(a, b);
        if (length_m <= 0) continue;
        const glm::dvec2 ahead = (b - a) / length_m;
        const int steps = std::max(1, static_cast<int>(length_m / step_m));
        for (int k = i == 0 ? 0 : 1; k <= steps; ++k) {
            const double s = length_m * k / steps;
            const double at_m = along_m + s;
            // Turning inland smoothly at the corners: the normal is blended over the last tenth of each leg.
            glm::dvec2 inland(-ahead.y, ahead.x);
            const auto blend = [&](glm::dvec2 p, glm::dvec2 q, double weight) {
                const glm::dvec2 other = glm::normalize(q - p);
                inland = glm::normalize(inland * (1 - weight) + glm::dvec2(-other.y, other.x) * weight);
            };
            const double u = s / length_m;
            if (u > 0.8 && i + 2 < coast.shore_m.size()) blend(b, coast.shore_m[i + 2], 2.5 * (u - 0.8));
            if (u < 0.2 && i > 0) blend(coast.shore_m[i - 1], a, 2.5 * (0.2 - u));
            // The ends run down into the sea.
            const double taper =
                std::clamp(std::min(at_m, total_m - at_m) / (1.5 * coast.setback_m + 200), 0.0, 1.0);
            const glm::dvec2 p = a + ahead * s;
            const auto place = [&](double inland_m, double height_m, double albedo) {
                const glm::dvec2 q = p + inland * inland_m;
                add_vertex(mesh, {q.x, q.y, height_m}, albedo);
            };
            const double beach_m = std::min(40.0, 0.2 * coast.setback_m);
            place(0, -0.5, beach_albedo);
            place(beach_m, 1.2 * taper, beach_albedo);
            place(coast.setback_m, ridge_m(coast, at_m, 0) * taper * 0.7, forest_albedo);
            place(2.2 * coast.setback_m, ridge_m(coast, at_m * 0.9 + 5000, 1) * taper, forest_albedo * 0.9);
            ++columns;
        }
        along_m += length_m;
    }
    for (std::uint32_t i = 0; i + 1 < columns; ++i)
        for (std::uint32_t r = 0; r + 1 < rows; ++r) {
            const std::uint32_t v = first + i * rows + r;
            for (const std::uint32_t k : {v, v + 1, v + rows, v + rows, v + 1, v + rows + 1})
                mesh.indices.push_back(k);
        }
}

// A block runs between two of these.
struct Section {
    glm::dvec2 at_m;
    double bottom_m, top_m;
};

void add_block(LandMesh& mesh, const Section& from, const Section& to, double width_m, double top_width_m,
               double albedo) {
    const double length_m = glm::distance(from.at_m, to.at_m);
    if (length_m <= 0) return;
    const glm::dvec2 ahead = (to.at_m - from.at_m) / length_m, side(-ahead.y, ahead.x);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto corner = [&](const Section& s, double across_m, double z, double shade) {
        const glm::dvec2 q = s.at_m + side * across_m;
        add_vertex(mesh, {q.x, q.y, z}, shade);
    };
    const double foot = width_m / 2, head = top_width_m / 2;
    const double wet = 0.6 * albedo;  // darker at the foot: wet, and under its own shade
    corner(from, -foot, from.bottom_m, wet);
    corner(to, -foot, to.bottom_m, wet);
    corner(to, foot, to.bottom_m, wet);
    corner(from, foot, from.bottom_m, wet);
    corner(from, -head, from.top_m, albedo);
    corner(to, -head, to.top_m, albedo);
    corner(to, head, to.top_m, albedo);
    corner(from, head, from.top_m, albedo);
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        for (const std::uint32_t k : {a, b, c, a, c, d})
            mesh.indices.push_back(first + k);
    };
    for (std::uint32_t i = 0; i < 4; ++i)
        quad(i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i);
    quad(4, 5, 6, 7);
    quad(3, 2, 1, 0);
}

void add_structure(LandMesh& mesh, const Structure& s) {
    const auto section = [&](double u) {
        const double sag_m = 4 * s.sag_m * u * (1 - u);
        return Section{s.from_m + (s.to_m - s.from_m) * u,
                       s.bottom_m + (s.to_bottom_m - s.bottom_m) * u - sag_m,
                       s.top_m + (s.to_top_m - s.top_m) * u - sag_m};
    };
    const int pieces = s.sag_m > 0 ? 32 : 1;
    for (int i = 0; i < pieces; ++i)
        add_block(mesh, section(static_cast<double>(i) / pieces),
                  section(static_cast<double>(i + 1) / pieces), s.width_m, s.top_width_m, s.albedo);
    if (s.pillar_spacing_m <= 0) return;
    const double length_m = glm::distance(s.from_m, s.to_m);
    const int pillars = static_cast<int>(length_m / s.pillar_spacing_m);
    for (int i = 0; i <= pillars; ++i) {
        const Section at = section(pillars == 0 ? 0.5 : static_cast<double>(i) / pillars);
        const glm::dvec2 half = (s.to_m - s.from_m) / length_m * (s.pillar_width_m / 2);
        add_block(mesh, {at.at_m - half, -1, at.bottom_m}, {at.at_m + half, -1, at.bottom_m}, 0.8 * s.width_m,
                  0.7 * s.width_m, s.albedo);
    }
}

}  // namespace

LandMesh make_land(const Scene& scene) {
    LandMesh mesh;
    for (const Coast& coast : scene.coasts)
        add_coast(mesh, coast);
    for (const Structure& structure : scene.structures)
        add_structure(mesh, structure);
    return mesh;
}

}  // namespace seaglare::host
