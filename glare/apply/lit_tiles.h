// Where in a band of the picture the sum of lights can change a code of the target: tiles of pixels. The last pass draws those
// alone, and the host's pixels beneath the others are not even read. Pure.
//
// Software rasterisers compute every branch of every pixel, so that a test in the shader spares nothing; on an ordinary night
// two thirds of a picture lie below a quarter of a code.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "glare/apply/accumulator.h"
#include "glare/apply/light_instance.h"

namespace seaglare::glare {

// Whole pixels of the viewport; right and top are beyond the last.
struct PixelBox {
    int left = 0, bottom = 0, right = 0, top = 0;
    int width() const { return right - left; }
    int height() const { return top - bottom; }
    bool empty() const { return right <= left || top <= bottom; }
};
PixelBox common_box(const PixelBox& a, const PixelBox& b);

class LitTiles {
  public:
    static constexpr int tile_width_px = 32;
    static constexpr int tile_height_px = 16;
    static_assert(band_rows % tile_height_px == 0);

    // Of pictures this wide. `least_cd_m2`: what no channel of a pixel need exceed to stay as it is (Compositor::least_cd_m2).
    void begin(int width_px, double least_cd_m2);
    void turn_to(RowRange band);  // none of it is lit
    void light_all();
    // What a rectangle touches, in pixels of the viewport.
    void light(const RectPx& rect);
    // What the sum of lights of the whole band says: count x width x 4 floats, red, green, blue and scotopic luminance. A NaN
    // lights nothing.
    void light(std::span<const float> rgbv);
    // What the rectangles of these lights touch; that of their tail as far as a grid of so many pixels carries it.
    void light(std::span<const LightInstance> lights, int grid_cell_px);

    // Boxes within `box` that cover each lit tile once, and no other. The list is good until the next call.
    std::span<const PixelBox> boxes_in(const PixelBox& box);

  private:
    using Word = std::uint64_t;
    Word& word(int row, int column) {
        return lit_[static_cast<std::size_t>(row) * words_ + static_cast<std::size_t>(column / word_tiles)];
    }
    bool is_lit(int row, int column) { return (word(row, column) >> (column % word_tiles) & 1U) != 0; }
    void light_tile(int row, int column) { word(row, column) |= Word{1} << (column % word_tiles); }
    void append(const PixelBox& run);

    static constexpr int word_tiles = 64;
    int width_px_ = 0;
    int across_ = 0;
    std::size_t words_ = 0;  // for a row of tiles
    float least_ = 0;
    RowRange band_;
    std::vector<Word> lit_;
    std::vector<PixelBox> boxes_;
};

}  // namespace seaglare::glare
