// From a point to a disc without a seam: one lamp approached from 20 km to 5 m in steps of a hundredth.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/accuracy/channel.h"

namespace seaglare::test {
namespace {

constexpr double intensity_cd = 10000;
constexpr double radius_m = 0.12;
constexpr double farthest_m = 20000;
constexpr double nearest_m = 5;
constexpr double step = 1.01;
constexpr double x_px = 80.37, y_px = 80.68;

// A picture divided by the light's illuminance: what is left is its shape.
struct Shape {
    double energy = 0;     // E D^2/I
    double peak_sr = 0;    // brightest pixel
    double radius_px = 0;  // around which half of the energy lies inside
    double core_px = 0;    // square root of the second moment, inside 4 px around the lamp's disc
};

Shape shape_at(Channel& channel, double distance_m) {
    channel.clear();
    channel.place_eye({0, 0, 60});  // so that 20 km is above the horizon
    channel.add(white_light(channel.at_px(x_px, y_px, distance_m), intensity_cd, radius_m));
    EXPECT_EQ(channel.render(), SEAGLARE_OK) << channel.last_error();
    const auto hdr = channel.hdr();
    const double lux = intensity_cd / (distance_m * distance_m);
    const double focal_px = ChannelOptions{}.focal_px;
    const double disc_px = focal_px * radius_m / distance_m;
    struct Pixel {
        double distance_px;
        double energy;
    };
    std::vector<Pixel> pixels;
    Shape shape;
    double core_energy = 0;
    double core_moment = 0;
    for (int y = 0; y < channel.height_px(); ++y) {
        for (int x = 0; x < channel.width_px(); ++x) {
            const std::size_t i = (static_cast<std::size_t>(y) * channel.width_px() + x) * 4;
            const double luminance = luminance_of({hdr[i], hdr[i + 1], hdr[i + 2], 0});
            const double from_axis_px = std::hypot(x + 0.5 - 80, y + 0.5 - 80);
            const double cosine = focal_px / std::hypot(focal_px, from_axis_px);
            const double energy = luminance * std::pow(cosine, 3) / (focal_px * focal_px) / lux;
            const double distance_px = std::hypot(x + 0.5 - x_px, y + 0.5 - y_px);
            pixels.push_back({distance_px, energy});
            shape.energy += energy;
            shape.peak_sr = std::max(shape.peak_sr, luminance / lux);
            if (distance_px > disc_px + 4) continue;
            core_energy += energy;
            core_moment += energy * distance_px * distance_px;
        }
    }
    shape.core_px = std::sqrt(core_moment / core_energy);
    std::sort(pixels.begin(), pixels.end(),
              [](const Pixel& a, const Pixel& b) { return a.distance_px < b.distance_px; });
    // A pixel's energy lies between its own distance and that of the one before: the radius moves smoothly.
    double inside = 0;
    double last_px = 0;
    for (const Pixel& pixel : pixels) {
        const double needed = 0.5 * shape.energy - inside;
        if (pixel.energy >= needed) {
            shape.radius_px = last_px + (pixel.distance_px - last_px) * needed / pixel.energy;
            break;
        }
        inside += pixel.energy;
        last_px = pixel.distance_px;
    }
    return shape;
}

struct Jump {
    double largest = 0;
    double at_m = 0;
    void add(double was, double is, double distance_m) {
        const double jump = std::abs(is / was - 1);
        if (jump > largest) {
            largest = jump;
            at_m = distance_m;
        }
    }
};

TEST(AccuracyApproach, ALampFrom20KilometresTo5MetresGrowsWithoutASeam) {
    ChannelOptions options;
    options.quality = {.transform_size = 512, .cie_tail = false, .gratings = false};
    SEAGLARE_CHANNEL(channel, options);
    Shape last;
    Jump energy_jump, peak_jump, radius_jump, core_jump;
    double lowest_energy = std::numeric_limits<double>::infinity();
    double highest_energy = 0;
    double widest_px = 0;
    double shrinks_by = 0, shrinks_at_m = 0;
    double brightens_by = 0, brightens_at_m = 0;
    double faintest_sr = std::numeric_limits<double>::infinity();
    for (double distance_m = farthest_m; distance_m >= nearest_m; distance_m /= step) {
        const Shape now = shape_at(channel, distance_m);
        lowest_energy = std::min(lowest_energy, now.energy);
        highest_energy = std::max(highest_energy, now.energy);
        if (distance_m < farthest_m) {
            energy_jump.add(last.energy, now.energy, distance_m);
            peak_jump.add(last.peak_sr, now.peak_sr, distance_m);
            radius_jump.add(last.radius_px, now.radius_px, distance_m);
            core_jump.add(last.core_px, now.core_px, distance_m);
        }
        if (widest_px > 0 && 1 - now.core_px / widest_px > shrinks_by) {
            shrinks_by = 1 - now.core_px / widest_px;
            shrinks_at_m = distance_m;
        }
        widest_px = std::max(widest_px, now.core_px);
        if (now.peak_sr / faintest_sr - 1 > brightens_by) {
            brightens_by = now.peak_sr / faintest_sr - 1;
            brightens_at_m = distance_m;
        }
        faintest_sr = std::min(faintest_sr, now.peak_sr);
        last = now;
    }
    std::printf("  E D^2/I %.5f to %.5f, largest step %.4f %% at %.1f m\n", lowest_energy, highest_energy,
                100 * energy_jump.largest, energy_jump.at_m);
    std::printf("  peak/E: largest step %.2f %% at %.1f m, rises by %.2f %% at %.1f m\n",
                100 * peak_jump.largest, peak_jump.at_m, 100 * brightens_by, brightens_at_m);
    std::printf("  half-energy radius: largest step %.2f %% at %.1f m\n", 100 * radius_jump.largest,
                radius_jump.at_m);
    std::printf("  core: largest step %.2f %% at %.1f m, shrinks by %.4f %% at %.1f m\n",
                100 * core_jump.largest, core_jump.at_m, 100 * shrinks_by, shrinks_at_m);
    // Clear air: E = I/D^2, all the way.
    EXPECT_GT(lowest_energy, 0.999);
    EXPECT_LT(highest_energy, 1.001);
    EXPECT_LT(energy_jump.largest, 1e-4);
    // The apparent size grows and never shrinks; per unit of illuminance the peak falls and never rises.
    EXPECT_LT(shrinks_by, 1e-4);
    EXPECT_LT(brightens_by, 2e-3);
    // A disc that is a hundredth wider is 2 % darker, and moves its rim by as much of a pixel as it has hundredths of
    // pixels of radius: nothing jumps by more than 4 %.
    EXPECT_LT(peak_jump.largest, 0.04);
    EXPECT_LT(radius_jump.largest, 0.04);
    EXPECT_LT(core_jump.largest, 0.015);
}

// The scene of figure 6.13 of "Rendering of Navigation Lights" (2012): ten lights of 100 cd, 5 degrees apart, 1, 3 ... 19 km
// away; adaptation to 1.94e-3 cd/m2.
TEST(AccuracyApproach, TenLightsFrom1To19KilometresKeepTheInverseSquareAndGrowSmaller) {
    ChannelOptions options;
    options.width_px = 800;
    options.height_px = 96;
    options.quality = {.transform_size = 512, .cie_tail = false, .gratings = false};
    SEAGLARE_CHANNEL(channel, options);
    channel.place_eye({0, 0, 60});
    const auto column = [&](int i) {
        return 400 + options.focal_px * std::tan((-22.5 + 5.0 * i) * std::numbers::pi / 180);
    };
    const auto distance_of = [](int i) { return 1000.0 + 2000.0 * i; };
    // Which pixels a light reaches depends on its place under the grid, and ten lights have ten places: counted in
    // whole pixels, a light one place away may have one more. So each is counted at the same nine places.
    constexpr int places = 3;
    constexpr double counted = places * places;
    struct Seen {
        double share = 0, peak = 0, lit = 0, codes = 0;
    };
    std::array<Seen, 10> seen{};
    for (int place = 0; place < places * places; ++place) {
        channel.clear();
        const auto within_px = [](double middle_px, int third) {
            return std::floor(middle_px) + (third + 0.5) / places;
        };
        for (int i = 0; i < 10; ++i) {
            const Point at = channel.at_px(within_px(column(i), place % places),
                                           within_px(48, place / places), distance_of(i));
            channel.add(white_light(at, 100));
        }
        seaglare_frame frame = channel.frame();
        frame.adaptation_luminance_cd_m2 = 1.94e-3;
        channel.draw_black();
        ASSERT_EQ(channel.render(frame), SEAGLARE_OK) << channel.last_error();
        const auto hdr = channel.hdr();
        const auto picture = channel.picture();
        for (int i = 0; i < 10; ++i) {
            Seen& light = seen.at(static_cast<std::size_t>(i));
            double energy_lx = 0;
            double peak = 0;
            const int first = static_cast<int>(column(i)) - 30;
            for (int y = 0; y < options.height_px; ++y) {
                for (int x = first; x < first + 60; ++x) {
                    const std::size_t at = (static_cast<std::size_t>(y) * options.width_px + x) * 4;
                    const double luminance = luminance_of({hdr[at], hdr[at + 1], hdr[at + 2], 0});
                    const double from_axis_px = std::hypot(x + 0.5 - 400, y + 0.5 - 48);
                    const double cosine = options.focal_px / std::hypot(options.focal_px, from_axis_px);
                    energy_lx += luminance * std::pow(cosine, 3) / (options.focal_px * options.focal_px);
                    peak = std::max(peak, luminance);
                    light.lit += picture[at + 1] > 8 ? 1 / counted : 0;
                    light.codes += picture[at + 1] / counted;
                }
            }
            light.share += energy_lx * distance_of(i) * distance_of(i) / 100 / counted;
            light.peak += peak / counted;
        }
    }
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const Seen& light = seen[i];
        std::printf("  %5.0f m: E D^2/I %.4f, peak %.3g cd/m2, %.1f pixels above code 8, codes %.0f\n",
                    distance_of(static_cast<int>(i)), light.share, light.peak, light.lit, light.codes);
        // What a neighbour's skirt adds and what falls out of the window: 0.3 %.
        EXPECT_NEAR(light.share, 1, 0.01);
        EXPECT_GT(light.codes, 0) << "still there";
        if (i == 0) continue;
        EXPECT_LT(light.peak, seen[i - 1].peak);
        EXPECT_LT(light.lit, seen[i - 1].lit);
        EXPECT_LT(light.codes, seen[i - 1].codes);
    }
}

}  // namespace
}  // namespace seaglare::test
