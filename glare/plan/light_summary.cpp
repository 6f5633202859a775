#include "glare/plan/light_summary.h"

#include <algorithm>
#include <cmath>

#include "glare/apply/footprint.h"
#include "glare/apply/light_instance.h"

namespace seaglare::glare {

namespace {

constexpr int most_cells = 32;  // along each axis

std::size_t class_of(double channel_lx) {
    if (!(channel_lx > faintest_class_lx)) return 0;
    const double steps = std::log2(channel_lx / faintest_class_lx) / 2;
    return static_cast<std::size_t>(std::clamp(steps, 0.0, brightness_classes - 1.0));
}

// Cells as large as a skirt, with one more around the picture for the lights outside.
struct CellGrid {
    CellGrid(const ScreenGeometry& geometry, double skirt_px)
        : cell_px(std::max({skirt_px, 8.0, static_cast<double>(geometry.width_px) / (most_cells - 2),
                            static_cast<double>(geometry.height_px) / (most_cells - 2)})),
          columns(static_cast<int>(std::ceil(geometry.width_px / cell_px)) + 2),
          rows(static_cast<int>(std::ceil(geometry.height_px / cell_px)) + 2) {}

    int column_of(double x_px) const {
        return static_cast<int>(std::clamp(std::floor(x_px / cell_px) + 1, 0.0, columns - 1.0));
    }
    int row_of(double y_px) const {
        return static_cast<int>(std::clamp(std::floor(y_px / cell_px) + 1, 0.0, rows - 1.0));
    }

    double cell_px;
    int columns;
    int rows;
};

}  // namespace

void BrightnessHistogram::add(double channel_lx) {
    const std::size_t k = class_of(channel_lx);
    count[k] += 1;
    lux[k] += static_cast<float>(channel_lx);
}

void BrightnessHistogram::add(const BrightnessHistogram& other) {
    for (std::size_t k = 0; k < count.size(); ++k) {
        count[k] += other.count[k];
        lux[k] += other.lux[k];
    }
}

double BrightnessHistogram::left_out(double share, double at_most_per_lx) const {
    double sum = 0;
    for (std::size_t k = 0; k < count.size(); ++k) {
        sum += std::min(static_cast<double>(count[k]) * share, static_cast<double>(lux[k]) * at_most_per_lx);
    }
    return sum;
}

double BrightnessHistogram::total_lux() const {
    double sum = 0;
    for (const float part : lux)
        sum += static_cast<double>(part);
    return sum;
}

bool BrightnessHistogram::empty() const {
    return std::all_of(count.begin(), count.end(), [](float n) { return n == 0; });
}

void LightSummary::clear() {
    std::vector<BrightnessHistogram> kept = std::move(neighbourhoods);
    *this = {};
    neighbourhoods = std::move(kept);
    neighbourhoods.clear();
}

void summarise(const ScreenGeometry& geometry, std::span<const PointSource> sources, double skirt_px,
               LightSummary& summary) {
    summary.clear();
    const CellGrid grid(geometry, skirt_px);
    const auto cells = static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
    summary.neighbourhoods.resize(cells);
    const auto at = [&](int column, int row) -> BrightnessHistogram& {
        return summary.neighbourhoods[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
                                      static_cast<std::size_t>(column)];
    };
    for (const PointSource& source : sources) {
        Appearance light;
        if (!appearance_of(geometry, source, light)) continue;
        ++summary.lights;
        const double lux = channel_bound_lx(source);
        summary.all.add(lux);
        const auto& rgb = source.illuminance_rgb_lx;
        const double luminance = 0.2126 * static_cast<double>(rgb[0]) + 0.7152 * static_cast<double>(rgb[1]) +
                                 0.0722 * static_cast<double>(rgb[2]);
        if (luminance > 0) {
            const double strongest =
                static_cast<double>(std::max({std::abs(rgb[0]), std::abs(rgb[1]), std::abs(rgb[2])}));
            summary.largest_channel_ratio = std::max(summary.largest_channel_ratio, strongest / luminance);
            summary.largest_scotopic_ratio =
                std::max(summary.largest_scotopic_ratio,
                         static_cast<double>(source.illuminance_scotopic_lx) / luminance);
        }
        summary.largest_disc_rad = std::max(summary.largest_disc_rad, light.radius_rad);
        const double disc_px = light.radius_rad / geometry.pitch;
        if (disc_px > point_until_px) ++summary.disc_lights;
        if (source.lamp < most_lamps) {
            summary.lamps |= 1U << source.lamp;
            summary.lux_of_lamp[source.lamp] += lux;
            summary.brightest_of_lamp[source.lamp] = std::max(summary.brightest_of_lamp[source.lamp], lux);
        }
        std::array<double, 2> centre{};
        // A light beside or behind the eye is in all cells: its direction says little about which.
        int left = 0, right = grid.columns - 1, bottom = 0, top = grid.rows - 1;
        if (project_px(geometry, light.direction, centre)) {
            // Angles grow in pixels towards the edges of a wide picture: the skirt's reach with them.
            const double stretch =
                geometry.plane_area_px > 0
                    ? std::sqrt(geometry.plane_area_px /
                                std::max(pixel_solid_angle_sr(geometry, light.direction), 1e-18))
                    : 1;
            const double reach_px = std::min((skirt_px + disc_px) * std::max(stretch * stretch, 1.0), 1e6);
            left = grid.column_of(centre[0] - reach_px);
            right = grid.column_of(centre[0] + reach_px);
            bottom = grid.row_of(centre[1] - reach_px);
            top = grid.row_of(centre[1] + reach_px);
        }
        for (int row = bottom; row <= top; ++row) {
            for (int column = left; column <= right; ++column)
                at(column, row).add(lux);
        }
    }
    // The border stands for what is not in the picture; empty cells cannot lose anything.
    std::size_t kept = 0;
    for (int row = 1; row + 1 < grid.rows; ++row) {
        for (int column = 1; column + 1 < grid.columns; ++column) {
            const BrightnessHistogram cell = at(column, row);
            if (!cell.empty()) summary.neighbourhoods[kept++] = cell;
        }
    }
    summary.neighbourhoods.resize(kept);
}

double share_of_each(std::span<const BrightnessHistogram> neighbourhoods, double budget_cd_m2,
                     double at_most_per_lx) {
    if (!(budget_cd_m2 > 0)) return 0;
    if (neighbourhoods.empty()) return budget_cd_m2;  // no pixel to lose anything
    double most_in_one = 1;
    for (const BrightnessHistogram& cell : neighbourhoods) {
        double count = 0;
        for (const float n : cell.count)
            count += static_cast<double>(n);
        most_in_one = std::max(most_in_one, count);
    }
    const auto fits = [&](double share) {
        return std::all_of(neighbourhoods.begin(), neighbourhoods.end(),
                           [&](const BrightnessHistogram& cell) {
                               return cell.left_out(share, at_most_per_lx) <= budget_cd_m2;
                           });
    };
    // No light of one pixel needs more than the whole budget.
    double low = budget_cd_m2 / most_in_one, high = budget_cd_m2;
    if (most_in_one <= 1) return low;
    if (fits(high)) return high;
    for (int i = 0; i < 12; ++i) {
        const double middle = std::sqrt(low * high);
        (fits(middle) ? low : high) = middle;
    }
    return low;
}

}  // namespace seaglare::glare
