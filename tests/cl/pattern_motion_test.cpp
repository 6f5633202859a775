// The bound that lets a frame keep the pattern of the eye at rest: measured patterns stay inside it, and it falls to nothing
// where nothing moves.
#include "glare/plan/pattern_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "glare/psf/motion_keys.h"
#include "tests/cl/pattern_fixture.h"

namespace seaglare::glare {
namespace {

struct Case {
    const char* name;
    EyeModel eye;
    double focal_px;
    double adaptation_cd_m2;
};

PatternSettings settings_of() {
    PatternSettings settings;
    settings.transform_size = 1024;
    settings.wavelengths = 12;
    settings.layer_radii_px = {0};
    settings.max_radius_nodes = 96;
    return settings;
}

std::vector<SpectralSample> samples_of() {
    return sample_spectrum([](double) { return 1.0; }, settings_of().wavelengths);
}

EyeModel unblinking(EyeModel eye) {
    eye.lids.motion.blink_interval_s = 0;
    return eye;
}

class Motion : public ::testing::TestWithParam<Case> {};

TEST_P(Motion, StaysInsideItsBound) {
    const Case& c = GetParam();
    const PatternSettings settings = settings_of();
    SEAGLARE_CL_SOURCE(source, c.eye, settings, samples_of());
    EyeMoment moment;
    moment.adaptation_cd_m2 = c.adaptation_cd_m2;
    moment.request.pitch = 1 / c.focal_px;
    moment.request = request_at(c.eye, 7, moment, 0);
    Pattern rest;
    source->make_into(at_rest(moment).request, rest);
    const int radius = rest.radius_nodes;
    const int side = 2 * radius + 1;
    const auto value = [&](const Pattern& p, int x, int y, std::size_t channel) {
        return static_cast<double>(
            p.skirt[4 * static_cast<std::size_t>((y + radius) * side + x + radius) + channel]);
    };
    std::vector<double> mean(static_cast<std::size_t>(radius) + 1);
    std::vector<double> nodes(mean.size());
    const auto ring_of = [](int x, int y) { return static_cast<std::size_t>(std::lround(std::hypot(x, y))); };
    const auto each = [&](auto&& look) {
        for (int y = -radius; y <= radius; ++y)
            for (int x = -radius; x <= radius; ++x)
                if (ring_of(x, y) < mean.size() && ring_of(x, y) > 0) look(x, y, ring_of(x, y));
    };
    each([&](int x, int y, std::size_t ring) {
        mean[ring] +=
            0.2126 * value(rest, x, y, 0) + 0.7152 * value(rest, x, y, 1) + 0.0722 * value(rest, x, y, 2);
        ++nodes[ring];
    });
    for (std::size_t ring = 1; ring < mean.size(); ++ring)
        mean[ring] /= nodes[ring];

    const MotionSpread spread =
        motion_spread(c.eye, settings, moment.request.resting_pupil_mm, moment.request.pitch);
    double core = 0;
    double skirt = 0;
    Pattern now;
    for (int i = 0; i < 10; ++i) {
        source->make_into(request_at(c.eye, 7, moment, 0.1 + 0.37 * i), now);
        core =
            std::max(core, std::abs(static_cast<double>(now.core_energy[0][1] / rest.core_energy[0][1]) - 1));
        each([&](int x, int y, std::size_t ring) {
            // What the tail takes over is not the skirt's any more.
            if (static_cast<double>(ring) / c.focal_px > rest.window_inner) return;
            const double share = std::min(1.0, 0.1 + 0.15 * std::hypot(x, y));
            for (std::size_t channel = 0; channel < 3; ++channel)
                skirt = std::max(skirt, std::abs(value(now, x, y, channel) - value(rest, x, y, channel)) /
                                            mean[ring] / share);
        });
    }
    EXPECT_LE(core, spread.core);
    EXPECT_LE(skirt, spread.skirt);
    // And not far below: a bound that allows anything would be none.
    EXPECT_GT(skirt, 0.05 * spread.skirt);
}

INSTANTIATE_TEST_SUITE_P(
    Eyes, Motion,
    ::testing::Values(Case{"YoungByStarlight", young_eye(), 869, 0.001},
                      Case{"YoungAtDusk", young_eye(), 869, 0.1}, Case{"YoungByDay", young_eye(), 869, 30},
                      Case{"YoungFine", young_eye(), 4031, 0.001},
                      Case{"YoungFineByDay", young_eye(), 4031, 30},
                      Case{"Sixty", sixty_year_eye(), 1304, 0.001},
                      Case{"SixtyByDay", sixty_year_eye(), 1304, 30},
                      Case{"AllMoves", unblinking(young_eye_with_lashes()), 1304, 0.001},
                      Case{"AllMovesByDay", unblinking(young_eye_with_lashes()), 869, 30}),
    [](const auto& given) { return std::string(given.param.name); });

TEST(MotionBound, IsNothingWhereNothingMoves) {
    EyeModel eye = young_eye();
    eye.hippus_amplitude_mm = 0;
    const MotionSpread spread = motion_spread(eye, settings_of(), 6, 1.0 / 869);
    EXPECT_EQ(spread.core, 0);
    EXPECT_EQ(spread.skirt, 0);
    LightSummary lights;
    lights.all.add(1000);
    EXPECT_EQ(motion_bound_codes(spread, sensitivity({}, 0.001), lights, 1.0 / 869, 1e-6, 1), 0);
}

TEST(MotionBound, ABlinkTakesEverything) {
    EyeModel eye = young_eye();
    eye.lids.motion.blink_interval_s = 4;
    EXPECT_EQ(motion_spread(eye, settings_of(), 6, 1.0 / 869).core, 1);
}

TEST(MotionBound, GrowsWithTheLightAndShrinksByDay) {
    const MotionSpread spread = motion_spread(young_eye(), settings_of(), 6, 1.0 / 869);
    const auto codes = [&](double lux, double adaptation_cd_m2) {
        LightSummary lights;
        lights.all.add(lux);
        return motion_bound_codes(spread, sensitivity({}, adaptation_cd_m2), lights, 1.0 / 869, 1e-6, 1);
    };
    EXPECT_NEAR(codes(2e-8, 0.001), 2 * codes(1e-8, 0.001), 1e-3 * codes(2e-8, 0.001));
    EXPECT_LT(codes(1e-6, 100), 0.1 * codes(1e-6, 0.001));
    EXPECT_LT(codes(1e-10, 0.001), 0.5);
}

}  // namespace
}  // namespace seaglare::glare
