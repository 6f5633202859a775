// The frame reference itself, against closed forms and laws that it does not use.
#include "glare/reference/frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "glare/apply/footprint.h"
#include "glare/apply/screen_geometry.h"
#include "glare/reference/comparison.h"
#include "glare/reference/frame_footprint.h"
#include "glare/reference/frame_tone.h"
#include "glare/tone/operators.h"

namespace seaglare::reference {
namespace {

constexpr double pi = std::numbers::pi;

// Looking along -z, `f_px` pixels per unit tangent, the axis `shift_px` beside the picture's middle.
std::array<double, 16> projection(int width, int height, double f_px, double shift_px = 0) {
    std::array<double, 16> m{};
    m[0] = 2 * f_px / width;
    m[5] = 2 * f_px / height;
    m[8] = 2 * shift_px / width;
    m[10] = -1;
    m[11] = -1;
    m[14] = -0.2;
    return m;
}

// A light of 1 lux, white, whose image lies `x`, `y` pixels from the axis.
glare::PointSource light_at(double x, double y, double f_px, double radius_rad = 0,
                            double distance_m = 1000) {
    const Vector d = unit({x / f_px, y / f_px, -1});
    glare::PointSource light;
    for (std::size_t i = 0; i < 3; ++i)
        light.position_view_m[i] = static_cast<float>(distance_m * d[i]);
    light.radius_m = static_cast<float>(distance_m * std::sin(radius_rad));
    light.illuminance_rgb_lx = {1, 1, 1};
    light.illuminance_scotopic_lx = 2.464F;
    return light;
}

double energy_of(const FrameScreen& screen, const std::vector<Rgbv>& pixels, std::size_t channel) {
    double sum = 0;
    std::size_t i = 0;
    for (int y = 0; y < screen.height_px(); ++y)
        for (int x = 0; x < screen.width_px(); ++x)
            sum += pixels[i++][channel] * screen.pixel_sr(x + 0.5, y + 0.5);
    return sum;
}

// One wavelength through a round hole: Airy's pattern, known in closed form.
ShapeRequest airy(double pupil_mm, double wavelength_nm, double pitch, double window_px) {
    ShapeRequest request;
    request.eye = glare::circular_pupil_eye();
    request.pupil_mm = pupil_mm;
    request.pitch = pitch;
    request.window_outer = window_px * pitch;
    request.window_inner = 0.75 * request.window_outer;
    request.lamps = {0};
    request.lines = {{{wavelength_nm, {1, 1, 1, 1}}}};
    return request;
}

const PatternMaker plain = [](const ReferenceRequest& request,
                              const std::vector<std::vector<SpectralLine>>& lines) {
    return make_reference(request, lines);
};

// Energy of Airy's pattern inside an angle: 1 - J0^2(x) - J1^2(x), x = pi p sin(theta)/lambda.
double airy_energy(double pupil_mm, double wavelength_nm, double sine) {
    const double x = pi * pupil_mm * sine / (wavelength_nm * 1e-6);
    return 1 - std::pow(std::cyl_bessel_j(0.0, x), 2) - std::pow(std::cyl_bessel_j(1.0, x), 2);
}

TEST(FrameReference, HasTheScreensGeometryAsTheProductHasIt) {
    glare::Frame frame;
    frame.viewport_px = {0, 0, 320, 200};
    frame.clip_from_view = projection(320, 200, 250, 70);
    const glare::ScreenGeometry product = glare::screen_geometry(frame);
    const FrameScreen screen(frame.clip_from_view, 320, 200);
    EXPECT_NEAR(screen.pitch(), product.pitch, 1e-15);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> across(0, 1);
    for (int i = 0; i < 200; ++i) {
        const double x = 320 * across(random);
        const double y = 200 * across(random);
        const Vector ray = screen.ray(x, y);
        EXPECT_LT(length(along(ray, glare::ray_of_px(product, x, y), -1)), 1e-14);
        EXPECT_NEAR(screen.pixel_sr(x, y) / glare::pixel_solid_angle_sr(product, ray), 1, 1e-12);
        const auto ours = screen.tangents(ray);
        const auto theirs = glare::pattern_tangents(product, ray);
        EXPECT_LT(length(along(ours.u, theirs.u, -1)), 1e-14);
        EXPECT_LT(length(along(ours.v, theirs.v, -1)), 1e-14);
        std::array<double, 2> place{};
        ASSERT_TRUE(screen.place_px(ray, place));
        EXPECT_NEAR(place[0], x, 1e-9);
        EXPECT_NEAR(place[1], y, 1e-9);
    }
}

TEST(FrameReference, TheFootprintIsThatOfItsDefinition) {
    for (double x = -2; x <= 2; x += 0.01) {
        // Box of two pixels convolved with a Hann window of 1.5, by the midpoint rule.
        double sum = 0;
        constexpr int steps = 4000;
        for (int i = 0; i < steps; ++i) {
            const double t = 1.5 * ((i + 0.5) / steps - 0.5);
            if (std::abs(x - t) <= 1) sum += 0.5 * (1 + std::cos(2 * pi * t / 1.5)) / 1.5 * 1.5 / steps;
        }
        EXPECT_NEAR(footprint(x), sum, 2e-4);
        EXPECT_NEAR(footprint(x), glare::kernel(x), 1e-14);
        EXPECT_NEAR(footprint_integral(x), glare::kernel_integral(x), 1e-14);
    }
}

TEST(FrameReference, ACoreOfAnySizeAndPlaceHasAllItsLight) {
    const FrameScreen screen(projection(240, 160, 120), 240, 160);
    for (const double radius_px : {0.0, 0.05, 0.6, 1.0, 1.79, 1.81, 3.5, 12.0, 40.0}) {
        for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.37, -0.21}, {31.5, -17.25}}) {
            const Vector d = unit({x / 120, y / 120, -1});
            double sum = 0;
            spread_core(screen, d, radius_px / 120, [&](int px, int py, double per_sr) {
                sum += per_sr * screen.pixel_sr(px + 0.5, py + 0.5);
            });
            EXPECT_NEAR(sum, 1, 1e-4) << radius_px << " px at " << x << ", " << y;
        }
    }
}

