#include "glare/apply/grid_quads.h"

#include <algorithm>
#include <cmath>

namespace seaglare::glare {

namespace {

constexpr int tile_rows_of_band = band_rows / tile_height;

double area_of(const GridQuad& quad) {
    return (static_cast<double>(quad.rect[2]) - static_cast<double>(quad.rect[0])) *
           (static_cast<double>(quad.rect[3]) - static_cast<double>(quad.rect[1]));
}

GridQuad quad_of(const GatherEntry& entry) {
    GridQuad quad;
    quad.light = static_cast<float>(entry.light);
    quad.rect = {static_cast<float>(entry.columns & 0xffffU), static_cast<float>(entry.rows & 0xffffU),
                 static_cast<float>((entry.columns >> 16) + 1), static_cast<float>((entry.rows >> 16) + 1)};
    quad.fade = entry.fade;
    return quad;
}

QuadKind kind_of(const GatherEntry& entry, int level, bool two_layers, double tail_from_nodes) {
    if (level > 0) return two_layers ? QuadKind::mean_of_two : QuadKind::mean_of_one;
    // Without an end it goes on for ever.
    if (!(entry.fade[3] > 0) || static_cast<double>(entry.fade[3]) > tail_from_nodes)
        return QuadKind::near_and_tail;
    return two_layers ? QuadKind::near_two : QuadKind::near_one;
}

}  // namespace

void GridQuads::build(const ScreenGeometry& g, const TileLists& lists, std::span<const LightInstance> lights,
                      double tail_from_nodes) {
    const auto& m = g.ray_from_ndc;
    for (std::size_t i = 0; i < 3; ++i) {
        ray_[0][i] = static_cast<float>(m[6 + i] - m[i] - m[3 + i]);
        ray_[1][i] = static_cast<float>(2 * m[i] / g.width_px);
        ray_[2][i] = static_cast<float>(2 * m[3 + i] / g.height_px);
    }
    quads_.clear();
    covered_nodes_ = covered_px_ = 0;
    const int height = lists.levels()[0].height;
    bands_.assign(static_cast<std::size_t>((height + band_rows - 1) / band_rows), {});
    for (int level = 0; level < static_cast<int>(lists.levels().size()); ++level)
        add_level(lists, level, tail_from_nodes);
    add_departures(lists, lights);
}

void GridQuads::add_level(const TileLists& lists, int level, double tail_from_nodes) {
    const std::span<const GatherEntry> entries = lists.entries();
    const std::span<const std::uint8_t> level_of = lists.level_of_entry();
    for (std::vector<GridQuad>& kept : kept_)
        kept.clear();
    for (std::size_t e = 0; e < entries.size(); ++e) {
        if (level_of[e] != level) continue;
        const bool two = lists.lights()[static_cast<std::size_t>(entries[e].light)].upper_share > 0;
        kept_[static_cast<std::size_t>(kind_of(entries[e], level, two, tail_from_nodes))].push_back(
            quad_of(entries[e]));
    }
    for (std::size_t kind = 0; kind < quad_kinds; ++kind) {
        const auto first = static_cast<int>(quads_.size());
        quads_.insert(quads_.end(), kept_[kind].begin(), kept_[kind].end());
        levels_[static_cast<std::size_t>(level)][kind] = {first, static_cast<int>(quads_.size())};
        for (auto at = static_cast<std::size_t>(first); at < quads_.size(); ++at) {
            const GridQuad& quad = quads_[at];
            (level > 0 ? covered_nodes_ : covered_px_) += area_of(quad);
            if (level > 0) continue;
            // Lights lie in the order of their rows: those of a band together.
            const std::size_t last = (static_cast<std::size_t>(quad.rect[3]) - 1) / band_rows;
            for (std::size_t band = static_cast<std::size_t>(quad.rect[1]) / band_rows;
                 band <= std::min(last, bands_.size() - 1); ++band) {
                QuadRange& range = bands_[band][kind];
                if (range.count() == 0) range.first = static_cast<int>(at);
                range.end = static_cast<int>(at) + 1;
            }
        }
    }
}

void GridQuads::add_departures(const TileLists& lists, std::span<const LightInstance> lights) {
    run_of_light_.assign(lists.lights().size(), -1);
    const int rows = lists.levels()[0].tiles_down;
    for (int y = 0; y < rows; ++y) {
        if (y % tile_rows_of_band == 0)
            for (std::vector<GridQuad>& kept : kept_)
                kept.clear();
        add_row(lists, lights, y);
        if ((y + 1) % tile_rows_of_band != 0 && y + 1 < rows) continue;
        Ranges& band = bands_[static_cast<std::size_t>(y / tile_rows_of_band)];
        for (const QuadKind kind : {QuadKind::departs_one, QuadKind::departs_two, QuadKind::departs_fading}) {
            const auto k = static_cast<std::size_t>(kind);
            const auto first = static_cast<int>(quads_.size());
            quads_.insert(quads_.end(), kept_[k].begin(), kept_[k].end());
            band[k] = {first, static_cast<int>(quads_.size())};
        }
    }
    for (const Ranges& band : bands_)
        for (std::size_t k = static_cast<std::size_t>(QuadKind::departs_one); k < quad_kinds; ++k)
            for (int i = band[k].first; i < band[k].end; ++i)
                covered_px_ += area_of(quads_[static_cast<std::size_t>(i)]);
}

float GridQuads::nearest_nodes(const GatherLight& light, const std::array<float, 2>& centre_px,
                               const std::array<float, 4>& rect) const {
    const float x = std::clamp(centre_px[0], rect[0], rect[2]);
    const float y = std::clamp(centre_px[1], rect[1], rect[3]);
    const float u = light.along_u[0] + light.along_u[1] * x + light.along_u[2] * y;
    const float v = light.along_v[0] + light.along_v[1] * x + light.along_v[2] * y;
    float length2 = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const float ray = ray_[0][i] + ray_[1][i] * x + ray_[2][i] * y;
        length2 += ray * ray;
    }
    return std::sqrt((u * u + v * v) / length2);
}

