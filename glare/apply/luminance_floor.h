// How bright the glare is at least in each part of a picture, and what a pixel there may lose without being off by more than
// some display codes. Where a crowd's glare is bright, the display's curve is flat: a needle of a faint light that would show
// before a dark sky is lost there. Pure.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "glare/apply/code_slopes.h"
#include "glare/apply/light_instance.h"
#include "glare/apply/pattern_profile.h"
#include "glare/apply/screen_geometry.h"

namespace seaglare::glare {

// The most display codes that a channel changes by when every channel of the glare changes by 1 cd/m2, where the glare is
// at least `least` (linear sRGB and scotopic luminance) and of about its colour; whatever the background.
double codes_per_cd_m2(const CodeBudget& budget, const std::array<double, 4>& least);

class LuminanceFloor {
  public:
    static constexpr int cell_px = 32;

    // Without a budget every pixel may lose `otherwise_cd_m2`. `visible`: one factor for each light, negative where it is not
    // known; or none where nothing hides them.
    void build(const ScreenGeometry& geometry, const Pattern& pattern, const PatternProfile& profile,
               const CodeBudget& budget, double otherwise_cd_m2, std::span<const LightInstance> lights,
               std::span<const float> visible);

    int columns() const { return columns_; }
    int rows() const { return rows_; }
    // Of the cell that holds a pixel of the picture.
    std::size_t cell_of(int x_px, int y_px) const {
        return static_cast<std::size_t>(y_px / cell_px) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(x_px / cell_px);
    }
    // At least so much glare is in every pixel of the cell: linear sRGB and scotopic luminance.
    std::array<double, 4> least(std::size_t cell) const;
    // The same of a part of the picture whose sides are multiples of fine_px.
    static constexpr int fine_px = cell_px / 2;
    std::array<double, 4> least(int left_px, int bottom_px, int width_px, int height_px) const;
    // What a pixel of the cell may lose, cd/m2.
    double affordable_cd_m2(std::size_t cell) const { return affordable_[cell]; }

    // The least of that within a cell's width of a place, in the picture or beside it.
    double affordable_around(const std::array<float, 2>& place_px) const;

  private:
    using Rgbv = std::array<float, 4>;
    void add_far();
    void add_near();
    void add_own(const PatternProfile& profile, float node_px, const LightInstance& light, float factor);

    int columns_ = 0;
    int rows_ = 0;
    static constexpr int near_parts = 8;
    std::vector<Rgbv> lux_;         // of the lights in each cell
    std::vector<Rgbv> fine_lux_;    // in each part of one, four to a cell, in rows and columns of their own
    std::vector<Rgbv> least_;       // by cell: of far lights, then of all
    std::vector<Rgbv> node_least_;  // at the corners of parts
    // What lights of a cell have at least at any pixel of another, by offset.
    std::vector<Rgbv> psf_;
    // What lights of a part have at least at a node, by the number of parts in between.
    std::array<Rgbv, static_cast<std::size_t>(near_parts) * near_parts> near_psf_{};
    std::vector<double> affordable_;
};

}  // namespace seaglare::glare
