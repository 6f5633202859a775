// What a light looks like on the display: the colour that it adds to a black 8-bit picture.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace seaglare::test {

// IEC 61966-2-1, written anew here: the product's own must not judge itself.
inline double linear_of_code(std::uint8_t code) {
    const double v = code / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

struct Displayed {
    std::array<double, 3> linear{};  // sum of linear sRGB over the pixels about the brightest
    std::array<double, 3> codes{};   // sum of their codes
    int brightest_code = 0;
};

// Sums a square of (2 reach + 1) pixels about the brightest one.
inline Displayed displayed(const std::vector<std::uint8_t>& rgba, int width_px, int height_px,
                           int reach = 3) {
    Displayed sum;
    int best_x = 0, best_y = 0, best = -1;
    for (int y = 0; y < height_px; ++y) {
        for (int x = 0; x < width_px; ++x) {
            const std::uint8_t* p = &rgba[(static_cast<std::size_t>(y) * width_px + x) * 4];
            const int brightness = p[0] + p[1] + p[2];
            if (brightness <= best) continue;
            best = brightness;
            best_x = x;
            best_y = y;
            sum.brightest_code = std::max({p[0], p[1], p[2]});
        }
    }
    for (int y = std::max(best_y - reach, 0); y <= std::min(best_y + reach, height_px - 1); ++y) {
        for (int x = std::max(best_x - reach, 0); x <= std::min(best_x + reach, width_px - 1); ++x) {
            const std::uint8_t* p = &rgba[(static_cast<std::size_t>(y) * width_px + x) * 4];
            for (std::size_t c = 0; c < 3; ++c) {
                sum.linear[c] += linear_of_code(p[c]);
                sum.codes[c] += p[c];
            }
        }
    }
    return sum;
}

// CIE 1976 u'v' of linear sRGB (its primaries and D65).
inline std::array<double, 2> uv_of(const std::array<double, 3>& rgb) {
    const double x = 0.4124 * rgb[0] + 0.3576 * rgb[1] + 0.1805 * rgb[2];
    const double y = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
    const double z = 0.0193 * rgb[0] + 0.1192 * rgb[1] + 0.9505 * rgb[2];
    const double sum = x + 15 * y + 3 * z;
    return {4 * x / sum, 9 * y / sum};
}
inline double uv_distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    const auto p = uv_of(a);
    const auto q = uv_of(b);
    return std::hypot(p[0] - q[0], p[1] - q[1]);
}

}  // namespace seaglare::test
