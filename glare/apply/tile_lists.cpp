#include "glare/apply/tile_lists.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "glare/apply/layer_moment.h"
#include "glare/tone/operators.h"

namespace seaglare::glare {

namespace {

constexpr int grid_pad = 2;
constexpr int fewest_nodes = 20;

// Nearer than this, in cells, the fade into a grid could not be told from a step.
constexpr double nearest_cells = 2.5;
constexpr float never_departs = 1e6F;
constexpr double end_ratio = 1.3;
// On the coarsest grids a tail costs next to nothing, and what a thousand tails leave out adds up: they end this much later
// than the threshold asks.
constexpr double later_end = 16;

constexpr double quarter_turn_rad = std::numbers::pi / 2;

double channel_bound_lx(const std::array<float, 4>& rgbv) {
    const double rods = std::abs(static_cast<double>(rgbv[3])) / d65_scotopic_ratio * rod_tint[2];
    return std::max({static_cast<double>(std::abs(rgbv[0])), static_cast<double>(std::abs(rgbv[1])),
                     static_cast<double>(std::abs(rgbv[2])), rods});
}

// A linear function of the pixel position: its value times the length of the ray is vector . ray.
std::array<float, 3> per_px(const ScreenGeometry& g, const Vec3& vector, double scale) {
    const auto& m = g.ray_from_ndc;
    const double x = dot(vector, {m[0], m[1], m[2]}) * scale;
    const double y = dot(vector, {m[3], m[4], m[5]}) * scale;
    const double one = dot(vector, {m[6], m[7], m[8]}) * scale;
    return {static_cast<float>(one - x - y), static_cast<float>(2 * x / g.width_px),
            static_cast<float>(2 * y / g.height_px)};
}

// As lash_warp_of in shaders/lash_warp.glsl.
std::array<float, 4> lash_of(const ScreenGeometry& g, const Pattern& pattern, const Vec3& direction) {
    if (pattern.lash_turn_rad == 0 && pattern.lash_bend_per_rad == 0) return {1, 0, 0, 0};
    const double w = dot(g.row_w, direction);
    std::array<double, 2> place = {1, 1};
    if (w > 1e-6 * length(g.row_w))
        place = {std::clamp(dot(g.row_x, direction) / w, -1.0, 1.0),
                 std::clamp(dot(g.row_y, direction) / w, -1.0, 1.0)};
    const double turn = pattern.lash_turn_rad * std::sin(std::numbers::pi * place[0]);
    const double bend =
        pattern.lash_bend_per_rad * (1 + 0.5 * std::sin(std::numbers::pi * place[1])) * pattern.pitch;
    return {static_cast<float>(std::cos(turn)), static_cast<float>(std::sin(turn)), static_cast<float>(bend),
            0};
}

std::uint32_t packed(double first, double last) {
    return static_cast<std::uint32_t>(first) | static_cast<std::uint32_t>(last) << 16;
}

}  // namespace

std::vector<GridLevel> plan_levels(int width_px, int height_px) {
    std::vector<GridLevel> levels;
    GridLevel level;
    level.width = width_px;
    level.height = height_px;
    for (;;) {
        level.tiles_across = (level.width + tile_width - 1) / tile_width;
        level.tiles_down = (level.height + tile_height - 1) / tile_height;
        levels.push_back(level);
        if (static_cast<int>(levels.size()) == most_levels ||
            std::max(level.width, level.height) < fewest_nodes)
            return levels;
        GridLevel above;
        above.cell_px = level.cell_px * 2;
        above.pad = grid_pad;
        // What the last strip and the last row interpolate from (UPSAMPLE in shaders/gather.cl).
        above.width = level.row_nodes() / 2 - level.pad / 2 + 8;
        above.height = (level.height - 1 - level.pad + 2 * grid_pad) / 2 + 3;
        above.first_tile = level.first_tile + level.tiles_across * level.tiles_down;
        level = above;
    }
}

bool is_gathered(const Pattern& pattern, const LightInstance& light, float visible) {
    if (!(visible >= 0)) return false;
    // The radial tables begin two nodes from a light: a tail that is there nearer by is drawn.
    constexpr double nearest_nodes = 2;
    if (pattern.tail_scale > 0 && pattern.window_inner < nearest_nodes * pattern.pitch) return false;
    const float last = pattern.layer_radius_nodes.empty() ? 0.0F : pattern.layer_radius_nodes.back();
    return light.disc_nodes <= std::max(last, 0.25F);
}

void TileLists::build(const ScreenGeometry& g, const Pattern& pattern, const PatternProfile& profile,
                      const GatherThresholds& thresholds, std::span<const LightInstance> lights,
                      std::span<const float> visible) {
    if (levels_.empty() || levels_[0].width != g.width_px || levels_[0].height != g.height_px)
        levels_ = plan_levels(g.width_px, g.height_px);
    floor_.build(g, pattern, profile, thresholds.structure, thresholds.share_cd_m2, lights, visible);
    lights_.clear();
    sources_.clear();
    departing_.clear();
    entries_.clear();
    level_of_entry_.clear();
    levels_used_ = 1;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        float factor = visible.empty() ? 1.0F : visible[i];
        if (factor < 0 && thresholds.unknown_too) factor = 1;
        if (!(factor > 0) || !is_gathered(pattern, lights[i], factor)) continue;
        add_light(g, pattern, profile, thresholds, lights[i], factor);
        // One that reaches no pixel was not added.
        if (lights_.size() > sources_.size()) sources_.push_back(static_cast<std::int32_t>(i));
    }
    sort_into_tiles();
    departures_.build(g, pattern, profile, floor_, thresholds.structure, thresholds.share_cd_m2, departing_);
}

