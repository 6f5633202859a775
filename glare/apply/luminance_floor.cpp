#include "glare/apply/luminance_floor.h"

#include <algorithm>
#include <cmath>

#include "glare/tone/operators.h"

namespace seaglare::glare {

namespace {

constexpr double display_codes = 255;
constexpr double rod_luminance_cd_m2 = 0.04;  // tone/operators.h, rod_weight
constexpr int steps_up = 6;

// Steepest slope of the sRGB curve from a linear value on. A channel beyond 1 is brought back to 1 with the others in
// proportion, so that the curve does not end there.
double encode_slope(double linear) {
    const double value = std::min(linear, 1.0);
    return value <= 0.0031308 ? 12.92 : 1.055 / 2.4 * std::pow(value, 1 / 2.4 - 1);
}

double luminance_of(const std::array<double, 4>& rgbv) {
    return 0.2126 * rgbv[0] + 0.7152 * rgbv[1] + 0.0722 * rgbv[2];
}

}  // namespace

// A channel c of glare of luminance L is shown as s(f(L) c/L), s the sRGB curve, f the tone curve. Adding d to c and L moves
// it by s'(f c/L) (f/L) d at most for a channel below L; for one above, c = k L, by s'(k f) k f' d, and s' falls so that this
// is less than sqrt(k) s'(f) f' d. All of it falls as L and c grow. Where rods take part, the hue moves with the luminance,
// too, by the distance of the colour from that of rods: that first grows with L, and so is tried from L upwards.
double codes_per_cd_m2(const CodeBudget& budget, const std::array<double, 4>& least) {
    const double scale = budget.curve.scale;
    const double luminance = std::max(luminance_of(least), 0.0);
    const double rods = std::max(least[3], 0.0) / d65_scotopic_ratio;
    double weakest = budget.blue_shift ? rods : luminance;
    double strongest = luminance;
    double from_rods = 0;  // distance of the hues, as a part of the luminance
    for (std::size_t c = 0; c < 3; ++c) {
        weakest = std::min(weakest, std::max(least[c], 0.0));
        strongest = std::max(strongest, least[c]);
        from_rods = std::max(from_rods, std::abs(least[c] - rods * rod_tint[c]));
    }
    const double ratio = luminance > 0 ? strongest / luminance : 1;
    from_rods = luminance > 0 ? from_rods / luminance : 0;
    double most = 0;
    for (int i = 0; i <= steps_up; ++i) {
        // From the luminance itself up to where the hue moves fastest.
        const double top = std::max(rod_luminance_cd_m2, luminance);
        const double from = std::max(luminance, 1e-3 * rod_luminance_cd_m2);
        const double here =
            i == 0 ? luminance : from * std::pow(top / from, static_cast<double>(i) / steps_up);
        const double relative = scale * here;
        const double shown = scale * (1 + relative * budget.curve.inverse_white2) / (1 + relative);
        const double slope = scale * (1 + relative * budget.curve.inverse_white2 * (2 + relative)) /
                             ((1 + relative) * (1 + relative));
        double hue = 0;
        if (budget.blue_shift) {
            const double rest = rod_luminance_cd_m2 + here;
            hue = rod_luminance_cd_m2 * here / (rest * rest) * from_rods;
        }
        const double weak = shown * encode_slope(shown * weakest);
        const double strong = std::sqrt(ratio) * slope * encode_slope(shown * here);
        most = std::max(most, display_codes * (1 + hue) * std::max(weak, strong));
        if (!budget.blue_shift || luminance >= rod_luminance_cd_m2) break;
    }
    return most;
}

void LuminanceFloor::build(const ScreenGeometry& g, const Pattern& pattern, const PatternProfile& profile,
                           const CodeBudget& budget, double otherwise_cd_m2,
                           std::span<const LightInstance> lights, std::span<const float> visible) {
    columns_ = (g.width_px + cell_px - 1) / cell_px;
    rows_ = (g.height_px + cell_px - 1) / cell_px;
    const auto columns = static_cast<std::size_t>(columns_);
    const auto rows = static_cast<std::size_t>(rows_);
    lux_.assign(columns * rows, {});
    least_.assign(columns * rows, {});
    affordable_.resize(columns * rows);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const float factor = visible.empty() ? 1.0F : visible[i];
        const float x = lights[i].centre_px[0];
        const float y = lights[i].centre_px[1];
        if (!(factor > 0) ||
            !(x >= 0 && y >= 0 && x < static_cast<float>(g.width_px) && y < static_cast<float>(g.height_px)))
            continue;
        std::array<float, 4>& lux = lux_[cell_of(static_cast<int>(x), static_cast<int>(y))];
        for (std::size_t c = 0; c < 4; ++c)
            lux[c] += factor * lights[i].illuminance[c];
    }
    // A pixel is never farther in nodes of the pattern than on the picture's axis, so that its glare is no fainter.
    const double node_px = g.pitch / (pattern.pitch > 0 ? pattern.pitch : g.pitch);
    psf_.resize(columns * rows);
    for (std::size_t y = 0; y < rows; ++y)
        for (std::size_t x = 0; x < columns; ++x)
            psf_[y * columns + x] = static_cast<float>(profile.least_psf_sr(
                cell_px * node_px * std::hypot(static_cast<double>(x) + 1, static_cast<double>(y) + 1)));
    for (std::size_t from = 0; from < lux_.size(); ++from) {
        const std::array<float, 4>& lux = lux_[from];
        if (lux == std::array<float, 4>{}) continue;
        const auto at_x = static_cast<int>(from % columns);
        const auto at_y = static_cast<int>(from / columns);
        for (int y = 0; y < rows_; ++y) {
            const float* const psf = &psf_[static_cast<std::size_t>(std::abs(y - at_y)) * columns];
            std::array<float, 4>* const least = &least_[static_cast<std::size_t>(y) * columns];
            for (int x = 0; x < columns_; ++x)
                for (std::size_t c = 0; c < 4; ++c)
                    least[x][c] += lux[c] * psf[std::abs(x - at_x)];
        }
    }
    for (std::size_t cell = 0; cell < affordable_.size(); ++cell)
        affordable_[cell] =
            budget.codes > 0 ? budget.codes / codes_per_cd_m2(budget, least(cell)) : otherwise_cd_m2;
}

double LuminanceFloor::affordable_around(const std::array<float, 2>& place_px) const {
    const auto cell_at = [](float px, int count) {
        return static_cast<int>(
            std::clamp(px / static_cast<float>(cell_px), 0.0F, static_cast<float>(count - 1)));
    };
    const int x = cell_at(place_px[0], columns_);
    const int y = cell_at(place_px[1], rows_);
    const auto place = [this](int column, int row) {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column);
    };
    double least = affordable_[place(x, y)];
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, rows_ - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, columns_ - 1); ++i)
            least = std::min(least, affordable_[place(i, j)]);
    return least;
}

std::array<double, 4> LuminanceFloor::least(std::size_t cell) const {
    std::array<double, 4> value{};
    for (std::size_t c = 0; c < 4; ++c)
        value[c] = static_cast<double>(least_[cell][c]);
    return value;
}

}  // namespace seaglare::glare
