// Pass times without a GPU: a table of GL functions whose clock and answers the test sets.
#include "glare/device/gl_pass_timer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace seaglare::glare {
namespace {

struct FakeGl {
    GLuint64 now_ns = 1000;
    GLint clock_bits = 64;
    GLint deepest_group = 64;
    bool results_are_in = false;
    bool debug_output = false;
    std::vector<std::string> groups;  // open, the host's among them
    std::vector<std::string> opened;
    int muted = 0;
    GLuint last_query = 0;
    std::set<GLuint> queries;
    std::vector<GLuint64> stamps = std::vector<GLuint64>(1000);
    int stamps_asked_for = 0;
    int results_read = 0;
    int results_read_too_early = 0;
};
FakeGl* fake = nullptr;

void APIENTRY get_query(GLenum target, GLenum name, GLint* value) {
    if (target == GL_TIMESTAMP && name == GL_QUERY_COUNTER_BITS) *value = fake->clock_bits;
}
void APIENTRY gen_queries(GLsizei count, GLuint* names) {
    for (GLsizei i = 0; i < count; ++i) {
        names[i] = ++fake->last_query;
        fake->queries.insert(names[i]);
    }
}
void APIENTRY delete_queries(GLsizei count, const GLuint* names) {
    for (GLsizei i = 0; i < count; ++i)
        fake->queries.erase(names[i]);
}
void APIENTRY query_counter(GLuint query, GLenum target) {
    EXPECT_EQ(target, static_cast<GLenum>(GL_TIMESTAMP));
    fake->stamps[query] = fake->now_ns;
    ++fake->stamps_asked_for;
}
void APIENTRY query_object(GLuint query, GLenum what, GLuint64* value) {
    if (what == GL_QUERY_RESULT_AVAILABLE) {
        *value = fake->results_are_in ? GL_TRUE : GL_FALSE;
        return;
    }
    ++fake->results_read;
    if (!fake->results_are_in) ++fake->results_read_too_early;
    *value = fake->stamps[query];
}
void APIENTRY get_integer(GLenum name, GLint* value) {
    if (name == GL_DEBUG_GROUP_STACK_DEPTH) *value = static_cast<GLint>(fake->groups.size()) + 1;
    if (name == GL_MAX_DEBUG_GROUP_STACK_DEPTH) *value = fake->deepest_group;
}
GLboolean APIENTRY is_enabled(GLenum what) {
    return what == GL_DEBUG_OUTPUT && fake->debug_output ? GL_TRUE : GL_FALSE;
}
void APIENTRY push_group(GLenum /*source*/, GLuint /*id*/, GLsizei /*size*/, const GLchar* text) {
    fake->groups.emplace_back(text);
    fake->opened.emplace_back(text);
}
void APIENTRY pop_group() {
    fake->groups.pop_back();
}
void APIENTRY mute(GLenum /*source*/, GLenum /*type*/, GLenum /*severity*/, GLsizei /*count*/,
                   const GLuint* /*ids*/, GLboolean enabled) {
    EXPECT_EQ(enabled, GL_FALSE);
    EXPECT_EQ(fake->groups.size(), 1U) << "outside a group of ours the host's own volume would change";
    ++fake->muted;
}

class PassTimers : public ::testing::Test {
  protected:
    PassTimers() {
        fake = &fake_;
        gl_.GetQueryiv = &get_query;
        gl_.GenQueries = &gen_queries;
        gl_.DeleteQueries = &delete_queries;
        gl_.QueryCounter = &query_counter;
        gl_.GetQueryObjectui64v = &query_object;
        gl_.GetIntegerv = &get_integer;
        gl_.IsEnabled = &is_enabled;
        gl_.PushDebugGroup = &push_group;
        gl_.PopDebugGroup = &pop_group;
        gl_.DebugMessageControl = &mute;
    }
    ~PassTimers() override { fake = nullptr; }
    PassTimers(const PassTimers&) = delete;
    PassTimers& operator=(const PassTimers&) = delete;

