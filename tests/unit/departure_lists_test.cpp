// What a gather leaves out of the lights' structure: never more than the pixels of a tile can afford, and more of it where the
// other lights' glare is bright.
#include "glare/apply/departure_lists.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "glare/apply/luminance_floor.h"
#include "glare/apply/tile_lists.h"
#include "glare/plan/sensitivity.h"
#include "glare/psf/cie_curve.h"
#include "glare/tone/operators.h"
#include "tests/unit/needle_pattern.h"

namespace seaglare::test {
namespace {

using namespace glare;

constexpr double adaptation_cd_m2 = 0.001;

std::vector<LightInstance> lights_of(const ScreenGeometry& g, int count, double lux, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<LightInstance> lights;
    for (int i = 0; i < count; ++i) {
        LightInstance light;
        const double x = g.width_px * uniform(random);
        const double y = g.height_px * uniform(random);
        const Vec3 ray = normalised(ray_of_px(g, x, y));
        for (std::size_t k = 0; k < 3; ++k)
            light.direction[k] = static_cast<float>(ray[k]);
        const auto e = static_cast<float>(lux * std::pow(10.0, -2 * uniform(random)));
        light.illuminance = {e, e, e, 2.464F * e};
        light.centre_px = {static_cast<float>(x), static_cast<float>(y)};
        lights.push_back(light);
    }
    return lights;
}

CodeBudget codes(double allowed) {
    return {allowed, tone_curve({}, adaptation_cd_m2), true};
}

struct Lists {
    Lists(int count, double lux, double allowed_codes, std::uint64_t seed = 1)
        : g(narrow_screen(320, 240)), pattern(needle_pattern(g.pitch)) {
        profile.update(pattern);
        const auto lights = lights_of(g, count, lux, seed);
        const double share = threshold_luminance_cd_m2({}, adaptation_cd_m2, allowed_codes);
        lists.build(g, pattern, profile, {share, share / 64, codes(allowed_codes)}, lights, {});
        floor.build(g, pattern, profile, codes(allowed_codes), share, lights, {});
    }
    // Tiles in which a light has its structure: near it all of it is drawn, farther away its departures.
    double kept_per_light() const {
        const GridLevel& picture = lists.levels().front();
        const std::int32_t whole = lists.tile_begin()[static_cast<std::size_t>(picture.tiles_across) *
                                                      static_cast<std::size_t>(picture.tiles_down)];
        return (static_cast<double>(lists.departures().entries().size()) + whole) /
               static_cast<double>(lists.lights().size());
    }
    // Where a pixel is in a light's pattern, in nodes.
    std::array<double, 2> offset(const GatherLight& light, double x, double y) const {
        const double length = std::sqrt(dot(ray_of_px(g, x, y), ray_of_px(g, x, y)));
        const auto along = [&](const std::array<float, 3>& axis) {
            return (static_cast<double>(axis[0]) + static_cast<double>(axis[1]) * x +
                    static_cast<double>(axis[2]) * y) /
                   length;
        };
        return {along(light.along_u), along(light.along_v)};
    }
    // Glare of all lights by the radial mean alone.
    double mean_at(double x, double y) const {
        double sum = 0;
        for (const GatherLight& light : lists.lights()) {
            const auto at = offset(light, x, y);
            const double angle_deg =
                std::asin(std::max(std::hypot(at[0], at[1]), 1.0) * pattern.pitch) * 180 / std::numbers::pi;
            sum += static_cast<double>(light.illuminance[1]) * cie_total_glare_sr(angle_deg, 24, 0.5);
        }
        return sum;
    }
    // Of all pixels, with the departures that the tiles have and without: how far apart, in codes, before a dark sky.
    double largest_error_codes() const {
        std::vector<float> nodes(pattern.skirt.size());
        profile.departures(pattern, nodes);
        const auto departs = [&](const GatherLight& light, double x, double y) {
            const auto at = offset(light, x, y);
            const double radius = std::hypot(at[0], at[1]);
            if (radius <= static_cast<double>(light.departs_from) || radius >= 39) return 0.0;
            const double u = at[0] + 40;
            const double v = at[1] + 40;
            const auto node = [&](int dx, int dy) {
                const auto row = static_cast<std::size_t>(v) + static_cast<std::size_t>(dy);
                const auto column = static_cast<std::size_t>(u) + static_cast<std::size_t>(dx);
                return static_cast<double>(nodes[(row * 81 + column) * 4 + 1]);
            };
            const double tu = u - std::floor(u);
            const double tv = v - std::floor(v);
            return static_cast<double>(light.illuminance[1]) *
                   ((1 - tv) * ((1 - tu) * node(0, 0) + tu * node(1, 0)) +
                    tv * ((1 - tu) * node(0, 1) + tu * node(1, 1)));
        };
        const auto code = [](double glare) {
            const Rgb shown =
                display_delta({}, adaptation_cd_m2, 0, {}, {glare, glare, glare}, d65_scotopic_ratio * glare);
            return 255 * srgb_encode(shown[1]);
        };
        const GridLevel& picture = lists.levels().front();
        const auto begin = lists.departures().tile_begin();
        double most = 0;
        for (int y = 0; y < g.height_px; y += 3)
            for (int x = 0; x < g.width_px; x += 3) {
                double all = 0;
                for (const GatherLight& light : lists.lights())
                    all += departs(light, x + 0.5, y + 0.5);
                double kept = 0;
                const int place = y / tile_height * picture.tiles_across + x / tile_width;
                const auto tile = static_cast<std::size_t>(place);
                for (std::int32_t i = begin[tile]; i < begin[tile + 1]; ++i) {
                    const Departure entry = lists.departures().entries()[static_cast<std::size_t>(i)];
                    const GatherLight& light = lists.lights()[static_cast<std::size_t>(
                        entry.light < 0 ? -1 - entry.light : entry.light)];
                    const auto at = offset(light, x + 0.5, y + 0.5);
                    if (at[0] * at[0] + at[1] * at[1] < static_cast<double>(entry.reach2))
                        kept += departs(light, x + 0.5, y + 0.5);
                }
                const double mean = mean_at(x + 0.5, y + 0.5);
                most = std::max(most, std::abs(code(mean + all) - code(mean + kept)));
            }
        return most;
    }
    ScreenGeometry g;
    Pattern pattern;
    PatternProfile profile;
    TileLists lists;
    LuminanceFloor floor;
};

}  // namespace

TEST(DepartureLists, NoTileLosesMoreThanItCanAfford) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        const Lists lists(200, 1e-3, 0.25, seed);
        for (const float spent : lists.lists.departures().spent())
            EXPECT_LE(spent, 1.0F);
    }
}

