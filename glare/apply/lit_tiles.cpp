#include "glare/apply/lit_tiles.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace seaglare::glare {

namespace {

// The largest and the least of each component, two pixels at a time: four instructions of a vector unit.
struct Extremes {
    std::array<float, 8> largest{};
    std::array<float, 8> least{};

    void take(std::span<const float> rgbv) {
        std::size_t i = 0;
        for (; i + 8 <= rgbv.size(); i += 8) {
            for (std::size_t c = 0; c < 8; ++c)
                take(c, rgbv[i + c]);
        }
        for (; i < rgbv.size(); ++i)
            take(i % 4, rgbv[i]);
    }
    // More than glare can move any channel, whatever the host's pixel: a colour outside the gamut is moved by its lowest
    // component; rods see scotopic luminance/2.464 in a hue whose largest component is 1.27/1.0087 (tone/operators.h).
    float channel_bound() const {
        float high = 0;
        float low = 0;
        for (const std::size_t c : {0, 1, 2, 4, 5, 6}) {
            high = std::max(high, largest[c]);
            low = std::min(low, least[c]);
        }
        return std::max(high - low, 0.511F * std::max(largest[3], largest[7]));
    }

  private:
    void take(std::size_t c, float value) {
        largest[c] = value > largest[c] ? value : largest[c];
        least[c] = value < least[c] ? value : least[c];
    }
};

int to_pixel(float px, int most) {
    return static_cast<int>(std::clamp(px, 0.0F, static_cast<float>(most)));
}

}  // namespace

PixelBox common_box(const PixelBox& a, const PixelBox& b) {
    return {std::max(a.left, b.left), std::max(a.bottom, b.bottom), std::min(a.right, b.right),
            std::min(a.top, b.top)};
}

void LitTiles::begin(int width_px, double least_cd_m2) {
    width_px_ = width_px;
    across_ = (width_px + tile_width_px - 1) / tile_width_px;
    words_ = static_cast<std::size_t>((across_ + word_tiles - 1) / word_tiles);
    least_ = static_cast<float>(std::clamp(least_cd_m2, 0.0, 1e30));
    lit_.resize(words_ * (band_rows / tile_height_px));
    boxes_.reserve(static_cast<std::size_t>(across_) * (band_rows / tile_height_px));
}

void LitTiles::turn_to(RowRange band) {
    band_ = band;
    std::fill(lit_.begin(), lit_.end(), Word{0});
}

void LitTiles::light_all() {
    std::fill(lit_.begin(), lit_.end(), ~Word{0});
}

void LitTiles::light(const RectPx& rect) {
    const float first_row = static_cast<float>(band_.first);
    if (!(rect[0] < rect[2] && rect[1] < rect[3] && rect[3] > first_row &&
          rect[1] < static_cast<float>(band_.end()) && rect[2] > 0 &&
          rect[0] < static_cast<float>(width_px_)))
        return;
    const int left = to_pixel(std::floor(rect[0]), width_px_ - 1) / tile_width_px;
    const int right = (to_pixel(std::ceil(rect[2]), width_px_) + tile_width_px - 1) / tile_width_px;
    const int bottom = to_pixel(std::floor(rect[1] - first_row), band_.count - 1) / tile_height_px;
    const int top =
        (to_pixel(std::ceil(rect[3] - first_row), band_.count) + tile_height_px - 1) / tile_height_px;
    for (int row = bottom; row < top; ++row) {
        for (int column = left; column < right; ++column)
            light_tile(row, column);
    }
}

void LitTiles::light(std::span<const float> rgbv) {
    const auto row_floats = static_cast<std::size_t>(width_px_) * 4;
    constexpr auto tile_floats = static_cast<std::size_t>(tile_width_px) * 4;
    for (int y = 0; y < band_.count; ++y) {
        const std::span<const float> row = rgbv.subspan(static_cast<std::size_t>(y) * row_floats, row_floats);
        const int tile_row = y / tile_height_px;
        for (int column = 0; column < across_; ++column) {
            if (is_lit(tile_row, column)) continue;
            const std::size_t first = static_cast<std::size_t>(column) * tile_floats;
            Extremes extremes;
            extremes.take(row.subspan(first, std::min(tile_floats, row_floats - first)));
            if (extremes.channel_bound() > least_) light_tile(tile_row, column);
        }
    }
}

void LitTiles::light(std::span<const LightInstance> lights, int grid_cell_px) {
    const auto reach = static_cast<float>(grid_cell_px);
    for (const LightInstance& lamp : lights) {
        light(lamp.core_rect);
        light(lamp.skirt_rect);
        RectPx tail = lamp.tail_rect;
        if (!(tail[0] < tail[2] && tail[1] < tail[3])) continue;
        tail[0] -= reach;
        tail[1] -= reach;
        tail[2] += reach;
        tail[3] += reach;
        light(tail);
    }
}

// A run as wide as a box that it lies on makes that one higher.
void LitTiles::append(const PixelBox& run) {
    const auto below = std::find_if(boxes_.begin(), boxes_.end(), [&](const PixelBox& box) {
        return box.top == run.bottom && box.left == run.left && box.right == run.right;
    });
    if (below != boxes_.end())
        below->top = run.top;
    else
        boxes_.push_back(run);
}

std::span<const PixelBox> LitTiles::boxes_in(const PixelBox& box) {
    boxes_.clear();
    for (int row = 0; row * tile_height_px < band_.count; ++row) {
        const int bottom = band_.first + row * tile_height_px;
        const int top = std::min(bottom + tile_height_px, band_.end());
        for (int column = 0; column < across_;) {
            if (!is_lit(row, column)) {
                ++column;
                continue;
            }
            const int first = column;
            while (column < across_ && is_lit(row, column))
                ++column;
            const PixelBox run = common_box(
                box, {first * tile_width_px, bottom, std::min(column * tile_width_px, width_px_), top});
            if (!run.empty()) append(run);
        }
    }
    return boxes_;
}

}  // namespace seaglare::glare
