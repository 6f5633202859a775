// Occlusion with smoothing in a host: its state is as it was, nothing is waited for, and without depth nothing is done.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "glare/device/gl_touched_state.h"
#include "tests/gl/counted_gl.h"
#include "tests/gl/plugin_fixture.h"

namespace {

using namespace seaglare;
using namespace seaglare::test;

class PluginOcclusion : public PluginTest {
  protected:
    GLuint make_depth(float value) const {
        GLuint texture = 0;
        gl().GenTextures(1, &texture);
        gl().BindTexture(GL_TEXTURE_2D, texture);
        const std::vector<float> depth(target_width_px * target_height_px, value);
        gl().TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, target_width_px, target_height_px, 0,
                        GL_DEPTH_COMPONENT, GL_FLOAT, depth.data());
        gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
        gl().BindTexture(GL_TEXTURE_2D, 0);
        return texture;
    }
    std::vector<float> hdr() {
        const auto* api = plugin_.extension<seaglare_hdr_api>("seaglare.hdr/1");
        std::vector<float> rgba(target_width_px * target_height_px * 4);
        std::int32_t size_px[2] = {0, 0};
        EXPECT_EQ(api->read(view_, rgba.data(), rgba.size(), size_px), SEAGLARE_OK);
        return rgba;
    }
    // Of the picture's brightest pixel, luminance's green.
    float peak() {
        float most = 0;
        const auto rgba = hdr();
        for (std::size_t i = 1; i < rgba.size(); i += 4)
            most = std::max(most, rgba[i]);
        return most;
    }
};

TEST_P(PluginOcclusion, LeavesTheStateAsItWasWhileALightFadesBehindAWall) {
    const Target target = make_target();
    const GLuint clear = make_depth(1);
    const GLuint wall = make_depth(0.5F);
    add_light(0, 1000);
    const PoisonedState poisoned(*gl_context_);
    const GlSnapshot before = take_snapshot(*gl_context_);
    seaglare_frame frame = frame_on(target);
    frame.depth_source = SEAGLARE_DEPTH_TEXTURE;
    for (int i = 0; i < 8; ++i) {
        frame.depth_object = i < 2 ? clear : wall;
        frame.time_s = i / 60.0;
        ASSERT_GE(plugin_->render(view_, &frame), 0) << plugin_.last_error(context_);
        ASSERT_EQ(differences(before, take_snapshot(*gl_context_)), "") << "frame " << i;
    }
    EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_P(PluginOcclusion, ALightFadesAsTheConfigurationSays) {
    const Target target = make_target();
    const GLuint clear = make_depth(1);
    const GLuint wall = make_depth(0.5F);
    add_light(0, 1000);
    const struct {
        const char* quality;
        double left;
    } cases[] = {{R"({"occlusion": {"smoothing_s": 0.5}})", std::exp(-0.1 / 0.5)},
                 {R"({"occlusion": {"smoothing_s": 0}})", 0},
                 {"{}", std::exp(-0.1 / 0.1)}};
    double start_s = 0;
    for (const auto& c : cases) {
        const TemporaryFile quality("quality.json", c.quality);
        ASSERT_GE(plugin_->load_config(context_, quality.path()), 0) << plugin_.last_error(context_);
        seaglare_frame frame = frame_on(target);
        frame.depth_source = SEAGLARE_DEPTH_TEXTURE;
        frame.depth_object = clear;
        start_s += 10;
        frame.time_s = start_s;
        ASSERT_GE(plugin_->render(view_, &frame), 0);
        frame.depth_object = wall;
        // The pattern moves with the eye: the light is compared with itself, free, at the same instant.
        frame.time_s = start_s + 0.1;
        ASSERT_GE(plugin_->render(view_, &frame), 0);
        const float faded = peak();
        frame.depth_source = SEAGLARE_DEPTH_NONE;
        ASSERT_GE(plugin_->render(view_, &frame), 0);
        EXPECT_NEAR(faded / peak(), c.left, 0.01) << c.quality;
    }
}

TEST_P(PluginOcclusion, WithoutDepthNothingIsDoneForIt) {
    if (!CountedGl::possible()) GTEST_SKIP() << "calls can be counted on x86-64 only";
    make_view(0, &CountedGl::get_proc);
    const Target target = make_target();
    const GLuint clear = make_depth(1);
    add_light(0, 1000);
    seaglare_frame frame = frame_on(target);
    const auto calls_of = [&](std::int32_t source, const char* name) {
        frame.depth_source = source;
        frame.depth_object = source == SEAGLARE_DEPTH_NONE ? 0 : clear;
        for (int i = 0; i < 2; ++i) {
            frame.time_s += 1.0 / 60;
            EXPECT_GE(plugin_->render(view_, &frame), 0) << plugin_.last_error(context_);
        }
        CountedGl::reset();
        frame.time_s += 1.0 / 60;
        EXPECT_GE(plugin_->render(view_, &frame), 0);
        return CountedGl::calls_of(name);
    };
    EXPECT_EQ(calls_of(SEAGLARE_DEPTH_TEXTURE, "glDrawArrays"),
              calls_of(SEAGLARE_DEPTH_NONE, "glDrawArrays") + 1)
        << "one draw looks at all lights";
    EXPECT_EQ(calls_of(SEAGLARE_DEPTH_TEXTURE, "glBufferSubData"),
              calls_of(SEAGLARE_DEPTH_NONE, "glBufferSubData") + 1)
        << "where each light was";
    for (const std::int32_t source : {SEAGLARE_DEPTH_NONE, SEAGLARE_DEPTH_TEXTURE}) {
        for (const char* name : {"glReadPixels", "glMapBufferRange", "glFenceSync", "glClientWaitSync",
                                 "glFinish", "glGetTexImage"}) {
            EXPECT_EQ(calls_of(source, name), 0U) << name << ", depth source " << source;
        }
    }
}

SEAGLARE_BOTH_PROFILES(PluginOcclusion);

}  // namespace