TEST(DepartureLists, ACrowdOfDiscsLosesNoMoreByLowerLayersAloneThanTheTilesCanAfford) {
    const ScreenGeometry g = narrow_screen(320, 240);
    const Pattern pattern = needle_pattern(g.pitch, {0.0F, 0.4F});
    PatternProfile profile;
    profile.update(pattern);
    std::vector<LightInstance> lights = lights_of(g, 6000, 1e-3, 3);
    for (LightInstance& light : lights)
        light.disc_nodes = 0.3F;
    int lower_alone = 0;
    for (const double allowed : {0.002, 0.01, 0.05, 0.25, 1.0}) {
        TileLists lists;
        const double share = threshold_luminance_cd_m2({}, adaptation_cd_m2, allowed);
        lists.build(g, pattern, profile, {share, share / 64, codes(allowed)}, lights, {});
        for (const float spent : lists.departures().spent())
            EXPECT_LE(spent, 1.0F) << allowed;
        for (const Departure& departure : lists.departures().entries())
            lower_alone += departure.light < 0 ? 1 : 0;
    }
    EXPECT_GT(lower_alone, 1000);
}

TEST(DepartureLists, ASmallerBudgetKeepsMore) {
    double before = 0;
    for (const double allowed : {4.0, 1.0, 0.25, 0.05, 0.001}) {
        const double kept = Lists(100, 1e-3, allowed).kept_per_light();
        EXPECT_GE(kept, before) << allowed;
        before = kept;
    }
    EXPECT_GT(before, 5);
}

TEST(DepartureLists, FaintLightsAmongBrightOnesShowLessThanAlone) {
    // The same faint lights; with a hundred bright ones there, whose glare lifts the picture.
    const ScreenGeometry g = narrow_screen(320, 240);
    const Pattern pattern = needle_pattern(g.pitch);
    PatternProfile profile;
    profile.update(pattern);
    const auto faint = lights_of(g, 50, 1e-4, 3);
    auto both = faint;
    const auto bright = lights_of(g, 100, 0.3, 4);
    both.insert(both.end(), bright.begin(), bright.end());
    const auto entries_of_faint = [&](const std::vector<LightInstance>& lights) {
        TileLists lists;
        lists.build(g, pattern, profile, {1e-5, 1e-7, codes(0.25)}, lights, {});
        const auto entries = lists.departures().entries();
        return std::count_if(entries.begin(), entries.end(),
                             [](const Departure& d) { return (d.light < 0 ? -1 - d.light : d.light) < 50; });
    };
    EXPECT_GT(entries_of_faint(faint), 0);
    EXPECT_LT(entries_of_faint(both), entries_of_faint(faint) / 2);
}

