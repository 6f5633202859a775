// What accumulates in an eye, stepped by frames: exact, once per instant, and safe from any time.
#include "glare/eye/eye_state.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "glare/eye/adaptation.h"

namespace seaglare::glare {
namespace {

EyeSurroundings frame(double time_s, double luminance_cd_m2 = 1, double head_rad_s = 0) {
    return {luminance_cd_m2, {0, 0, head_rad_s}, time_s};
}

EyeModel adapting_eye() {
    EyeModel eye = young_eye();
    eye.adapts = true;
    return eye;
}

TEST(EyeState, TheFirstFrameIsTakenAsItIs) {
    const EyeState state = advanced({}, adapting_eye(), frame(100, 5, 2));
    EXPECT_EQ(state.adapted_cd_m2, 5);
    EXPECT_EQ(state.time_s, 100);
    EXPECT_EQ(state.vitreous, VitreousState{});
}

TEST(EyeState, AnEyeThatDoesNotAdaptHasEachFramesLuminanceAtOnce) {
    EyeState state = advanced({}, young_eye(), frame(0, 1e4));
    state = advanced(state, young_eye(), frame(1e-9, 1e-3));
    EXPECT_EQ(state.adapted_cd_m2, 1e-3);
}

TEST(EyeState, AnEyeThatAdaptsApproachesByTheClosedForm) {
    EyeState state = advanced({}, adapting_eye(), frame(0, 100));
    state = advanced(state, adapting_eye(), frame(0.25, 0.01));
    EXPECT_DOUBLE_EQ(*state.adapted_cd_m2, light_adapted_cd_m2(100, 0.01, 0.25));
    state = advanced(state, adapting_eye(), frame(10, 0.01));
    EXPECT_NEAR(*state.adapted_cd_m2, 0.01, 1e-6);
}

TEST(EyeState, TimeThatStandsStillRunsBackOrIsNoNumberMakesNoStep) {
    EyeState state = advanced({}, adapting_eye(), frame(10, 1, 1));
    state = advanced(state, adapting_eye(), frame(10.1, 1, 1));
    for (double time_s : {10.1, 9.0, std::nan(""), std::numeric_limits<double>::infinity(),
                          -std::numeric_limits<double>::infinity()}) {
        const EyeState same = advanced(state, adapting_eye(), frame(time_s, 1e5, 7));
        EXPECT_EQ(same.adapted_cd_m2, state.adapted_cd_m2) << time_s;
        EXPECT_EQ(same.vitreous, state.vitreous) << time_s;
        EXPECT_TRUE(std::isfinite(*same.time_s)) << time_s;
    }
}

// However the frames fall, and however late it is.
TEST(EyeState, TwoHalfStepsEqualOne) {
    for (double late_s : {0.0, 1e7}) {
        for (double step_s : {1e-9, 1.0 / 240, 1.0 / 64, 1.0, 10.0}) {
            EyeState start = advanced({}, adapting_eye(), frame(late_s, 50));
            start = advanced(start, adapting_eye(), frame(late_s + 0.125, 50, 3));
            const double from = late_s + 0.125;
            const EyeState whole = advanced(start, adapting_eye(), frame(from + step_s, 0.02, 3));
            EyeState halves = advanced(start, adapting_eye(), frame(from + step_s / 2, 0.02, 3));
            halves = advanced(halves, adapting_eye(), frame(from + step_s, 0.02, 3));
            EXPECT_NEAR(*halves.adapted_cd_m2, *whole.adapted_cd_m2, 1e-12 * 50);
            EXPECT_NEAR(roll_about_sight_rad(*halves.vitreous), roll_about_sight_rad(*whole.vitreous), 1e-12);
        }
    }
}

// A head that starts to turn leaves the cloud behind by rate over drag, and the cloud comes to rest there.
TEST(EyeState, TheVitreousBodyLagsBehindATurningHead) {
    EyeModel eye = young_eye();
    eye.vitreous_drag_per_s = 4;
    EyeState state = advanced({}, eye, frame(0));
    for (int i = 1; i <= 600; ++i)
        state = advanced(state, eye, frame(i / 60.0, 1, 1));
    EXPECT_NEAR(roll_about_sight_rad(*state.vitreous), -1 / 4.0, 1e-9);
    for (int i = 601; i <= 1800; ++i)
        state = advanced(state, eye, frame(i / 60.0, 1, 0));
    EXPECT_NEAR(roll_about_sight_rad(*state.vitreous), 0, 1e-9);
}

}  // namespace
}  // namespace seaglare::glare