    // Upload 1 ms, occlusion 2 ms, accumulate 4 ms in two parts, composite 8 ms.
    void frame(PassTimer& timer, std::uint64_t unit_ns = 1000000) {
        PassTimer::Frame passes(timer, Pass::upload);
        fake_.now_ns += unit_ns;
        passes.enter(Pass::occlusion);
        fake_.now_ns += unit_ns;
        passes.enter(Pass::accumulate);
        fake_.now_ns += 4 * unit_ns;
        passes.enter(Pass::occlusion);
        fake_.now_ns += unit_ns;
        passes.enter(Pass::composite);
        fake_.now_ns += 8 * unit_ns;
        passes.finish();
    }

    FakeGl fake_;
    Gl gl_;
};

TEST_F(PassTimers, ComeInAFrameLateAndAddUp) {
    PassTimer timer(gl_, true);
    frame(timer);
    EXPECT_EQ(timer.gpu().frames_ago, 0U);
    fake_.results_are_in = true;
    frame(timer, 5000000);
    EXPECT_EQ(timer.gpu().frames_ago, 1U);
    EXPECT_DOUBLE_EQ(timer.gpu().passes.of(Pass::upload), 1);
    EXPECT_DOUBLE_EQ(timer.gpu().passes.of(Pass::occlusion), 2) << "both of its parts";
    EXPECT_DOUBLE_EQ(timer.gpu().passes.of(Pass::accumulate), 4);
    EXPECT_DOUBLE_EQ(timer.gpu().passes.of(Pass::composite), 8);
    EXPECT_DOUBLE_EQ(timer.gpu().whole_ms, 15);
    EXPECT_EQ(fake_.results_read_too_early, 0);
}

TEST_F(PassTimers, AreNeverWaitedForHoweverFarBehindTheGpuIs) {
    PassTimer timer(gl_, true);
    for (int i = 0; i < 100; ++i)
        frame(timer);
    EXPECT_EQ(fake_.results_read, 0);
    EXPECT_EQ(timer.gpu().frames_ago, 0U);
    EXPECT_EQ(fake_.queries.size(), 4U * 6) << "nothing grows";
    fake_.results_are_in = true;
    frame(timer);
    EXPECT_EQ(timer.gpu().frames_ago, 97U) << "the last of the four frames that were timed";
    frame(timer);
    EXPECT_EQ(timer.gpu().frames_ago, 1U);
    EXPECT_EQ(fake_.results_read_too_early, 0);
}

// A picture that is made band by band goes to and fro between two passes.
TEST_F(PassTimers, FramesOfManyPartsAreTimedNowAndThen) {
    PassTimer timer(gl_, true);
    fake_.results_are_in = true;
    constexpr int bands = 12;
    constexpr int frames = 90;
    std::uint32_t oldest = 0;
    for (int i = 0; i < frames; ++i) {
        {
            PassTimer::Frame passes(timer, Pass::upload);
            for (int band = 0; band < bands; ++band) {
                passes.enter(Pass::accumulate);
                fake_.now_ns += 2000000;
                passes.enter(Pass::composite);
                fake_.now_ns += 1000000;
            }
            passes.finish();
        }
        if (i == 0) continue;
        EXPECT_DOUBLE_EQ(timer.gpu().passes.of(Pass::accumulate), 2 * bands) << "frame " << i;
        EXPECT_DOUBLE_EQ(timer.gpu().passes.of(Pass::composite), bands);
        oldest = std::max(oldest, timer.gpu().frames_ago);
    }
    EXPECT_LE(fake_.stamps_asked_for, 3 * frames + 2 * bands);
    EXPECT_GT(fake_.stamps_asked_for, 2 * frames);
    EXPECT_LE(oldest, 10U);
    // Few parts again: every frame.
    frame(timer);
    for (int i = 0; i < 20; ++i)
        frame(timer);
    EXPECT_EQ(timer.gpu().frames_ago, 1U);
}

TEST_F(PassTimers, SurviveAClockThatWraps) {
    fake_.clock_bits = 36;
    fake_.now_ns = (GLuint64{1} << 36) - 1500000;
    PassTimer timer(gl_, true);
    frame(timer);
    for (GLuint64& stamp : fake_.stamps)
        stamp &= (GLuint64{1} << 36) - 1;
    fake_.results_are_in = true;
    frame(timer);
    EXPECT_DOUBLE_EQ(timer.gpu().whole_ms, 15);
    EXPECT_DOUBLE_EQ(timer.gpu().passes.of(Pass::occlusion), 2);
}

TEST_F(PassTimers, AFrameThatFailsIsNotCountedAndClosesItsGroups) {
    PassTimer timer(gl_, true);
    fake_.results_are_in = true;
    EXPECT_THROW(
        {
            PassTimer::Frame passes(timer, Pass::upload);
            passes.enter(Pass::composite);
            throw std::runtime_error("no target");
        },
        std::runtime_error);
    EXPECT_TRUE(fake_.groups.empty());
    frame(timer);
    EXPECT_EQ(timer.gpu().frames_ago, 0U);
    frame(timer);
    EXPECT_EQ(timer.gpu().frames_ago, 1U);
}

TEST_F(PassTimers, AreNamedGroupsWithinOneThatTheHostsCallbackHearsOf) {
    PassTimer timer(gl_, true);
    frame(timer);
    const std::vector<std::string> expected{"Seaglare",
                                            "Seaglare: upload",
                                            "Seaglare: occlusion",
                                            "Seaglare: accumulate",
                                            "Seaglare: occlusion",
                                            "Seaglare: composite"};
    EXPECT_EQ(fake_.opened, expected);
    EXPECT_TRUE(fake_.groups.empty());
    EXPECT_EQ(fake_.muted, 0) << "without debug output there are no messages";
    fake_.debug_output = true;
    frame(timer);
    EXPECT_EQ(fake_.muted, 2);
}

TEST_F(PassTimers, OpenNoGroupWhereTheHostsStackIsFull) {
    fake_.groups.assign(60, "the host's");
    PassTimer timer(gl_, true);
    frame(timer);
    EXPECT_TRUE(fake_.opened.empty());
    EXPECT_EQ(fake_.groups.size(), 60U);
}

TEST_F(PassTimers, SwitchedOffOrWithoutAClockMakeNoQuery) {
    PassTimer off(gl_, false);
    frame(off);
    EXPECT_TRUE(fake_.queries.empty());
    EXPECT_TRUE(fake_.opened.empty());
    fake_.clock_bits = 0;
    PassTimer blind(gl_, true);
    frame(blind);
    EXPECT_TRUE(fake_.queries.empty());
    EXPECT_FALSE(fake_.opened.empty());
}

TEST_F(PassTimers, GiveTheirQueriesBackUnlessTheContextIsGone) {
    fake_.results_are_in = true;
    {
        PassTimer timer(gl_, true);
        frame(timer);
        EXPECT_FALSE(fake_.queries.empty());
    }
    EXPECT_TRUE(fake_.queries.empty());
    {
        PassTimer timer(gl_, true);
        frame(timer);
        timer.forget();
    }
    EXPECT_FALSE(fake_.queries.empty()) << "no GL call after the context is lost";
}

TEST_F(PassTimers, TellTheCpuTimeOfEachPassAtOnce) {
    PassTimer timer(gl_, true);
    PassTimer::Frame passes(timer, Pass::upload);
    passes.enter(Pass::composite);
    const PassTimes cpu = passes.finish();
    EXPECT_GT(cpu.of(Pass::upload), 0);
    EXPECT_GT(cpu.of(Pass::composite), 0);
    EXPECT_EQ(cpu.of(Pass::accumulate), 0);
}

}  // namespace
}  // namespace seaglare::glare
