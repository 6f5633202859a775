// Lights behind the host's picture are hidden, those before it are not, in every depth convention.
#include <functional>
#include <numeric>

#include "tests/gl/view_fixture.h"

namespace seaglare::test {
namespace {

using glare::DepthConvention;
using glare::DepthSource;

constexpr int size_px = 64;

class Occlusion : public ViewTest {
  protected:
    Frame frame_ = make_frame(size_px, size_px);

    // Stored depth of a distance along the axis, by the frame's own projection.
    double stored(double distance_m) const {
        if (frame_.depth_convention == DepthConvention::logarithmic) {
            return std::log(frame_.depth_log_c * distance_m + 1) /
                   std::log(frame_.depth_log_c * frame_.depth_log_far_m + 1);
        }
        const auto& m = frame_.clip_from_view;
        // m[11] tells the handedness: ahead is where w is positive.
        const double z = (m[10] * distance_m * m[11] + m[14]) / distance_m;
        return frame_.depth_convention == DepthConvention::standard ? (z + 1) / 2 : z;
    }
    void set_wall(const GlObject& texture, GLenum format, double distance_m, int first_column = 0) const {
        std::vector<float> depth(size_px * size_px, static_cast<float>(stored(1e9)));
        if (frame_.depth_convention == DepthConvention::logarithmic)
            std::fill(depth.begin(), depth.end(), 1.0F);
        for (int y = 0; y < size_px; ++y) {
            for (int x = first_column; x < size_px; ++x) {
                depth[static_cast<std::size_t>(y) * size_px + x] = static_cast<float>(stored(distance_m));
            }
        }
        glare::set_neutral_pixel_store(gl());
        gl().BindTexture(GL_TEXTURE_2D, texture.name());
        gl().TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), size_px, size_px, 0, GL_DEPTH_COMPONENT,
                        GL_FLOAT, depth.data());
        gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    }
    // Part of the light that is left.
    double visible(double light_m, double x_px = 32, double radius_m = 0.05) {
        PointSource source = source_at_px(frame_, x_px, 32, 1e-4, light_m, radius_m);
        const Pattern pattern = make_pattern(glare::screen_geometry(frame_).pitch, {.radius_nodes = 4});
        const double hidden_or_not = energy_lx(frame_, hdr_of(frame_, pattern, {source}));
        const DepthSource depth = frame_.depth_source;
        frame_.depth_source = DepthSource::none;
        const double free = energy_lx(frame_, hdr_of(frame_, pattern, {source}));
        frame_.depth_source = depth;
        return hidden_or_not / free;
    }
    void expect_wall_hides(GLenum format) {
        const GlObject texture(gl(), GlKind::texture);
        set_wall(texture, format, 500);
        frame_.depth_source = DepthSource::texture;
        frame_.depth_object = texture.name();
        EXPECT_EQ(visible(600), 0);
        EXPECT_EQ(visible(400), 1);
        EXPECT_EQ(visible(500), 1) << "a light on the wall itself";
    }
};

TEST_F(Occlusion, ByStandardDepthOf24Bits) {
    expect_wall_hides(GL_DEPTH_COMPONENT24);
}
TEST_F(Occlusion, ByStandardDepthOf32FloatBits) {
    expect_wall_hides(GL_DEPTH_COMPONENT32F);
}

TEST_F(Occlusion, ByReversedInfiniteDepth) {
    frame_.depth_convention = DepthConvention::zero_to_one;
    frame_.clip_from_view[10] = 0;
    frame_.clip_from_view[14] = 0.1;
    expect_wall_hides(GL_DEPTH_COMPONENT32F);
    const GlObject texture(gl(), GlKind::texture);
    set_wall(texture, GL_DEPTH_COMPONENT32F, 20000);
    frame_.depth_object = texture.name();
    EXPECT_EQ(visible(20500), 0) << "reversed depth is good at 20 km";
    EXPECT_EQ(visible(19900), 1);
}

