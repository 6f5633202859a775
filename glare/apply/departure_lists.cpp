#include "glare/apply/departure_lists.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "glare/apply/tile_lists.h"

namespace seaglare::glare {

namespace {

// Of what a tile can afford, the part that all lights together may leave out where they are not even looked at.
constexpr double unseen_part = 0.2;
// Of the square of what it can afford, what the lights that are kept may lose together beyond their reach.
constexpr double beyond_reach = 0.1;
// And what one of them may lose by its lower layer alone. The upper departs as much again and half of it in step.
constexpr float lower_alone = 0.004F;
constexpr float lower_for_both = 1.5F;

// The larger half of a float's exponent: 0 for 1 ... 2, 1 for 1/2 ... 1.
int halvings(float positive) {
    return 127 - static_cast<int>(std::bit_cast<std::uint32_t>(positive) >> 23);
}

}  // namespace

void DepartureLists::find_affordable(const LuminanceFloor& floor) {
    const auto tiles = static_cast<std::size_t>(tiles_across_) * static_cast<std::size_t>(tiles_down_);
    inverse_square_.resize(tiles);
    for (int y = 0; y < tiles_down_; ++y)
        for (int x = 0; x < tiles_across_; ++x) {
            const double affordable =
                floor.affordable_cd_m2(floor.cell_of(x * tile_width, y * tile_height)) / departure_deviations;
            inverse_square_[static_cast<std::size_t>(y) * static_cast<std::size_t>(tiles_across_) +
                            static_cast<std::size_t>(x)] =
                static_cast<float>(std::min(1 / std::max(affordable * affordable, 1e-60), 1e30));
        }
}

void DepartureLists::build(const ScreenGeometry& g, const Pattern& pattern, const PatternProfile& profile,
                           const LuminanceFloor& floor, std::span<const DepartingLight> lights) {
    static_assert(LuminanceFloor::cell_px % tile_width == 0 && LuminanceFloor::cell_px % tile_height == 0);
    tiles_across_ = (g.width_px + tile_width - 1) / tile_width;
    tiles_down_ = (g.height_px + tile_height - 1) / tile_height;
    find_affordable(floor);
    const std::size_t tiles = inverse_square_.size();
    squares_.assign(tiles * classes, 0.0F);
    candidates_.clear();
    const auto& m = g.ray_from_ndc;
    for (std::size_t i = 0; i < 3; ++i) {
        ray_[0][i] = static_cast<float>(m[6 + i] - m[i] - m[3 + i]);
        ray_[1][i] = static_cast<float>(2 * m[i] / g.width_px);
        ray_[2][i] = static_cast<float>(2 * m[3 + i] / g.height_px);
    }
    const float dearest = *std::max_element(inverse_square_.begin(), inverse_square_.end());
    const double least_shown =
        unseen_part /
        std::sqrt(static_cast<double>(dearest) * std::max<double>(static_cast<double>(lights.size()), 1));
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const DepartingLight& light = lights[i];
        const std::span<const float> lower = profile.deviation(light.lower_table);
        const std::span<const float> upper = profile.deviation(light.upper_table);
        deviation2_.resize(lower.size());
        for (std::size_t ring = 0; ring < lower.size(); ++ring) {
            const double shown = light.lux * static_cast<double>(std::max(lower[ring], upper[ring]));
            deviation2_[ring] = static_cast<float>(shown * shown);
        }
        if (!deviation2_.empty()) add(g, pattern, static_cast<std::int32_t>(i), light, least_shown);
    }
    choose();
    limit(profile, lights);
}

