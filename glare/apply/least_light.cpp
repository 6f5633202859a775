#include "glare/apply/least_light.h"

#include <algorithm>
#include <cmath>

#include "glare/apply/glare_bound.h"
#include "glare/apply/light_instance.h"
#include "glare/apply/screen_geometry.h"
#include "glare/colour/navigation_colours.h"
#include "glare/tone/operators.h"

namespace seaglare::glare {

namespace {

// As in cull.cpp, whose decisions this foresees.
constexpr double widest_age_years = 80;
constexpr double widest_pigmentation = 1.2;
constexpr double smallest_share = 1 / least_lights_to_threshold;

// What the strongest channel of a navigation colour has of a lux: blue's is far above its luminance.
double strongest_of_navigation_colours() {
    double strongest = 0;
    for (int colour = 0; colour < lamp_count; ++colour) {
        const UnitColour unit = navigation_colour(colour);
        PointSource source;
        source.illuminance_rgb_lx = unit.rgb;
        source.illuminance_scotopic_lx = unit.scotopic_per_photopic;
        strongest = std::max(strongest, channel_bound_lx(source));
    }
    return strongest;
}

}  // namespace

double least_illuminance_lx(const Frame& frame, const ToneSettings& tone, double angular_scale,
                            double strongest_channel_per_lux) {
    static const double of_navigation_colours = strongest_of_navigation_colours();
    const double channel_per_lux = std::max(of_navigation_colours, strongest_channel_per_lux);
    const ScreenGeometry g = screen_geometry(frame);
    const GlareBound bound(widest_age_years, widest_pigmentation, angular_scale);
    const double threshold_cd_m2 = threshold_luminance_cd_m2(tone, frame.adaptation_luminance_cd_m2,
                                                             tone.threshold_codes * smallest_share);
    const double corner = std::max(
        std::cos(std::min(g.cone_rad + std::acos(std::clamp(dot(g.axis, g.forward), -1.0, 1.0)), 1.55)),
        0.02);
    const double smallest_pixel_sr = g.plane_area_px * corner * corner * corner;
    const double brightest_per_lux = bound.psf_sr(g.pitch / 2) + 1 / (4 * smallest_pixel_sr);
    // A hair less: sources are rounded to single precision.
    return threshold_cd_m2 / (brightest_per_lux * channel_per_lux) * (1 - 1e-6);
}

}  // namespace seaglare::glare
