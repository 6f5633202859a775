// What the plan knows of a frame's lights: not each, but how many of which brightness stand how close together. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "glare/apply/screen_geometry.h"
#include "glare/colour/lamp_list.h"
#include "glare/frame.h"

namespace seaglare::glare {

// Lights by illuminance at the eye, in classes of a factor of four.
inline constexpr int brightness_classes = 24;
inline constexpr double faintest_class_lx = 1e-9;  // class 0: up to four times this, however faint

struct BrightnessHistogram {
    std::array<float, brightness_classes> count{};
    std::array<float, brightness_classes> lux{};  // sum, of each light's strongest display channel

    void add(double channel_lx);
    void add(const BrightnessHistogram& other);
    // At least the sum over the lights of min(share, lux * at_most_per_lx): what they leave out in one pixel when each may
    // leave out `share` and none can leave out more than it has.
    double left_out(double share, double at_most_per_lx) const;
    double total_lux() const;
    bool empty() const;
};

struct LightSummary {
    std::uint32_t lights = 0;
    BrightnessHistogram all;
    // For each neighbourhood of the picture in which a skirt can reach a pixel, the lights in it: which lie up to a skirt's
    // radius beside it. Not all of them are in `all` once only.
    std::vector<BrightnessHistogram> neighbourhoods;
    double largest_channel_ratio = 1;  // of a light's strongest channel to its luminance
    double largest_scotopic_ratio = 0;
    double largest_disc_rad = 0;                         // apparent radius
    std::uint32_t lamps = 0;                             // bit l: a light with lamp l is there
    std::array<double, most_lamps> lux_of_lamp{};        // sum of the strongest channels
    std::array<double, most_lamps> brightest_of_lamp{};  // lux of the brightest light of each lamp
    std::uint32_t disc_lights = 0;                       // lights larger than `point_until_px`

    // Its memory is used again.
    void clear();
};

// `skirt_px`: how far a skirt reaches. `summary` is overwritten; no allocation when its capacity suffices.
void summarise(const ScreenGeometry& geometry, std::span<const PointSource> sources, double skirt_px,
               LightSummary& summary);

// The largest share each light may leave out, so that no pixel of any neighbourhood loses more than `budget`; the same unit,
// cd/m2. `at_most_per_lx`: no light leaves out more than this times its lux. Rounded down.
double share_of_each(std::span<const BrightnessHistogram> neighbourhoods, double budget_cd_m2,
                     double at_most_per_lx);

}  // namespace seaglare::glare
