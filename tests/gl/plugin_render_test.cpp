// render() as a host calls it: what is drawn, what is refused, and that a refusal touches nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <thread>

#include "glare/device/gl_touched_state.h"
#include "lightdb/json/value.h"
#include "tests/gl/counted_gl.h"
#include "tests/gl/plugin_fixture.h"

namespace {

using namespace seaglare;
using namespace seaglare::test;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

class PluginRender : public PluginTest {
  protected:
    seaglare_stats stats() const {
        auto stats = sized<seaglare_stats>();
        EXPECT_EQ(plugin_.extension<seaglare_stats_api>("seaglare.stats/1")->get_stats(view_, &stats),
                  SEAGLARE_OK);
        return stats;
    }
    std::string plan() const {
        const auto* api = plugin_.extension<seaglare_stats_api>("seaglare.stats/1");
        std::uint32_t size = 0;
        EXPECT_EQ(api->copy_plan(view_, nullptr, 0, &size), SEAGLARE_OK);
        std::string text(size, '\0');
        EXPECT_EQ(api->copy_plan(view_, text.data(), size, &size), SEAGLARE_OK);
        text.pop_back();
        return text;
    }
    // The frame is refused with the code, the text names the field, and no pixel changes.
    void expect_refused(const Target& target, const seaglare_frame& frame, seaglare_result code,
                        const std::string& names) {
        EXPECT_EQ(plugin_->render(view_, &frame), code) << names;
        EXPECT_NE(plugin_.last_error(context_).find(names), std::string::npos)
            << plugin_.last_error(context_);
        const auto pixels = pixels_of(target);
        EXPECT_TRUE(std::all_of(pixels.begin(), pixels.end(), [](std::uint8_t v) { return v == 30; }))
            << "the target was touched";
    }
};

TEST_P(PluginRender, ALightAheadBrightensThePictureAndSaysHow) {
    const Target target = make_target();
    add_light(0, 1000);
    const seaglare_frame frame = frame_on(target);
    ASSERT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED) << plugin_.last_error(context_);
    EXPECT_NE(plugin_.last_error(context_).find("made on the CPU"), std::string::npos);
    const auto pixels = pixels_of(target);
    EXPECT_TRUE(std::all_of(pixels.begin(), pixels.end(), [](std::uint8_t v) { return v >= 30; }))
        << "an add can only brighten";
    EXPECT_GT(*std::max_element(pixels.begin(), pixels.end()), 100);

    const seaglare_stats stats = this->stats();
    EXPECT_EQ(stats.degraded, 1U);
    EXPECT_EQ(stats.lights_total, 1U);
    EXPECT_EQ(stats.lights_drawn, 1U);
    EXPECT_GT(stats.draw_calls, 0U);
    EXPECT_GT(stats.device_memory_bytes, 0);
    EXPECT_EQ(stats.adaptation_luminance_cd_m2, 0.001);
    EXPECT_NEAR(stats.pupil_mm, 6.76, 0.5);  // Moon & Spencer 1944 at 0.001 cd/m2, and hippus
    EXPECT_GE(stats.render_ms, stats.evaluate_ms + stats.pattern_ms);
}

TEST_P(PluginRender, ThePlanIsJsonThatAccountsForEveryLight) {
    const Target target = make_target();
    add_light(0, 1000);
    add_light(0, -1000);    // behind
    add_light(0, 1000, 0);  // dark
    const seaglare_frame frame = frame_on(target);
    ASSERT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED) << plugin_.last_error(context_);
    const seaglare_stats stats = this->stats();
    EXPECT_EQ(stats.lights_total, stats.lights_drawn + stats.lights_dark + stats.lights_horizon +
                                      stats.lights_outside + stats.lights_below_threshold);
    const json::Document document = json::parse(plan(), "plan");
    EXPECT_EQ(document.root().find("channel")->string(), "centre");
    EXPECT_TRUE(document.root().find("drawn")->boolean());
    double left_out = 0;
    for (const json::Value& entry : document.root().find("left_out")->array()) {
        EXPECT_FALSE(entry.find("reason")->string().empty());
        if (entry.find("what")->string() == "light") left_out += entry.find("count")->number();
    }
    EXPECT_EQ(left_out, 2);
    EXPECT_GE(document.root().find("passes")->array().size(), 5U);
}

