// The currency of the error bounds: no change of a pixel's glare is worth more codes than the bounds say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "glare/plan/sensitivity.h"
#include "glare/tone/operators.h"

namespace seaglare::glare {
namespace {

Rgb codes_of(const ToneSettings& tone, double adaptation, const Rgb& background, const Rgb& glare,
             double scotopic) {
    const Rgb delta = display_delta(tone, adaptation, 0, background, glare, scotopic);
    Rgb codes{};
    for (std::size_t i = 0; i < 3; ++i)
        codes[i] = 255 * srgb_encode(background[i] + delta[i]);
    return codes;
}

double largest_change(const Rgb& a, const Rgb& b) {
    return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

// A pixel with glare of navigation lights' colours, from far below a code to white, over any background.
class Pixels {
  public:
    double log_uniform(double from, double to) { return from * std::pow(to / from, part_(engine_)); }
    double part() { return part_(engine_); }
    Rgb colour(double& ratio) {
        static constexpr Rgb unit[] = {{1, 1, 1}, {4.703, 0, 0}, {0.016, 1.37, 0.233}, {2.67, 0.604, 0}};
        const Rgb chosen = unit[static_cast<std::size_t>(part() * 3.999)];
        ratio = std::max({chosen[0], chosen[1], chosen[2]});
        return chosen;
    }
    Rgb background() {
        if (part() < 0.4) return {0, 0, 0};
        return {part() * part(), part() * part(), part() * part()};
    }

  private:
    std::mt19937 engine_{31};
    std::uniform_real_distribution<double> part_{0, 1};
};

TEST(Sensitivity, BoundsEveryChangeOfLuminance) {
    Pixels random;
    double closest = 0;
    for (int i = 0; i < 60000; ++i) {
        ToneSettings tone;
        tone.mode = random.part() < 0.5 ? CompositeMode::difference : CompositeMode::plain;
        tone.blue_shift = random.part() < 0.7;
        const double adaptation = random.log_uniform(1e-3, 1e4);
        double ratio = 1, other_ratio = 1;
        const Rgb colour = random.colour(ratio), other = random.colour(other_ratio);
        const Sensitivity bound = sensitivity(tone, adaptation, std::max(ratio, other_ratio));
        const double white_cd_m2 = 2 / tone_curve(tone, adaptation).scale;
        const double luminance = white_cd_m2 * random.log_uniform(1e-6, 3);
        const double change = bound.luminance_cd_m2(random.log_uniform(0.01, 2)) / other_ratio;
        const double rods = 2.464 * luminance * random.part() * 2;
        Rgb glare{}, more{};
        for (std::size_t c = 0; c < 3; ++c) {
            glare[c] = luminance * colour[c];
            more[c] = glare[c] + change * other[c];
        }
        const Rgb background = random.background();
        const double codes = largest_change(codes_of(tone, adaptation, background, glare, rods),
                                            codes_of(tone, adaptation, background, more, rods));
        const double most = bound.codes_per_cd_m2 * change * other_ratio;
        ASSERT_LE(codes, most * 1.01 + 1e-9)
            << "adaptation " << adaptation << " luminance " << luminance << " change " << change;
        closest = std::max(closest, codes / most);
    }
    EXPECT_GT(closest, 0.9) << "a bound far above every change would waste the budget";
}

TEST(Sensitivity, BoundsEveryRelativeChange) {
    Pixels random;
    double closest = 0;
    for (int i = 0; i < 60000; ++i) {
        ToneSettings tone;
        tone.blue_shift = random.part() < 0.7;
        const double adaptation = random.log_uniform(1e-3, 1e4);
        double ratio = 1;
        const Rgb colour = random.colour(ratio);
        const Sensitivity bound = sensitivity(tone, adaptation, ratio);
        const double luminance = 2 / tone_curve(tone, adaptation).scale * random.log_uniform(1e-6, 3);
        const double part = random.log_uniform(1e-4, 0.02);
        const double rods = 2.464 * luminance * random.part();
        Rgb glare{}, more{};
        for (std::size_t c = 0; c < 3; ++c) {
            glare[c] = luminance * colour[c];
            more[c] = glare[c] * (1 + part);
        }
        const Rgb background = random.background();
        const double codes = largest_change(codes_of(tone, adaptation, background, glare, rods),
                                            codes_of(tone, adaptation, background, more, rods * (1 + part)));
        ASSERT_LE(codes, bound.codes_per_unit_ratio * part * 1.02 + 1e-9) << luminance << " " << adaptation;
        closest = std::max(closest, codes / (bound.codes_per_unit_ratio * part));
    }
    EXPECT_GT(closest, 0.5);
}

TEST(Sensitivity, RodHueIsBoundedAndVanishesByDay) {
    Pixels random;
    for (int i = 0; i < 30000; ++i) {
        const double adaptation = random.log_uniform(1, 1e4);
        double ratio = 1;
        const Rgb colour = random.colour(ratio);
        const double luminance = random.log_uniform(1e-4, 10) / tone_curve(ToneSettings{}, adaptation).scale;
        const double rods_per_luminance = random.part() * 5;
        Rgb glare{};
        for (std::size_t c = 0; c < 3; ++c)
            glare[c] = luminance * colour[c];
        ToneSettings with, without;
        without.blue_shift = false;
        const Rgb background = random.background();
        const double rods = rods_per_luminance * luminance;
        const double codes = largest_change(codes_of(with, adaptation, background, glare, rods),
                                            codes_of(without, adaptation, background, glare, rods));
        ASSERT_LE(codes, rod_hue_codes(with, adaptation, ratio, rods_per_luminance) * 1.01 + 1e-9);
    }
    EXPECT_LT(rod_hue_codes(ToneSettings{}, 3000, 1, 2.464), 0.1);
    EXPECT_GT(rod_hue_codes(ToneSettings{}, 0.001, 1, 2.464), 50);
    ToneSettings off;
    off.blue_shift = false;
    EXPECT_EQ(rod_hue_codes(off, 0.001, 1, 2.464), 0);
}

}  // namespace
}  // namespace seaglare::glare
