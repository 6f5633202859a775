// A host whose GL state is odd in every slot: it finds it again after every call, and its picture is as if it were not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "glare/device/gl_touched_state.h"
#include "tests/gl/plugin_fixture.h"

namespace {

using namespace seaglare;
using namespace seaglare::test;

class PluginState : public PluginTest {};

TEST_P(PluginState, IsUnchangedByRender) {
    const Target target = make_target();
    add_light(0, 1000);
    const PoisonedState poisoned(*gl_context_);
    const GlSnapshot before = take_snapshot(*gl_context_);
    ASSERT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
    const seaglare_frame frame = frame_on(target);
    for (int i = 0; i < 3; ++i) {
        ASSERT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED) << plugin_.last_error(context_);
        ASSERT_EQ(differences(before, take_snapshot(*gl_context_)), "") << "frame " << i;
    }
    EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_P(PluginState, IsUnchangedByMakingReadingAndDestroyingAView) {
    const Target target = make_target();
    add_light(0, 1000);
    const PoisonedState poisoned(*gl_context_);
    const GlSnapshot before = take_snapshot(*gl_context_);
    make_view();
    EXPECT_EQ(differences(before, take_snapshot(*gl_context_)), "") << "after create_view";
    const seaglare_frame frame = frame_on(target);
    ASSERT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED) << plugin_.last_error(context_);
    const auto* hdr = plugin_.extension<seaglare_hdr_api>("seaglare.hdr/1");
    std::vector<float> rgba(target_width_px * target_height_px * 4);
    std::int32_t size_px[2] = {0, 0};
    ASSERT_EQ(hdr->read(view_, rgba.data(), rgba.size(), size_px), SEAGLARE_OK)
        << plugin_.last_error(context_);
    EXPECT_EQ(size_px[0], target_width_px);
    EXPECT_EQ(size_px[1], target_height_px);
    EXPECT_GT(*std::max_element(rgba.begin(), rgba.end()), 0);
    EXPECT_EQ(differences(before, take_snapshot(*gl_context_)), "") << "after reading";
    ASSERT_EQ(plugin_->destroy_view(view_, 0), SEAGLARE_OK);
    view_ = nullptr;
    EXPECT_EQ(differences(before, take_snapshot(*gl_context_)), "") << "after destroy_view";
    EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_P(PluginState, IsUnchangedWhenRenderFails) {
    add_light(0, 1000);
    Target incomplete;
    gl().GenFramebuffers(1, &incomplete.framebuffer);
    gl().BindFramebuffer(GL_FRAMEBUFFER, incomplete.framebuffer);  // exists, but has nothing to draw to
    const PoisonedState poisoned(*gl_context_);
    const GlSnapshot before = take_snapshot(*gl_context_);
    const seaglare_frame frame = frame_on(incomplete);
    EXPECT_EQ(plugin_->render(view_, &frame), SEAGLARE_ERROR_GL);
    EXPECT_NE(plugin_.last_error(context_).find("target_fbo"), std::string::npos)
        << plugin_.last_error(context_);
    EXPECT_EQ(differences(before, take_snapshot(*gl_context_)), "");
    EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR)) << "a host's error check must not see ours";
}

TEST_P(PluginState, AnErrorTheHostHasNotFetchedYetIsStillThere) {
    const Target target = make_target();
    add_light(0, 1000);
    gl().Enable(0xDEAD);
    const seaglare_frame frame = frame_on(target);
    ASSERT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED) << plugin_.last_error(context_);
    EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_INVALID_ENUM));
    EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_P(PluginState, ThePictureFromAPoisonedStateEqualsThatFromACleanOne) {
    const Target clean = make_target();
    const Target odd = make_target();
    add_light(0, 1000);
    add_light(60, 900, 200);
    seaglare_frame frame = frame_on(clean);
    ASSERT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED) << plugin_.last_error(context_);
    const PoisonedState poisoned(*gl_context_);
    frame.target_fbo = odd.framebuffer;
    ASSERT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED) << plugin_.last_error(context_);
    const auto expected = pixels_of(clean);
    EXPECT_GT(*std::max_element(expected.begin(), expected.end()), 100) << "nothing bright was drawn";
    EXPECT_EQ(pixels_of(odd), expected);
}

TEST_P(PluginState, AViewMadeInAPoisonedStateDrawsTheSame) {
    const Target clean = make_target();
    const Target odd = make_target();
    add_light(0, 1000);
    seaglare_frame frame = frame_on(clean);
    ASSERT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED) << plugin_.last_error(context_);
    const PoisonedState poisoned(*gl_context_);
    make_view();
    frame.target_fbo = odd.framebuffer;
    ASSERT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED) << plugin_.last_error(context_);
    const auto expected = pixels_of(clean);
    EXPECT_EQ(pixels_of(odd), expected);
}

TEST_P(PluginState, AHostThatRestoresItsOwnStateGetsTheSamePicture) {
    const Target saved = make_target();
    const Target unsaved = make_target();
    add_light(0, 1000);
    seaglare_frame frame = frame_on(saved);
    ASSERT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED);
    make_view(SEAGLARE_VIEW_HOST_RESTORES_STATE);
    frame.target_fbo = unsaved.framebuffer;
    ASSERT_EQ(plugin_->render(view_, &frame), SEAGLARE_DEGRADED) << plugin_.last_error(context_);
    const auto expected = pixels_of(saved);
    EXPECT_EQ(pixels_of(unsaved), expected);
}

SEAGLARE_BOTH_PROFILES(PluginState);

}  // namespace