// What the product draws, pixel by pixel, of points, of what is hardly one, and of small discs: a thousandth of the core's light
// is a code of what lies two pixels beside it.
TEST(FrameReference, TheCoreOfASmallDiscIsTheProducts) {
    constexpr double f_px = 2000;
    const FrameScreen screen(projection(64, 64, f_px), 64, 64);
    for (const double radius_px : {0.0, 0.03, 0.07, 0.09, 0.095, 0.1, 0.11, 0.3, 1.0, 1.79, 2.5}) {
        for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.4, -0.3}}) {
            std::vector<double> shares(64UL * 64);
            spread_core(screen, unit({x / f_px, y / f_px, -1}), radius_px / f_px,
                        [&](int px, int py, double per_sr) {
                            shares[static_cast<std::size_t>(py) * 64 + static_cast<std::size_t>(px)] +=
                                per_sr * screen.pixel_sr(px + 0.5, py + 0.5);
                        });
            for (int py = 26; py < 38; ++py)
                for (int px = 26; px < 38; ++px)
                    EXPECT_NEAR(shares[static_cast<std::size_t>(py) * 64 + static_cast<std::size_t>(px)],
                                glare::core_weight(px - 31.5 - x, py - 31.5 - y, {radius_px, 0, 0, radius_px},
                                                   radius_px),
                                radius_px < 0.3 ? 1e-5 : 1e-3)
                        << radius_px << " px, pixel " << px << ", " << py;
        }
    }
}

