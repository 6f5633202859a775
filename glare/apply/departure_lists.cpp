#include "glare/apply/departure_lists.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "glare/apply/tile_lists.h"

namespace seaglare::glare {

namespace {

// Of what a tile can afford, the part that all lights together may leave out where they are not even looked at.
constexpr double unseen_part = 0.05;
// Of the square of what it can afford, what the lights that are kept may lose together beyond their reach.
constexpr double beyond_reach = 0.02;
// What is left of either for the lights that are left out.
constexpr double most_square = 1 - unseen_part * unseen_part - beyond_reach;
// And what one of them, and all together, may lose by their lower layer alone, which costs two thirds as much to add. The
// upper departs as much again and half of it in step.
constexpr float lower_alone = 0.03F;
constexpr float all_lower_alone = 0.2F;
constexpr float lower_for_both = 1.5F;

// The larger half of a float's exponent: 0 for 1 ... 2, 1 for 1/2 ... 1.
int halvings(float positive) {
    return 127 - static_cast<int>(std::bit_cast<std::uint32_t>(positive) >> 23);
}

}  // namespace

void DepartureLists::find_slopes(const LuminanceFloor& floor, const CodeBudget& budget,
                                 double otherwise_cd_m2) {
    const auto tiles = static_cast<std::size_t>(tiles_across_) * static_cast<std::size_t>(tiles_down_);
    // Of a light whose strongest display channel is 1 (channel_bound_lx in tile_lists.cpp).
    constexpr std::array<float, 4> all_channels = {1, 1, 1,
                                                   static_cast<float>(d65_scotopic_ratio / rod_tint[2])};
    slopes_.resize(tiles);
    part_.resize(tiles);
    std::size_t tile = 0;
    for (int y = 0; y < tiles_down_; ++y)
        for (int x = 0; x < tiles_across_; ++x, ++tile) {
            slopes_[tile] =
                code_slopes(budget, otherwise_cd_m2,
                            floor.least(x * tile_width, y * tile_height, tile_width, tile_height));
            part_[tile] = std::max(slopes_[tile].part_of(all_channels), 1e-30F);
        }
}

void DepartureLists::find_rays(const ScreenGeometry& g) {
    const auto& m = g.ray_from_ndc;
    per_length_.clear();
    for (int y = 0; y <= tiles_down_; ++y)
        for (int x = 0; x <= tiles_across_; ++x) {
            const double ndc_x = 2.0 * x * tile_width / g.width_px - 1;
            const double ndc_y = 2.0 * y * tile_height / g.height_px - 1;
            double length2 = 0;
            for (std::size_t i = 0; i < 3; ++i) {
                const double ray = m[i] * ndc_x + m[3 + i] * ndc_y + m[6 + i];
                length2 += ray * ray;
            }
            per_length_.push_back(static_cast<float>(1 / std::sqrt(length2)));
        }
}

void DepartureLists::build(const ScreenGeometry& g, const Pattern& pattern, const PatternProfile& profile,
                           const LuminanceFloor& floor, const CodeBudget& budget, double otherwise_cd_m2,
                           std::span<const DepartingLight> lights) {
    static_assert(tile_width % LuminanceFloor::fine_px == 0 && tile_height % LuminanceFloor::fine_px == 0);
    tiles_across_ = (g.width_px + tile_width - 1) / tile_width;
    tiles_down_ = (g.height_px + tile_height - 1) / tile_height;
    find_slopes(floor, budget, otherwise_cd_m2);
    find_rays(g);
    sums_.assign(slopes_.size() * classes, {});
    candidates_.clear();
    const auto dearest = static_cast<double>(*std::max_element(part_.begin(), part_.end()));
    const double least_shown =
        unseen_part /
        (departure_deviations * dearest * std::sqrt(std::max<double>(static_cast<double>(lights.size()), 1)));
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const DepartingLight& light = lights[i];
        const std::span<const float> lower = profile.deviation(light.lower_table);
        const std::span<const float> upper = profile.deviation(light.upper_table);
        deviation_.resize(lower.size());
        for (std::size_t ring = 0; ring < lower.size(); ++ring)
            deviation_[ring] =
                static_cast<float>(light.lux * static_cast<double>(std::max(lower[ring], upper[ring])));
        if (!deviation_.empty()) add(g, pattern, profile, static_cast<std::int32_t>(i), light, least_shown);
    }
    choose();
    limit(profile, lights);
}