TEST_P(PluginRender, NothingVisibleMakesNoGlCall) {
    if (!CountedGl::possible()) GTEST_SKIP() << "calls are counted by machine code for x86-64";
    const Target target = make_target();
    const seaglare_light_id behind = add_light(0, -1000);
    CountedGl::reset();
    make_view(0, &CountedGl::get_proc);
    EXPECT_GT(CountedGl::calls(), 0U) << "making a view makes GL calls: nothing is counted";
    CountedGl::reset();
    const seaglare_frame frame = frame_on(target);
    EXPECT_EQ(plugin_->render(view_, &frame), SEAGLARE_NOTHING_TO_DRAW);
    EXPECT_EQ(CountedGl::calls(), 0U);
    seaglare_frame bad = frame;
    bad.time_s = nan;
    EXPECT_EQ(plugin_->render(view_, &bad), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(CountedGl::calls(), 0U) << "what is refused is refused before GL";
    add_light(0, 1000);
    EXPECT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED);
    EXPECT_GT(CountedGl::calls(), 0U);
    EXPECT_EQ(CountedGl::calls_of("glFinish"), 0U) << "render must not stall the pipeline";
    EXPECT_EQ(CountedGl::calls_of("glReadPixels"), 0U);
    EXPECT_EQ(CountedGl::calls_of("glGetError"), 0U) << "it would eat the host's errors";
    EXPECT_EQ(plugin_->remove_light(context_, behind), SEAGLARE_OK);
    CountedGl::reset();
    EXPECT_EQ(plugin_->destroy_view(view_, 1), SEAGLARE_OK);
    EXPECT_EQ(CountedGl::calls(), 0U) << "a lost context takes no calls";
    view_ = nullptr;
}

TEST_P(PluginRender, EveryDoubleOfTheFrameIsChecked) {
    const Target target = make_target();
    add_light(0, 1000);
    const seaglare_frame good = frame_on(target);
    struct Named {
        const char* name;
        std::size_t offset;
        int count;
    };
    const Named fields[] = {
        {"depth_log_c", offsetof(seaglare_frame, depth_log_c), 1},
        {"depth_log_far_m", offsetof(seaglare_frame, depth_log_far_m), 1},
        {"view_from_world", offsetof(seaglare_frame, view_from_world), 16},
        {"clip_from_view", offsetof(seaglare_frame, clip_from_view), 16},
        {"time_s", offsetof(seaglare_frame, time_s), 1},
        {"frame_interval_s", offsetof(seaglare_frame, frame_interval_s), 1},
        {"adaptation_luminance_cd_m2", offsetof(seaglare_frame, adaptation_luminance_cd_m2), 1},
        {"local_time_of_day_h", offsetof(seaglare_frame, local_time_of_day_h), 1},
        {"ldr_white_luminance_cd_m2", offsetof(seaglare_frame, ldr_white_luminance_cd_m2), 1},
        {"meteorological_visibility_m", offsetof(seaglare_frame, meteorological_visibility_m), 1},
    };
    int doubles = 0;
    for (const Named& field : fields) {
        for (int i = 0; i < field.count; ++i) {
            ++doubles;
            for (const double bad : {nan, infinity, -infinity}) {
                seaglare_frame frame = good;
                std::memcpy(reinterpret_cast<char*>(&frame) + field.offset + 8 * static_cast<std::size_t>(i),
                            &bad, 8);
                const std::string name = std::string("frame.") + field.name +
                                         (field.count > 1 ? "[" + std::to_string(i) + "]" : "");
                ASSERT_EQ(plugin_->render(view_, &frame), SEAGLARE_ERROR_INVALID_ARGUMENT) << name;
                ASSERT_EQ(plugin_.last_error(context_).rfind(name + " is", 0), 0U)
                    << plugin_.last_error(context_);
            }
        }
    }
    EXPECT_EQ(doubles, 40) << "the frame has another number of doubles than this test knows";
    expect_refused(
        target,
        [&] {
            auto f = good;
            f.time_s = nan;
            return f;
        }(),
        SEAGLARE_ERROR_INVALID_ARGUMENT, "time_s");
}

