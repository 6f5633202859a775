// Timing of passes in a host: its own queries, debug groups and debug callback go on as if we were not there.
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>
#include <vector>

#include "glare/device/gl_touched_state.h"
#include "tests/gl/counted_gl.h"
#include "tests/gl/plugin_fixture.h"

namespace {

using namespace seaglare;
using namespace seaglare::test;

template <class Function>
Function function(const char* name) {
    return reinterpret_cast<Function>(HeadlessContext::get_proc(nullptr, name));
}

class PluginTiming : public PluginTest {
  protected:
    seaglare_stats stats() {
        auto stats = sized<seaglare_stats>();
        const auto* api = plugin_.extension<seaglare_stats_api>("seaglare.stats/1");
        EXPECT_EQ(api->get_stats(view_, &stats), SEAGLARE_OK);
        return stats;
    }
    GLint debug_depth() const {
        GLint depth = 0;
        gl().GetIntegerv(GL_DEBUG_GROUP_STACK_DEPTH, &depth);
        return depth;
    }
};

TEST_P(PluginTiming, GpuTimesOfThePassesComeInFramesLate) {
    const Target target = make_target();
    add_light(0, 1000);
    const seaglare_frame frame = frame_on(target);
    ASSERT_GE(plugin_->render(view_, &frame), 0) << plugin_.last_error(context_);
    EXPECT_EQ(stats().gpu_frames_ago, 0U) << "the frame that was just asked for cannot have come in";
    gl().Finish();
    ASSERT_GE(plugin_->render(view_, &frame), 0);
    const seaglare_stats after = stats();
    GLint bits = 0;
    gl().GetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
    if (bits == 0) GTEST_SKIP() << "this GL has no clock";
    EXPECT_EQ(after.gpu_frames_ago, 1U);
    EXPECT_GT(after.gpu_ms, 0);
    const double sum =
        after.gpu_upload_ms + after.gpu_occlusion_ms + after.gpu_accumulate_ms + after.gpu_composite_ms;
    EXPECT_NEAR(sum, after.gpu_ms, 0.05 * after.gpu_ms);
    EXPECT_GT(after.occlusion_ms, 0);
}

TEST_P(PluginTiming, NothingIsWaitedForAndAFrameAsksForFewTimestamps) {
    if (!CountedGl::possible()) GTEST_SKIP() << "calls can be counted on x86-64 only";
    make_view(0, &CountedGl::get_proc);
    const Target target = make_target();
    add_light(0, 1000);
    const seaglare_frame frame = frame_on(target);
    for (int i = 0; i < 5; ++i)
        ASSERT_GE(plugin_->render(view_, &frame), 0);
    CountedGl::reset();
    ASSERT_GE(plugin_->render(view_, &frame), 0);
    EXPECT_EQ(CountedGl::calls_of("glFinish"), 0U);
    EXPECT_LE(CountedGl::calls_of("glQueryCounter"), 5U);
    EXPECT_EQ(CountedGl::calls_of("glBeginQuery"), 0U);
    EXPECT_EQ(CountedGl::calls_of("glPushDebugGroup"), CountedGl::calls_of("glPopDebugGroup"));

    make_view(SEAGLARE_VIEW_NO_GPU_TIMES, &CountedGl::get_proc);
    ASSERT_GE(plugin_->render(view_, &frame), 0);
    CountedGl::reset();
    ASSERT_GE(plugin_->render(view_, &frame), 0);
    for (const char* name : {"glQueryCounter", "glGetQueryObjectui64v", "glPushDebugGroup"})
        EXPECT_EQ(CountedGl::calls_of(name), 0U) << name;
    EXPECT_EQ(stats().gpu_frames_ago, 0U);
}

TEST_P(PluginTiming, QueriesOfTheHostGoOnUndisturbed) {
    const Target target = make_target();
    add_light(0, 1000);
    const seaglare_frame frame = frame_on(target);
    GLuint elapsed = 0;
    gl().GenQueries(1, &elapsed);
    gl().BeginQuery(GL_TIME_ELAPSED, elapsed);
    for (int i = 0; i < 3; ++i)
        ASSERT_GE(plugin_->render(view_, &frame), 0);
    GLint current = 0;
    gl().GetQueryiv(GL_TIME_ELAPSED, GL_CURRENT_QUERY, &current);
    EXPECT_EQ(static_cast<GLuint>(current), elapsed);
    gl().EndQuery(GL_TIME_ELAPSED);
    EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
    gl().DeleteQueries(1, &elapsed);
}

struct Heard {
    mutable std::vector<std::string> texts;  // GL hands the callback's user as const
};
void APIENTRY hear(GLenum /*source*/, GLenum type, GLuint /*id*/, GLenum /*severity*/, GLsizei size,
                   const GLchar* text, const void* user) {
    if (type != GL_DEBUG_TYPE_PUSH_GROUP && type != GL_DEBUG_TYPE_POP_GROUP) return;
    static_cast<const Heard*>(user)->texts.emplace_back(text, static_cast<std::size_t>(size));
}

TEST_P(PluginTiming, TheHostsDebugCallbackHearsOfOneGroupAFrameAndOfItsOwnAsBefore) {
    if (gl().PushDebugGroup == nullptr) GTEST_SKIP() << "this GL has no KHR_debug";
    const Target target = make_target();
    add_light(0, 1000);
    const seaglare_frame frame = frame_on(target);
    Heard heard;
    const auto set_callback = function<void(APIENTRY*)(GLDEBUGPROC, const void*)>("glDebugMessageCallback");
    gl().Enable(GL_DEBUG_OUTPUT);
    gl().Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    set_callback(&hear, &heard);
    gl().DebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
    ASSERT_GE(plugin_->render(view_, &frame), 0);
    EXPECT_EQ(heard.texts, (std::vector<std::string>{"Seaglare", "Seaglare"}));
    heard.texts.clear();
    gl().PushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 7, -1, "the host's");
    gl().PopDebugGroup();
    EXPECT_EQ(heard.texts.size(), 2U) << "what we switched off is on again";
    set_callback(nullptr, nullptr);
    gl().Disable(GL_DEBUG_OUTPUT);
}