TEST_F(Occlusion, ByZeroToOneDepthThatGrows) {
    frame_.depth_convention = DepthConvention::zero_to_one;
    frame_.clip_from_view[10] = -1e5 / (1e5 - 0.1);
    frame_.clip_from_view[14] = -0.1 * 1e5 / (1e5 - 0.1);
    expect_wall_hides(GL_DEPTH_COMPONENT32F);
}

TEST_F(Occlusion, ByLogarithmicDepth) {
    frame_.depth_convention = DepthConvention::logarithmic;
    frame_.depth_log_c = 1;
    frame_.depth_log_far_m = 1e5;
    expect_wall_hides(GL_DEPTH_COMPONENT24);
}

TEST_F(Occlusion, ByALeftHandedProjection) {
    frame_.clip_from_view[8] = -frame_.clip_from_view[8];
    frame_.clip_from_view[10] = -frame_.clip_from_view[10];
    frame_.clip_from_view[11] = 1;
    expect_wall_hides(GL_DEPTH_COMPONENT24);
}

TEST_F(Occlusion, ToleratesTheStepsOfADeepDepthBuffer) {
    // Near 0.05 m, far 100 km, 24 bits: a step is 119 m at 10 km. A light on the wall there must not be hidden.
    const double t = std::tan(22.5 * pi / 180);
    frame_.clip_from_view = frustum(-t, t, -t, t, 0.05, 1e5);
    const GlObject texture(gl(), GlKind::texture);
    frame_.depth_source = DepthSource::texture;
    frame_.depth_object = texture.name();
    for (const double distance_m : {1000.0, 3333.0, 9990.0, 10040.0}) {
        set_wall(texture, GL_DEPTH_COMPONENT24, distance_m);
        EXPECT_EQ(visible(distance_m), 1) << distance_m << " m";
        EXPECT_EQ(visible(distance_m * 1.2), 0) << distance_m << " m";
    }
}

TEST_F(Occlusion, IgnoresTheTexturesCompareMode) {
    const GlObject texture(gl(), GlKind::texture);
    set_wall(texture, GL_DEPTH_COMPONENT24, 500);
    gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_GREATER);
    frame_.depth_source = DepthSource::texture;
    frame_.depth_object = texture.name();
    EXPECT_EQ(visible(600), 0);
    EXPECT_EQ(visible(400), 1);
}

TEST_F(Occlusion, CopiesTheDepthOfAFramebuffer) {
    for (const GLenum format :
         {GL_DEPTH_COMPONENT24, GL_DEPTH24_STENCIL8, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT16}) {
        const GlObject texture(gl(), GlKind::texture);
        const GlObject fbo(gl(), GlKind::framebuffer);
        const bool stencil = format == GL_DEPTH24_STENCIL8;
        gl().BindTexture(GL_TEXTURE_2D, texture.name());
        gl().TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), size_px, size_px, 0,
                        stencil ? GL_DEPTH_STENCIL : GL_DEPTH_COMPONENT,
                        stencil ? GL_UNSIGNED_INT_24_8 : GL_FLOAT, nullptr);
        gl().BindFramebuffer(GL_FRAMEBUFFER, fbo.name());
        gl().FramebufferTexture2D(GL_FRAMEBUFFER, stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                                  GL_TEXTURE_2D, texture.name(), 0);
        gl().DrawBuffer(GL_NONE);
        gl().ReadBuffer(GL_NONE);
        gl().DepthMask(GL_TRUE);
        gl().Disable(GL_SCISSOR_TEST);
        const auto wall = static_cast<float>(stored(50));
        gl().ClearBufferfv(GL_DEPTH, 0, &wall);
        frame_.depth_source = DepthSource::fbo;
        frame_.depth_object = fbo.name();
        EXPECT_EQ(visible(120), 0) << std::hex << format;
        EXPECT_EQ(visible(30), 1) << std::hex << format;
    }
    frame_.depth_object = 0;  // the window's
    gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
    const auto wall = static_cast<float>(stored(50));
    gl().ClearBufferfv(GL_DEPTH, 0, &wall);
    EXPECT_EQ(visible(120), 0);
    EXPECT_EQ(visible(30), 1);
}