TEST_P(PluginRender, AFrameThatMakesNoSenseIsRefusedByName) {
    const Target target = make_target();
    add_light(0, 1000);
    const auto refuse = [&](auto change, const char* names) {
        seaglare_frame frame = frame_on(target);
        change(frame);
        expect_refused(target, frame, SEAGLARE_ERROR_INVALID_ARGUMENT, names);
    };
    refuse([](auto& f) { f.viewport_px[2] = 0; }, "frame.viewport_px[2]");
    refuse([](auto& f) { f.viewport_px[3] = -1; }, "frame.viewport_px[3]");
    refuse([](auto& f) { f.viewport_px[2] = 16385; }, "frame.viewport_px[2]");
    refuse([](auto& f) { f.viewport_px[0] = std::numeric_limits<std::int32_t>::max(); },
           "frame.viewport_px[0]");
    refuse([](auto& f) { f.target_encoding = 3; }, "frame.target_encoding");
    refuse([](auto& f) { f.depth_source = 4; }, "frame.depth_source");
    refuse([](auto& f) { f.depth_source = SEAGLARE_DEPTH_TEXTURE; }, "frame.depth_object");
    refuse([](auto& f) { f.depth_convention = -1; }, "frame.depth_convention");
    refuse(
        [](auto& f) {
            f.depth_source = SEAGLARE_DEPTH_FBO;
            f.depth_convention = SEAGLARE_DEPTH_LOGARITHMIC;
        },
        "frame.depth_log_c");
    refuse([](auto& f) { f.flags |= 1U << 30; }, "frame.flags");
    refuse([](auto& f) { f.reserved = 1; }, "frame.reserved");
    refuse([](auto& f) { f.frame_interval_s = -0.01; }, "frame.frame_interval_s");
    refuse([](auto& f) { f.adaptation_luminance_cd_m2 = -1; }, "frame.adaptation_luminance_cd_m2");
    refuse([](auto& f) { f.view_from_world[0] = 2; }, "frame.view_from_world");
    refuse([](auto& f) { f.view_from_world[3] = 1; }, "frame.view_from_world[3]");
    refuse([](auto& f) { std::fill_n(f.clip_from_view, 16, 0.0); }, "clip_from_view");
    refuse(
        [](auto& f) {
            f.flags |= SEAGLARE_FRAME_HAS_FOG;
            f.meteorological_visibility_m = 0;
        },
        "frame.meteorological_visibility_m");
    seaglare_frame frame = frame_on(target);
    frame.struct_size = 0;
    expect_refused(target, frame, SEAGLARE_ERROR_STRUCT_SIZE, "frame.struct_size is 0");
}

TEST_P(PluginRender, ALeftHandedViewIsTaken) {
    const Target right = make_target();
    const Target left = make_target();
    add_light(30, 1000);
    seaglare_frame frame = frame_on(right);
    ASSERT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED) << plugin_.last_error(context_);
    // The same camera with z forward: the third row of the view and the third column of the projection change sign.
    frame.target_fbo = left.framebuffer;
    for (int column = 0; column < 4; ++column)
        frame.view_from_world[4 * column + 2] *= -1;
    for (int row = 0; row < 4; ++row)
        frame.clip_from_view[8 + row] *= -1;
    ASSERT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED) << plugin_.last_error(context_);
    const auto expected = pixels_of(right);
    EXPECT_EQ(pixels_of(left), expected);
}

struct Asked {
    std::uint32_t calls = 0;
    std::uint32_t count = 0;
    seaglare_light_id id = 0;
    double position_m[3] = {};
    float answer = 0;
};
void SEAGLARE_CALL answer(void* user, seaglare_visibility_query* queries, std::uint32_t count) {
    auto* asked = static_cast<Asked*>(user);
    ++asked->calls;
    asked->count = count;
    asked->id = queries[0].id;
    std::copy_n(queries[0].position_m, 3, asked->position_m);
    for (std::uint32_t i = 0; i < count; ++i)
        queries[i].visibility = asked->answer;
}

TEST_P(PluginRender, TheHostIsAskedOnceAndOnlyAboutLightsThatMatter) {
    const Target target = make_target();
    add_light(0, -1000);
    const seaglare_light_id ahead = add_light(5, 1000);
    add_light(0, 1000, 0);
    Asked asked;
    seaglare_frame frame = frame_on(target);
    frame.visibility = &answer;
    frame.visibility_user = &asked;
    EXPECT_EQ(plugin_->render(view_, &frame), SEAGLARE_NOTHING_TO_DRAW) << plugin_.last_error(context_);
    EXPECT_EQ(asked.calls, 1U);
    EXPECT_EQ(asked.count, 1U);
    EXPECT_EQ(asked.id, ahead);
    EXPECT_NEAR(asked.position_m[0], 5, 1e-9);
    EXPECT_NEAR(asked.position_m[1], 1000, 1e-9);
    EXPECT_NEAR(asked.position_m[2], 10, 1e-9);
    // After a jump in time an answer counts at once; in between it is smoothed.
    asked.answer = 1;
    frame.time_s += 2;
    EXPECT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED);
    asked.answer = std::numeric_limits<float>::quiet_NaN();
    frame.time_s += 2;
    EXPECT_EQ(plugin_->render(view_, &frame), SEAGLARE_NOTHING_TO_DRAW) << "NaN is no visibility";
}

