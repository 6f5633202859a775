// What accumulates in the eye, through the C interface and from frame to frame of a context.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>

#include "plugin_api/context.h"
#include "plugin_api/failure.h"
#include "plugin_api/validate.h"
#include "tests/abi/loaded_plugin.h"

namespace {

// Every bit: the struct has no padding but what it names.
auto bytes_of(const seaglare_eye_state& state) {
    return std::bit_cast<std::array<unsigned char, sizeof(state)>>(state);
}

using namespace seaglare;

// A context as the library has it, without a view: what a frame makes of the eye does not need one.
class EyeStateOfContext : public ::testing::Test {
  protected:
    static std::unique_ptr<plugin::Context> make(const std::string& eye = R"({"adapts": true})") {
        const test::TemporaryFile quality("eye_state.json",
                                          R"({"pattern": {"transform_size": 256}, "eye": )" + eye + "}");
        auto info = test::sized<seaglare_create_info>();
        info.flags = SEAGLARE_CREATE_NO_OPENCL;
        info.seed = 5;
        const std::string path = quality.path();
        info.config_path = path.c_str();
        return std::make_unique<plugin::Context>(info);
    }

    static plugin::FrameState draw(plugin::Context& context, double time_s, double luminance_cd_m2,
                                   double head_rad_s) {
        auto frame = test::sized<seaglare_frame>();
        frame.flags = SEAGLARE_FRAME_HAS_ADAPTATION | SEAGLARE_FRAME_HAS_HEAD_RATE;
        frame.adaptation_luminance_cd_m2 = luminance_cd_m2;
        frame.head_rate_rad_s[2] = head_rad_s;
        frame.head_rate_rad_s[0] = 0.3 * head_rad_s;
        frame.time_s = time_s;
        frame.viewport_px[2] = 64;
        frame.viewport_px[3] = 64;
        for (int i = 0; i < 16; i += 5)
            frame.view_from_world[i] = 1;
        frame.clip_from_view[0] = frame.clip_from_view[5] = 1;
        frame.clip_from_view[10] = frame.clip_from_view[11] = -1;
        frame.clip_from_view[14] = -0.2;
        glare::Frame picture;
        picture.viewport_px = {0, 0, 64, 64};
        std::copy_n(frame.clip_from_view, 16, picture.clip_from_view.begin());
        lightdb::Evaluated evaluated;
        return context.evaluate(frame, picture, 0, evaluated);
    }