// Tiles of a row that follow one another are one rectangle, which shows what the farthest reaching of them does.
void GridQuads::add_row(const TileLists& lists, std::span<const LightInstance> lights, int tile_y) {
    const GridLevel& picture = lists.levels()[0];
    const std::span<const std::int32_t> begin = lists.departures().tile_begin();
    const std::span<const Departure> departures = lists.departures().entries();
    const auto bottom = static_cast<float>(tile_y * tile_height);
    const auto top = static_cast<float>(std::min((tile_y + 1) * tile_height, picture.height));
    row_.clear();
    std::fill(run_of_light_.begin(), run_of_light_.end(), -1);
    for (int x = 0; x < picture.tiles_across; ++x) {
        const auto tile = static_cast<std::size_t>(tile_y) * static_cast<std::size_t>(picture.tiles_across) +
                          static_cast<std::size_t>(x);
        const auto left = static_cast<float>(x * tile_width);
        const auto right = static_cast<float>(std::min((x + 1) * tile_width, picture.width));
        for (std::int32_t i = begin[tile]; i < begin[tile + 1]; ++i) {
            const Departure& departure = departures[static_cast<std::size_t>(i)];
            const auto light =
                static_cast<std::size_t>(departure.light < 0 ? -1 - departure.light : departure.light);
            const GatherLight& what = lists.lights()[light];
            const LightInstance& where = lights[static_cast<std::size_t>(lists.sources()[light])];
            const bool one = departure.light < 0 || !(what.upper_share > 0);
            QuadKind kind = one ? QuadKind::departs_one : QuadKind::departs_two;
            // The pixel nearest on the picture is not quite the nearest in angle.
            if (nearest_nodes(what, where.centre_px, {left, bottom, right, top}) <
                1.05F * static_cast<float>(fade_ratio) * what.departs_from)
                kind = QuadKind::departs_fading;
            int& run = run_of_light_[light];
            if (run >= 0) {
                Run& last = row_[static_cast<std::size_t>(run)];
                if (last.kind == kind && last.quad.rect[2] == left) {
                    last.quad.rect[2] = right;
                    last.quad.lower_only = std::min(last.quad.lower_only, departure.light < 0 ? 1.0F : 0.0F);
                    last.quad.reach2 = std::max(last.quad.reach2, departure.reach2);
                    continue;
                }
            }
            run = static_cast<int>(row_.size());
            row_.push_back({kind, {}});
            GridQuad& quad = row_.back().quad;
            quad.light = static_cast<float>(light);
            quad.lower_only = departure.light < 0 ? 1.0F : 0.0F;
            quad.departs_from = what.departs_from;
            quad.reach2 = departure.reach2;
            quad.rect = {left, bottom, right, top};
        }
    }
    for (const Run& run : row_)
        kept_[static_cast<std::size_t>(run.kind)].push_back(run.quad);
}

}  // namespace seaglare::glare
