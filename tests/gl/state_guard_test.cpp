// The GL state guard alone: whatever happens inside it, every state has its entry value again.
#include "plugin_api/gl_state_guard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>

#include "glare/device/gl_touched_state.h"
#include "tests/gl/gl_snapshot.h"

namespace {

using namespace seaglare;
using namespace seaglare::test;

class StateGuard : public ::testing::TestWithParam<GlProfile> {
  protected:
    void SetUp() override {
        try {
            context_ = std::make_unique<HeadlessContext>(HeadlessOptions{.profile = GetParam()});
        } catch (const std::exception& error) {
            GTEST_SKIP() << error.what();
        }
        caps_ = plugin::gl_state_caps(context_->gl(), &HeadlessContext::get_proc, nullptr);
    }
    // What a renderer does: binds, enables, draws nothing.
    void make_a_mess() const {
        const glare::Gl& gl = context_->gl();
        glare::set_neutral_state(gl);
        GLuint texture = 0, framebuffer = 0, vertex_array = 0, buffer = 0;
        gl.GenTextures(1, &texture);
        gl.GenFramebuffers(1, &framebuffer);
        gl.GenVertexArrays(1, &vertex_array);
        gl.GenBuffers(1, &buffer);
        for (GLuint unit = 0; unit < plugin::guarded_texture_units; ++unit) {
            gl.ActiveTexture(GL_TEXTURE0 + unit);
            gl.BindTexture(GL_TEXTURE_2D, texture);
            gl.BindSampler(unit, 0);
        }
        gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        gl.BindVertexArray(vertex_array);
        for (const GLenum target : {GL_ARRAY_BUFFER, GL_TEXTURE_BUFFER, GL_PIXEL_UNPACK_BUFFER,
                                    GL_PIXEL_PACK_BUFFER, GL_UNIFORM_BUFFER, GL_COPY_READ_BUFFER})
            gl.BindBuffer(target, buffer);
        gl.BindBufferBase(GL_UNIFORM_BUFFER, 2, buffer);
        gl.UseProgram(0);
        gl.Viewport(0, 0, 99, 99);
        gl.Scissor(0, 0, 98, 98);
        gl.Enable(GL_SCISSOR_TEST);
        gl.ClearColor(0, 0, 0, 0);
        gl.Enablei(GL_BLEND, 1);
        gl.BlendFunc(GL_ONE, GL_ONE);
        gl.ColorMaski(1, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        gl.DepthMask(GL_FALSE);
    }

    std::unique_ptr<HeadlessContext> context_;
    plugin::GlStateCaps caps_;
};

TEST_P(StateGuard, RestoresEverySlotOfAPoisonedState) {
    const PoisonedState poisoned(*context_);
    const GlSnapshot before = take_snapshot(*context_);
    ASSERT_EQ(context_->gl().GetError(), static_cast<GLenum>(GL_NO_ERROR))
        << "the poison itself must be valid";
    {
        const plugin::GlStateGuard guard(context_->gl(), caps_);
        make_a_mess();
        ASSERT_NE(differences(before, take_snapshot(*context_)), "")
            << "nothing was disturbed: the test proves nothing";
    }
    EXPECT_EQ(differences(before, take_snapshot(*context_)), "");
    EXPECT_EQ(context_->gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_P(StateGuard, RestoresTheStateOfAFreshContext) {
    const GlSnapshot before = take_snapshot(*context_);
    {
        const plugin::GlStateGuard guard(context_->gl(), caps_);
        make_a_mess();
    }
    EXPECT_EQ(differences(before, take_snapshot(*context_)), "");
    EXPECT_EQ(context_->gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_P(StateGuard, SurvivesAProgramTheHostHasMarkedForDeletion) {
    const PoisonedState poisoned(*context_);
    context_->gl().DeleteProgram(poisoned.program());  // current, so it lives on until another is used
    {
        const plugin::GlStateGuard guard(context_->gl(), caps_);
        context_->gl().UseProgram(0);
    }
    EXPECT_EQ(context_->gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_P(StateGuard, PausesAndResumesTransformFeedback) {
    if (!caps_.feedback_pause) GTEST_SKIP() << "transform feedback cannot be paused in this context";
    const glare::Gl& gl = context_->gl();
    const auto proc = [](const char* name) { return HeadlessContext::get_proc(nullptr, name); };
    const auto varyings = reinterpret_cast<void (*)(GLuint, GLsizei, const char* const*, GLenum)>(
        proc("glTransformFeedbackVaryings"));
    const auto begin = reinterpret_cast<void (*)(GLenum)>(proc("glBeginTransformFeedback"));
    const auto end = reinterpret_cast<void (*)()>(proc("glEndTransformFeedback"));

    const PoisonedState poisoned(*context_);
    const std::array<const char*, 1> names = {"gl_Position"};
    gl.UseProgram(0);
    varyings(poisoned.program(), 1, names.data(), GL_INTERLEAVED_ATTRIBS);
    gl.LinkProgram(poisoned.program());
    gl.UseProgram(poisoned.program());
    GLuint buffer = 0;
    gl.GenBuffers(1, &buffer);
    gl.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
    gl.BufferData(GL_TRANSFORM_FEEDBACK_BUFFER, 4096, nullptr, GL_STATIC_DRAW);
    begin(GL_POINTS);
    ASSERT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
    GLint active = 0, paused = 1;
    {
        const plugin::GlStateGuard guard(gl, caps_);
        make_a_mess();
        EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
    }
    gl.GetIntegerv(GL_TRANSFORM_FEEDBACK_ACTIVE, &active);
    gl.GetIntegerv(GL_TRANSFORM_FEEDBACK_PAUSED, &paused);
    EXPECT_EQ(active, 1);
    EXPECT_EQ(paused, 0);
    end();
    EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_P(StateGuard, RefusesAnOpenDisplayListAndChangesNothing) {
    if (GetParam() != GlProfile::compatibility) GTEST_SKIP() << "the core profile has no display lists";
    const auto proc = [](const char* name) { return HeadlessContext::get_proc(nullptr, name); };
    const auto new_list = reinterpret_cast<void (*)(GLuint, GLenum)>(proc("glNewList"));
    const auto end_list = reinterpret_cast<void (*)()>(proc("glEndList"));
    const GlSnapshot before = take_snapshot(*context_);
    new_list(7, 0x1300);  // GL_COMPILE
    EXPECT_THROW(plugin::GlStateGuard(context_->gl(), caps_), glare::GlError);
    end_list();
    EXPECT_EQ(differences(before, take_snapshot(*context_)), "");
}

INSTANTIATE_TEST_SUITE_P(Profiles, StateGuard, ::testing::Values(GlProfile::core, GlProfile::compatibility),
                         [](const auto& given) {
                             return given.param == GlProfile::core ? std::string("Core")
                                                                   : std::string("Compatibility");
                         });

}  // namespace