// A lamp as near as the eye is to a wall: inside its disc the luminance is E over the solid angle of the cap.
TEST(FrameReference, InsideALargeDiscTheLuminanceIsTheLampsOwn) {
    const FrameScreen screen(projection(200, 150, 100), 200, 150);
    for (const double radius_rad : {0.2, 0.7, 1.2}) {
        double middle = 0;
        spread_core(screen, {0, 0, -1}, radius_rad, [&](int x, int y, double per_sr) {
            if (x == 100 && y == 75) middle += per_sr;
        });
        EXPECT_NEAR(middle * 2 * pi * (1 - std::cos(radius_rad)), 1, 1e-3) << radius_rad;
    }
}

// The whole of Airy's pattern: core and skirt of a light on a pixel's middle hold its energy, ring by ring.
TEST(FrameReference, ARoundHoleGivesAirysRings) {
    constexpr double f_px = 4000;
    constexpr double pupil_mm = 2;
    constexpr double wavelength_nm = 575;
    constexpr double window_px = 60;
    const GlareShape shape = make_shape(airy(pupil_mm, wavelength_nm, 1 / f_px, window_px), plain);
    // What the window takes away is known, too: the energy is scaled to what lies inside it.
    double inside_window = 0;
    constexpr int steps = 4000;
    double before = 0;
    for (int i = 0; i < steps; ++i) {
        const double to = (i + 1.0) / steps * shape.window_outer;
        const double energy = airy_energy(pupil_mm, wavelength_nm, to);
        const double t = std::clamp((to / shape.window_outer - 0.75) / 0.25 - 0.5 / steps, 0.0, 1.0);
        inside_window += (energy - before) * (0.5 + 0.5 * std::cos(pi * t));
        before = energy;
    }
    EXPECT_NEAR(shape.structure_scale * inside_window, 1, 2e-4);

    const FrameScreen screen(projection(201, 201, f_px), 201, 201);
    const std::vector<glare::PointSource> lights = {light_at(0, 0, f_px)};
    const std::vector<Rgbv> pixels = draw_frame(screen, shape, lights);
    EXPECT_NEAR(energy_of(screen, pixels, 1), 1, 1e-4);
    for (const double radius_px : {12.0, 20.0, 30.0, 44.0}) {
        double sum = 0;
        for (int y = -100; y <= 100; ++y)
            for (int x = -100; x <= 100; ++x)
                if (std::hypot(x, y) <= radius_px)
                    sum += pixels[static_cast<std::size_t>(y + 100) * 201 + static_cast<std::size_t>(x + 100)]
                                 [1] *
                           screen.pixel_sr(x + 100.5, y + 100.5);
        const double exact = airy_energy(pupil_mm, wavelength_nm, radius_px / f_px) / inside_window;
        EXPECT_NEAR(sum, exact, 1.5e-3) << radius_px;
    }
}

// A skirt that falls as glare does, known everywhere: the levels of detail that it is kept in add up to its mean over a pixel,
// wherever one hands over to the next.
TEST(FrameReference, LevelsOfDetailHandOverWithoutATrace) {
    const auto skirt = [](double u_px, double v_px) { return std::pow(u_px * u_px + v_px * v_px + 9, -1.5); };
    const ShapeRequest request = airy(3, 575, 1e-3, 60);
    const GlareShape shape = make_shape(
        request, [&](const ReferenceRequest& wanted, const std::vector<std::vector<SpectralLine>>&) {
            ReferencePattern pattern;
            pattern.radius = wanted.radius;
            pattern.pitch = wanted.pitch;
            pattern.lamp = {1, 1, 1, 1};
            const double px = wanted.pitch / request.pitch;
            for (int b = -pattern.radius; b <= pattern.radius; ++b)
                for (int a = -pattern.radius; a <= pattern.radius; ++a) {
                    const double value = skirt(a * px, b * px);
                    pattern.pixels.push_back({value, value, value, value});
                }
            return std::vector{pattern};
        });
    ASSERT_EQ(shape.lamps[0].levels.size(), 3U);
    for (double radius_px = 5; radius_px < 44; radius_px += 0.17) {
        const double u_px = radius_px * std::cos(radius_px);
        const double v_px = radius_px * std::sin(radius_px);
        double made = 0;
        for (const SkirtLevel& level : shape.lamps[0].levels)
            made += level.at(u_px, v_px)[1];
        double mean = 0;
        constexpr int steps = 8;
        for (int y = 0; y < steps; ++y)
            for (int x = 0; x < steps; ++x)
                mean +=
                    skirt(u_px + (x + 0.5) / steps - 0.5, v_px + (y + 0.5) / steps - 0.5) / (steps * steps);
        EXPECT_NEAR(made / (shape.structure_scale * mean), 1, 4e-3) << radius_px << " px";
    }
}