TEST_F(Occlusion, ReadsMultisampledDepth) {
    using TexImage2DMultisample = void (*)(GLenum, GLsizei, GLenum, GLsizei, GLsizei, GLboolean);
    const auto storage = reinterpret_cast<TexImage2DMultisample>(
        HeadlessContext::get_proc(nullptr, "glTexImage2DMultisample"));
    const GlObject texture(gl(), GlKind::texture);
    const GlObject fbo(gl(), GlKind::framebuffer);
    gl().BindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture.name());
    storage(GL_TEXTURE_2D_MULTISAMPLE, 4, GL_DEPTH_COMPONENT24, size_px, size_px, GL_TRUE);
    gl().BindFramebuffer(GL_FRAMEBUFFER, fbo.name());
    gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D_MULTISAMPLE, texture.name(),
                              0);
    gl().DrawBuffer(GL_NONE);
    gl().ReadBuffer(GL_NONE);
    gl().DepthMask(GL_TRUE);
    const auto wall = static_cast<float>(stored(500));
    gl().ClearBufferfv(GL_DEPTH, 0, &wall);
    frame_.depth_source = DepthSource::texture_ms;
    frame_.depth_object = texture.name();
    EXPECT_EQ(visible(600), 0);
    EXPECT_EQ(visible(400), 1);
    frame_.depth_source = DepthSource::fbo;
    frame_.depth_object = fbo.name();
    EXPECT_EQ(visible(600), 0);
    EXPECT_EQ(visible(400), 1);
}

TEST_F(Occlusion, DimsSmoothlyAsALightGoesBehindAnEdge) {
    const GlObject texture(gl(), GlKind::texture);
    set_wall(texture, GL_DEPTH_COMPONENT24, 500, 32);  // columns 32 and up are wall
    frame_.depth_source = DepthSource::texture;
    frame_.depth_object = texture.name();
    double last = visible(600, 29.9);
    EXPECT_NEAR(last, 1, 1e-5);
    for (int step = 1; step <= 42; ++step) {
        const double now = visible(600, 29.9 + 0.1 * step);
        EXPECT_LE(now, last + 1e-5);
        EXPECT_GT(now, last - 0.13) << "step " << step;
        last = now;
    }
    EXPECT_NEAR(last, 0, 1e-5);
    EXPECT_NEAR(visible(600, 32), 0.5, 1e-3);
}

TEST_F(Occlusion, LeavesOffScreenLightsFree) {
    const GlObject texture(gl(), GlKind::texture);
    set_wall(texture, GL_DEPTH_COMPONENT24, 10);
    frame_.depth_source = DepthSource::texture;
    frame_.depth_object = texture.name();
    const Pattern pattern = make_pattern(glare::screen_geometry(frame_).pitch, {.radius_nodes = 20});
    const auto hdr = hdr_of(frame_, pattern, {source_at_px(frame_, -8, 32, 1e-2)});
    EXPECT_GT(energy_lx(frame_, hdr), 0);
}

TEST_F(Occlusion, NamesADepthObjectThatCannotBeRead) {
    const Target target(gl(), size_px, size_px);
    target.fill({10, 20, 30, 40});
    frame_.target_fbo = target.fbo();
    const Pattern pattern = make_pattern(glare::screen_geometry(frame_).pitch, {.radius_nodes = 4});
    const std::vector sources{source_at_px(frame_, 32, 32)};
    for (const DepthSource source : {DepthSource::texture, DepthSource::texture_ms, DepthSource::fbo}) {
        frame_.depth_source = source;
        frame_.depth_object = 4711;
        try {
            renderer_->render(frame_, {}, pattern, sources, stats_);
            ADD_FAILURE() << "no error";
        } catch (const glare::GlError& error) {
            EXPECT_NE(std::string(error.what()).find("4711"), std::string::npos) << error.what();
        }
    }
    const auto pixels = target.read();
    for (std::size_t i = 0; i < pixels.size(); i += 4)
        ASSERT_EQ(pixels[i], 10);
}

}  // namespace
}  // namespace seaglare::test