    static void expect_same(const plugin::FrameState& a, const plugin::FrameState& b) {
        EXPECT_EQ(a.adaptation_luminance_cd_m2, b.adaptation_luminance_cd_m2);
        EXPECT_EQ(a.pupil_mm, b.pupil_mm);
        EXPECT_EQ(a.lids, b.lids);
        EXPECT_EQ(a.vitreous_roll_rad, b.vitreous_roll_rad);
    }
};

constexpr const char* living_eye = R"({"adapts": true, "lids": {"blink_interval_s": 3, "squint": 0.5}})";

// One simulator is started while another has run for months: after one state the two draw the same.
TEST_F(EyeStateOfContext, ATwinThatIsGivenTheStateGoesOnToTheLastBit) {
    const auto first = make(living_eye);
    const auto twin = make(living_eye);
    constexpr double late_s = 1e7;
    for (int i = 0; i < 50; ++i)
        draw(*first, late_s + i / 60.0, i < 25 ? 2000 : 0.01, std::sin(0.3 * i));
    const seaglare_eye_state state = first->eye_state();
    EXPECT_NE(state.vitreous_spin_rad_s[2], 0);
    EXPECT_GT(state.adapted_luminance_cd_m2, 0.1);
    EXPECT_NO_THROW(plugin::check(state));
    twin->set_eye_state(state);
    for (int i = 50; i < 120; ++i) {
        const double rate = std::sin(0.3 * i);
        expect_same(draw(*first, late_s + i / 60.0, 0.01, rate), draw(*twin, late_s + i / 60.0, 0.01, rate));
    }
    const seaglare_eye_state a = first->eye_state();
    const seaglare_eye_state b = twin->eye_state();
    EXPECT_EQ(bytes_of(a), bytes_of(b));
}

TEST_F(EyeStateOfContext, SeveralViewsOfOneInstantMakeOneStep) {
    const auto one = make(living_eye);
    const auto five = make(living_eye);
    for (int i = 0; i < 30; ++i) {
        const auto alone = draw(*one, i / 30.0, 10 + i, 1);
        for (int view = 0; view < 5; ++view)
            expect_same(draw(*five, i / 30.0, 10 + i, 1), alone);
    }
}

TEST_F(EyeStateOfContext, AnEyeThatDoesNotAdaptIsAtOnceWhatTheFrameSays) {
    const auto context = make("{}");
    EXPECT_EQ(draw(*context, 0, 1000, 0).adaptation_luminance_cd_m2, 1000);
    EXPECT_EQ(draw(*context, 0.001, 0.01, 0).adaptation_luminance_cd_m2, 0.01);
    const auto slow = make();
    draw(*slow, 0, 1000, 0);
    const double soon = draw(*slow, 0.05, 0.01, 0).adaptation_luminance_cd_m2;
    EXPECT_GT(soon, 100);
    EXPECT_LT(soon, 1000);
    EXPECT_EQ(slow->eye_state().adaptation_luminance_cd_m2, 0.01) << "where it is going";
}

// A day of light that comes and goes, with hitches, time that runs back, and rates at their limits.
TEST_F(EyeStateOfContext, StaysFiniteThroughAnything) {
    const auto context = make(living_eye);
    double time_s = 0;
    const double steps_s[] = {0, 1e-9, 1.0 / 240, 1.0 / 60, 1, 10, -5, 1e7};
    for (int i = 0; i < 200; ++i) {
        time_s += steps_s[static_cast<std::size_t>(i) % 8];
        const auto state =
            draw(*context, time_s, i % 3 == 0 ? 0 : (i % 3 == 1 ? 1e6 : 1e-3), i % 2 == 0 ? 1000 : -1000);
        ASSERT_TRUE(std::isfinite(state.vitreous_roll_rad));
        ASSERT_GE(state.adaptation_luminance_cd_m2, 0);
        ASSERT_LE(state.adaptation_luminance_cd_m2, 1e6);
        EXPECT_NO_THROW(plugin::check(context->eye_state())) << i;
    }
}

// ---- the structs --------------------------------------------------------------------------------------------------

class EyeStateArguments : public ::testing::Test {
  protected:
    void SetUp() override {
        auto info = test::sized<seaglare_create_info>();
        info.flags = SEAGLARE_CREATE_NO_OPENCL;
        ASSERT_GE(plugin_->create(&info, &context_), 0);
    }
    void TearDown() override { EXPECT_EQ(plugin_->destroy(context_), SEAGLARE_OK); }
    seaglare_eye_state whole_state() const {
        auto state = test::sized<seaglare_eye_state>();
        state.flags = SEAGLARE_EYE_HAS_ADAPTED | SEAGLARE_EYE_HAS_VITREOUS;
        state.time_s = 77;
        state.adaptation_luminance_cd_m2 = 3;
        state.adapted_luminance_cd_m2 = 2;
        state.vitreous_orientation[0] = 0.6;
        state.vitreous_orientation[3] = 0.8;
        state.vitreous_spin_rad_s[1] = -4;
        state.head_rate_rad_s[2] = 5;
        return state;
    }