void TileLists::add_light(const ScreenGeometry& g, const Pattern& pattern, const PatternProfile& profile,
                          const GatherThresholds& thresholds, const LightInstance& light, float visible) {
    const double pitch = pattern.pitch > 0 ? pattern.pitch : g.pitch;
    GatherLight out;
    const Vec3 direction =
        normalised({static_cast<double>(light.direction[0]), static_cast<double>(light.direction[1]),
                    static_cast<double>(light.direction[2])});
    const Tangents tangents = pattern_tangents(g, direction);
    out.along_u = per_px(g, tangents.u, 1 / pitch);
    out.along_v = per_px(g, tangents.v, 1 / pitch);
    out.towards = per_px(g, direction, 1);
    out.illuminance = light.illuminance;
    for (float& channel : out.illuminance)
        channel *= visible;
    const auto lash = lash_of(g, pattern, direction);
    std::copy_n(lash.begin(), 3, out.lash.begin());

    // As psf_of_disc in shaders/skirt.frag.glsl.
    std::size_t lower = profile.tail_table();
    std::size_t upper = lower;
    if (const std::size_t layers = pattern.layer_radius_nodes.size(); layers > 0 && !pattern.skirt.empty()) {
        const auto& radii = pattern.layer_radius_nodes;
        std::size_t below = 0;
        const float disc2 = light.disc_nodes * light.disc_nodes;
        while (below + 2 < layers && layer_moment(radii[below + 1]) < disc2)
            ++below;
        const std::size_t above = std::min(below + 1, layers - 1);
        const float low2 = layer_moment(radii[below]);
        const float span = layer_moment(radii[above]) - low2;
        const double share =
            span > 0 ? static_cast<double>(std::clamp((disc2 - low2) / span, 0.0F, 1.0F)) : 0.0;
        const auto slot = static_cast<std::size_t>(light.lamp_slot);
        lower = profile.table_of(slot, below);
        upper = profile.table_of(slot, above);
        if (share < 1.0 / 512) upper = lower;
        if (share > 1 - 1.0 / 512) lower = upper;
        out.upper_share = upper == lower ? 0.0F : static_cast<float>(share);
    }
    out.lower_table = static_cast<std::int32_t>(lower);
    out.upper_table = static_cast<std::int32_t>(upper);

    const double lux = std::max(channel_bound_lx(out.illuminance), 1e-30);
    const auto farther = [&](auto reach) {
        return std::max(reach(lower), upper == lower ? 0.0 : reach(upper));
    };
    double end = farther([&](std::size_t table) {
        return profile.reach_nodes(table, thresholds.reach_cd_m2 / (later_end * lux));
    });
    const bool endless = end * pitch > 0.99 / end_ratio;
    // How near to the light a grid may begin. Those that begin within the light's own surroundings err where it is bright.
    const double node_px = g.pitch / pitch;
    const double around = floor_.affordable_around(light.centre_px);
    const auto nearest = [&](int level) {
        const double h = levels_[static_cast<std::size_t>(level)].cell_px * node_px;
        const double share = level <= 2 ? around : thresholds.share_cd_m2;
        const double needed =
            farther([&](std::size_t table) { return profile.grid_reach_nodes(table, level, share / lux); });
        return std::max(needed * node_px, nearest_cells * h);
    };

    const auto index = static_cast<std::int32_t>(lights_.size());
    const std::size_t before = entries_.size();
    const int coarsest = static_cast<int>(levels_.size()) - 1;
    int level = 0;
    std::array<double, 2> in{};
    double start = 0;
    out.departs_from = never_departs;
    for (;;) {
        int next = level;
        if (level < coarsest) {
            start = std::max(start, nearest(level + 1));
            next = level + 1;
            while (next < coarsest && nearest(next + 1) <= start)
                ++next;
        }
        if (next == level || start * fade_ratio >= end) {
            if (endless)
                add_entry(g, light, pitch, level, {in[0], in[1], 0, 0});
            else
                add_entry(g, light, pitch, level, {in[0], in[1], end, end * end_ratio});
            break;
        }
        const double stop = start * fade_ratio;
        if (level == 0) out.departs_from = static_cast<float>(start);
        add_entry(g, light, pitch, level, {in[0], in[1], start, stop});
        in = {start, stop};
        start = stop;
        level = next;
    }
    if (entries_.size() == before) return;
    for (std::size_t e = before; e < entries_.size(); ++e)
        entries_[e].light = index;
    lights_.push_back(out);
    departing_.push_back({direction, out.along_u, out.along_v, light.centre_px, lux, lower, upper,
                          out.departs_from, out.upper_share, out.illuminance});
}

