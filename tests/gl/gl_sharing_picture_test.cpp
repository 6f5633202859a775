// A GL texture that OpenCL fills: what GL reads is what OpenCL had. Where no driver shares, that it says why.
#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "glare/device/cl_device.h"
#include "glare/device/cl_gl_texture.h"
#include "glare/device/cl_signal_guard.h"
#include "glare/device/gl_object.h"
#include "tests/gl/headless_context.h"

namespace seaglare::glare {
namespace {

TEST(GlSharing, KnowsTheContextThatIsCurrent) {
    std::unique_ptr<test::HeadlessContext> context;
    try {
        context = std::make_unique<test::HeadlessContext>();
    } catch (const std::runtime_error& error) {
        GTEST_SKIP() << error.what();
    }
    const GlContext current = current_gl_context();
    EXPECT_EQ(current.binding, GlBinding::egl);
    EXPECT_NE(current.context, nullptr);
    EXPECT_NE(current.display, nullptr);
}

TEST(GlSharing, GlReadsWhatOpenClHasFilled) {
    const SignalGuard guard;
    std::unique_ptr<test::HeadlessContext> context;
    SharingDecision decision;
    std::shared_ptr<ClShared> shared;
    try {
        context = std::make_unique<test::HeadlessContext>();
        shared = ClShared::acquire(current_gl_context(), decision);
    } catch (const std::runtime_error& error) {
        GTEST_SKIP() << error.what();
    }
    if (!decision.shares) {
        EXPECT_NE(decision.reason, "");
        GTEST_SKIP() << decision.reason;
    }
    ASSERT_TRUE(shared->shares_with_gl());
    constexpr std::size_t width = 8;
    constexpr std::size_t rows = 4;
    std::vector<float> wanted(width * rows * 4);
    for (std::size_t i = 0; i < wanted.size(); ++i)
        wanted[i] = static_cast<float>(i) / 7;
    const Gl& gl = context->gl();
    const GlObject texture(gl, GlKind::texture);
    gl.BindTexture(GL_TEXTURE_2D, texture.name());
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, rows, 0, GL_RGBA, GL_FLOAT, nullptr);
    const ClDevice device(shared);
    ClBuffer buffer;
    buffer.reserve(device.context(), device.queue(), wanted.size() * sizeof(float), "wanted");
    buffer.write(device.queue(), wanted.size() * sizeof(float), wanted.data());
    const ClGlTexture image(device.context(), texture.name());
    image.fill(device.queue(), buffer.get(), width, rows);
    const GlObject framebuffer(gl, GlKind::framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.name(), 0);
    std::vector<float> got(wanted.size());
    gl.ReadPixels(0, 0, width, rows, GL_RGBA, GL_FLOAT, got.data());
    EXPECT_EQ(got, wanted);
}

}  // namespace
}  // namespace seaglare::glare
