// The ring two pixels around a light, where core and skirt meet: one light, one wavelength, a round pupil without particles.
// There everything is known in closed form: Airy's pattern, the core's window, the footprint.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "glare/psf/pattern_sources.h"
#include "glare/reference/frame_footprint.h"
#include "glare/reference/frame_shape.h"

namespace seaglare::reference {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double f_px = 869.1;
constexpr double pupil_mm = 6;
constexpr double wavelength_mm = 575e-6;
constexpr double core_radius_px = 2;

// Airy's pattern per steradian.
double airy(double sine) {
    const double x = std::max(pi * pupil_mm * sine / wavelength_mm, 1e-9);
    return std::pow(std::cyl_bessel_j(1.0, x) / (std::max(sine, 1e-12)), 2) / pi;
}

// What the core's window leaves of it, averaged over a pixel around an offset.
double skirt_in_closed_form(double u_px, double v_px) {
    constexpr int steps = 60;
    double sum = 0;
    for (int j = 0; j < steps; ++j) {
        for (int i = 0; i < steps; ++i) {
            const double d = std::hypot(u_px + (i + 0.5) / steps - 0.5, v_px + (j + 0.5) / steps - 0.5);
            const double core = d < core_radius_px ? std::pow(std::cos(pi / 2 * d / core_radius_px), 2) : 0.0;
            sum += airy(d / f_px) * (1 - core);
        }
    }
    return sum / (steps * steps);
}

glare::Pattern product_pattern() {
    glare::EyeModel eye = glare::circular_pupil_eye();
    eye.cie_tail = false;
    glare::PatternSettings settings;
    settings.transform_size = 1024;
    settings.layer_radii_px = {0};
    settings.max_radius_nodes = 21;
    glare::LampSamples samples;
    samples[0] = {{wavelength_mm * 1e6, {1, 1, 1, 1}}};
    glare::PatternRequest request;
    request.pupil_mm = pupil_mm;
    request.pitch = 1 / f_px;
    return glare::make_cpu_pattern_source(eye, settings, 1, samples)->make(request);
}

GlareShape reference_shape(const glare::Pattern& like) {
    ShapeRequest request;
    request.eye = glare::circular_pupil_eye();
    request.eye.cie_tail = false;
    request.pupil_mm = pupil_mm;
    request.pitch = like.pitch;
    request.window_inner = like.window_inner;
    request.window_outer = like.window_outer;
    request.core_radius_px = core_radius_px;
    request.lamps = {0};
    request.lines = {{{wavelength_mm * 1e6, {1, 1, 1, 1}}}};
    return make_shape(
        request, [](const ReferenceRequest& wanted, const std::vector<std::vector<SpectralLine>>& lines) {
            return make_reference(wanted, lines);
        });
}

double skirt_of(const GlareShape& shape, double u_px, double v_px) {
    double sum = 0;
    for (const SkirtLevel& level : shape.lamps[0].levels)
        sum += level.at(u_px, v_px)[1];
    return sum;
}
double all_of(const GlareShape& shape, double u_px, double v_px) {
    return skirt_of(shape, u_px, v_px) +
           shape.lamps[0].core[1] * footprint(u_px) * footprint(v_px) / (shape.pitch * shape.pitch);
}

// The reference's scale makes the energy inside its window whole: a factor that is known.
TEST(Ring, TheReferenceIsAirysPatternLessTheCore) {
    const GlareShape shape = reference_shape(product_pattern());
    for (const double v : {0.0, 0.5}) {
        for (double u = 1; u <= 8; u += 0.5) {
            const double exact = skirt_in_closed_form(u, v) * shape.structure_scale;
            EXPECT_NEAR(skirt_of(shape, u, v) / exact, 1, 0.02) << u << ", " << v;
        }
    }
}

// On pixels' middles the product differs by where it evaluates the core's window: at nodes.
TEST(Ring, TheProductFollowsItAtItsNodes) {
    const glare::Pattern pattern = product_pattern();
    const GlareShape product = shape_of(pattern);
    const GlareShape reference = reference_shape(pattern);
    for (int v = 0; v <= 8; ++v)
        for (int u = 0; u <= 8; ++u)
            EXPECT_NEAR(all_of(product, u, v) / all_of(reference, u, v), 1, 0.06) << u << ", " << v;
}

// The largest error of the luminance within a ring, at any place of the light under the grid.
double largest_error(const GlareShape& product, const GlareShape& reference, double from_px, double to_px) {
    double largest = 0;
    for (double v = -to_px; v <= to_px; v += 0.125) {
        for (double u = -to_px; u <= to_px; u += 0.125) {
            const double d = std::hypot(u, v);
            if (d < from_px || d > to_px) continue;
            largest = std::max(largest, std::abs(all_of(product, u, v) / all_of(reference, u, v) - 1));
        }
    }
    return largest;
}

// Straight lines between nodes a pixel apart are off by 0.53 and 0.16: finer nodes near the light are there for that.
TEST(Ring, BetweenNodesTheProductFollowsToo) {
    const glare::Pattern pattern = product_pattern();
    const GlareShape reference = reference_shape(pattern);
    const GlareShape product = shape_of(pattern);
    EXPECT_LT(largest_error(product, reference, 0, 1.5), 0.03);
    EXPECT_LT(largest_error(product, reference, 1.5, 3), 0.05);
    EXPECT_LT(largest_error(product, reference, 3, 6), 0.03);
    glare::Pattern coarse = pattern;
    coarse.fine.clear();
    const GlareShape without = shape_of(coarse);
    EXPECT_GT(largest_error(without, reference, 1.5, 3), 0.4);
    EXPECT_GT(largest_error(without, reference, 3, 6), 0.1);
}

}  // namespace
}  // namespace seaglare::reference
