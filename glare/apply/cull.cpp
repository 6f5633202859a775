// ViewRenderer::cull: which lights can change a pixel. Pure; no GL.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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

// At least what the lights left out add to any one pixel together. Directions fall into cells; each cell sums what is in it
// and its neighbours, so that whatever is not in a pixel's sum is `far` from it. Cells that share a place in the table only
// make the sum larger.
class LeftOutSum {
  public:
    static constexpr double far_px = 16;
    LeftOutSum(double far_rad, double most_cd_m2) : cell_(far_rad), most_cd_m2_(most_cd_m2) {}

    // A light that adds at most near_cd_m2 to any pixel and at most far_cd_m2 to those that are far. False: it would be too
    // much, and nothing is added.
    bool add(const Vec3& direction, double outside_rad, double near_cd_m2, double far_cd_m2) {
        if (!(far_cd_m2_ + far_cd_m2 + most_near_cd_m2_ <= most_cd_m2_)) return false;
        if (outside_rad < cell_) {
            std::array<std::size_t, 27> around{};
            for (std::size_t i = 0; i < around.size(); ++i)
                around[i] = place_of(direction, i);
            const double fullest_cd_m2 = near_cd_m2_[*std::max_element(
                around.begin(), around.end(),
                [this](std::size_t a, std::size_t b) { return near_cd_m2_[a] < near_cd_m2_[b]; })];
            const double now_cd_m2 = std::max(most_near_cd_m2_, fullest_cd_m2 + near_cd_m2);
            if (!(far_cd_m2_ + far_cd_m2 + now_cd_m2 <= most_cd_m2_)) return false;
            most_near_cd_m2_ = now_cd_m2;
            for (std::size_t i = 0; i < around.size(); ++i) {
                const auto earlier = around.begin() + static_cast<std::ptrdiff_t>(i);
                if (std::find(around.begin(), earlier, around[i]) == earlier)
                    near_cd_m2_[around[i]] += near_cd_m2;
            }
        }
        far_cd_m2_ += far_cd_m2;
        return true;
    }

  private:
    std::size_t place_of(const Vec3& direction, std::size_t neighbour) const {
        std::uint64_t hash = 0;
        for (std::size_t i = 0; i < 3; ++i, neighbour /= 3) {
            const auto cell = static_cast<std::int64_t>(std::floor(direction[i] / cell_)) +
                              static_cast<std::int64_t>(neighbour % 3) - 1;
            hash = (hash ^ static_cast<std::uint64_t>(cell)) * 0x9E3779B97F4A7C15U;
            hash ^= hash >> 32;
        }
        return hash % near_cd_m2_.size();
    }

    double cell_;  // edge, of direction cosines
    double most_cd_m2_;
    double far_cd_m2_ = 0;
    double most_near_cd_m2_ = 0;
    std::array<double, 4096> near_cd_m2_{};
};

}  // namespace

std::size_t ViewRenderer::cull(const Frame& frame, const ToneSettings& tone, std::span<PointSource> sources,
                               RenderStats& stats, double angular_scale) {
    const ScreenGeometry g = screen_geometry(frame);
    const GlareBound bound(widest_age_years, widest_pigmentation, angular_scale);
    // Each light left out gets a share of the threshold; whether it is all used up, LeftOutSum knows.
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

    const double far_rad = LeftOutSum::far_px * g.pitch;
    LeftOutSum left_out(
        far_rad, threshold_luminance_cd_m2(tone, frame.adaptation_luminance_cd_m2, tone.threshold_codes));
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
        if (brightest > 0 &&
            (brightest >= threshold || !left_out.add(light.direction, outside, brightest,
                                                     std::min(brightest, lux * bound.psf_sr(far_rad))))) {
            sources[kept++] = source;
            continue;
        }
        if (outside > 0) {
            ++stats.lights_outside;
        } else {
            ++stats.lights_below_threshold;
        }
    }
    return kept;
}

}  // namespace seaglare::glare