// The same light anywhere under the grid, as a point or a disc: core and skirt have the same energy.
TEST(FrameReference, EnergyIsTheSameAtEverySubpixelPlaceAndSize) {
    constexpr double f_px = 400;
    const GlareShape shape = make_shape(airy(2, 575, 1 / f_px, 24), plain);
    const FrameScreen screen(projection(141, 141, f_px), 141, 141);
    for (const auto& [x, y, radius_px] : {std::array{0.0, 0.0, 0.0},
                                          {0.5, 0.5, 0.0},
                                          {0.31, -0.17, 0.0},
                                          {0.31, -0.17, 0.2},
                                          {0.1, 0.4, 0.8},
                                          {-0.4, 0.2, 3.0},
                                          {0.25, 0.1, 15.0}}) {
        const std::vector<glare::PointSource> lights = {light_at(x, y, f_px, radius_px / f_px)};
        EXPECT_NEAR(energy_of(screen, draw_frame(screen, shape, lights), 1), 1, 2e-3)
            << x << ", " << y << ", radius " << radius_px;
    }
}

TEST(FrameReference, BeyondTheStructureIsTheCiesCurve) {
    constexpr double f_px = 100;
    ShapeRequest request = airy(2, 575, 1 / f_px, 4);
    request.eye.cie_tail = true;
    const GlareShape shape = make_shape(request, plain);
    const FrameScreen screen(projection(401, 5, f_px), 401, 5);
    const std::vector<glare::PointSource> lights = {light_at(0, 0, f_px)};
    const std::vector<Rgbv> pixels = draw_frame(screen, shape, lights);
    for (const int x : {8, 20, 60, 150}) {
        const double angle_deg = std::atan(x / f_px) * 180 / pi;
        const Rgbv& pixel = pixels[2 * 401 + 200 + static_cast<std::size_t>(x)];
        const double cie = cie_curve_sr(angle_deg, request.eye.age_years, request.eye.pigmentation);
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(pixel[c] / cie, 1, 1e-5) << x;
        EXPECT_NEAR(pixel[3] / cie / 2.464, 1, 1e-5);
    }
    // Structure and tail together are what the pupil passes.
    double core_and_skirt = shape.lamps[0].core[1];
    for (const SkirtLevel& level : shape.lamps[0].levels)
        for (const Rgbv& sample : level.samples)
            core_and_skirt += sample[1] * std::pow(shape.pitch / level.per_px, 2);
    EXPECT_NEAR(core_and_skirt + tail_energy(24, 0.5, shape.window_inner, shape.window_outer), 1, 2e-3);
}

