// Patterns in between two patterns: energy is conserved whatever their lamps and layers, and the weights of a moment's keys
// add up to 1, go over without a jump and come back to the beginning.
#include "glare/psf/pattern_mix.h"

#include <gtest/gtest.h>

#include <cmath>

#include "glare/psf/motion_keys.h"

namespace seaglare::glare {
namespace {

constexpr int radius = 3;
constexpr std::size_t nodes = 49;

// Core and skirt add up to `energy` in every layer and channel; the shape is `phase`'s.
Pattern pattern_of(double energy, int phase, std::vector<std::uint8_t> lamps, std::size_t layers) {
    Pattern p;
    p.generation = static_cast<std::uint64_t>(phase) + 1;
    p.radius_nodes = radius;
    p.pitch = 0.5;
    p.lamps = std::move(lamps);
    p.slot_of_lamp.fill(0);
    for (std::size_t s = 0; s < p.lamps.size(); ++s)
        p.slot_of_lamp[p.lamps[s]] = static_cast<std::uint8_t>(s);
    p.layer_radius_nodes.clear();
    for (std::size_t l = 0; l < layers; ++l)
        p.layer_radius_nodes.push_back(static_cast<float>(2 * l));
    p.tail_scale = energy;
    p.skirt.resize(p.lamps.size() * layers * nodes * 4);
    for (std::size_t slot = 0; slot < p.lamps.size(); ++slot) {
        p.core_energy[slot].fill(static_cast<float>(0.6 * energy));
        for (std::size_t layer = 0; layer < layers; ++layer) {
            for (std::size_t c = 0; c < 4; ++c) {
                double sum = 0;
                const auto at = [&](std::size_t n) -> float& {
                    return p.skirt[((slot * layers + layer) * nodes + n) * 4 + c];
                };
                for (std::size_t n = 0; n < nodes; ++n) {
                    at(n) =
                        static_cast<float>(1 + std::sin(static_cast<double>(n * (c + 1) + layer) + phase));
                    sum += static_cast<double>(at(n));
                }
                for (std::size_t n = 0; n < nodes; ++n)
                    at(n) = static_cast<float>(static_cast<double>(at(n)) * 0.4 * energy / sum / 0.25);
            }
        }
    }
    return p;
}

double energy_of(const Pattern& p, std::size_t slot, std::size_t layer, std::size_t channel) {
    double sum = 0;
    for (std::size_t n = 0; n < nodes; ++n)
        sum += static_cast<double>(
            p.skirt[((slot * p.layer_radius_nodes.size() + layer) * nodes + n) * 4 + channel]);
    return static_cast<double>(p.core_energy[slot][channel]) + sum * p.pitch * p.pitch;
}

TEST(PatternMix, ConservesEnergyInEveryLampLayerAndChannel) {
    const Pattern a = pattern_of(1, 0, {0, 3}, 1);
    const Pattern b = pattern_of(0.9, 1, {0, 2, 3}, 3);
    Pattern mixed;
    for (const double weight : {0.0, 0.25, 0.5, 1.0}) {
        mix_patterns(a, b, weight, mixed);
        ASSERT_EQ(mixed.lamps, b.lamps);
        ASSERT_EQ(mixed.layer_radius_nodes.size(), 3U);
        for (std::size_t slot = 0; slot < 3; ++slot)
            for (std::size_t layer = 0; layer < 3; ++layer)
                for (std::size_t c = 0; c < 4; ++c)
                    EXPECT_NEAR(energy_of(mixed, slot, layer, c), 1 - 0.1 * weight, 1e-5);
        EXPECT_NEAR(mixed.tail_scale, 1 - 0.1 * weight, 1e-12);
    }
}

TEST(PatternMix, IsEitherOfTheTwoAtItsEnds) {
    const Pattern a = pattern_of(1, 0, {0}, 2);
    const Pattern b = pattern_of(1, 1, {0}, 2);
    Pattern mixed;
    mix_patterns(a, b, 0, mixed);
    EXPECT_EQ(mixed.skirt, a.skirt);
    mix_patterns(a, b, 1, mixed);
    EXPECT_EQ(mixed.skirt, b.skirt);
    mix_patterns(a, b, std::nan(""), mixed);
    EXPECT_EQ(mixed.skirt, b.skirt);
}

// Lamps 1, 2, 5 and 7 are in view and two have patterns. Before, those are 2 and 7, and 5 and 1 are drawn with 2; then those
// are 1 and 2, and 5 is drawn with 1 and 7 with 2.
TEST(PatternMix, LampsThatLoseOrChangeTheirPatternGoOverToWhatStandsInForThem) {
    Pattern a = pattern_of(1, 0, {2, 7}, 2);
    Pattern b = pattern_of(1, 1, {1, 2}, 2);
    a.slot_of_lamp[1] = a.slot_of_lamp[5] = 0;
    b.slot_of_lamp[5] = 0;
    b.slot_of_lamp[7] = 1;
    constexpr std::uint32_t in_view = 1U << 1U | 1U << 2U | 1U << 5U | 1U << 7U;
    const auto drawn = [](const Pattern& p, std::size_t lamp, std::size_t at) {
        const std::size_t slot = p.slot_of_lamp[lamp];
        return static_cast<double>(p.skirt[slot * p.skirt.size() / p.lamps.size() + at]);
    };
    Pattern mixed;
    for (const double weight : {0.0, 0.3, 1.0}) {
        mix_patterns(a, b, weight, mixed, 1, in_view);
        for (const std::size_t lamp : {1U, 2U, 5U, 7U}) {
            for (std::size_t at = 0; at < 2 * nodes * 4; ++at)
                EXPECT_NEAR(drawn(mixed, lamp, at),
                            (1 - weight) * drawn(a, lamp, at) + weight * drawn(b, lamp, at), 1e-6)
                    << "lamp " << lamp << " weight " << weight;
            EXPECT_NEAR(energy_of(mixed, mixed.slot_of_lamp[lamp], 1, 1), 1, 1e-5);
        }
    }
    // Nobody looks at 5 and 7: no slots for them.
    mix_patterns(a, b, 0.3, mixed, 1, 1U << 1U | 1U << 2U);
    EXPECT_EQ(mixed.lamps, (std::vector<std::uint8_t>{1, 2}));
    EXPECT_EQ(mixed.slot_of_lamp[7], 1);
}

TEST(PatternMix, ABlinkDimsAllOfIt) {
    const Pattern a = pattern_of(1, 0, {0}, 1);
    Pattern mixed;
    mix_patterns(a, a, 0.5, mixed, 0.25);
    EXPECT_NEAR(energy_of(mixed, 0, 0, 1), 0.25, 1e-6);
    EXPECT_NEAR(mixed.tail_scale, 0.25, 1e-12);
}

TEST(PatternMix, HasAGenerationOfItsOwnAndUsesItsMemoryAgain) {
    const Pattern a = pattern_of(1, 0, {0}, 1);
    const Pattern b = pattern_of(1, 1, {0}, 1);
    Pattern mixed;
    mix_patterns(a, b, 0.5, mixed);
    const std::uint64_t first = mixed.generation;
    const float* const memory = mixed.skirt.data();
    mix_patterns(a, b, 0.6, mixed);
    EXPECT_GT(mixed.generation, first);
    EXPECT_EQ(mixed.skirt.data(), memory);
}

TEST(PatternMix, RefusesPatternsOfTwoGrids) {
    const Pattern a = pattern_of(1, 0, {0}, 1);
    Pattern b = a;
    b.pitch = 0.25;
    Pattern mixed;
    EXPECT_FALSE(can_mix(a, b));
    EXPECT_THROW(mix_patterns(a, b, 0.5, mixed), std::invalid_argument);
}

EyeMoment moment_at(double time_s, double adaptation_cd_m2 = 0.001) {
    EyeMoment moment;
    moment.request.pitch = 1e-3;
    moment.request.time_s = time_s;
    moment.adaptation_cd_m2 = adaptation_cd_m2;
    return moment;
}

PatternMotion motion_of(MotionMode mode) {
    PatternMotion motion;
    motion.mode = mode;
    motion.rate_hz = 10;
    motion.frames = 8;
    motion.loop_s = 2;
    return motion;
}

class Keys : public ::testing::TestWithParam<MotionMode> {};

TEST_P(Keys, WeighOneTogetherAndGoOverWithoutAJump) {
    const EyeModel eye = young_eye();
    const PatternMotion motion = motion_of(GetParam());
    constexpr double step_s = 1.0 / 960;
    const auto weight_of = [](const MotionKeys& keys, double pupil_mm) {
        double sum = 0;
        for (int i = 0; i < keys.count; ++i) {
            const auto& key = keys.list[static_cast<std::size_t>(i)];
            if (key.request.pupil_mm == pupil_mm) sum += key.weight;
        }
        return sum;
    };
    MotionKeys last = motion_keys(eye, motion, 3, moment_at(0));
    for (int i = 1; i < 4000; ++i) {
        const MotionKeys now = motion_keys(eye, motion, 3, moment_at(i * step_s));
        double sum = 0;
        for (int k = 0; k < now.count; ++k) {
            const auto& key = now.list[static_cast<std::size_t>(k)];
            sum += key.weight;
            EXPECT_NEAR(key.weight, weight_of(last, key.request.pupil_mm), 10 * step_s + 1e-9) << i;
        }
        ASSERT_NEAR(sum, 1, 1e-12);
        last = now;
    }
}

TEST_P(Keys, AreAPureFunctionOfTimeAndAdaptation) {
    const EyeModel eye = young_eye();
    const PatternMotion motion = motion_of(GetParam());
    const MotionKeys once = motion_keys(eye, motion, 3, moment_at(1e6 + 0.123));
    const MotionKeys again = motion_keys(eye, motion, 3, moment_at(1e6 + 0.123, 0.001 * (1 + 1e-6)));
    ASSERT_EQ(once.count, again.count);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(once.list[i].request.pupil_mm, again.list[i].request.pupil_mm);
        EXPECT_EQ(once.list[i].weight, again.list[i].weight);
    }
}

INSTANTIATE_TEST_SUITE_P(Modes, Keys, ::testing::Values(MotionMode::interpolated, MotionMode::flip_book),
                         [](const auto& given) {
                             return given.param == MotionMode::flip_book ? "FlipBook" : "Interpolated";
                         });

TEST(FlipBook, BeginsAnewAfterItsLoop) {
    const EyeModel eye = young_eye();
    const PatternMotion motion = motion_of(MotionMode::flip_book);
    for (const double time_s : {0.1, 1.9, 1.999}) {
        const MotionKeys once = motion_keys(eye, motion, 3, moment_at(time_s));
        const MotionKeys later = motion_keys(eye, motion, 3, moment_at(time_s + 2 * 4));
        EXPECT_EQ(once.list[0].page, later.list[0].page);
        EXPECT_NEAR(once.list[0].weight, later.list[0].weight, 1e-9);
    }
    EXPECT_EQ(motion_keys(eye, motion, 3, moment_at(1.999)).list[1].page, 0);
}

TEST(EyeAtRest, IsTheSameAtAllTimes) {
    const EyeModel eye = young_eye_with_lashes();
    const auto rest_at = [&](double time_s) {
        EyeMoment moment = moment_at(time_s, 1);
        moment.request = request_at(eye, 3, moment, time_s);
        return at_rest(moment).request;
    };
    const PatternRequest first = rest_at(0);
    for (const double time_s : {0.3, 17.0, 1e6}) {
        const PatternRequest later = rest_at(time_s);
        EXPECT_EQ(first.pupil_mm, later.pupil_mm);
        EXPECT_EQ(first.time_s, later.time_s);
        EXPECT_EQ(first.lids, later.lids);
    }
}

}  // namespace
}  // namespace seaglare::glare