TEST_P(PluginTiming, GroupsAreBalancedAlsoWhenRenderFails) {
    if (gl().PushDebugGroup == nullptr) GTEST_SKIP() << "this GL has no KHR_debug";
    const Target target = make_target();
    add_light(0, 1000);
    seaglare_frame frame = frame_on(target);
    const GLint before = debug_depth();
    ASSERT_GE(plugin_->render(view_, &frame), 0);
    EXPECT_EQ(debug_depth(), before);
    frame.depth_source = SEAGLARE_DEPTH_TEXTURE;
    frame.depth_object = 4711;
    EXPECT_EQ(plugin_->render(view_, &frame), SEAGLARE_ERROR_GL);
    EXPECT_EQ(debug_depth(), before);
}

TEST_P(PluginTiming, AHostWithItsStackOfGroupsFullGetsItsPictureAndNoError) {
    if (gl().PushDebugGroup == nullptr) GTEST_SKIP() << "this GL has no KHR_debug";
    const Target target = make_target();
    add_light(0, 1000);
    const seaglare_frame frame = frame_on(target);
    GLint deepest = 0;
    gl().GetIntegerv(GL_MAX_DEBUG_GROUP_STACK_DEPTH, &deepest);
    const GLint before = debug_depth();
    for (GLint i = before; i < deepest; ++i)
        gl().PushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, "the host's");
    ASSERT_EQ(debug_depth(), deepest);
    ASSERT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
    EXPECT_GE(plugin_->render(view_, &frame), 0);
    EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
    EXPECT_EQ(debug_depth(), deepest);
    for (GLint i = before; i < deepest; ++i)
        gl().PopDebugGroup();
}

TEST_P(PluginTiming, ProgramsAndTexturesHaveNamesInADebugger) {
    if (gl().ObjectLabel == nullptr) GTEST_SKIP() << "this GL has no KHR_debug";
    const Target target = make_target();
    add_light(0, 1000);
    const seaglare_frame frame = frame_on(target);
    ASSERT_GE(plugin_->render(view_, &frame), 0);
    const auto label_of =
        function<void(APIENTRY*)(GLenum, GLuint, GLsizei, GLsizei*, GLchar*)>("glGetObjectLabel");
    std::set<std::string> labels;
    for (GLuint name = 1; name < 300; ++name) {
        std::array<GLchar, 64> text{};
        GLsizei length = 0;
        if (gl().IsProgram(name) == GL_TRUE) label_of(GL_PROGRAM, name, 64, &length, text.data());
        if (length > 0) labels.insert(text.data());
        length = 0;
        if (gl().IsTexture(name) == GL_TRUE) label_of(GL_TEXTURE, name, 64, &length, text.data());
        if (length > 0) labels.insert(text.data());
    }
    for (const char* expected : {"Seaglare: visibility", "Seaglare: core", "Seaglare: skirt",
                                 "Seaglare: composite", "Seaglare: the HDR buffer", "Seaglare: pattern"}) {
        EXPECT_EQ(labels.count(expected), 1U) << expected;
    }
    EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

SEAGLARE_BOTH_PROFILES(PluginTiming);

}  // namespace
