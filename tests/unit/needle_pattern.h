// What tests of the lists of lights share: a screen, and a pattern whose structure is known.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "glare/apply/screen_geometry.h"
#include "glare/psf/cie_curve.h"
#include "glare/psf/pattern.h"

namespace seaglare::test {

// About 30 degrees high.
inline glare::ScreenGeometry narrow_screen(int width_px, int height_px) {
    glare::Frame frame;
    frame.viewport_px = {0, 0, width_px, height_px};
    auto& m = frame.clip_from_view;
    m[0] = 3.7 * height_px / width_px;
    m[5] = 3.7;
    m[10] = m[11] = -1;
    m[14] = -0.2;
    return glare::screen_geometry(frame);
}

// The CIE curve with 24 needles of a tenth of it, in every layer the same.
inline glare::Pattern needle_pattern(double pitch, std::vector<float> layer_radius_nodes = {0.0F}) {
    glare::Pattern p;
    static std::uint64_t generation = 0;
    p.generation = ++generation;
    p.radius_nodes = 40;
    p.pitch = pitch;
    p.layer_radius_nodes = std::move(layer_radius_nodes);
    p.window_outer = 39 * pitch;
    p.window_inner = 30 * pitch;
    p.tail_scale = 1;
    for (std::size_t layer = 0; layer < p.layer_radius_nodes.size(); ++layer)
        for (int y = -40; y <= 40; ++y)
            for (int x = -40; x <= 40; ++x) {
                const double r = std::max(std::hypot(x, y), 1.0);
                const double angle_deg = std::asin(r * pitch) * 180 / std::numbers::pi;
                const double value = glare::fade_window(r * pitch, p.window_inner, p.window_outer) *
                                     glare::cie_total_glare_sr(angle_deg, 24, 0.5) *
                                     (1 + 0.1 * std::cos(24 * std::atan2(y, x)));
                for (int c = 0; c < 4; ++c)
                    p.skirt.push_back(static_cast<float>(value));
            }
    return p;
}

}  // namespace seaglare::test
