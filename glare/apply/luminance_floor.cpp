#include "glare/apply/luminance_floor.h"

#include <algorithm>
#include <cmath>

#include "glare/tone/operators.h"

namespace seaglare::glare {

namespace {

constexpr double display_codes = 255;
constexpr double rod_luminance_cd_m2 = 0.04;  // tone/operators.h, rod_weight
constexpr int steps_up = 6;
// The glare falls as the distance to the power of 2.5: so many cells away and nearer each light counts by itself, and so many
// the parts of cells do.
constexpr int own_cells = 1;
constexpr int near_cells = 3;
// Nodes stand fine_px apart. Half way between two, glare of a power of -2.5 is fainter than at both on average by 4.4 h^2/r^2,
// h half of that: as much as if they were farther away, r^2 + 3.5 h^2. In the middle of the four the part is no larger.
constexpr double valley_px2 = 3.5 * LuminanceFloor::fine_px * LuminanceFloor::fine_px / 4;
// And what a pattern's rings add to that.
constexpr double rings = 0.9;

// Steepest slope of the sRGB curve from a linear value on. A channel beyond 1 is brought back to 1 with the others in
// proportion, so that the curve does not end there.
double encode_slope(double linear) {
    const double value = std::min(linear, 1.0);
    return value <= 0.0031308 ? 12.92 : 1.055 / 2.4 * std::pow(value, 1 / 2.4 - 1);
}

// Nodes of the cells so many cells away from a part and nearer; the last cell of a row has the node at its end, too.
struct Nodes {
    int first = 0, end = 0;
};
Nodes nodes_around(int part, int cells_away, int cells) {
    const int last = std::min(part / 2 + cells_away, cells - 1);
    return {2 * std::max(part / 2 - cells_away, 0), 2 * last + (last == cells - 1 ? 3 : 2)};
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
    static_assert(near_parts == 2 * near_cells + 2);
    columns_ = (g.width_px + cell_px - 1) / cell_px;
    rows_ = (g.height_px + cell_px - 1) / cell_px;
    const auto columns = static_cast<std::size_t>(columns_);
    const auto rows = static_cast<std::size_t>(rows_);
    lux_.assign(columns * rows, {});
    fine_lux_.assign(4 * columns * rows, {});
    affordable_.resize(columns * rows);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const float factor = visible.empty() ? 1.0F : visible[i];
        const float x = lights[i].centre_px[0];
        const float y = lights[i].centre_px[1];
        if (!(factor > 0) ||
            !(x >= 0 && y >= 0 && x < static_cast<float>(g.width_px) && y < static_cast<float>(g.height_px)))
            continue;
        Rgbv& lux = lux_[cell_of(static_cast<int>(x), static_cast<int>(y))];
        Rgbv& fine = fine_lux_[static_cast<std::size_t>(y / fine_px) * 2 * columns +
                               static_cast<std::size_t>(x / fine_px)];
        for (std::size_t c = 0; c < 4; ++c) {
            lux[c] += factor * lights[i].illuminance[c];
            fine[c] += factor * lights[i].illuminance[c];
        }
    }
    // A pixel is never farther in nodes of the pattern than on the picture's axis, so that its glare is no fainter.
    const double node_px = g.pitch / (pattern.pitch > 0 ? pattern.pitch : g.pitch);
    const auto psf = [&](double x_px, double y_px) {
        return profile.least_psf_sr(
            static_cast<float>(node_px * node_px * (x_px * x_px + y_px * y_px + valley_px2)));
    };
    psf_.resize(columns * rows);
    for (std::size_t y = 0; y < rows; ++y)
        for (std::size_t x = 0; x < columns; ++x)
            psf_[y * columns + x] =
                psf(cell_px * (static_cast<double>(x) + 1), cell_px * (static_cast<double>(y) + 1));
    for (int y = 0; y < near_parts; ++y)
        for (int x = 0; x < near_parts; ++x)
            near_psf_[static_cast<std::size_t>(y) * near_parts + static_cast<std::size_t>(x)] =
                psf(fine_px * (x + 1), fine_px * (y + 1));
    add_far();
    add_near();
    for (std::size_t i = 0; i < lights.size(); ++i)
        add_own(profile, static_cast<float>(node_px), lights[i], visible.empty() ? 1.0F : visible[i]);
    for (std::size_t cell = 0; cell < least_.size(); ++cell) {
        const auto x = static_cast<int>(cell % columns) * cell_px;
        const auto y = static_cast<int>(cell / columns) * cell_px;
        const std::array<double, 4> all = least(x, y, cell_px, cell_px);
        for (std::size_t c = 0; c < 4; ++c)
            least_[cell][c] = static_cast<float>(all[c]);
    }
    for (std::size_t cell = 0; cell < affordable_.size(); ++cell)
        affordable_[cell] =
            budget.codes > 0 ? budget.codes / codes_per_cd_m2(budget, least(cell)) : otherwise_cd_m2;
}

void LuminanceFloor::add_far() {
    const auto columns = static_cast<std::size_t>(columns_);
    least_.assign(lux_.size(), {});
    for (std::size_t from = 0; from < lux_.size(); ++from) {
        const Rgbv lux = lux_[from];
        if (lux == Rgbv{}) continue;
        const auto at_x = static_cast<int>(from % columns);
        const auto at_y = static_cast<int>(from / columns);
        for (int y = 0; y < rows_; ++y) {
            const Rgbv* const psf = &psf_[static_cast<std::size_t>(std::abs(y - at_y)) * columns];
            Rgbv* const least = &least_[static_cast<std::size_t>(y) * columns];
            const auto add = [&](int first, int end) {
                for (int x = first; x < end; ++x)
                    for (std::size_t c = 0; c < 4; ++c)
                        least[x][c] += lux[c] * psf[std::abs(x - at_x)][c];
            };
            if (std::abs(y - at_y) > near_cells) {
                add(0, columns_);
            } else {
                add(0, at_x - near_cells);
                add(at_x + near_cells + 1, columns_);
            }
        }
    }
}

void LuminanceFloor::add_near() {
    const auto columns = 2 * static_cast<std::size_t>(columns_);
    const int nodes_across = 2 * columns_ + 1;
    const int nodes_down = 2 * rows_ + 1;
    node_least_.clear();
    for (int y = 0; y < nodes_down; ++y)
        for (int x = 0; x < nodes_across; ++x)
            node_least_.push_back(least_[static_cast<std::size_t>(std::min(y / 2, rows_ - 1)) *
                                             static_cast<std::size_t>(columns_) +
                                         static_cast<std::size_t>(std::min(x / 2, columns_ - 1))]);
    // A node at the part's beginning or before has it ahead.
    const auto parts_away = [](int node, int part) { return node <= part ? part - node : node - 1 - part; };
    for (std::size_t from = 0; from < fine_lux_.size(); ++from) {
        const Rgbv lux = fine_lux_[from];
        if (lux == Rgbv{}) continue;
        const auto at_x = static_cast<int>(from % columns);
        const auto at_y = static_cast<int>(from / columns);
        const Nodes across = nodes_around(at_x, near_cells, columns_);
        const Nodes down = nodes_around(at_y, near_cells, rows_);
        const Nodes own_across = nodes_around(at_x, own_cells, columns_);
        const Nodes own_down = nodes_around(at_y, own_cells, rows_);
        for (int y = down.first; y < down.end; ++y) {
            const Rgbv* const psf = &near_psf_[static_cast<std::size_t>(parts_away(y, at_y)) * near_parts];
            Rgbv* const least =
                &node_least_[static_cast<std::size_t>(y) * static_cast<std::size_t>(nodes_across)];
            const bool own_row = y >= own_down.first && y < own_down.end;
            for (int x = across.first; x < across.end; ++x) {
                if (own_row && x == own_across.first) x = own_across.end;
                if (x >= across.end) break;
                for (std::size_t c = 0; c < 4; ++c)
                    least[x][c] += lux[c] * psf[parts_away(x, at_x)][c];
            }
        }
    }
}

void LuminanceFloor::add_own(const PatternProfile& profile, float node_px, const LightInstance& light,
                             float factor) {
    const float at_x = light.centre_px[0];
    const float at_y = light.centre_px[1];
    const float width = static_cast<float>(columns_) * cell_px;
    const float height = static_cast<float>(rows_) * cell_px;
    if (!(factor > 0) || !(at_x >= 0 && at_y >= 0 && at_x < width && at_y < height)) return;
    const Nodes across = nodes_around(static_cast<int>(at_x / fine_px), own_cells, columns_);
    const Nodes down = nodes_around(static_cast<int>(at_y / fine_px), own_cells, rows_);
    const float node_px2 = node_px * node_px;
    for (int y = down.first; y < down.end; ++y) {
        Rgbv* const least =
            &node_least_[static_cast<std::size_t>(y) * (2 * static_cast<std::size_t>(columns_) + 1)];
        const float dy = static_cast<float>(y * fine_px) - at_y;
        for (int x = across.first; x < across.end; ++x) {
            const float dx = static_cast<float>(x * fine_px) - at_x;
            const Rgbv& psf =
                profile.least_psf_sr(node_px2 * (dx * dx + dy * dy + static_cast<float>(valley_px2)));
            for (std::size_t c = 0; c < 4; ++c)
                least[x][c] += factor * light.illuminance[c] * psf[c];
        }
    }
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

std::array<double, 4> LuminanceFloor::least(int left_px, int bottom_px, int width_px, int height_px) const {
    const int last_x = std::min((left_px + width_px) / fine_px, 2 * columns_);
    const int last_y = std::min((bottom_px + height_px) / fine_px, 2 * rows_);
    std::array<double, 4> value{};
    value.fill(1e30);
    for (int y = bottom_px / fine_px; y <= last_y; ++y)
        for (int x = left_px / fine_px; x <= last_x; ++x) {
            const Rgbv& node =
                node_least_[static_cast<std::size_t>(y) * (2 * static_cast<std::size_t>(columns_) + 1) +
                            static_cast<std::size_t>(x)];
            for (std::size_t c = 0; c < 4; ++c)
                value[c] = std::min(value[c], rings * static_cast<double>(node[c]));
        }
    return value;
}

}  // namespace seaglare::glare
