#include "glare/psf/pattern_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "glare/colour/cie_tables.h"
#include "glare/psf/cie_curve.h"

namespace seaglare::glare {

namespace {

// The last samples before the edge of the field take part in look-ups that would reach beyond it.
constexpr double field_used = 0.98;
constexpr double fade_starts_at = 0.75;  // of the outer limit

double largest_layer(const PatternSettings& settings, int room) {
    double largest = 0;
    for (float radius : settings.layer_radii_px)
        if (static_cast<double>(radius) <= room) largest = std::max(largest, static_cast<double>(radius));
    return largest;
}

// Area of the disc inside the cell, by exact chords over sub-rows.
double covered_area(double radius, int dx, int dy) {
    constexpr int sub_rows = 256;
    double sum = 0;
    for (int s = 0; s < sub_rows; ++s) {
        const double y = dy - 0.5 + (s + 0.5) / sub_rows;
        const double square = radius * radius - y * y;
        if (square <= 0) continue;
        const double chord = std::sqrt(square);
        sum += std::max(0.0, std::min(chord, dx + 0.5) - std::max(-chord, dx - 0.5));
    }
    return sum / sub_rows;
}

}  // namespace

PatternSettings thesis_settings() {
    PatternSettings settings;
    settings.transform_size = 512;
    settings.plane_width_mm = 9;
    // A sample is 575 nm/9 mm, a pixel 1/869.1: their ratio to a twentieth of a per cent.
    settings.angular_scale = 18;
    settings.layer_radii_px = {0.0F, 1.0F, 2.0F, 4.0F, 10.0F};
    return settings;
}

PatternGrid plan_grid(const PatternSettings& settings, double pitch) {
    if (!(pitch > 0) || !std::isfinite(pitch))
        throw std::invalid_argument("glare pattern: the pitch must be positive and finite");
    const double shortest_mm = cie_first_wavelength_nm * 1e-6;
    const double field = field_transform_size(settings) * shortest_mm / (2 * settings.plane_width_mm) *
                         settings.angular_scale * field_used;
    const int limit = std::max(settings.max_radius_nodes, 4);
    PatternGrid grid;
    grid.pitch = pitch;
    grid.margin = static_cast<int>(std::ceil(largest_layer(settings, limit / 2))) + 1;
    const double room = (limit - grid.margin) * pitch;
    grid.window_outer = std::min({field, room, 0.999});
    grid.window_inner = fade_starts_at * grid.window_outer;
    // The quotient may round up to just above the room's own number of nodes.
    const int most = std::max(limit - grid.margin, 1);
    grid.structure_radius = std::clamp(static_cast<int>(std::ceil(grid.window_outer / pitch)), 1, most);
    grid.radius = grid.structure_radius + grid.margin;
    return grid;
}

std::vector<float> plan_layers(const PatternSettings& settings, const PatternGrid& grid,
                               float largest_disc_nodes) {
    const LayerPlan plan = layer_plan(settings, grid, largest_disc_nodes);
    return {plan.radii_nodes.begin(), plan.radii_nodes.begin() + static_cast<std::ptrdiff_t>(plan.count)};
}

LayerPlan layer_plan(const PatternSettings& settings, const PatternGrid& grid, float largest_disc_nodes) {
    LayerPlan plan;
    for (float radius : settings.layer_radii_px) {
        const float last = plan.radii_nodes[plan.count - 1];
        if (!(radius > last) || radius + 1 > static_cast<float>(grid.margin)) continue;
        if (last >= largest_disc_nodes || !(largest_disc_nodes > 0)) break;
        if (plan.count == plan.radii_nodes.size()) break;  // validate() has refused such settings
        plan.radii_nodes[plan.count++] = radius;
    }
    return plan;
}

DiscStencil make_disc_stencil(double radius_nodes) {
    DiscStencil stencil;
    if (!(radius_nodes > 0)) {
        stencil.taps = {{0, 0, 1}};
        return stencil;
    }
    const int reach = static_cast<int>(std::ceil(radius_nodes + 0.5));
    double total = 0;
    for (int dy = -reach; dy <= reach; ++dy) {
        // The cells whose farthest corner is inside the disc.
        const double corner_y = std::abs(dy) + 0.5;
        const double square = radius_nodes * radius_nodes - corner_y * corner_y;
        const int whole = square > 0.25 ? static_cast<int>(std::floor(std::sqrt(square) - 0.5)) : -1;
        if (whole >= 1) {
            stencil.spans.push_back({dy, whole});
            total += 2 * whole + 1;
        }
        for (int dx = -reach; dx <= reach; ++dx) {
            if (whole >= 1 && std::abs(dx) <= whole) continue;
            const double area = covered_area(radius_nodes, dx, dy);
            if (area <= 0) continue;
            stencil.taps.push_back({dx, dy, area});
            total += area;
        }
    }
    stencil.span_weight = 1 / total;
    for (DiscTap& tap : stencil.taps)
        tap.weight /= total;
    return stencil;
}

double core_window(double distance_nodes, double core_radius_nodes) {
    if (!(distance_nodes < core_radius_nodes)) return 0;
    const double c = std::cos(std::numbers::pi / 2 * distance_nodes / core_radius_nodes);
    return c * c;
}

EnergyPlan plan_energy(const EyeModel& eye, const PatternSettings& settings, const PatternGrid& grid,
                       double pupil_mm) {
    EnergyPlan plan;
    const double passed = transmitted_fraction(eye, pupil_mm);
    plan.structure = passed;
    if (!eye.cie_tail || settings.angular_scale != 1.0) return plan;
    plan.tail_scale = passed;
    plan.structure =
        passed * (1 - cie_tail_energy(eye.age_years, eye.pigmentation, grid.window_inner, grid.window_outer));
    return plan;
}

}  // namespace seaglare::glare
