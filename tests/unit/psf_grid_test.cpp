#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "glare/eye/aperture.h"
#include "glare/psf/cie_curve.h"
#include "glare/psf/pattern_grid.h"

namespace seaglare::glare {
namespace {

// CIE 135/1-1999 at 24 years, brown eyes.
TEST(CieCurve, HasItsValues) {
    const std::array<std::array<double, 2>, 9> values = {{{0.01, 7.943e5},
                                                          {0.1, 11443},
                                                          {0.3, 572.1},
                                                          {1, 18.85},
                                                          {3, 1.010},
                                                          {4, 0.4940},
                                                          {10, 0.06016},
                                                          {30, 0.007585},
                                                          {90, 0.002427}}};
    for (const auto& [angle_deg, psf_sr] : values)
        EXPECT_NEAR(cie_total_glare_sr(angle_deg, 24, 0.5), psf_sr, 6e-4 * psf_sr) << angle_deg;
}

// Its integral over the hemisphere is 1.0102, of which 95.7 % lie inside 4 degrees; fading out over the last ten
// degrees before a quarter turn takes 0.0014 off.
TEST(CieCurve, HasItsEnergy) {
    constexpr double faded = 0.0014;
    EXPECT_NEAR(cie_tail_energy(24, 0.5, 1e-7, 2e-7), 1.0102 - faded, 3e-4);
    const double four_degrees = std::sin(4 * std::numbers::pi / 180);
    const double outside = cie_tail_energy(24, 0.5, four_degrees, four_degrees * 1.0001) + faded;
    EXPECT_NEAR(outside / 1.0102, 1 - 0.957, 5e-4);
}

TEST(CieCurve, TheWindowFallsOnceFromOneToZero) {
    EXPECT_EQ(fade_window(0.1, 0.1, 0.2), 1);
    EXPECT_EQ(fade_window(0.2, 0.1, 0.2), 0);
    EXPECT_NEAR(fade_window(0.15, 0.1, 0.2), 0.5, 1e-12);
}

// The field is colour-complete: N 380 nm / (2 S) is 4.97 degrees for 4096 samples over 9 mm.
TEST(PatternGrid, EndsInsideTheFieldOfTheShortestWavelength) {
    const PatternGrid grid = plan_grid(PatternSettings{}, 1 / 869.1);
    EXPECT_LT(std::asin(grid.window_outer) * 180 / std::numbers::pi, 4.97);
    EXPECT_GT(std::asin(grid.window_outer) * 180 / std::numbers::pi, 4.8);
    EXPECT_LT(grid.window_inner, grid.window_outer);
    EXPECT_GE(grid.structure_radius * grid.pitch, grid.window_outer);
    EXPECT_EQ(grid.margin, 13);
    EXPECT_EQ(grid.radius, grid.structure_radius + grid.margin);
}

TEST(PatternGrid, NeverExceedsItsCrop) {
    PatternSettings settings;
    settings.max_radius_nodes = 64;
    for (double pitch : {1e-9, 1e-5, 1e-3, 0.1, 10.0}) {
        const PatternGrid grid = plan_grid(settings, pitch);
        EXPECT_LE(grid.radius, 64) << pitch;
        EXPECT_GE(grid.structure_radius, 1) << pitch;
    }
    EXPECT_THROW(plan_grid(settings, 0), std::invalid_argument);
    EXPECT_THROW(plan_grid(settings, -1), std::invalid_argument);
    EXPECT_THROW(plan_grid(settings, std::nan("")), std::invalid_argument);
}

// One sample is one pixel at 45 degrees and 720 lines, 575 nm.
TEST(PatternGrid, TheThesisLookMagnifiesEighteenTimes) {
    const PatternSettings settings = thesis_settings();
    EXPECT_EQ(settings.angular_scale, 18);
    const double px_per_sample = 575e-6 / settings.plane_width_mm * settings.angular_scale * 869.117;
    EXPECT_NEAR(settings.transform_size * px_per_sample, 512, 0.5);
    // 380/575 of that, less the last samples, is where no colour is missing.
    const PatternGrid grid = plan_grid(settings, 1 / 869.117);
    EXPECT_NEAR(2 * grid.window_outer / grid.pitch, 338.4 * 0.98, 1);
}

// Weights sum to one; their second moment is the disc's, r^2/2, to within a cell's.
TEST(DiscStencil, IsTheDiscInWeightAndWidth) {
    for (double radius : {0.2, 0.5, 1.0, 1.5, 3.0, 6.0, 12.0}) {
        const DiscStencil stencil = make_disc_stencil(radius);
        double sum = 0;
        double moment = 0;
        const auto add = [&](int dx, int dy, double weight) {
            sum += weight;
            moment += weight * (dx * dx + dy * dy);
        };
        for (const DiscTap& tap : stencil.taps)
            add(tap.dx, tap.dy, tap.weight);
        for (const DiscSpan& span : stencil.spans)
            for (int dx = -span.half_width; dx <= span.half_width; ++dx)
                add(dx, span.dy, stencil.span_weight);
        EXPECT_NEAR(sum, 1, 1e-12) << radius;
        const double area = std::numbers::pi * radius * radius;
        EXPECT_NEAR(1 / stencil.span_weight, area, 2e-3 * area) << radius;
        if (radius < 1) continue;
        EXPECT_NEAR(moment, radius * radius / 2, 0.02 * radius * radius + 0.3) << radius;
    }
}

// The work grows with the radius, not with its square.
TEST(DiscStencil, CostsItsRimAndItsRows) {
    const auto cost = [](double radius) {
        const DiscStencil stencil = make_disc_stencil(radius);
        return static_cast<double>(stencil.taps.size() + 2 * stencil.spans.size());
    };
    EXPECT_LT(cost(24) / cost(12), 2.3);
    EXPECT_LT(cost(12), 0.5 * std::numbers::pi * 144);
}

TEST(CoreWindow, FallsFromOneToZeroOverItsRadius) {
    EXPECT_EQ(core_window(0, 2), 1);
    EXPECT_NEAR(core_window(1, 2), 0.5, 1e-12);
    EXPECT_EQ(core_window(2, 2), 0);
    EXPECT_EQ(core_window(std::nan(""), 2), 0);
}

// What the tail takes the structure has not; a magnified pattern has no tail.
TEST(EnergyPlan, StructureAndTailAreWhatThePupilPasses) {
    const PatternGrid grid = plan_grid(PatternSettings{}, 1 / 869.1);
    const EyeModel eye = young_eye();
    const EnergyPlan plan = plan_energy(eye, PatternSettings{}, grid, 7);
    const double tail = cie_tail_energy(24, 0.5, grid.window_inner, grid.window_outer);
    EXPECT_NEAR(plan.structure + plan.tail_scale * tail, transmitted_fraction(eye, 7), 1e-12);
    EXPECT_GT(tail, 0.03);
    EXPECT_LT(tail, 0.06);
    EXPECT_EQ(plan_energy(eye, thesis_settings(), grid, 7).tail_scale, 0);
    EXPECT_EQ(plan_energy(eye, thesis_settings(), grid, 7).structure, transmitted_fraction(eye, 7));
}

TEST(Aperture, ParticlesFillTheirFieldEvenlyWithTheirSizes) {
    EyeModel eye;
    eye.particles = {{20000, 10, 40, 2.5, 4.0}};
    const ApertureParts parts(eye, 3);
    std::vector<Disc> discs;
    parts.place(0, 4096, 9, discs);
    ASSERT_EQ(discs.size(), 20000U);
    const double samples_per_mm = 4096 / 9.0;
    int inner = 0;
    int small = 0;
    for (const Disc& disc : discs) {
        const double r = std::hypot(static_cast<double>(disc.x) - 2048, static_cast<double>(disc.y) - 2048);
        EXPECT_LE(r, 4 * samples_per_mm + 0.01);
        const double diameter_um = 2000 * static_cast<double>(disc.radius) / samples_per_mm;
        EXPECT_GE(diameter_um, 10 - 1e-3);
        EXPECT_LE(diameter_um, 40 + 1e-3);
        inner += r < 2 * samples_per_mm ? 1 : 0;
        small += diameter_um < 20 ? 1 : 0;
    }
    EXPECT_NEAR(inner / 20000.0, 0.25, 0.015);
    // Integral of d^-2.5 from 10 to 20 over 10 to 40.
    const double expected = (1 - std::pow(2, -1.5)) / (1 - std::pow(4, -1.5));
    EXPECT_NEAR(small / 20000.0, expected, 0.015);
}

TEST(Aperture, FamiliesDriftTogetherAndReturnToTheSamePlaceAtTheSameTime) {
    EyeModel eye;
    eye.particles = {{50, 10, 40, 2.5, 4.0, 100, 10}};
    const ApertureParts parts(eye, 3);
    std::vector<Disc> before;
    std::vector<Disc> later;
    std::vector<Disc> again;
    parts.place(1e7, 1024, 9, before);
    parts.place(1e7 + 7, 1024, 9, later);
    parts.place(1e7, 1024, 9, again);
    const double limit = 2 * 0.1 * 1024 / 9;  // twice the amplitude, in samples
    for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_EQ(before[i].x, again[i].x);
        EXPECT_NEAR(later[i].x - before[i].x, later[0].x - before[0].x, 1e-3F);
        EXPECT_LE(std::abs(static_cast<double>(later[i].x - before[i].x)), limit);
    }
    EXPECT_NE(later[0].x, before[0].x);
}

TEST(Aperture, EveryTileListsEveryDiscThatTouchesIt) {
    EyeModel eye;
    eye.particles = {{500, 10, 400, 2.5, 5.0}};
    const ApertureParts parts(eye, 3);
    std::vector<Disc> discs;
    constexpr int n = 512;
    parts.place(0, n, 9, discs);
    TileLists lists;
    lists.sort(discs, n);
    EXPECT_LE(lists.discs().size(), TileLists::worst_case(discs));
    constexpr int tiles = n / TileLists::tile_side;
    ASSERT_EQ(lists.begin().size(), static_cast<std::size_t>(tiles * tiles + 1));
    for (int t = 0; t < tiles * tiles; ++t) {
        const int column = t % tiles;
        const int row = t / tiles;
        const double left = column * TileLists::tile_side;
        const double low = row * TileLists::tile_side;
        std::size_t touching = 0;
        for (const Disc& disc : discs) {
            const auto x = static_cast<double>(disc.x);
            const auto y = static_cast<double>(disc.y);
            const double dx = std::max({left - x, 0.0, x - left - TileLists::tile_side});
            const double dy = std::max({low - y, 0.0, y - low - TileLists::tile_side});
            if (std::hypot(dx, dy) < static_cast<double>(disc.radius)) ++touching;
        }
        const auto listed = static_cast<std::size_t>(lists.begin()[static_cast<std::size_t>(t) + 1] -
                                                     lists.begin()[static_cast<std::size_t>(t)]);
        EXPECT_GE(listed, touching) << t;
    }
}

}  // namespace
}  // namespace seaglare::glare
