#include "lightdb/light_block.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lightdb/geodesy.h"
#include "lightdb/light_marks.h"
#include "lightdb/photometry.h"

namespace seaglare::lightdb {

namespace {

constexpr float float_infinity = std::numeric_limits<float>::infinity();

// The nearest float that is not below (not above) a number; NaN stays one.
float rounded_up(double value) {
    if (value > static_cast<double>(std::numeric_limits<float>::max())) return float_infinity;
    if (value < static_cast<double>(std::numeric_limits<float>::lowest()))
        return std::numeric_limits<float>::lowest();
    const auto nearest = static_cast<float>(value);
    return static_cast<double>(nearest) < value ? std::nextafter(nearest, float_infinity) : nearest;
}

float rounded_down(double value) {
    return -rounded_up(-value);
}

// Distance in metres at which an intensity in cd falls to 2e-7 lx in air of 10 nm visibility. The root of Allard's
// law is Lambert's W function, here by Winitzki's approximation (2003), within 2 %: it only orders lights.
double typical_reach_m(double peak_cd) {
    const double half_rho = extinction_per_m(nominal_visibility_nm * metres_per_nautical_mile) / 2;
    const double x = half_rho * std::sqrt(std::max(peak_cd, 0.0) / night_threshold_lx);
    const double l = std::log1p(x);
    return l * (1 - std::log1p(l) / (2 + l)) / half_rho;
}

double typical_horizon_m(double height_m) {
    return geographical_range_nm(height_m, 0) * metres_per_nautical_mile;
}

float narrowed(double value) {
    if (!std::isfinite(value)) return 0;
    return static_cast<float>(std::clamp(value, -1e30, 1e30));
}

double round_height_m(const Vec3& position_m) {
    return position_m[2] +
           (position_m[0] * position_m[0] + position_m[1] * position_m[1]) / (2 * earth_radius_m);
}

}  // namespace

LightBlock::Entry LightBlock::entry_of(const LightArrays& lights, LightIndex light) {
    const Vec3& p = lights[light].position_m;
    const double peak_cd = std::min(static_cast<double>(lights[light].peak_cd), 1e12);
    return {{narrowed(p[0]), narrowed(p[1]), narrowed(p[2]), narrowed(typical_reach_m(peak_cd)),
             narrowed(typical_horizon_m(p[2]))},
            light};
}

void LightBlock::halve(std::span<Entry> entries, std::size_t middle) {
    std::array<float, 5> low = entries.front().length_m;
    std::array<float, 5> high = low;
    for (const Entry& entry : entries) {
        for (std::size_t i = 0; i < low.size(); ++i) {
            low[i] = std::min(low[i], entry.length_m[i]);
            high[i] = std::max(high[i], entry.length_m[i]);
        }
    }
    std::size_t longest = 0;
    for (std::size_t i = 1; i < low.size(); ++i) {
        if (high[i] - low[i] > high[longest] - low[longest]) longest = i;
    }
    const auto at = [&](std::size_t i) { return entries.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(0), at(middle), entries.end(), [longest](const Entry& a, const Entry& b) {
        // Equal lengths: by slot, so that the same lights give the same tree.
        if (a.length_m[longest] != b.length_m[longest]) return a.length_m[longest] < b.length_m[longest];
        return a.light < b.light;
    });
}

LightBlock::LightBlock(const LightArrays& lights, std::span<Entry> entries)
    : order_(entries.size()), present_(entries.size()), awake_((entries.size() + 63) / 64) {
    while (entries.size() > leaves_ * leaf_size)
        leaves_ *= 2;
    nodes_.resize(2 * leaves_ - 1);
    if (entries.empty()) return;
    order_within(entries, 0, 1);
    std::transform(entries.begin(), entries.end(), order_.begin(), [](const Entry& e) { return e.light; });
    bound(lights);
}

void LightBlock::order_within(std::span<Entry> entries, std::size_t node_in_level,
                              std::size_t nodes_in_level) {
    if (nodes_in_level == leaves_) return;
    const std::size_t first = first_of(node_in_level, nodes_in_level);
    const std::size_t last = first_of(node_in_level + 1, nodes_in_level);
    const std::size_t middle = first_of(2 * node_in_level + 1, 2 * nodes_in_level);
    halve(entries.subspan(first, last - first), middle - first);
    order_within(entries, 2 * node_in_level, 2 * nodes_in_level);
    order_within(entries, 2 * node_in_level + 1, 2 * nodes_in_level);
}

void LightBlock::bound(const LightArrays& lights) {
    Vec3 low = lights[order_.front()].position_m;
    Vec3 high = low;
    for (const LightIndex light : order_) {
        for (std::size_t i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], lights[light].position_m[i]);
            high[i] = std::max(high[i], lights[light].position_m[i]);
        }
    }
    for (std::size_t i = 0; i < 3; ++i)
        origin_m_[i] = low[i] / 2 + high[i] / 2;

    for (std::size_t leaf = 0; leaf < leaves_; ++leaf) {
        Node& node = nodes_[leaves_ - 1 + leaf];
        node.low_m.fill(float_infinity);
        node.high_m.fill(-float_infinity);
        node.round_height_m = -float_infinity;
        for (std::size_t rank = first_of(leaf, leaves_); rank < first_of(leaf + 1, leaves_); ++rank) {
            const LightIndex light = order_[rank];
            const Vec3 relative = lights[light].position_m - origin_m_;
            for (std::size_t i = 0; i < 3; ++i) {
                node.low_m[i] = std::min(node.low_m[i], rounded_down(relative[i]));
                node.high_m[i] = std::max(node.high_m[i], rounded_up(relative[i]));
            }
            node.peak_cd = std::max(node.peak_cd, lights[light].peak_cd);
            node.radius_m = std::max(node.radius_m, lights[light].radius_m);
            node.round_height_m =
                std::max(node.round_height_m, rounded_up(round_height_m(lights[light].position_m)));
            if (!lights.is(light, light_flag::awake)) continue;
            awake_[rank / 64] |= std::uint64_t{1} << rank % 64;
            ++node.awake;
            if (!lights.is(light, light_flag::day_off)) ++node.by_day;
        }
    }
    for (std::size_t n = leaves_ - 1; n-- > 0;) {
        Node& node = nodes_[n];
        const Node& a = nodes_[2 * n + 1];
        const Node& b = nodes_[2 * n + 2];
        for (std::size_t i = 0; i < 3; ++i) {
            node.low_m[i] = std::min(a.low_m[i], b.low_m[i]);
            node.high_m[i] = std::max(a.high_m[i], b.high_m[i]);
        }
        node.peak_cd = std::max(a.peak_cd, b.peak_cd);
        node.radius_m = std::max(a.radius_m, b.radius_m);
        node.round_height_m = std::max(a.round_height_m, b.round_height_m);
        node.awake = static_cast<std::uint16_t>(a.awake + b.awake);
        node.by_day = static_cast<std::uint16_t>(a.by_day + b.by_day);
    }
}

