// A host for tests of render(): a context without a display, a target of its own, a light or two.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "glare/device/gl_touched_state.h"
#include "tests/abi/loaded_plugin.h"
#include "tests/gl/gl_snapshot.h"

namespace seaglare::test {

inline constexpr int target_width_px = 96;
inline constexpr int target_height_px = 64;

// An RGBA8 texture with a framebuffer around it, filled with one colour.
struct Target {
    GLuint framebuffer = 0;
    GLuint texture = 0;
};

class PluginTest : public ::testing::TestWithParam<GlProfile> {
  protected:
    void SetUp() override {
        try {
            gl_context_ = std::make_unique<HeadlessContext>(HeadlessOptions{.profile = GetParam()});
        } catch (const std::exception& error) {
            GTEST_SKIP() << error.what();
        }
        make_view();
    }
    void TearDown() override {
        if (view_ == nullptr) return;
        EXPECT_EQ(plugin_->destroy_view(view_, 0), SEAGLARE_OK) << plugin_.last_error(context_);
    }

    const glare::Gl& gl() const { return gl_context_->gl(); }
    void make_view(std::uint32_t flags = 0, seaglare_get_proc_fn get_proc = &HeadlessContext::get_proc) {
        if (view_ != nullptr) {
            ASSERT_EQ(plugin_->destroy_view(view_, 0), SEAGLARE_OK);
        }
        auto info = sized<seaglare_view_info>();
        info.flags = flags;
        info.get_proc = get_proc;
        info.channel_name = "centre";
        ASSERT_EQ(plugin_->create_view(context_, &info, &view_), SEAGLARE_OK) << plugin_.last_error(context_);
    }
    seaglare_light_id add_light(double east_m, double north_m, double intensity_cd = 1000) {
        auto light = sized<seaglare_light>();
        light.position_m[0] = east_m;
        light.position_m[1] = north_m;
        light.position_m[2] = 10;
        light.intensity_cd = intensity_cd;
        seaglare_light_id id = 0;
        EXPECT_EQ(plugin_->add_light(context_, &light, &id), SEAGLARE_OK) << plugin_.last_error(context_);
        return id;
    }
    Target make_target() const {
        Target target;
        gl().GenTextures(1, &target.texture);
        gl().BindTexture(GL_TEXTURE_2D, target.texture);
        const std::vector<std::uint8_t> grey(target_width_px * target_height_px * 4, 30);
        gl().TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, target_width_px, target_height_px, 0, GL_RGBA,
                        GL_UNSIGNED_BYTE, grey.data());
        gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl().GenFramebuffers(1, &target.framebuffer);
        gl().BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
        gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.texture, 0);
        gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
        gl().BindTexture(GL_TEXTURE_2D, 0);
        return target;
    }
    // Reads with a plain state of its own and leaves it plain; the last thing a test does with a context.
    std::vector<std::uint8_t> pixels_of(const Target& target) const {
        glare::set_neutral_pixel_store(gl());
        if (gl().compatibility) {
            // Pixel transfer of a poisoned host would change what is read.
            const auto transfer = reinterpret_cast<void (*)(GLenum, GLfloat)>(
                HeadlessContext::get_proc(nullptr, "glPixelTransferf"));
            transfer(0x0D14, 1);
            transfer(0x0D1B, 0);
            transfer(0x0D10, 0);
        }
        gl().BindFramebuffer(GL_READ_FRAMEBUFFER, target.framebuffer);
        std::vector<std::uint8_t> pixels(target_width_px * target_height_px * 4);
        gl().ReadPixels(0, 0, target_width_px, target_height_px, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
        return pixels;
    }
    seaglare_frame frame_on(const Target& target) const {
        seaglare_frame frame = looking_north(target_width_px, target_height_px);
        frame.target_fbo = target.framebuffer;
        return frame;
    }

    LoadedPlugin plugin_;
    QuickContext context_{plugin_};
    std::unique_ptr<HeadlessContext> gl_context_;
    seaglare_view* view_ = nullptr;
};

inline std::string profile_name(const ::testing::TestParamInfo<GlProfile>& given) {
    return given.param == GlProfile::core ? "Core" : "Compatibility";
}
#define SEAGLARE_BOTH_PROFILES(suite)                                                                       \
    INSTANTIATE_TEST_SUITE_P(Profiles, suite, ::testing::Values(GlProfile::core, GlProfile::compatibility), \
                             profile_name)

}  // namespace seaglare::test
