#include "lightdb/profile.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace seaglare::lightdb {

namespace {

double between(double x, double x0, double y0, double x1, double y1) {
    if (!(x1 > x0)) return y1;
    return y0 + (y1 - y0) * ((x - x0) / (x1 - x0));
}

// Index of the first sample whose angle is above `angle_deg`.
std::size_t first_above(const AngleTable& table, double angle_deg) {
    const auto above = std::upper_bound(table.angle_deg.begin(), table.angle_deg.end(), angle_deg);
    return static_cast<std::size_t>(above - table.angle_deg.begin());
}

constexpr std::array<std::string_view, 4> profile_names = {"uniform", "sabik_vp", "colreg_power",
                                                           "colreg_sail"};

}  // namespace

double clamped_factor(const AngleTable& table, double angle_deg) {
    if (table.angle_deg.empty()) return 1;
    if (std::isnan(angle_deg)) return 0;
    const std::size_t i = first_above(table, angle_deg);
    if (i == 0) return table.factor.front();
    if (i == table.angle_deg.size()) return table.factor.back();
    return between(angle_deg, table.angle_deg[i - 1], table.factor[i - 1], table.angle_deg[i],
                   table.factor[i]);
}

double periodic_factor(const AngleTable& table, double angle_deg) {
    if (table.angle_deg.empty()) return 1;
    if (!std::isfinite(angle_deg)) return 0;
    const double first_deg = table.angle_deg.front();
    const double last_deg = table.angle_deg.back();
    double wrapped_deg = first_deg + std::fmod(angle_deg - first_deg, 360.0);
    if (wrapped_deg < first_deg) wrapped_deg += 360;
    if (wrapped_deg < last_deg) return clamped_factor(table, wrapped_deg);
    return between(wrapped_deg, last_deg, table.factor.back(), first_deg + 360, table.factor.front());
}

std::optional<AngleTable> named_vertical_profile(std::string_view name) {
    if (name == "uniform") return AngleTable{};
    if (name == "sabik_vp") return AngleTable{{-10, -5, 0, 5, 10}, {0.1, 0.5, 1, 0.5, 0.1}};
    if (name == "colreg_power") return AngleTable{{-7.5, -5, 5, 7.5}, {0.6, 1, 1, 0.6}};
    if (name == "colreg_sail") return AngleTable{{-25, -5, 5, 25}, {0.5, 1, 1, 0.5}};
    return std::nullopt;
}

std::span<const std::string_view> vertical_profile_names() {
    return profile_names;
}

}  // namespace seaglare::lightdb
