#include "glare/apply/pattern_profile.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
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
    grid_error_.assign(count * grids * table_entries, 0.0F);
    deviation_.assign(count * rings, 0.0F);

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
        entry_.clear();
        towards_entry_.clear();
        inverse_q_.clear();
        ring_weight_.assign(rings, 0.0F);
        for (int y = 0; y <= r; ++y) {
            for (int x = -r; x <= r; ++x) {
                const double distance = std::hypot(x, y);
                const auto q = static_cast<float>(x * x + y * y);
                const std::uint32_t bits = std::bit_cast<std::uint32_t>(std::max(q, RadialTable::q_of(0))) -
                                           RadialTable::first_q_bits;
                entry_.push_back(static_cast<std::uint16_t>(bits >> RadialTable::entry_shift));
                constexpr std::uint32_t step = 1U << RadialTable::entry_shift;
                towards_entry_.push_back(static_cast<float>(bits % step) / static_cast<float>(step));
                inverse_q_.push_back(1 / std::max(q, RadialTable::q_of(0)));
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
    blocks_.resize(pattern.radius_nodes, tail_table());
    const std::size_t side = 2 * static_cast<std::size_t>(pattern.radius_nodes) + 1;
    fill_table(pattern, tail_table(), false);
    find_reaches(tail_table());
    measure_grids(tail_table());
    for (std::size_t table = 0; table < tail_table(); ++table) {
        const float* const skirt = pattern.skirt.data() + table * side * side * 4;
        measure_rings(pattern, skirt);
        fill_table(pattern, table, true);
        smooth_table(pattern, table);
        measure_departures(pattern, table, skirt);
        find_reaches(table);
        measure_grids(table);
    }
    find_least();
    generation_ = pattern.generation;
}

void PatternProfile::measure_rings(const Pattern& pattern, const float* skirt) {
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
}

std::array<float, 4> PatternProfile::mean_of_node(std::size_t table, std::size_t node) const {
    const std::size_t entry = entry_[node];
    const float* const with_tail = &tables_[(table * table_entries + entry) * 4];
    const float* const tail = &tables_[(tail_table() * table_entries + entry) * 4];
    std::array<float, 4> mean{};
    for (std::size_t c = 0; c < 4; ++c) {
        const float low = with_tail[c] - tail[c];
        mean[c] = (low + towards_entry_[node] * (with_tail[c + 4] - tail[c + 4] - low)) * inverse_q_[node];
    }
    return mean;
}

void PatternProfile::measure_departures(const Pattern& pattern, std::size_t table, const float* skirt) {
    const auto r = static_cast<std::size_t>(pattern.radius_nodes);
    const std::size_t side = 2 * r + 1;
    const std::size_t rings = r + 2;
    const float* const upper = skirt + r * side * 4;
    ring_square_.assign(rings * 4, 0.0F);
    ring_nodes_.assign(rings, 0.0F);
    ring_most_.assign(rings, 0.0F);
    blocks_.begin();
    constexpr auto nearest = static_cast<float>(nearest_departure_nodes * nearest_departure_nodes);
    for (std::size_t node = 0; node < ring_.size(); ++node) {
        if (towards_next_[node] < 0) continue;
        const std::array<float, 4> mean = mean_of_node(table, node);
        const std::size_t ring = ring_[node];
        std::array<float, 4> off{};
        for (std::size_t c = 0; c < 4; ++c) {
            off[c] = upper[node * 4 + c] - mean[c];
            ring_square_[ring * 4 + c] += off[c] * off[c];
            ring_most_[ring] = std::max(ring_most_[ring], std::abs(off[c]));
        }
        ring_nodes_[ring] += 1;
        if (inverse_q_[node] * nearest <= 1) blocks_.add(node, off);
    }
    blocks_.finish(table);
    // Lashes turn and bend the structure by the light's place in the picture: what is bent comes from elsewhere.
    const double bend = 1.5 * std::abs(pattern.lash_bend_per_rad);
    float* const deviation = &deviation_[table * rings];
    float after = 0;
    for (std::size_t ring = rings; ring-- > 0;) {
        const double radius = std::max<double>(static_cast<double>(ring), 1);
        const auto channels = [ring](const std::vector<float>& of) {
            return std::array<float, 4>{of[ring * 4], of[ring * 4 + 1], of[ring * 4 + 2], of[ring * 4 + 3]};
        };
        // A single light leaves out its largest departure, however rare.
        deviation[ring] =
            std::max(std::sqrt(largest_channel(channels(ring_square_)) / std::max(ring_nodes_[ring], 1.0F)),
                     ring_most_[ring] / static_cast<float>(departure_deviations));
        if (bend > 0)
            deviation[ring] += static_cast<float>(3 * bend * radius * pattern.pitch) *
                               largest_channel(channels(ring_sum_)) / static_cast<float>(radius * radius);
        after = deviation[ring] = std::max(deviation[ring], after);
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

// The halo of a lamp of one colour is a ring narrower than the cells of the grids that far from the light: what is drawn on
// them is smoothed over a part of the distance, and the ring left to the departures. Near the skirt's end, beyond which there
// are no departures, it stays as it is.
void PatternProfile::smooth_table(const Pattern& pattern, std::size_t table) {
    // Entries are 2.2 % of the distance apart.
    constexpr int reach = 24;
    constexpr double sigma = 9;
    static const std::array<float, reach + 1> kernel = [] {
        std::array<float, reach + 1> values{};
        for (int i = 0; i <= reach; ++i)
            values[static_cast<std::size_t>(i)] =
                static_cast<float>(std::exp(-0.5 * i * i / (sigma * sigma)));
        return values;
    }();
    const double outer = std::min(pattern.window_outer / std::max(pattern.pitch, 1e-9),
                                  static_cast<double>(pattern.radius_nodes));
    float* const values = &tables_[table * table_entries * 4];
    smoothed_.assign(values, values + table_entries * 4);
    for (int i = 0; i < static_cast<int>(table_entries); ++i) {
        const double radius = radius_of_entry(static_cast<std::size_t>(i));
        const double raw = std::clamp((radius / outer - 0.8) / 0.2, 0.0, 1.0);
        if (raw >= 1) break;
        std::array<float, 4> sum{};
        float weights = 0;
        // As far down as up, so that a slope stays one.
        const int most = std::min({reach, i, static_cast<int>(table_entries) - 1 - i});
        for (int k = -most; k <= most; ++k) {
            const float weight = kernel[static_cast<std::size_t>(std::abs(k))];
            weights += weight;
            for (std::size_t c = 0; c < 4; ++c)
                sum[c] += weight * smoothed_[static_cast<std::size_t>(i + k) * 4 + c];
        }
        for (std::size_t c = 0; c < 4; ++c) {
            float& value = values[static_cast<std::size_t>(i) * 4 + c];
            value += static_cast<float>(1 - raw) * (sum[c] / weights - value);
        }
    }
}

void PatternProfile::find_reaches(std::size_t table) {
    float largest = 0;
    for (std::size_t i = table_entries; i-- > 0;) {
        const float* const value = &tables_[(table * table_entries + i) * 4];
        const float q = RadialTable::q_of(static_cast<int>(i));
        const float psf = largest_channel({value[0], value[1], value[2], value[3]}) / q;
        largest = std::max(largest, psf);
        largest_[table * table_entries + i] = largest;
    }
}

std::array<float, 4> PatternProfile::mean_at(std::size_t table, float radius_nodes) const {
    const float q = std::clamp(radius_nodes * radius_nodes, RadialTable::q_of(0),
                               RadialTable::q_of(RadialTable::entries - 2));
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(q) - RadialTable::first_q_bits;
    constexpr std::uint32_t step = 1U << RadialTable::entry_shift;
    const float* const at = &tables_[(table * table_entries + (bits >> RadialTable::entry_shift)) * 4];
    const float t = static_cast<float>(bits % step) / static_cast<float>(step);
    std::array<float, 4> mean{};
    for (std::size_t c = 0; c < 4; ++c)
        mean[c] = (at[c] + t * (at[c + 4] - at[c])) / q;
    return mean;
}

void PatternProfile::measure_grids(std::size_t table) {
    const auto at_radius = [&](std::size_t entry) { return static_cast<float>(radius_of_entry(entry)); };
    for (int level = 1; level <= grids; ++level) {
        const auto h = static_cast<float>(1 << level);
        float* const error =
            &grid_error_[(table * grids + static_cast<std::size_t>(level - 1)) * table_entries];
        float largest = 0;
        // Every other entry: the mean is smooth over nine of them.
        for (std::size_t i = (table_entries - 1) / 2 * 2;; i -= 2) {
            const float r = at_radius(i);
            // Nearer, no grid is used.
            if (r >= 2 * h) {
                const std::array<float, 4> here = mean_at(table, r);
                const auto apart = [&](const std::array<float, 4>& inner, const std::array<float, 4>& outer,
                                       const std::array<float, 4>& inmost,
                                       const std::array<float, 4>& outmost, float near, float far) {
                    float most = 0;
                    for (std::size_t c = 0; c < 4; ++c)
                        most = std::max(most, std::abs(here[c] - near * (inner[c] + outer[c]) -
                                                       far * (inmost[c] + outmost[c])));
                    return most;
                };
                float off =
                    apart(mean_at(table, r - h / 2), mean_at(table, r + h / 2), mean_at(table, r - 1.5F * h),
                          mean_at(table, r + 1.5F * h), 0.5625F, -0.0625F);
                if (level == 1)
                    off += apart(mean_at(table, r - 0.5F), mean_at(table, r + 0.5F), {}, {}, 0.5F, 0);
                largest = std::max(largest, off - grid_precision * largest_channel(here));
            }
            error[i] = largest;
            if (i + 1 < table_entries) error[i + 1] = largest;
            if (i == 0) break;
        }
    }
}

void PatternProfile::find_least() {
    least_.assign(table_entries, {});
    if (tail_table() == 0) return;
    std::array<float, 4> least{};
    least.fill(std::numeric_limits<float>::max());
    for (std::size_t i = 0; i < table_entries; ++i)
        for (std::size_t c = 0; c < 4; ++c) {
            for (std::size_t table = 0; table < tail_table(); ++table)
                least[c] = std::min(least[c], tables_[(table * table_entries + i) * 4 + c] /
                                                  RadialTable::q_of(static_cast<int>(i)));
            least_[i][c] = std::max(least[c], 0.0F);
        }
}

std::span<const float> PatternProfile::deviation(std::size_t table) const {
    if (table >= tail_table()) return {};
    const std::size_t rings = static_cast<std::size_t>(radius_) + 2;
    return std::span<const float>(deviation_).subspan(table * rings, rings);
}

void PatternProfile::departures(const Pattern& pattern, std::span<float> out) const {
    const auto r = static_cast<std::size_t>(radius_);
    const std::size_t side = 2 * r + 1;
    constexpr auto nearest = static_cast<float>(nearest_departure_nodes * nearest_departure_nodes);
    for (std::size_t table = 0; table < tail_table(); ++table) {
        std::size_t at = table * side * side * 4;
        for (std::size_t y = 0; y < side; ++y) {
            const std::size_t row = (y > r ? y - r : r - y) * side;
            for (std::size_t node = row; node < row + side; ++node, at += 4) {
                const bool asked = inverse_q_[node] * nearest <= 1;
                const std::array<float, 4> mean = mean_of_node(table, node);
                for (std::size_t c = 0; c < 4; ++c)
                    out[at + c] = asked ? pattern.skirt[at + c] - mean[c] : 0.0F;
            }
        }
    }
}

double PatternProfile::reach_nodes(std::size_t table, double psf_sr) const {
    const std::size_t entry =
        first_below(std::span<const float>(largest_).subspan(table * table_entries, table_entries), psf_sr);
    return std::min(radius_of_entry(entry), std::sqrt(quarter_turn_q_));
}

double PatternProfile::grid_reach_nodes(std::size_t table, int level, double psf_sr) const {
    const auto grid = static_cast<std::size_t>(std::clamp(level, 1, grids) - 1);
    const std::size_t entry = first_below(
        std::span<const float>(grid_error_).subspan((table * grids + grid) * table_entries, table_entries),
        psf_sr);
    return radius_of_entry(entry);
}

}  // namespace seaglare::glare