TEST(DepartureLists, WhatIsLeftOutShowsLessThanTheCodesAllowedAtAnyPixel) {
    for (const double allowed : {0.25, 1.0, 4.0})
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            const Lists made(60, 1e-3, allowed, seed);
            const double error = made.largest_error_codes();
            EXPECT_LE(error, allowed) << "seed " << seed;
            EXPECT_GT(error, 0.02 * allowed) << "something is left out";
        }
}

TEST(LuminanceFloor, OfAnyPartIsNoMoreThanTheGlareAtItsPixels) {
    for (const int count : {1, 2, 7, 60})
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            const Lists made(count, 1e-3, 0.25, seed);
            for (int y = 0; y < 240; y += 16)
                for (int x = 0; x < 320; x += 32) {
                    const auto least = made.floor.least(x, y, 32, 16);
                    for (int j = 0; j < 16; j += 3)
                        for (int i = 0; i < 32; i += 3)
                            EXPECT_LE(least[1], made.mean_at(x + i + 0.5, y + j + 0.5) * 1.01)
                                << count << " lights, " << x + i << ", " << y + j;
                }
        }
}

TEST(LuminanceFloor, IsNeverAboveTheSumOfTheMeans) {
    const Lists lists(40, 1e-3, 0.25, 5);
    const auto lights = lights_of(lists.g, 40, 1e-3, 5);
    for (int y = 3; y < 240; y += 29)
        for (int x = 5; x < 320; x += 31) {
            const Vec3 ray = normalised(ray_of_px(lists.g, x + 0.5, y + 0.5));
            double sum = 0;
            for (const LightInstance& light : lights) {
                const Vec3 towards = {static_cast<double>(light.direction[0]),
                                      static_cast<double>(light.direction[1]),
                                      static_cast<double>(light.direction[2])};
                const double cosine = std::clamp(dot(ray, towards), -1.0, 1.0);
                const double angle_deg = std::acos(cosine) * 180 / std::numbers::pi;
                sum += static_cast<double>(light.illuminance[1]) *
                       cie_total_glare_sr(std::max(angle_deg, 0.05), 24, 0.5);
            }
            EXPECT_LE(lists.floor.least(lists.floor.cell_of(x, y))[1], 1.02 * sum) << x << ", " << y;
        }
}

// Its means are in tables that begin two nodes from the light: what is there nearer by would be that of two nodes.
TEST(TileLists, ATailThatBeginsWithinTwoNodesIsDrawnAndNotGathered) {
    Pattern pattern = needle_pattern(1 / 869.1);
    const LightInstance light;
    EXPECT_TRUE(is_gathered(pattern, light, 1));
    pattern.tail_scale = 1;
    pattern.window_inner = 1.9 * pattern.pitch;
    EXPECT_FALSE(is_gathered(pattern, light, 1));
    pattern.window_inner = 2.1 * pattern.pitch;
    EXPECT_TRUE(is_gathered(pattern, light, 1));
}

TEST(LuminanceFloor, ADarkPictureAffordsWhatTheWholePlanCountsOn) {
    const CodeBudget budget = codes(1);
    const Sensitivity everywhere = sensitivity({}, adaptation_cd_m2);
    EXPECT_LE(codes_per_cd_m2(budget, {0, 0, 0, 0}), everywhere.codes_per_cd_m2 * 1.0001);
}

TEST(LuminanceFloor, TheSlopeOfTheDisplayIsABoundOfWhatIsShown) {
    const CodeBudget budget = codes(1);
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 4000; ++i) {
        const double luminance = std::pow(10.0, -5 + 5 * uniform(random));
        std::array<double, 4> glare{};
        for (double& channel : glare)
            channel = luminance * (0.5 + uniform(random));
        glare[3] *= d65_scotopic_ratio;
        const double slope = codes_per_cd_m2(budget, glare);
        const double step = 1e-3 * luminance;
        const auto shown = [&](double more) {
            // Rods count with the tint that they are shown in (channel_bound_lx).
            return display_delta({}, adaptation_cd_m2, 0, {},
                                 {glare[0] + more, glare[1] + more, glare[2] + more},
                                 glare[3] + d65_scotopic_ratio / rod_tint[2] * more);
        };
        const Rgb before = shown(0);
        const Rgb after = shown(step);
        for (std::size_t c = 0; c < 3; ++c) {
            const double moved = 255 * std::abs(srgb_encode(after[c]) - srgb_encode(before[c]));
            EXPECT_LE(moved, 1.05 * slope * step) << luminance << " channel " << c;
        }
    }
}

}  // namespace seaglare::test