TEST_P(PluginRender, TwoViewsOfOneContextDrawTheSame) {
    const Target first = make_target();
    const Target second = make_target();
    add_light(0, 1000);
    auto info = sized<seaglare_view_info>();
    info.get_proc = &HeadlessContext::get_proc;
    seaglare_view* other = nullptr;
    ASSERT_EQ(plugin_->create_view(context_, &info, &other), SEAGLARE_OK);
    seaglare_frame frame = frame_on(first);
    ASSERT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED) << plugin_.last_error(context_);
    EXPECT_GE(stats().pattern_size, 1U);
    frame.target_fbo = second.framebuffer;
    ASSERT_EQ(plugin_->render(other, &frame), SEAGLARE_DEGRADED) << plugin_.last_error(context_);
    const auto expected = pixels_of(first);
    EXPECT_EQ(pixels_of(second), expected);
    EXPECT_EQ(plugin_->destroy(context_), SEAGLARE_ERROR_BUSY) << "views still exist";
    EXPECT_EQ(plugin_->destroy_view(other, 0), SEAGLARE_OK);
}

TEST_P(PluginRender, AViewInUseOnAnotherThreadIsBusy) {
    const Target target = make_target();
    add_light(0, 1000);
    struct Host {
        const LoadedPlugin& plugin;
        seaglare_view* view;
        seaglare_frame frame;
        seaglare_result other = SEAGLARE_OK;
        seaglare_result destroyed = SEAGLARE_OK;
    } host{plugin_, view_, frame_on(target)};
    seaglare_frame frame = host.frame;
    frame.visibility_user = &host;
    // While render() waits in the callback, another thread comes.
    frame.visibility = [](void* user, seaglare_visibility_query*, std::uint32_t) {
        auto* self = static_cast<Host*>(user);
        std::thread([self] {
            self->other = self->plugin->render(self->view, &self->frame);
            self->destroyed = self->plugin->destroy_view(self->view, 0);
        }).join();
    };
    EXPECT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED) << plugin_.last_error(context_);
    EXPECT_EQ(host.other, SEAGLARE_ERROR_BUSY);
    EXPECT_EQ(host.destroyed, SEAGLARE_ERROR_BUSY);
}

TEST_P(PluginRender, AnotherThreadMayChangeLightsWhileTheHostAnswers) {
    const Target target = make_target();
    const seaglare_light_id id = add_light(0, 1000);
    struct Host {
        const LoadedPlugin& plugin;
        seaglare_context* context;
        seaglare_light_id id;
        seaglare_result removed = SEAGLARE_ERROR_INTERNAL;
    } host{plugin_, context_, id};
    seaglare_frame frame = frame_on(target);
    frame.visibility_user = &host;
    frame.visibility = [](void* user, seaglare_visibility_query*, std::uint32_t) {
        auto* self = static_cast<Host*>(user);
        std::thread([self] { self->removed = self->plugin->remove_light(self->context, self->id); }).join();
    };
    EXPECT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED) << "the frame had begun with the light";
    EXPECT_EQ(host.removed, SEAGLARE_OK);
    frame.visibility = nullptr;
    EXPECT_EQ(plugin_->render(view_, &frame), SEAGLARE_NOTHING_TO_DRAW);
}

TEST_P(PluginRender, ALostContextsViewIsDestroyedWithoutGl) {
    add_light(0, 1000);
    gl_context_->release();
    EXPECT_EQ(plugin_->destroy_view(view_, 1), SEAGLARE_OK);
    view_ = nullptr;
    gl_context_->make_current();
}

TEST_P(PluginRender, AHostThatCannotNameAGlFunctionIsToldWhich) {
    auto info = sized<seaglare_view_info>();
    info.get_proc = [](void*, const char* name) -> void* {
        return std::strcmp(name, "glBlendFunc") == 0 ? nullptr : HeadlessContext::get_proc(nullptr, name);
    };
    seaglare_view* other = nullptr;
    EXPECT_EQ(plugin_->create_view(context_, &info, &other), SEAGLARE_ERROR_GL);
    EXPECT_EQ(other, nullptr);
    EXPECT_NE(plugin_.last_error(context_).find("glBlendFunc"), std::string::npos)
        << plugin_.last_error(context_);
}

