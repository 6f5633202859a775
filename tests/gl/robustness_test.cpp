// Extremes and errors: no value, size or host object may poison the picture.
#include <algorithm>
#include <cmath>

#include "tests/gl/view_fixture.h"

namespace seaglare::test {
namespace {

class Robustness : public ViewTest {};

TEST_F(Robustness, HdrStaysFiniteFromTheFaintestToTheBrightestLight) {
    Frame frame = make_frame(64, 48);
    const Pattern pattern =
        make_pattern(glare::screen_geometry(frame).pitch, {.radius_nodes = 20, .with_tail = true});
    for (const double lux : {2.8e-12, 1e-4, 1e10}) {
        for (const double adaptation : {0.0, 1e-6, 1e6, std::nan("")}) {
            frame.adaptation_luminance_cd_m2 = adaptation;
            const Target target(gl(), 64, 48);
            target.fill({5, 5, 5, 255});
            frame.target_fbo = target.fbo();
            const std::vector sources(20, source_at_px(frame, 31.2, 22.2, lux, 1, 0.05));
            renderer_->render(frame, {}, pattern, sources, stats_);
            for (const float value : read_hdr())
                ASSERT_TRUE(std::isfinite(value));
            const auto pixels = target.read();
            for (std::size_t i = 0; i < pixels.size(); ++i)
                ASSERT_GE(pixels[i], i % 4 == 3 ? 255 : 5);
        }
    }
}

TEST_F(Robustness, EyeInsideALampSeesAFiniteDiscOverTheWholePicture) {
    const Frame frame = make_frame(64, 48);
    Pattern pattern = make_pattern(glare::screen_geometry(frame).pitch, {.radius_nodes = 10});
    PointSource source = source_at_px(frame, 32, 24, 1e3, 0.3, 0.5);
    for (const double distance : {0.3, 0.0}) {
        for (float& p : source.position_view_m)
            p *= distance > 0 ? 1.0F : 0.0F;
        const auto hdr = hdr_of(frame, pattern, {source});
        for (std::size_t i = 1; i < hdr.size(); i += 4) {
            ASSERT_TRUE(std::isfinite(hdr[i]));
            // Half the sky: E core / (2 pi), and the skirt on top.
            ASSERT_GT(hdr[i], 1e3 * 0.6 / (2 * pi) * 0.9);
        }
        EXPECT_NEAR(hdr[1], 1e3 * 0.6 / (2 * pi), 1e3 * 0.6 / (2 * pi) * 0.5);
    }
}

// A host that asks for more pixels than its GL has textures for is told so; GL raises no error that it would find.
TEST_F(Robustness, APictureLargerThanGlAllowsIsRefusedWithoutAGlError) {
    static PFNGLGETINTEGERVPROC real = nullptr;
    real = gl().GetIntegerv;
    Gl small = gl();
    small.GetIntegerv = [](GLenum name, GLint* value) {
        real(name, value);
        if (name == GL_MAX_TEXTURE_SIZE) *value = 300;
    };
    const Pattern pattern = make_pattern(1e-3, {.radius_nodes = 10});
    const Target target(gl(), 400, 40);
    target.fill({7, 7, 7, 255});
    Frame frame = make_frame(400, 40);
    frame.target_fbo = target.fbo();
    const std::vector sources(1, source_at_px(frame, 200, 20));
    {
        ViewRenderer renderer(small);
        EXPECT_THROW(renderer.render(frame, {}, pattern, sources, stats_), glare::GlError);
        EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
        for (const std::uint8_t value : target.read())
            ASSERT_TRUE(value == 7 || value == 255);
        frame.viewport_px = {0, 0, 300, 40};
        EXPECT_EQ(renderer.render(frame, {}, pattern, sources, stats_), glare::RenderResult::drawn);
    }
    EXPECT_EQ(renderer_->render(frame, {}, pattern, sources, stats_), glare::RenderResult::drawn);
}

TEST_F(Robustness, NotANumberIsNoLight) {
    const Frame frame = make_frame(64, 48);
    const Pattern pattern = make_pattern(glare::screen_geometry(frame).pitch, {.radius_nodes = 10});
    std::vector<PointSource> sources(3, source_at_px(frame, 32, 24));
    sources[0].position_view_m[1] = std::nanf("");
    sources[1].illuminance_rgb_lx[2] = std::nanf("");
    const auto hdr = hdr_of(frame, pattern, sources);
    for (const float value : hdr)
        ASSERT_TRUE(std::isfinite(value));
    EXPECT_GT(energy_lx(frame, hdr), 5e-5);
    EXPECT_EQ(stats_.lights_drawn, 1U);
}

TEST_F(Robustness, PicturesOfOnePixelAndOfOneRowWork) {
    for (const auto& [width, height] : {std::pair{1, 1}, {300, 1}, {1, 200}}) {
        const Frame frame = make_frame(width, height);
        const Pattern pattern =
            make_pattern(glare::screen_geometry(frame).pitch, {.radius_nodes = 10, .with_tail = true});
        const auto hdr = hdr_of(frame, pattern, {source_at_px(frame, width / 2.0, height / 2.0)});
        EXPECT_EQ(hdr.size(), static_cast<std::size_t>(width) * height * 4);
        EXPECT_GT(*std::max_element(hdr.begin(), hdr.end()), 0);
        for (const float value : hdr)
            ASSERT_TRUE(std::isfinite(value));
    }
}

TEST_F(Robustness, ALeftHandedProjectionGivesTheMirroredWorldsSamePicture) {
    Frame right = make_frame(80, 60);
    Frame left = right;
    left.clip_from_view[10] = -left.clip_from_view[10];
    left.clip_from_view[11] = 1;
    const Pattern pattern =
        make_pattern(glare::screen_geometry(right).pitch, {.radius_nodes = 20, .with_tail = true});
    const auto a = hdr_of(right, pattern, {source_at_px(right, 21.3, 44.4)});
    const auto b = hdr_of(left, pattern, {source_at_px(left, 21.3, 44.4)});
    EXPECT_GT(source_at_px(left, 21.3, 44.4).position_view_m[2], 0);
    for (std::size_t i = 0; i < a.size(); ++i)
        ASSERT_NEAR(a[i], b[i], 1e-4 * std::abs(a[i]) + 1e-12);
}

TEST_F(Robustness, ARolledProjectionTurnsThePictureAndThePatternStaysUprightOnScreen) {
    // Roll in the matrix: x and y of the screen come from other axes of view space, the picture is the same.
    const Frame upright = make_frame(80, 80);
    Frame rolled = upright;
    const auto& m = upright.clip_from_view;
    rolled.clip_from_view[0] = 0;
    rolled.clip_from_view[1] = m[5];
    rolled.clip_from_view[4] = -m[0];
    rolled.clip_from_view[5] = 0;
    Pattern pattern = make_pattern(glare::screen_geometry(upright).pitch, {.radius_nodes = 20});
    // An arm to the right tells the directions apart.
    for (int x = 26; x < 41; ++x)
        pattern.skirt[(20UL * 41 + x) * 4 + 1] += 500;
    const auto a = hdr_of(upright, pattern, {source_at_px(upright, 40.5, 40.5)});
    const auto b = hdr_of(rolled, pattern, {source_at_px(rolled, 40.5, 40.5)});
    for (std::size_t i = 0; i < a.size(); ++i)
        ASSERT_NEAR(a[i], b[i], 1e-3 * std::abs(a[i]) + 1e-9);
    EXPECT_GT(a[(40UL * 80 + 50) * 4 + 1], 2 * a[(40UL * 80 + 30) * 4 + 1]);
}

TEST_F(Robustness, GlareOfAnOffScreenLightReachesIn) {
    Frame frame = make_frame(120, 90);
    const Pattern pattern =
        make_pattern(glare::screen_geometry(frame).pitch, {.radius_nodes = 30, .with_tail = true});
    std::vector sources{source_at_px(frame, -40, 45, 1e-2)};
    RenderStats stats;
    ASSERT_EQ(ViewRenderer::cull(frame, {}, sources, stats), 1U);
    const auto hdr = hdr_of(frame, pattern, sources);
    const double angle_deg = std::atan(100.5 * glare::screen_geometry(frame).pitch) * 180 / pi -
                             std::atan(59.5 * glare::screen_geometry(frame).pitch) * 180 / pi;
    const double expected = 1e-2 * glare::cie_total_glare_sr(angle_deg, 24, 0.5);
    EXPECT_NEAR(hdr[(45UL * 120 + 0) * 4 + 1] / expected, 1, 0.1);
}

TEST_F(Robustness, ManyLightsThanOneChunkHoldsAreAllDrawn) {
    const Frame frame = make_frame(32, 32);
    Pattern pattern = make_pattern(glare::screen_geometry(frame).pitch, {.radius_nodes = 2});
    std::fill(pattern.skirt.begin(), pattern.skirt.end(), 0.0F);
    const std::vector sources(8192 + 100, source_at_px(frame, 16, 16, 1e-6));
    const auto hdr = hdr_of(frame, pattern, sources);
    EXPECT_EQ(stats_.lights_drawn, sources.size());
    EXPECT_NEAR(energy_lx(frame, hdr) / (0.6e-6 * static_cast<double>(sources.size())), 1, 1e-3);
}

TEST_F(Robustness, AnIncompleteTargetIsNamedAndNothingIsDrawn) {
    Frame frame = make_frame(32, 32);
    const Pattern pattern = make_pattern(glare::screen_geometry(frame).pitch, {.radius_nodes = 2});
    const GlObject empty(gl(), GlKind::framebuffer);
    gl().BindFramebuffer(GL_FRAMEBUFFER, empty.name());
    const std::vector sources{source_at_px(frame, 16, 16)};
    for (const GLuint fbo : {empty.name(), 999U}) {
        frame.target_fbo = fbo;
        try {
            renderer_->render(frame, {}, pattern, sources, stats_);
            ADD_FAILURE() << "no error";
        } catch (const glare::GlError& error) {
            EXPECT_NE(std::string(error.what()).find("target_fbo " + std::to_string(fbo)), std::string::npos);
        }
    }
}

TEST_F(Robustness, WritesOnlyTheFirstOfTheHostsDrawBuffers) {
    Frame frame = make_frame(32, 32);
    const Pattern pattern = make_pattern(glare::screen_geometry(frame).pitch, {.radius_nodes = 8});
    const Target first(gl(), 32, 32);
    const Target second(gl(), 32, 32);
    first.fill({0, 0, 0, 255});
    second.fill({77, 78, 79, 80});
    gl().BindFramebuffer(GL_FRAMEBUFFER, first.fbo());
    gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, second.texture(), 0);
    const std::array<GLenum, 2> buffers = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    gl().DrawBuffers(2, buffers.data());
    gl().ReadBuffer(GL_COLOR_ATTACHMENT1);
    frame.target_fbo = first.fbo();
    renderer_->render(frame, {}, pattern, std::vector{source_at_px(frame, 16, 16)}, stats_);
    GLint read_buffer = 0;
    gl().BindFramebuffer(GL_FRAMEBUFFER, first.fbo());
    gl().GetIntegerv(GL_READ_BUFFER, &read_buffer);
    EXPECT_EQ(read_buffer, GL_COLOR_ATTACHMENT1);
    EXPECT_GT(first.read()[(16UL * 32 + 16) * 4], 50);
    const auto untouched = second.read();
    for (std::size_t i = 0; i < untouched.size(); ++i)
        ASSERT_EQ(untouched[i], 77 + i % 4);
}

TEST_F(Robustness, HdrIsZeroAfterAFrameInWhichNothingWasDrawn) {
    const Frame frame = make_frame(32, 32);
    const Pattern pattern = make_pattern(glare::screen_geometry(frame).pitch, {.radius_nodes = 8});
    hdr_of(frame, pattern, {source_at_px(frame, 16, 16)});
    renderer_->mark_nothing_drawn(frame);
    for (const float value : read_hdr())
        ASSERT_EQ(value, 0);
    // A light whose glare cannot reach the picture gives the same by itself.
    RenderStats stats;
    PointSource behind = source_at_px(frame, 16, 16);
    for (float& p : behind.position_view_m)
        p = -p;
    EXPECT_EQ(renderer_->render(frame, {}, pattern, std::vector{behind}, stats),
              glare::RenderResult::nothing_to_draw);
    EXPECT_EQ(stats.draw_calls, 0U);
}

TEST_F(Robustness, PictureInACompatibilityContextIsThatOfACoreOne) {
    const Frame frame = make_frame(64, 48);
    const Pattern pattern =
        make_pattern(glare::screen_geometry(frame).pitch, {.radius_nodes = 20, .with_tail = true});
    const auto expected = hdr_of(frame, pattern, {source_at_px(frame, 30, 20, 1e-1)});
    renderer_.reset();
    context_.reset();
    context_ = std::make_unique<HeadlessContext>(HeadlessOptions{.profile = GlProfile::compatibility});
    renderer_ = std::make_unique<ViewRenderer>(gl());
    constexpr GLenum alpha_test = 0x0BC0;
    constexpr GLenum clamp_fragment_color = 0x891B;
    gl().Enable(alpha_test);
    gl().ClampColor(clamp_fragment_color, GL_TRUE);
    gl().ClampColor(GL_CLAMP_READ_COLOR, GL_TRUE);
    gl().PolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    gl().Enable(GL_CULL_FACE);
    gl().CullFace(GL_FRONT_AND_BACK);
    gl().Enable(GL_CLIP_DISTANCE0);
    gl().PixelStorei(GL_UNPACK_SKIP_ROWS, 3);
    gl().PixelStorei(GL_PACK_ROW_LENGTH, 1000);
    const auto actual = hdr_of(frame, pattern, {source_at_px(frame, 30, 20, 1e-1)});
    for (std::size_t i = 0; i < actual.size(); ++i)
        ASSERT_EQ(actual[i], expected[i]);
}

TEST_F(Robustness, AnAbandonedRendererMakesNoGlCall) {
    const Frame frame = make_frame(32, 32);
    const Pattern pattern = make_pattern(glare::screen_geometry(frame).pitch, {.radius_nodes = 8});
    hdr_of(frame, pattern, {source_at_px(frame, 16, 16)});
    context_->release();
    renderer_->abandon();
    renderer_.reset();  // without a current context a GL call would crash or be lost
    context_->make_current();
    SUCCEED();
}

}  // namespace
}  // namespace seaglare::test