void TileLists::add_entry(const ScreenGeometry& g, const LightInstance& light, double pitch, int level,
                          const std::array<double, 4>& fade) {
    const GridLevel& grid = levels_[static_cast<std::size_t>(level)];
    const double cell = grid.cell_px;
    const double sine = fade[3] > 0 ? std::min(fade[3] * pitch, 1.0) : 1.0;
    const Vec3 direction = {static_cast<double>(light.direction[0]), static_cast<double>(light.direction[1]),
                            static_cast<double>(light.direction[2])};
    const double margin = level == 0 ? 0 : cell * (strip_nodes + 2 * grid_pad);
    const PixelRect rect =
        cone_bounds_px(g, direction, sine < 1 ? std::asin(sine) : quarter_turn_rad, margin);
    if (rect.empty()) return;
    const double left = std::max(std::floor((rect.left - 0.5) / cell) + grid.pad, 0.0);
    const double right = std::min(std::ceil((rect.right - 0.5) / cell) + grid.pad, grid.width - 1.0);
    const double bottom = std::max(std::floor((rect.bottom - 0.5) / cell) + grid.pad, 0.0);
    const double top = std::min(std::ceil((rect.top - 0.5) / cell) + grid.pad, grid.height - 1.0);
    if (right < left || top < bottom) return;
    GatherEntry entry;
    entry.columns = packed(left, right);
    entry.rows = packed(bottom, top);
    for (std::size_t i = 0; i < 4; ++i)
        entry.fade[i] = static_cast<float>(fade[i]);
    entries_.push_back(entry);
    level_of_entry_.push_back(static_cast<std::uint8_t>(level));
    levels_used_ = std::max(levels_used_, level + 1);
}

void TileLists::sort_into_tiles() {
    const GridLevel& last = levels_.back();
    const int all_tiles = last.first_tile + last.tiles_across * last.tiles_down;
    const auto tiles = static_cast<std::size_t>(all_tiles);
    tile_begin_.assign(tiles + 1, 0);
    const auto for_each_tile = [this](std::size_t e, auto visit) {
        const GridLevel& grid = levels_[level_of_entry_[e]];
        const GatherEntry& entry = entries_[e];
        const auto first_x = static_cast<int>(entry.columns & 0xffffU) / tile_width;
        const auto last_x = static_cast<int>(entry.columns >> 16) / tile_width;
        const auto first_y = static_cast<int>(entry.rows & 0xffffU) / tile_height;
        const auto last_y = static_cast<int>(entry.rows >> 16) / tile_height;
        for (int y = first_y; y <= last_y; ++y)
            for (int x = first_x; x <= last_x; ++x)
                visit(grid.first_tile + y * grid.tiles_across + x);
    };
    for (std::size_t e = 0; e < entries_.size(); ++e)
        for_each_tile(e, [this](int tile) { ++tile_begin_[static_cast<std::size_t>(tile) + 1]; });
    for (std::size_t t = 0; t < tiles; ++t)
        tile_begin_[t + 1] += tile_begin_[t];
    tile_entries_.resize(static_cast<std::size_t>(tile_begin_[tiles]));
    // Filling moves each beginning to its end, which is the next beginning: shifted back below.
    for (std::size_t e = 0; e < entries_.size(); ++e)
        for_each_tile(e, [this, e](int tile) {
            std::int32_t& place = tile_begin_[static_cast<std::size_t>(tile)];
            tile_entries_[static_cast<std::size_t>(place)] = static_cast<std::int32_t>(e);
            ++place;
        });
    for (std::size_t t = tiles; t > 0; --t)
        tile_begin_[t] = tile_begin_[t - 1];
    tile_begin_[0] = 0;
}

}  // namespace seaglare::glare