TEST_P(PluginRender, TheTimeOfDayGivesTheAdaptationWhenNothingElseDoes) {
    const Target target = make_target();
    add_light(0, 1000);
    seaglare_frame frame = frame_on(target);
    frame.flags = SEAGLARE_FRAME_HAS_TIME_OF_DAY;
    frame.local_time_of_day_h = 12;
    plugin_->render(view_, &frame);
    EXPECT_NEAR(stats().adaptation_luminance_cd_m2, 8000, 1e-6);  // config/quality/default.json
    frame.flags = 0;
    plugin_->render(view_, &frame);
    EXPECT_NEAR(stats().adaptation_luminance_cd_m2, 0.001, 1e-9);
    auto state = sized<seaglare_eye_state>();
    state.adaptation_luminance_cd_m2 = 3;
    ASSERT_EQ(plugin_->set_eye_state(context_, &state), SEAGLARE_OK);
    plugin_->render(view_, &frame);
    EXPECT_EQ(stats().adaptation_luminance_cd_m2, 3);
}

TEST_P(PluginRender, TheHdrReaderTellsItsSizeWithoutAnError) {
    const Target target = make_target();
    add_light(0, 1000);
    const seaglare_frame frame = frame_on(target);
    ASSERT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED) << plugin_.last_error(context_);
    const std::string before = plugin_.last_error(context_);
    const auto* hdr = plugin_.extension<seaglare_hdr_api>("seaglare.hdr/1");
    std::int32_t size_px[2] = {0, 0};
    EXPECT_EQ(hdr->read(view_, nullptr, 0, size_px), SEAGLARE_OK);
    EXPECT_EQ(size_px[0], target_width_px);
    EXPECT_EQ(size_px[1], target_height_px);
    EXPECT_EQ(plugin_.last_error(context_), before);
    std::vector<float> rgba(target_width_px * target_height_px * 4);
    size_px[0] = size_px[1] = 0;
    EXPECT_EQ(hdr->read(view_, rgba.data(), rgba.size() - 1, size_px), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(size_px[0], target_width_px);
    EXPECT_EQ(hdr->read(view_, nullptr, rgba.size(), size_px), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(hdr->read(view_, nullptr, 0, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
}

// Six degrees beside the picture glare at its true angles is too faint to see, and magnified 18 times it is not.
TEST_P(PluginRender, AMagnifiedPatternReachesInFromFurtherOutside) {
    const Target target = make_target();
    const double half_width_rad =
        std::atan(std::tan(22.5 * std::numbers::pi / 180) * target_width_px / target_height_px);
    const double azimuth_rad = half_width_rad + 6 * std::numbers::pi / 180;
    add_light(1000 * std::sin(azimuth_rad), 1000 * std::cos(azimuth_rad), 10);
    const seaglare_frame frame = frame_on(target);
    EXPECT_EQ(plugin_->render(view_, &frame), SEAGLARE_NOTHING_TO_DRAW);
    EXPECT_EQ(stats().lights_outside, 1U);
    const TemporaryFile magnified("magnified.json", R"({"pattern": {"transform_size": 512, "wavelengths": 5,
        "angular_scale": 18, "max_radius_nodes": 24, "layer_radii_px": [0, 3]}})");
    ASSERT_EQ(plugin_->load_config(context_, magnified.path()), SEAGLARE_DEGRADED);
    EXPECT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED);
    EXPECT_EQ(stats().lights_drawn, 1U);
}

// Views keep a copy of the pattern: a new configuration's must not be taken for the old one.
TEST_P(PluginRender, ANewConfigurationShowsInTheNextFrame) {
    const Target before = make_target();
    const Target after = make_target();
    const Target fresh = make_target();
    add_light(0, 1000, 1e5);
    seaglare_frame frame = frame_on(before);
    ASSERT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED);
    const TemporaryFile magnified("magnified.json", R"({"pattern": {"transform_size": 256, "wavelengths": 5,
        "angular_scale": 18, "max_radius_nodes": 24, "layer_radii_px": [0, 3]}})");
    ASSERT_EQ(plugin_->load_config(context_, magnified.path()), SEAGLARE_DEGRADED);
    auto info = sized<seaglare_view_info>();
    info.get_proc = &HeadlessContext::get_proc;
    // Making a view makes a pattern: the new source has now made as many as the old one had.
    seaglare_view* other = nullptr;
    ASSERT_EQ(plugin_->create_view(context_, &info, &other), SEAGLARE_OK);
    frame.target_fbo = after.framebuffer;
    ASSERT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED);
    frame.target_fbo = fresh.framebuffer;
    ASSERT_EQ(plugin_->render(other, &frame), SEAGLARE_DEGRADED);
    const auto expected = pixels_of(fresh);
    EXPECT_NE(pixels_of(before), expected);
    EXPECT_EQ(pixels_of(after), expected);
    EXPECT_EQ(plugin_->destroy_view(other, 0), SEAGLARE_OK);
}

SEAGLARE_BOTH_PROFILES(PluginRender);

}  // namespace