void DepartureLists::add(const ScreenGeometry& g, const Pattern& pattern, const PatternProfile& profile,
                         std::int32_t index, const DepartingLight& light, double least_shown) {
    const auto least = static_cast<float>(least_shown);
    const auto reach = static_cast<float>(
        std::partition_point(deviation_.begin(), deviation_.end(), [&](float d) { return d > least; }) -
        deviation_.begin());
    if (reach <= light.from_nodes) return;
    const double sine = std::min(static_cast<double>(reach) * pattern.pitch, 0.999);
    const PixelRect rect = cone_bounds_px(g, light.direction, std::asin(sine));
    if (rect.empty()) return;
    const int first_x = std::clamp(static_cast<int>(rect.left) / tile_width, 0, tiles_across_ - 1);
    const int last_x = std::clamp(static_cast<int>(rect.right) / tile_width, 0, tiles_across_ - 1);
    const int first_y = std::clamp(static_cast<int>(rect.bottom) / tile_height, 0, tiles_down_ - 1);
    const int last_y = std::clamp(static_cast<int>(rect.top) / tile_height, 0, tiles_down_ - 1);
    // Lashes turn and bend a pattern, so that what it has in a place says nothing.
    const bool stands = pattern.lash_turn_rad == 0 && pattern.lash_bend_per_rad == 0;
    const auto corners = static_cast<std::size_t>(tiles_across_) + 1;
    for (int ty = first_y; ty <= last_y; ++ty)
        for (int tx = first_x; tx <= last_x; ++tx) {
            DepartureBlocks::Range u{1e9F, -1e9F};
            DepartureBlocks::Range v{1e9F, -1e9F};
            for (int corner = 0; corner < 4; ++corner) {
                const int i = tx + corner % 2;
                const int j = ty + corner / 2;
                const auto x = static_cast<float>(i * tile_width);
                const auto y = static_cast<float>(j * tile_height);
                const float per_length =
                    per_length_[static_cast<std::size_t>(j) * corners + static_cast<std::size_t>(i)];
                const float at_u =
                    (light.along_u[0] + light.along_u[1] * x + light.along_u[2] * y) * per_length;
                const float at_v =
                    (light.along_v[0] + light.along_v[1] * x + light.along_v[2] * y) * per_length;
                u = {std::min(u.first, at_u), std::max(u.last, at_u)};
                v = {std::min(v.first, at_v), std::max(v.last, at_v)};
            }
            const float near_u = std::max({u.first, -u.last, 0.0F});
            const float near_v = std::max({v.first, -v.last, 0.0F});
            const float far_u = std::max(-u.first, u.last);
            const float far_v = std::max(-v.first, v.last);
            const float nearest2 = near_u * near_u + near_v * near_v;
            if (nearest2 >= reach * reach ||
                far_u * far_u + far_v * far_v <= light.from_nodes * light.from_nodes)
                continue;
            const auto tile = static_cast<std::size_t>(ty) * static_cast<std::size_t>(tiles_across_) +
                              static_cast<std::size_t>(tx);
            float rms = 0;
            float most = 0;
            if (stands) {
                Departed here = profile.departed(light.lower_table, u, v);
                if (light.upper_share > 0) {
                    const Departed upper = profile.departed(light.upper_table, u, v);
                    for (std::size_t c = 0; c < 4; ++c) {
                        here.most[c] += light.upper_share * (upper.most[c] - here.most[c]);
                        here.rms[c] += light.upper_share * (upper.rms[c] - here.rms[c]);
                    }
                }
                for (std::size_t c = 0; c < 4; ++c) {
                    here.most[c] *= std::abs(light.illuminance[c]);
                    here.rms[c] *= std::abs(light.illuminance[c]);
                }
                most = slopes_[tile].part_of(here.most);
                rms = slopes_[tile].part_of(here.rms);
            } else {
                const float nearest = std::max(std::sqrt(nearest2), light.from_nodes);
                rms = part_[tile] * deviation_[static_cast<std::size_t>(nearest)];
                most = static_cast<float>(departure_deviations) * rms;
            }
            const float deviations = static_cast<float>(departure_deviations) * rms;
            if (most > 0) add(tile, index, light.upper_share, {deviations * deviations, most});
        }
}