TEST(FrameReference, AFrameIsTheSumOfItsLights) {
    constexpr double f_px = 200;
    const GlareShape shape = make_shape(airy(2, 575, 1 / f_px, 16), plain);
    const FrameScreen screen(projection(90, 60, f_px), 90, 60);
    std::vector<glare::PointSource> lights = {light_at(-20.3, 4.4, f_px), light_at(7.7, -11.2, f_px, 0.01),
                                              light_at(60, 0, f_px)};
    lights[1].illuminance_rgb_lx = {3, -0.5F, 0.25F};
    const std::vector<Rgbv> together = draw_frame(screen, shape, lights);
    std::vector<Rgbv> sum(together.size());
    for (const glare::PointSource& light : lights) {
        const std::vector<Rgbv> one = draw_frame(screen, shape, std::vector{light});
        for (std::size_t i = 0; i < sum.size(); ++i)
            for (std::size_t c = 0; c < 4; ++c)
                sum[i][c] += one[i][c];
    }
    for (std::size_t i = 0; i < sum.size(); ++i)
        for (std::size_t c = 0; c < 4; ++c)
            EXPECT_NEAR(together[i][c], sum[i][c], 1e-9 * std::abs(sum[i][c]) + 1e-12);
}

// Mean over a disc against a plain sum over points of it.
TEST(FrameReference, ASkirtUnderADiscIsItsMeanOverTheDisc) {
    SkirtLevel level;
    level.per_px = 2;
    level.radius = 20;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(0, 1);
    level.samples.resize(41 * 41);
    for (Rgbv& sample : level.samples)
        for (double& value : sample)
            value = any(random);
    level.integrate();
    for (const double radius : {0.4, 1.0, 3.3}) {
        Rgbv sum{};
        int count = 0;
        for (double y = -radius; y <= radius; y += radius / 300)
            for (double x = -radius; x <= radius; x += radius / 300) {
                if (std::hypot(x, y) > radius) continue;
                ++count;
                const Rgbv value = level.at(1.3 + x, -2.1 + y);
                for (std::size_t c = 0; c < 4; ++c)
                    sum[c] += value[c];
            }
        const Rgbv exact = level.over_disc(1.3, -2.1, radius);
        for (std::size_t c = 0; c < 4; ++c)
            EXPECT_NEAR(exact[c], sum[c] / count, 5e-3) << radius;
    }
}

TEST(FrameReference, ToneMappingAgreesWithTheProductsOwn) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(0, 1);
    for (int i = 0; i < 3000; ++i) {
        DisplayState display;
        display.adaptation_cd_m2 = std::pow(10, 8 * any(random) - 5);
        display.tone.blue_shift = any(random) < 0.7;
        display.tone.mode =
            any(random) < 0.7 ? glare::CompositeMode::difference : glare::CompositeMode::plain;
        display.ldr_white_cd_m2 = any(random) < 0.3 ? 100 * any(random) : 0;
        const double level = std::pow(10, 8 * any(random) - 4) * display.adaptation_cd_m2;
        const Rgbv glare = {level * (any(random) - 0.1), level * any(random), level * (any(random) - 0.2),
                            level * 3 * any(random)};
        std::array<double, 3> before{};
        glare::Rgb linear{};
        for (std::size_t c = 0; c < 3; ++c) {
            before[c] = std::floor(256 * any(random) * any(random));
            linear[c] = glare::srgb_decode(before[c] / 255);
        }
        const glare::Rgb delta =
            glare::display_delta(display.tone, display.adaptation_cd_m2, display.ldr_white_cd_m2, linear,
                                 {glare[0], glare[1], glare[2]}, glare[3]);
        const auto codes = shown_codes(display, before, glare);
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(codes[c], 255 * glare::srgb_encode(linear[c] + delta[c]), 1e-6);
    }
}

TEST(FrameReference, RefusesWhatItDoesNotKnow) {
    ShapeRequest request = airy(2, 575, 1 / 200.0, 10);
    request.eye = glare::young_eye_with_lashes();
    EXPECT_THROW(make_shape(request, plain), std::invalid_argument);
    request.eye = glare::young_eye();
    request.eye.cie_calibrated = true;
    EXPECT_THROW(make_shape(request, plain), std::invalid_argument);
    EXPECT_THROW(FrameScreen(std::array<double, 16>{}, 10, 10), std::invalid_argument);
}

}  // namespace
}  // namespace seaglare::reference
