// What the lights of a frame add up to: luminance and scotopic luminance at full resolution, and their far tails on a grid
// of cells. The picture is the sum of both, the grid read bilinearly (add_coarse_grid).
//
// Of the full resolution there is a band at a time (accumulator.h), in two textures by turns: one is filled while the GPU
// reads the other. Which tiles of it can change the picture is known where the band is given, and is for whoever draws into it
// to say otherwise.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "glare/apply/accumulator.h"
#include "glare/apply/hdr_buffers.h"
#include "glare/apply/lit_tiles.h"

namespace seaglare::glare {

class HdrSum {
  public:
    explicit HdrSum(const Gl& gl) : bands_{FloatBuffer(gl), FloatBuffer(gl)}, grid_(gl) {}

    // Throws GlError as FloatBuffer::resize. `cell` 0: without the grid; otherwise 2 at least. Leaves everything zero.
    // `least_cd_m2`: as LitTiles::begin has it.
    void begin(int width_px, int height_px, int cell, double least_cd_m2 = 0) {
        tiles_.begin(width_px, least_cd_m2);
        grid_lit_ = false;
        for (FloatBuffer& band : bands_) {
            band.resize(GL_RGBA32F, width_px, height_px, std::min(band_rows, height_px), "the HDR buffer");
            band.bind_for_drawing();
            band.clear();
        }
        clean_ = {true, true};
        cell_px_ = cell;
        if (cell == 0) return;
        grid_.resize(GL_RGBA32F, (2 * width_px - 1) / (2 * cell) + 2, (2 * height_px - 1) / (2 * cell) + 2,
                     "the coarse HDR buffer");
        grid_.bind_for_drawing();
        grid_.clear();
    }
    // Turn to a band; what the one before the last was is lost. It is zero then, with no tile lit, or what is given, with the
    // tiles lit that it lights.
    void empty(RowRange band) {
        turn_to(band);
        if (!clean_[now_]) {
            bands_[now_].bind_for_drawing();
            bands_[now_].clear();
        }
        clean_[now_] = false;
    }
    void fill(RowRange band, std::span<const float> rgbv) {
        turn_to(band);
        bands_[now_].write(rgbv);
        tiles_.light(rgbv);
        clean_[now_] = false;
    }
    // Turn to a band that is in texture_in_turn(1) already, or will be before GL comes to what is drawn next.
    void given(RowRange band) {
        turn_to(band);
        tiles_.light_all();  // nobody has looked
        clean_[now_] = false;
    }
    // Of the band that will be turned to so many turns from now.
    GLuint texture_in_turn(std::size_t turns) const { return bands_[(now_ + turns) % 2].texture(); }
    // Something is drawn into the grid of this frame.
    void light_grid() { grid_lit_ = true; }
    const FloatBuffer& band() const { return bands_[now_]; }
    const FloatBuffer& grid() const { return grid_; }
    LitTiles& tiles() { return tiles_; }      // of the band
    int cell_px() const { return cell_px_; }  // of the grid; 0: there is none in this frame
    int lit_cell_px() const { return grid_lit_ ? cell_px_ : 0; }
    double band_bytes() const { return bands_[0].memory_bytes() + bands_[1].memory_bytes(); }
    double grid_bytes() const { return grid_.memory_bytes(); }
    void forget() {
        for (FloatBuffer& band : bands_)
            band.forget();
        grid_.forget();
    }

  private:
    void turn_to(RowRange band) {
        now_ = 1 - now_;
        bands_[now_].move_to(band.first, band.count);
        tiles_.turn_to(band);
    }

    std::array<FloatBuffer, 2> bands_;
    std::array<bool, 2> clean_{};  // cleared by begin(), and not turned to since
    std::size_t now_ = 0;
    FloatBuffer grid_;
    int cell_px_ = 0;
    bool grid_lit_ = false;
    LitTiles tiles_;
};

}  // namespace seaglare::glare