void DepartureLists::add(std::size_t tile, std::int32_t index, float upper_share, Parts parts) {
    Parts* const sums = &sums_[tile * classes];
    const auto put = [](Parts& sum, Parts more, float times) {
        sum.square += times * times * more.square;
        sum.most += times * more.most;
    };
    const int at = std::clamp(halvings(parts.most * parts.most), 0, classes - 1);
    put(sums[at], parts, 1);
    // The faintest class is always left out.
    if (at == classes - 1) return;
    const float both = lower_for_both * upper_share;
    const float lost = both * both * parts.square;
    const bool lower = both > 0 && lost <= lower_alone && sums[classes - 1].square + lost <= all_lower_alone;
    if (lower) put(sums[classes - 1], parts, both);
    candidates_.push_back({static_cast<std::uint32_t>(tile * classes) + static_cast<std::uint32_t>(at),
                           lower ? -1 - index : index, parts});
}

void DepartureLists::choose() {
    const std::size_t tiles = slopes_.size();
    const auto affords = [](Parts lost) {
        return static_cast<double>(lost.square) <= most_square ||
               static_cast<double>(lost.most) <= 1 - std::sqrt(1 - most_square);
    };
    const auto sum_of = [](Parts a, Parts b) { return Parts{a.square + b.square, a.most + b.most}; };
    first_kept_.resize(tiles);
    lost_.resize(tiles);
    for (std::size_t tile = 0; tile < tiles; ++tile) {
        const Parts* const sums = &sums_[tile * classes];
        int kept = classes - 1;
        Parts sum = sums[kept];
        while (kept > 0 && affords(sum_of(sum, sums[kept - 1]))) {
            --kept;
            sum = sum_of(sum, sums[kept]);
        }
        first_kept_[tile] = kept;
        lost_[tile] = sum;
    }
    const auto tile_of = [](const Candidate& candidate) {
        return static_cast<std::size_t>(candidate.tile_and_class / classes);
    };
    // Of the class that cannot go as a whole, those go that still can.
    const auto is_left_out = [&](const Candidate& candidate) {
        const auto in_class = static_cast<std::int32_t>(candidate.tile_and_class % classes);
        const std::size_t tile = tile_of(candidate);
        if (in_class >= first_kept_[tile]) return true;
        const Parts with = sum_of(lost_[tile], candidate.parts);
        if (in_class + 1 < first_kept_[tile] || !affords(with)) return false;
        lost_[tile] = with;
        return true;
    };
    candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(), is_left_out), candidates_.end());
    spent_.resize(tiles);
    for (std::size_t tile = 0; tile < tiles; ++tile) {
        const auto rest = 1 - most_square;
        spent_[tile] = static_cast<float>(std::min(std::sqrt(static_cast<double>(lost_[tile].square) + rest),
                                                   static_cast<double>(lost_[tile].most) + std::sqrt(rest)));
    }
    tile_begin_.assign(tiles + 1, 0);
    for (const Candidate& candidate : candidates_)
        ++tile_begin_[tile_of(candidate) + 1];
    for (std::size_t t = 0; t < tiles; ++t)
        tile_begin_[t + 1] += tile_begin_[t];
    kept_.resize(candidates_.size());
    // Filling moves each beginning to its end, which is the next beginning: shifted back below.
    for (const Candidate& candidate : candidates_) {
        std::int32_t& place = tile_begin_[tile_of(candidate)];
        kept_[static_cast<std::size_t>(place)].light = candidate.light;
        ++place;
    }
    for (std::size_t t = tiles; t > 0; --t)
        tile_begin_[t] = tile_begin_[t - 1];
    tile_begin_[0] = 0;
}

void DepartureLists::limit(const PatternProfile& profile, std::span<const DepartingLight> lights) {
    for (std::size_t tile = 0; tile < slopes_.size(); ++tile) {
        const auto first = static_cast<std::size_t>(tile_begin_[tile]);
        const auto end = static_cast<std::size_t>(tile_begin_[tile + 1]);
        if (first == end) continue;
        const double lost = std::sqrt(beyond_reach / static_cast<double>(end - first)) /
                            (departure_deviations * static_cast<double>(part_[tile]));
        for (std::size_t i = first; i < end; ++i) {
            const std::int32_t index = kept_[i].light;
            const DepartingLight& light = lights[static_cast<std::size_t>(index < 0 ? -1 - index : index)];
            const auto shown = static_cast<float>(lost / light.lux);
            const auto reach = [&](std::size_t table) {
                const std::span<const float> deviation = profile.deviation(table);
                return std::partition_point(deviation.begin(), deviation.end(),
                                            [shown](float d) { return d > shown; }) -
                       deviation.begin();
            };
            const auto nodes =
                static_cast<float>(std::max(reach(light.lower_table), reach(light.upper_table)));
            kept_[i].reach2 = nodes * nodes;
        }
    }
}

}  // namespace seaglare::glare