    test::LoadedPlugin plugin_;
    seaglare_context* context_ = nullptr;
};

TEST_F(EyeStateArguments, EveryFieldComesBackAsItWasSet) {
    const seaglare_eye_state state = whole_state();
    ASSERT_EQ(plugin_->set_eye_state(context_, &state), SEAGLARE_OK);
    auto read = test::sized<seaglare_eye_state>();
    ASSERT_EQ(plugin_->get_eye_state(context_, &read), SEAGLARE_OK);
    EXPECT_EQ(bytes_of(read), bytes_of(state));
}

TEST_F(EyeStateArguments, WhatTheFlagsDoNotNameStays) {
    seaglare_eye_state state = whole_state();
    ASSERT_EQ(plugin_->set_eye_state(context_, &state), SEAGLARE_OK);
    state.flags = 0;
    state.adapted_luminance_cd_m2 = 9;
    state.vitreous_spin_rad_s[1] = 0;
    ASSERT_EQ(plugin_->set_eye_state(context_, &state), SEAGLARE_OK);
    auto read = test::sized<seaglare_eye_state>();
    ASSERT_EQ(plugin_->get_eye_state(context_, &read), SEAGLARE_OK);
    EXPECT_EQ(read.adapted_luminance_cd_m2, 2);
    EXPECT_EQ(read.vitreous_spin_rad_s[1], -4);
}

TEST_F(EyeStateArguments, AnOlderCallerCanHandItsFlagsBack) {
    const seaglare_eye_state state = whole_state();
    ASSERT_EQ(plugin_->set_eye_state(context_, &state), SEAGLARE_OK);
    for (const std::size_t size :
         {offsetof(seaglare_eye_state, is_day), offsetof(seaglare_eye_state, adapted_luminance_cd_m2),
          offsetof(seaglare_eye_state, vitreous_orientation)}) {
        seaglare_eye_state older{};
        older.struct_size = static_cast<std::uint32_t>(size);
        ASSERT_EQ(plugin_->get_eye_state(context_, &older), SEAGLARE_OK);
        EXPECT_EQ(plugin_->set_eye_state(context_, &older), SEAGLARE_OK) << size;
        older.flags |= SEAGLARE_EYE_HAS_VITREOUS;
        EXPECT_EQ(plugin_->set_eye_state(context_, &older), SEAGLARE_ERROR_INVALID_ARGUMENT) << size;
    }
    auto read = test::sized<seaglare_eye_state>();
    ASSERT_EQ(plugin_->get_eye_state(context_, &read), SEAGLARE_OK);
    EXPECT_EQ(read.vitreous_spin_rad_s[1], -4);
}

TEST_F(EyeStateArguments, WhatCannotBeIsRefused) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refused = [this](auto&& change) {
        seaglare_eye_state state = whole_state();
        change(state);
        return plugin_->set_eye_state(context_, &state) == SEAGLARE_ERROR_INVALID_ARGUMENT;
    };
    EXPECT_TRUE(refused([&](auto& s) { s.adapted_luminance_cd_m2 = nan; }));
    EXPECT_TRUE(refused([](auto& s) { s.adapted_luminance_cd_m2 = -1; }));
    EXPECT_TRUE(refused([](auto& s) { s.vitreous_orientation[0] = s.vitreous_orientation[3] = 0; }));
    EXPECT_TRUE(refused([&](auto& s) { s.vitreous_orientation[1] = nan; }));
    EXPECT_TRUE(refused([&](auto& s) { s.vitreous_spin_rad_s[0] = nan; }));
    EXPECT_TRUE(refused([](auto& s) { s.head_rate_rad_s[2] = 2000; }));
    EXPECT_FALSE(refused([](auto&) {}));
}

TEST_F(EyeStateArguments, AFramesHeadRateIsChecked) {
    auto frame = test::sized<seaglare_frame>();
    frame.viewport_px[2] = frame.viewport_px[3] = 8;
    for (int i = 0; i < 16; i += 5)
        frame.view_from_world[i] = frame.clip_from_view[i] = 1;
    frame.flags = SEAGLARE_FRAME_HAS_HEAD_RATE;
    EXPECT_NO_THROW(plugin::check(frame));
    frame.head_rate_rad_s[1] = 1001;
    EXPECT_THROW(plugin::check(frame), plugin::Failure);
    frame.head_rate_rad_s[1] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(plugin::check(frame), plugin::Failure);
    frame.head_rate_rad_s[1] = 0;
    frame.struct_size = offsetof(seaglare_frame, head_rate_rad_s);
    EXPECT_THROW(plugin::check(frame), plugin::Failure) << "the flag of a field that an older caller has not";
}

}  // namespace
