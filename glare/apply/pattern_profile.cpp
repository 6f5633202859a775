#include "glare/apply/pattern_profile.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include "glare/psf/cie_curve.h"

namespace seaglare::glare {

namespace {

constexpr std::size_t table_entries = RadialTable::entries;

float largest_channel(const std::array<float, 4>& rgbv) {
    return std::max({std::abs(rgbv[0]), std::abs(rgbv[1]), std::abs(rgbv[2]), std::abs(rgbv[3])});
}

// Index one beyond the last value above `limit` in a row that never rises.
std::size_t first_below(std::span<const float> falling, double limit) {
    const auto first = std::partition_point(
        falling.begin(), falling.end(), [limit](float value) { return static_cast<double>(value) > limit; });
    return static_cast<std::size_t>(first - falling.begin());
}

double radius_of_entry(std::size_t entry) {
    const auto last = std::min<std::size_t>(entry, table_entries - 1);
    return std::sqrt(static_cast<double>(RadialTable::q_of(static_cast<int>(last))));
}

}  // namespace

float RadialTable::q_of(int entry) {
    return std::bit_cast<float>(first_q_bits + (static_cast<std::uint32_t>(entry) << entry_shift));
}

void PatternProfile::update(const Pattern& pattern) {
    if (pattern.generation == generation_ && generation_ != 0) return;
    generation_ = 0;
    const bool has_skirt = !pattern.skirt.empty() && pattern.pitch > 0;
    slots_ = has_skirt ? pattern.lamps.size() : 0;
    layers_ = has_skirt ? pattern.layer_radius_nodes.size() : 0;
    const double pitch = pattern.pitch > 0 ? pattern.pitch : 1e-3;
    quarter_turn_q_ = 1 / (pitch * pitch);
    const std::size_t count = tail_table() + 1;
    const auto rings = static_cast<std::size_t>(pattern.radius_nodes) + 2;
    tables_.assign(count * table_entries * 4, 0.0F);
    largest_.assign(count * table_entries, 0.0F);
    bend_.assign(count * table_entries, 0.0F);
    departure_.assign(count * rings, 0.0F);

    if (pattern.tail_scale > 0 &&
        (curve_age_ != pattern.tail_age_years || curve_pigmentation_ != pattern.tail_pigmentation ||
         curve_pitch_ != pitch)) {
        curve_.resize(table_entries);
        for (std::size_t i = 0; i < table_entries; ++i) {
            const auto q = static_cast<double>(RadialTable::q_of(static_cast<int>(i)));
            const double angle_deg = std::asin(std::min(std::sqrt(q) * pitch, 1.0)) * 180 / std::numbers::pi;
            curve_[i] = static_cast<float>(
                q * cie_total_glare_sr(angle_deg, pattern.tail_age_years, pattern.tail_pigmentation));
        }
        curve_age_ = pattern.tail_age_years;
        curve_pigmentation_ = pattern.tail_pigmentation;
        curve_pitch_ = pitch;
    }
    if (radius_ != pattern.radius_nodes) {
        radius_ = pattern.radius_nodes;
        const int r = radius_;
        ring_.clear();
        towards_next_.clear();
        ring_weight_.assign(rings, 0.0F);
        for (int y = 0; y <= r; ++y) {
            for (int x = -r; x <= r; ++x) {
                const double distance = std::hypot(x, y);
                const double ring = std::min(std::floor(distance), static_cast<double>(r + 1));
                ring_.push_back(static_cast<std::uint16_t>(std::min(ring, static_cast<double>(r))));
                // Corners of the square are in no ring.
                const double next = ring > r ? 0.0 : distance - ring;
                towards_next_.push_back(ring > r ? -1.0F : static_cast<float>(next));
                if (ring > r) continue;
                ring_weight_[static_cast<std::size_t>(ring)] += static_cast<float>(1 - next);
                ring_weight_[static_cast<std::size_t>(ring) + 1] += static_cast<float>(next);
            }
        }
    }
    const std::size_t side = 2 * static_cast<std::size_t>(pattern.radius_nodes) + 1;
    for (std::size_t table = 0; table < tail_table(); ++table) {
        measure_rings(pattern, table, pattern.skirt.data() + table * side * side * 4);
        fill_table(pattern, table, true);
        find_reaches(table);
    }
    fill_table(pattern, tail_table(), false);
    find_reaches(tail_table());
    generation_ = pattern.generation;
}

void PatternProfile::measure_rings(const Pattern& pattern, std::size_t table, const float* skirt) {
    const auto r = static_cast<std::size_t>(pattern.radius_nodes);
    const std::size_t side = 2 * r + 1;
    const std::size_t rings = r + 2;
    ring_sum_.assign(rings * 4, 0.0F);
    // A pattern is point-symmetric: the upper half says it all. Row y of it is row r + y of the table.
    const float* const upper = skirt + r * side * 4;
    std::size_t node = 0;
    for (std::size_t y = 0; y <= r; ++y) {
        for (std::size_t x = 0; x < side; ++x, ++node) {
            const float next = towards_next_[node];
            if (next < 0) continue;
            const float dx = static_cast<float>(x) - static_cast<float>(r);
            const float q = dx * dx + static_cast<float>(y * y);
            float* const sum = &ring_sum_[static_cast<std::size_t>(ring_[node]) * 4];
            for (std::size_t c = 0; c < 4; ++c) {
                const float value = upper[node * 4 + c] * q;
                sum[c] += value * (1 - next);
                sum[c + 4] += value * next;
            }
        }
    }
    for (std::size_t ring = 0; ring < rings; ++ring)
        for (std::size_t c = 0; c < 4; ++c)
            ring_sum_[ring * 4 + c] /= std::max(ring_weight_[ring], 1e-6F);

    float* const departure = &departure_[table * rings];
    node = 0;
    for (std::size_t y = 0; y <= r; ++y) {
        for (std::size_t x = 0; x < side; ++x, ++node) {
            const float next = towards_next_[node];
            const float dx = static_cast<float>(x) - static_cast<float>(r);
            const float q = dx * dx + static_cast<float>(y * y);
            const float* const value = upper + node * 4;
            std::array<float, 4> off = {value[0], value[1], value[2], value[3]};
            if (next >= 0 && q > 0) {
                const float* const mean = &ring_sum_[static_cast<std::size_t>(ring_[node]) * 4];
                for (std::size_t c = 0; c < 4; ++c)
                    off[c] -= (mean[c] + next * (mean[c + 4] - mean[c])) / q;
            }
            float& largest = departure[ring_[node] + (next < 0 ? 1U : 0U)];
            largest = std::max(largest, largest_channel(off));
        }
    }
    // Lashes turn and bend the structure by the light's place in the picture: what is bent comes from elsewhere.
    const double bend = 1.5 * std::abs(pattern.lash_bend_per_rad);
    float after = 0;
    for (std::size_t ring = rings; ring-- > 0;) {
        const double radius = std::max<double>(static_cast<double>(ring), 1);
        if (bend > 0) {
            const float* const mean = &ring_sum_[ring * 4];
            const std::array<float, 4> here = {mean[0], mean[1], mean[2], mean[3]};
            departure[ring] += static_cast<float>(3 * bend * radius * pattern.pitch / (radius * radius)) *
                               largest_channel(here);
        }
        after = departure[ring] = std::max(departure[ring], after);
    }
}

void PatternProfile::fill_table(const Pattern& pattern, std::size_t table, bool with_skirt) {
    const int last_ring = pattern.radius_nodes + 1;
    for (std::size_t i = 0; i < table_entries; ++i) {
        const auto q = static_cast<double>(RadialTable::q_of(static_cast<int>(i)));
        const double radius = std::sqrt(q);
        float* const out = &tables_[(table * table_entries + i) * 4];
        const int ring = static_cast<int>(radius);
        if (with_skirt && ring < last_ring) {
            const float t = static_cast<float>(radius) - static_cast<float>(ring);
            const float* const mean = &ring_sum_[static_cast<std::size_t>(ring) * 4];
            for (std::size_t c = 0; c < 4; ++c)
                out[c] = mean[c] + t * (mean[c + 4] - mean[c]);
        }
        if (pattern.tail_scale > 0) {
            const double beyond =
                1 - fade_window(radius * pattern.pitch, pattern.window_inner, pattern.window_outer);
            const auto tail = static_cast<float>(pattern.tail_scale * beyond) * curve_[i];
            for (std::size_t c = 0; c < 4; ++c)
                out[c] += tail;
        }
    }
}

void PatternProfile::find_reaches(std::size_t table) {
    float largest = 0;
    float bend = 0;
    for (std::size_t i = table_entries; i-- > 0;) {
        const float* const value = &tables_[(table * table_entries + i) * 4];
        const float q = RadialTable::q_of(static_cast<int>(i));
        const float psf = largest_channel({value[0], value[1], value[2], value[3]}) / q;
        largest = std::max(largest, psf);
        bend = std::max(bend, psf / (q * q));
        largest_[table * table_entries + i] = largest;
        bend_[table * table_entries + i] = bend;
    }
}

double PatternProfile::structure_reach_nodes(std::size_t table, double psf_sr) const {
    if (table >= tail_table()) return 0;
    const std::size_t rings = static_cast<std::size_t>(radius_) + 2;
    return static_cast<double>(
        first_below(std::span<const float>(departure_).subspan(table * rings, rings), psf_sr));
}

double PatternProfile::reach_nodes(std::size_t table, double psf_sr) const {
    const std::size_t entry =
        first_below(std::span<const float>(largest_).subspan(table * table_entries, table_entries), psf_sr);
    return std::min(radius_of_entry(entry), std::sqrt(quarter_turn_q_));
}

double PatternProfile::bend_reach_nodes(std::size_t table, double psf_per_r4) const {
    const std::size_t entry =
        first_below(std::span<const float>(bend_).subspan(table * table_entries, table_entries), psf_per_r4);
    return radius_of_entry(entry);
}

}  // namespace seaglare::glare
