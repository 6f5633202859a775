// ViewRenderer::cull: which lights can change a pixel. Pure; no GL.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "glare/apply/footprint.h"
#include "glare/apply/glare_bound.h"
#include "glare/apply/light_instance.h"
#include "glare/apply/view_renderer.h"
#include "glare/tone/operators.h"

namespace seaglare::glare {

namespace {

// The eye whose glare is widest among those the curve describes: old, with light eyes.
constexpr double widest_age_years = 80;
constexpr double widest_pigmentation = 1.2;

}  // namespace

std::size_t ViewRenderer::cull(const Frame& frame, const ToneSettings& tone, std::span<PointSource> sources,
                               RenderStats& stats, double angular_scale) {
    const ScreenGeometry g = screen_geometry(frame);
    const GlareBound bound(widest_age_years, widest_pigmentation, angular_scale);
    // Lights left out add up: each gets a share of the threshold.
    const double share =
        1.0 / std::max<double>(1.0, std::min<double>(static_cast<double>(sources.size()), 64));
    const double threshold =
        threshold_luminance_cd_m2(tone, frame.adaptation_luminance_cd_m2, tone.threshold_codes * share);
    // A pixel is smallest, and a footprint in it brightest, in the corners.
    const double corner = std::max(
        std::cos(std::min(g.cone_rad + std::acos(std::clamp(dot(g.axis, g.forward), -1.0, 1.0)), 1.55)),
        0.02);
    const double smallest_pixel_sr = g.plane_area_px * corner * corner * corner;
    const double core_reach_rad = 4 * g.pitch;

    std::size_t kept = 0;
    for (const PointSource& source : sources) {
        Appearance light;
        if (!appearance_of(g, source, light)) {
            ++stats.lights_below_threshold;
            continue;
        }
        const double outside = std::max(angle_outside_rad(g, light.direction) - light.radius_rad, 0.0);
        const double lux = channel_bound_lx(source);
        double brightest = lux * bound.psf_sr(std::max(outside, g.pitch / 2));
        if (outside <= core_reach_rad) brightest += lux / (4 * smallest_pixel_sr);
        // Beyond a quarter turn from every pixel there is no glare.
        if (outside >= std::numbers::pi / 2) brightest = 0;
        if (brightest >= threshold && brightest > 0) {
            sources[kept++] = source;
        } else if (outside > 0) {
            ++stats.lights_outside;
        } else {
            ++stats.lights_below_threshold;
        }
    }
    return kept;
}

}  // namespace seaglare::glare