void DepartureLists::add(const ScreenGeometry& g, const Pattern& pattern, std::int32_t index,
                         const DepartingLight& light, double least_shown) {
    const auto least2 = static_cast<float>(least_shown * least_shown);
    const auto reach = static_cast<std::size_t>(
        std::partition_point(deviation2_.begin(), deviation2_.end(), [&](float d) { return d > least2; }) -
        deviation2_.begin());
    if (static_cast<double>(reach) <= static_cast<double>(light.from_nodes)) return;
    const double sine = std::min(static_cast<double>(reach) * pattern.pitch, 0.999);
    const PixelRect rect = cone_bounds_px(g, light.direction, std::asin(sine));
    if (rect.empty()) return;
    const int first_x = std::clamp(static_cast<int>(rect.left) / tile_width, 0, tiles_across_ - 1);
    const int last_x = std::clamp(static_cast<int>(rect.right) / tile_width, 0, tiles_across_ - 1);
    const int first_y = std::clamp(static_cast<int>(rect.bottom) / tile_height, 0, tiles_down_ - 1);
    const int last_y = std::clamp(static_cast<int>(rect.top) / tile_height, 0, tiles_down_ - 1);
    for (int ty = first_y; ty <= last_y; ++ty) {
        const auto bottom = static_cast<float>(ty * tile_height);
        const float y = std::clamp(light.centre_px[1], bottom, bottom + tile_height);
        for (int tx = first_x; tx <= last_x; ++tx) {
            // Where the tile is nearest to the light.
            const auto left = static_cast<float>(tx * tile_width);
            const float x = std::clamp(light.centre_px[0], left, left + tile_width);
            const float u = light.along_u[0] + light.along_u[1] * x + light.along_u[2] * y;
            const float v = light.along_v[0] + light.along_v[1] * x + light.along_v[2] * y;
            float length2 = 0;
            for (std::size_t i = 0; i < 3; ++i) {
                const float ray = ray_[0][i] + ray_[1][i] * x + ray_[2][i] * y;
                length2 += ray * ray;
            }
            const float nearest = std::max(std::sqrt((u * u + v * v) / length2), light.from_nodes);
            const auto ring = static_cast<std::size_t>(std::min(nearest, 1e6F));
            if (ring >= deviation2_.size()) continue;
            const auto tile = static_cast<std::size_t>(ty) * static_cast<std::size_t>(tiles_across_) +
                              static_cast<std::size_t>(tx);
            const float square = deviation2_[ring] * inverse_square_[tile];
            if (!(square > 0)) continue;
            const int at = std::clamp(halvings(square), 0, classes - 1);
            squares_[tile * classes + static_cast<std::size_t>(at)] += square;
            // The faintest class is always left out.
            if (at == classes - 1) continue;
            const float both = lower_for_both * light.upper_share;
            const bool lower = both > 0 && both * both * square <= lower_alone;
            if (lower) squares_[tile * classes + classes - 1] += both * both * square;
            candidates_.push_back(
                {static_cast<std::uint32_t>(tile * classes) + static_cast<std::uint32_t>(at),
                 lower ? -1 - index : index});
        }
    }
}

void DepartureLists::choose() {
    const std::size_t tiles = inverse_square_.size();
    constexpr double most = 1 - unseen_part * unseen_part - beyond_reach;
    first_kept_.resize(tiles);
    spent_.resize(tiles);
    for (std::size_t tile = 0; tile < tiles; ++tile) {
        const float* const squares = &squares_[tile * classes];
        int kept = classes - 1;
        auto sum = static_cast<double>(squares[kept]);
        while (kept > 0 && sum + static_cast<double>(squares[kept - 1]) <= most) {
            --kept;
            sum += static_cast<double>(squares[kept]);
        }
        first_kept_[tile] = kept;
        spent_[tile] = static_cast<float>(std::sqrt(sum + unseen_part * unseen_part + beyond_reach));
    }
    tile_begin_.assign(tiles + 1, 0);
    const auto tile_of = [](const Candidate& candidate) {
        return static_cast<std::size_t>(candidate.tile_and_class / classes);
    };
    const auto is_kept = [&](const Candidate& candidate) {
        return static_cast<std::int32_t>(candidate.tile_and_class % classes) <
               first_kept_[tile_of(candidate)];
    };
    candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(),
                                     [&](const Candidate& candidate) { return !is_kept(candidate); }),
                      candidates_.end());
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
    for (std::size_t tile = 0; tile < inverse_square_.size(); ++tile) {
        const auto first = static_cast<std::size_t>(tile_begin_[tile]);
        const auto end = static_cast<std::size_t>(tile_begin_[tile + 1]);
        if (first == end) continue;
        const double lost = std::sqrt(
            beyond_reach / (static_cast<double>(end - first) * static_cast<double>(inverse_square_[tile])));
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
