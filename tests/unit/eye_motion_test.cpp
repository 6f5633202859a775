// Everything that moves in the eye, at time steps from 1e-9 s to hours. Expected values: physics notes section 4 (closed
// forms, recomputed by hand where a comment says so).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "glare/eye/accommodation.h"
#include "glare/eye/adaptation.h"
#include "glare/eye/exact_step.h"
#include "glare/eye/lids.h"
#include "glare/eye/noise.h"
#include "glare/eye/vitreous.h"

namespace {

using namespace seaglare::glare;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<double, 7> steps_s = {0, 1e-9, 1.0 / 240, 1.0 / 60, 1, 10, 1e4};

TEST(ExactStep, AFirstOrderApproachLeavesWhatTheExponentialLeaves) {
    EXPECT_NEAR(approached(1, 0, 1.0 / 60, 0.1), 0.84648, 5e-6);
    EXPECT_NEAR(approached(1, 0, 1, 0.1), 4.5e-5, 5e-7);
    EXPECT_NEAR(approached(1, 0, 10, 0.1), 0, 1e-40);
}

TEST(ExactStep, TwoHalfStepsAreOneStep) {
    for (const double step_s : steps_s) {
        for (const double tau_s : {1.6e-5, 0.1, 0.4, 400.0}) {
            const double once = approached(3, -2, step_s, tau_s);
            const double twice = approached(approached(3, -2, step_s / 2, tau_s), -2, step_s / 2, tau_s);
            EXPECT_NEAR(once, twice, 1e-14) << step_s << " " << tau_s;
            for (const double damping : {0.0, 0.2, 0.999999, 1.0, 1.000001, 3.0, 1e4}) {
                const double omega = 1 / tau_s;
                const SpringState start = {1, 5 * omega};
                const SpringState whole = sprung(start, 0.25, step_s, omega, damping);
                const SpringState halves =
                    sprung(sprung(start, 0.25, step_s / 2, omega, damping), 0.25, step_s / 2, omega, damping);
                // An undamped spring has turned omega * step radians, and its phase is known to that times 1e-16.
                const double tolerance = 1e-12 * (1 + omega * step_s * 1e-2);
                EXPECT_NEAR(whole.position, halves.position, 10 * tolerance)
                    << step_s << " " << tau_s << " " << damping;
                EXPECT_NEAR(whole.velocity / omega, halves.velocity / omega, 10 * tolerance)
                    << step_s << " " << tau_s << " " << damping;
            }
        }
    }
}

TEST(ExactStep, AnExplicitStepWouldHaveBlownUpHere) {
    const double tau_s = 0.1;
    double euler = 1;
    double exact = 1;
    for (int i = 0; i < 5; ++i) {
        euler += (0 - euler) / tau_s * 1.0;
        exact = approached(exact, 0, 1.0, tau_s);
    }
    EXPECT_DOUBLE_EQ(euler, -59049);  // (-9)^5
    EXPECT_GE(exact, 0);
    EXPECT_LT(exact, 1e-20);
}

TEST(ExactStep, AStepThatIsNoneChangesNothing) {
    const SpringState spring = {2, -3};
    for (const double step_s : {0.0, -1.0, nan}) {
        EXPECT_EQ(approached(5, 1, step_s, 0.1), 5);
        EXPECT_EQ(sprung(spring, 1, step_s, 3, 0.5), spring);
    }
}

TEST(ExactStep, ASpringIsTheTextbooksDampedCosine) {
    const double omega = 7;
    const double zeta = 0.3;
    const double omega_d = omega * std::sqrt(1 - zeta * zeta);
    for (const double t : {0.01, 0.3, 2.0}) {
        const SpringState s = sprung({1, 0}, 0, t, omega, zeta);
        const double wanted = std::exp(-zeta * omega * t) *
                              (std::cos(omega_d * t) + zeta * omega / omega_d * std::sin(omega_d * t));
        EXPECT_NEAR(s.position, wanted, 1e-14);
    }
    const SpringState critical = sprung({1, 0}, 0, 0.5, 4, 1);
    EXPECT_NEAR(critical.position, (1 + 2.0) * std::exp(-2.0), 1e-14);
    const SpringState over = sprung({1, 0}, 0, 0.5, 4, 2);  // roots -4 (2 -+ sqrt 3)
    const double slow = 4 * (2 - std::sqrt(3.0));
    const double fast = 4 * (2 + std::sqrt(3.0));
    EXPECT_NEAR(over.position, (fast * std::exp(-slow / 2) - slow * std::exp(-fast / 2)) / (fast - slow),
                1e-14);
}

TEST(ExactStep, TheRegimesMeetWithoutAStep) {
    for (const double step_s : {1e-3, 0.1, 1.0, 5.0}) {
        const SpringState below = sprung({1, 2}, 0, step_s, 5, 1 - 1e-9);
        const SpringState at = sprung({1, 2}, 0, step_s, 5, 1);
        const SpringState above = sprung({1, 2}, 0, step_s, 5, 1 + 1e-9);
        EXPECT_NEAR(below.position, at.position, 1e-7);
        EXPECT_NEAR(above.position, at.position, 1e-7);
    }
}

TEST(Adaptation, PigmentsRecoverInTheDarkAsTheTableSays) {
    const struct {
        double seconds, rod, cone;
    } rows[] = {{60, 0.139, 0.420}, {300, 0.528, 0.935}, {600, 0.777, 0.9957}, {1800, 0.989, 1.000}};
    for (const auto& row : rows) {
        const Pigments p = bleached({0, 0}, 0, row.seconds);
        EXPECT_NEAR(p.rod, row.rod, 5e-4);
        EXPECT_NEAR(p.cone, row.cone, 5e-4);
    }
}

TEST(Adaptation, BleachingIsStiffAndStaysInside) {
    for (const double luminance : {0.0, 1e-6, 0.04, 1.0, 1e4, 1e6}) {
        const Pigments rest = pigments_at_rest(luminance);
        EXPECT_NEAR(rest.rod, 0.04 / (0.04 + luminance), 1e-12);
        EXPECT_NEAR(rest.cone, 2e6 / (2e6 + luminance), 1e-12);
        for (const double step_s : steps_s) {
            const Pigments once = bleached({1, 1}, luminance, step_s);
            EXPECT_GE(once.rod, rest.rod);
            EXPECT_LE(once.rod, 1);
            const Pigments twice = bleached(bleached({1, 1}, luminance, step_s / 2), luminance, step_s / 2);
            EXPECT_NEAR(once.rod, twice.rod, 1e-13);
            EXPECT_NEAR(once.cone, twice.cone, 1e-13);
        }
    }
    EXPECT_NEAR(bleached({1, 1}, 1e4, 0.005).rod, std::exp(-0.005 * (1e4 / 16 + 1.0 / 400)), 1e-5);
}

TEST(Adaptation, TheExplicitSchemeBlowsUpWhereOursDoesNot) {
    double euler = 1;
    Pigments exact;
    for (int i = 0; i < 10; ++i) {
        const double dt = 1.0 / 60;
        euler += dt * ((1 - euler) / 400 - 1e4 * euler / 16);
        exact = bleached(exact, 1e4, dt);
    }
    EXPECT_NEAR(euler / 5.5e9, 1, 0.02);
    EXPECT_NEAR(exact.rod, 0.04 / 10000.04, 1e-9);
}

TEST(Adaptation, TheEyeFollowsALuminanceWithoutOvershoot) {
    for (const double from : {0.0, 1e-6, 0.01, 1e6}) {
        for (const double to : {0.0, 1e-6, 3.0, 1e6}) {
            double before = from;
            for (const double step_s : steps_s) {
                const double after = light_adapted_cd_m2(before, to, step_s);
                EXPECT_GE(after, std::min(before, to));
                EXPECT_LE(after, std::max(before, to));
                const double halves =
                    light_adapted_cd_m2(light_adapted_cd_m2(before, to, step_s / 2), to, step_s / 2);
                EXPECT_NEAR(after, halves, 1e-9 * std::max(1e-6, std::max(from, to)));
                before = after;
            }
        }
    }
    EXPECT_EQ(light_adapted_cd_m2(2, nan, 1), 2);
    EXPECT_EQ(light_adapted_cd_m2(2, std::numeric_limits<double>::infinity(), 1), 2);
    EXPECT_NEAR(rod_share(0.001), 0.976, 5e-4);  // physics notes section 6
}

TEST(Vitreous, ACloudThatIsLeftBehindComesToRest) {
    const double drag = 2;
    VitreousState state =
        turned({}, {0, 0, 1}, drag, 0);  // the head starts to turn: the cloud lags at -1 rad/s
    EXPECT_EQ(state.spin_rad_s[2], -1);
    const VitreousState later = turned(state, {0, 0, 1}, drag, 0.7);
    EXPECT_NEAR(roll_about_sight_rad(later), -(1 - std::exp(-1.4)) / 2, 1e-14);
    EXPECT_NEAR(later.spin_rad_s[2], -std::exp(-1.4), 1e-14);
    const VitreousState rest = turned(state, {0, 0, 1}, drag, 1e4);
    EXPECT_NEAR(roll_about_sight_rad(rest), -0.5, 1e-14);
}

TEST(Vitreous, TwoHalfStepsAreOneAboutAnyAxis) {
    const std::array<double, 3> head = {0.3, -2, 5};
    for (const double step_s : steps_s) {
        for (const double drag : {0.0, 0.5, 100.0}) {
            if (drag == 0 && step_s > 10) continue;  // a phase of 5e4 rad is known to 1e-11 only
            const VitreousState start = turned({}, head, drag, 0);
            const VitreousState once = turned(start, head, drag, step_s);
            const VitreousState twice = turned(turned(start, head, drag, step_s / 2), head, drag, step_s / 2);
            for (std::size_t i = 0; i < 4; ++i)
                EXPECT_NEAR(once.orientation[i], twice.orientation[i], 1e-12) << step_s << " " << drag;
        }
    }
}

TEST(Vitreous, WhatIsNotFiniteIsAHeadAtRest) {
    const VitreousState state = turned({}, {nan, 1, std::numeric_limits<double>::infinity()}, 1, 0.1);
    for (const double q : state.orientation)
        EXPECT_TRUE(std::isfinite(q));
    EXPECT_EQ(state.spin_rad_s[0], 0);
    EXPECT_EQ(turned(state, {0, 1, 0}, 1, -1), state);
    EXPECT_EQ(turned(state, {0, 1, 0}, 1, nan), state);
}

TEST(Lids, ABlinkEachIntervalShutsAndOpensAgain) {
    LidMotion motion;
    motion.blink_interval_s = 4;
    int blinks = 0;
    double longest_step = 0;
    double before = lid_closure(motion, 0.001, 0, 9);
    bool shut = false;
    constexpr int samples_per_s = 1000;
    for (int i = 1; i <= 400 * samples_per_s; ++i) {
        const double closure = lid_closure(motion, 0.001, static_cast<double>(i) / samples_per_s, 9);
        longest_step = std::max(longest_step, std::abs(closure - before));
        if (closure > 0.99 && !shut) ++blinks;
        if (closure > 0.99) shut = true;
        if (closure < 0.01) shut = false;
        before = closure;
    }
    EXPECT_EQ(blinks, 100);
    EXPECT_LT(longest_step, 1.875 / 100 + 1e-3);  // the steepest slope: 15/8 over a third of 0.3 s
}

TEST(Lids, TheyAreAPureFunctionOfSeedAndTime) {
    LidMotion motion;
    motion.blink_interval_s = 4;
    motion.squint = 0.4;
    EXPECT_EQ(lid_closure(motion, 1, 1e7, 3), lid_closure(motion, 1, 1e7, 3));
    EXPECT_TRUE(std::isfinite(lid_closure(motion, 1, nan, 3)));
    EXPECT_EQ(lid_closure({}, 1e6, 12.3, 3), 0);
}

TEST(Lids, SquintingGrowsWithTheLuminanceUpToItsLimit) {
    LidMotion motion;
    motion.squint = 0.4;
    double before = 0;
    for (const double luminance : {0.0, 1e-6, 1.0, 3000.0, 1e6}) {
        const double closure = lid_closure(motion, luminance, 0, 1);
        EXPECT_GE(closure, before);
        EXPECT_LE(closure, 0.4);
        before = closure;
    }
    EXPECT_NEAR(lid_closure(motion, 3000, 0, 1), 0.2, 1e-12);
}

TEST(Accommodation, FluctuationsStayInTheirBands) {
    AccommodationMotion motion;
    motion.quick_dioptre = 0.1;
    int upward = 0;
    double before = 0;
    constexpr double step_s = 1e-3;
    constexpr int samples = 200000;
    for (int i = 0; i < samples; ++i) {
        const double now = accommodation_dioptre(motion, 7, i * step_s, 5);
        EXPECT_LE(std::abs(now), 0.1);
        if (before < 0 && now >= 0) ++upward;
        before = now;
    }
    EXPECT_NEAR(upward / (samples * step_s), 1.7, 0.05);  // the mean of 1.3 to 2.1 Hz
}

TEST(Accommodation, TheSlowPartGrowsWithThePupil) {
    AccommodationMotion motion;
    motion.slow_dioptre = 0.3;
    for (const double time_s : {0.4, 17.3, 1e7}) {
        const double wide = accommodation_dioptre(motion, 7, time_s, 5);
        EXPECT_NEAR(accommodation_dioptre(motion, 3.5, time_s, 5), wide / 2, 1e-15);
        EXPECT_LE(std::abs(wide), 0.3);
        EXPECT_NEAR(lens_scale(motion, 7, time_s, 5), 1 - 0.004 * wide, 1e-15);
    }
    EXPECT_EQ(accommodation_dioptre({}, 7, 3, 5), 0);
    EXPECT_EQ(lens_scale({}, 7, 3, 5), 1);
}

}  // namespace