std::size_t LightBlock::leaf_node(std::size_t rank) const {
    return leaves_ - 1 + ((rank + 1) * leaves_ - 1) / order_.size();
}

void LightBlock::take_out(std::size_t rank, bool day_off) {
    set_awake(rank, false, day_off);
    order_[rank] = no_light;
    --present_;
}

void LightBlock::set_awake(std::size_t rank, bool awake, bool day_off) {
    if (awake == is_awake(rank)) return;
    awake_[rank / 64] ^= std::uint64_t{1} << rank % 64;
    const int change = awake ? 1 : -1;
    for (std::size_t n = leaf_node(rank);; n = (n - 1) / 2) {
        nodes_[n].awake = static_cast<std::uint16_t>(nodes_[n].awake + change);
        if (!day_off) nodes_[n].by_day = static_cast<std::uint16_t>(nodes_[n].by_day + change);
        if (n == 0) return;
    }
}

void LightBlock::raise_peak(std::size_t rank, float peak_cd) {
    for (std::size_t n = leaf_node(rank);; n = (n - 1) / 2) {
        if (nodes_[n].peak_cd >= peak_cd) return;  // and so has every node above
        nodes_[n].peak_cd = peak_cd;
        if (n == 0) return;
    }
}

GroupBounds LightBlock::bounds_for(const Node& node, const CullingEye& eye) const {
    const Vec3 from_origin_m = eye.eye_m - origin_m_;
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double below = static_cast<double>(node.low_m[i]) - from_origin_m[i];
        const double above = from_origin_m[i] - static_cast<double>(node.high_m[i]);
        const double outside = below > 0 ? below : above > 0 ? above : 0;
        square += outside * outside;
    }
    const double top_m = eye.round_earth ? static_cast<double>(node.round_height_m)
                                         : origin_m_[2] + static_cast<double>(node.high_m[2]);
    return {std::sqrt(square), top_m - eye.water_level_m, static_cast<double>(node.peak_cd),
            static_cast<double>(node.radius_m), node.awake};
}

void LightBlock::collect(const CullingEye& eye, LightMarks& marks, LeftOutCounts& counts) const {
    // The tree is at most as deep as log2(capacity / leaf_size), with one sibling waiting at each level.
    std::array<std::uint32_t, 16> waiting{};
    std::size_t count = 1;
    while (count > 0) {
        const std::size_t n = waiting[--count];
        const Node& node = nodes_[n];
        if (node.awake == 0) continue;
        if (eye.is_day && node.by_day == 0) {
            counts.off_by_day += node.awake;
            continue;
        }
        if (counts.leave_out(eye, bounds_for(node, eye))) continue;
        if (n < leaves_ - 1) {
            waiting[count++] = static_cast<std::uint32_t>(2 * n + 2);
            waiting[count++] = static_cast<std::uint32_t>(2 * n + 1);
            continue;
        }
        const std::size_t leaf = n - (leaves_ - 1);
        for (std::size_t rank = first_of(leaf, leaves_); rank < first_of(leaf + 1, leaves_); ++rank) {
            if (is_awake(rank)) marks.mark(order_[rank]);
        }
    }
}

std::size_t LightBlock::memory_bytes() const {
    return sizeof *this + order_.capacity() * sizeof(LightIndex) + nodes_.capacity() * sizeof(Node) +
           awake_.capacity() * sizeof awake_[0];
}

}  // namespace seaglare::lightdb
