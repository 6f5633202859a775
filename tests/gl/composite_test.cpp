// What the host's pixels become: the GL tone curve against the double-precision one, in each encoding.
#include <algorithm>
#include <cstdlib>
#include <utility>

#include "glare/tone/operators.h"
#include "tests/gl/view_fixture.h"

namespace seaglare::test {
namespace {

using glare::CompositeMode;
using glare::Rgb;
using glare::TargetEncoding;

class Composite : public ViewTest {
  protected:
    // Renders one light over a background and compares every pixel with the CPU operator on the same HDR values.
    // Returns how many pixels the light changed.
    int compare(GLenum format, TargetEncoding encoding, std::array<std::uint8_t, 4> background,
                ToneSettings tone, Frame frame, PointSource source) {
        tone.dither = false;
        const int width = frame.viewport_px[2];
        const Pattern pattern =
            make_pattern(glare::screen_geometry(frame).pitch, {.radius_nodes = 30, .with_tail = true});
        const Target target(gl(), width, frame.viewport_px[3], format);
        target.fill(background);
        const auto before = target.read();
        frame.target_fbo = target.fbo();
        frame.target_encoding = encoding;
        renderer_->render(frame, tone, pattern, std::vector{source}, stats_);
        const auto hdr = read_hdr();
        const auto after = target.read();
        int changed = 0;
        int worst = 0;
        for (std::size_t i = 0; i < hdr.size(); i += 4) {
            Rgb linear{};
            for (std::size_t c = 0; c < 3; ++c) {
                const double stored = before[i + c] / 255.0;
                linear[c] = encoding == TargetEncoding::linear ? stored : glare::srgb_decode(stored);
            }
            const Rgb delta =
                glare::display_delta(tone, frame.adaptation_luminance_cd_m2, frame.ldr_white_luminance_cd_m2,
                                     linear, {hdr[i], hdr[i + 1], hdr[i + 2]}, hdr[i + 3]);
            for (std::size_t c = 0; c < 3; ++c) {
                const double sum = std::min(1.0, linear[c] + delta[c]);
                const double expected = encoding == TargetEncoding::linear ? sum : glare::srgb_encode(sum);
                worst =
                    std::max(worst, std::abs(static_cast<int>(std::lround(expected * 255)) - after[i + c]));
                changed += after[i + c] != before[i + c];
            }
            EXPECT_EQ(after[i + 3], before[i + 3]) << "alpha is the host's";
        }
        EXPECT_LE(worst, 1);
        return changed;
    }
    int compare_all(GLenum format, TargetEncoding encoding, ToneSettings tone = {}, double ldr_white = 0) {
        int changed = 0;
        for (const std::array<std::uint8_t, 4> background : {std::array<std::uint8_t, 4>{0, 0, 0, 255},
                                                             {9, 12, 20, 200},
                                                             {120, 90, 60, 0},
                                                             {250, 255, 240, 255}}) {
            for (const std::array<float, 3> rgb :
                 {std::array<float, 3>{1, 1, 1}, {4.703F, 0, 0}, {-0.97F, 1.69F, -0.07F}}) {
                for (const double adaptation : {0.001, 1.0}) {
                    Frame frame = make_frame(64, 48);
                    frame.adaptation_luminance_cd_m2 = adaptation;
                    frame.ldr_white_luminance_cd_m2 = ldr_white;
                    changed +=
                        compare(format, encoding, background, tone, frame,
                                source_at_px(frame, 30.3, 22.8, 1e-4 * adaptation / 0.001, 1000, 0, rgb));
                }
            }
        }
        return changed;
    }
};

TEST_F(Composite, OfSrgbValuesIsTheCpuOperatorWithinOneCode) {
    EXPECT_GT(compare_all(GL_RGBA8, TargetEncoding::srgb_values), 1000);
}

TEST_F(Composite, OfAnSrgbFormatIsTheCpuOperatorWithinOneCode) {
    EXPECT_GT(compare_all(GL_SRGB8_ALPHA8, TargetEncoding::srgb_format), 1000);
}

TEST_F(Composite, OfLinearValuesIsTheCpuOperatorWithinOneCode) {
    EXPECT_GT(compare_all(GL_RGBA8, TargetEncoding::linear), 1000);
}

TEST_F(Composite, InPlainModeAndWithTheHostsWhiteIsTheCpuOperatorWithinOneCode) {
    ToneSettings plain;
    plain.mode = CompositeMode::plain;
    EXPECT_GT(compare_all(GL_RGBA8, TargetEncoding::srgb_values, plain), 1000);
    EXPECT_GT(compare_all(GL_RGBA8, TargetEncoding::srgb_values, {}, 0.5), 1000);
}

// A float target shows what rounding to codes hides. Every code of a host's channel, beside others; lights of every brightness.
TEST_F(Composite, IsTheCpuOperatorWithinAHundredthOfACodeOverEveryHostPixel) {
    constexpr int width = 256;
    constexpr int height = 40;
    std::vector<std::uint8_t> picture;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::array<int, 4> turns = {x, y % 2 == 0 ? x : 255 - x, (x * 7 + y * 13) % 256, 255};
            for (const int code : turns)
                picture.push_back(static_cast<std::uint8_t>(code));
        }
    }
    ToneSettings plain;
    plain.mode = CompositeMode::plain;
    ToneSettings no_rods;
    no_rods.blue_shift = false;
    const Target target(gl(), width, height, GL_RGBA32F);
    double worst = 0;
    int lit = 0;
    for (const ToneSettings& tone : {ToneSettings{}, plain, no_rods}) {
        for (const double ldr_white : {0.0, 0.5}) {
            for (const auto encoding : {TargetEncoding::srgb_values, TargetEncoding::linear}) {
                for (const std::array<float, 3> rgb :
                     {std::array<float, 3>{1, 1, 1}, {4.703F, 0, 0}, {-0.97F, 1.69F, -0.07F}}) {
                    Frame frame = make_frame(width, height);
                    frame.adaptation_luminance_cd_m2 = 0.001;
                    frame.ldr_white_luminance_cd_m2 = ldr_white;
                    frame.target_fbo = target.fbo();
                    frame.target_encoding = encoding;
                    target.upload(picture);
                    const auto before = target.read_floats();
                    const Pattern pattern = make_pattern(glare::screen_geometry(frame).pitch,
                                                         {.radius_nodes = 30, .with_tail = true});
                    renderer_->render(frame, tone, pattern,
                                      std::vector{source_at_px(frame, 30.3, 17.8, 1e-2, 1000, 0, rgb),
                                                  source_at_px(frame, 190.3, 17.8, 1e-4, 1000, 0, rgb)},
                                      stats_);
                    const auto hdr = read_hdr();
                    const auto after = target.read_floats();
                    for (std::size_t i = 0; i < hdr.size(); i += 4) {
                        Rgb linear{};
                        for (std::size_t c = 0; c < 3; ++c) {
                            const auto stored = static_cast<double>(before[i + c]);
                            linear[c] =
                                encoding == TargetEncoding::linear ? stored : glare::srgb_decode(stored);
                        }
                        const Rgb delta =
                            glare::display_delta(tone, frame.adaptation_luminance_cd_m2, ldr_white, linear,
                                                 {hdr[i], hdr[i + 1], hdr[i + 2]}, hdr[i + 3]);
                        for (std::size_t c = 0; c < 3; ++c) {
                            const auto is = static_cast<double>(after[i + c]);
                            const double code =
                                encoding == TargetEncoding::linear ? glare::srgb_encode(is) : is;
                            const double expected = glare::srgb_encode(linear[c] + delta[c]);
                            worst = std::max(worst, 255 * std::abs(std::min(code, 1.0) - expected));
                            lit += delta[c] > 1e-3;
                        }
                    }
                }
            }
        }
    }
    EXPECT_GT(lit, 100000);
    EXPECT_LE(worst, 0.01);
}

TEST_F(Composite, OnAFloatTargetKeepsTheHostsPixelAndAddsTheDelta) {
    Frame frame = make_frame(48, 48);
    const Pattern pattern = make_pattern(glare::screen_geometry(frame).pitch, {.radius_nodes = 20});
    const Target target(gl(), 48, 48, GL_RGBA16F);
    target.fill({64, 64, 64, 255});
    const auto before = target.read_floats();
    frame.target_fbo = target.fbo();
    frame.target_encoding = TargetEncoding::linear;
    renderer_->render(frame, {}, pattern, std::vector{source_at_px(frame, 24, 24)}, stats_);
    const auto after = target.read_floats();
    const auto hdr = read_hdr();
    const std::size_t middle = (24UL * 48 + 24) * 4;
    const double expected = glare::display_delta(
        {}, frame.adaptation_luminance_cd_m2, 0, {before[middle], before[middle], before[middle]},
        {hdr[middle], hdr[middle + 1], hdr[middle + 2]}, hdr[middle + 3])[1];
    EXPECT_NEAR(after[middle + 1] - before[middle + 1], expected, 2e-3);
}

TEST_F(Composite, LeavesUnlitPixelsAndThoseOutsideTheViewportBitIdentical) {
    Frame frame = make_frame(60, 40);
    frame.viewport_px = {17, 9, 60, 40};
    const Pattern pattern = make_pattern(glare::screen_geometry(frame).pitch, {.radius_nodes = 8});
    const Target target(gl(), 100, 70);
    std::vector<std::uint8_t> picture(100UL * 70 * 4);
    for (std::size_t i = 0; i < picture.size(); ++i)
        picture[i] = static_cast<std::uint8_t>(i * 7919 % 251);
    target.upload(picture);
    frame.target_fbo = target.fbo();
    renderer_->render(frame, {}, pattern, std::vector{source_at_px(frame, 3.2, 37.7, 1e-3)}, stats_);
    const auto hdr = read_hdr();
    const auto after = target.read();
    int lit = 0;
    for (int y = 0; y < 70; ++y) {
        for (int x = 0; x < 100; ++x) {
            const std::size_t i = (static_cast<std::size_t>(y) * 100 + x) * 4;
            const int vx = x - 17;
            const int vy = y - 9;
            const bool inside = vx >= 0 && vx < 60 && vy >= 0 && vy < 40;
            if (inside && hdr[(static_cast<std::size_t>(vy) * 60 + vx) * 4 + 1] > 0) {
                ++lit;
                continue;
            }
            for (std::size_t c = 0; c < 4; ++c)
                ASSERT_EQ(after[i + c], picture[i + c]) << x << ", " << y;
        }
    }
    EXPECT_GT(lit, 50);
}

TEST_F(Composite, OfAMultisampledTargetIsThatOfAPlainOne) {
    using TexImage2DMultisample = void (*)(GLenum, GLsizei, GLenum, GLsizei, GLsizei, GLboolean);
    const auto storage = reinterpret_cast<TexImage2DMultisample>(
        HeadlessContext::get_proc(nullptr, "glTexImage2DMultisample"));
    Frame frame = make_frame(64, 64);
    const Pattern pattern = make_pattern(glare::screen_geometry(frame).pitch, {.radius_nodes = 20});
    const auto source = source_at_px(frame, 31.4, 30.2);
    ToneSettings tone;
    tone.dither = false;

    const Target plain(gl(), 64, 64);
    plain.fill({20, 30, 40, 255});
    frame.target_fbo = plain.fbo();
    renderer_->render(frame, tone, pattern, std::vector{source}, stats_);
    const auto expected = plain.read();

    const GlObject texture(gl(), GlKind::texture);
    const GlObject fbo(gl(), GlKind::framebuffer);
    gl().BindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture.name());
    storage(GL_TEXTURE_2D_MULTISAMPLE, 4, GL_RGBA8, 64, 64, GL_TRUE);
    gl().BindFramebuffer(GL_FRAMEBUFFER, fbo.name());
    gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D_MULTISAMPLE, texture.name(),
                              0);
    gl().Disable(GL_SCISSOR_TEST);
    gl().ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    const std::array<float, 4> grey = {20 / 255.0F, 30 / 255.0F, 40 / 255.0F, 1};
    gl().ClearBufferfv(GL_COLOR, 0, grey.data());
    frame.target_fbo = fbo.name();
    renderer_->render(frame, tone, pattern, std::vector{source}, stats_);

    const Target resolved(gl(), 64, 64);
    glare::set_neutral_state(gl());
    gl().BindFramebuffer(GL_READ_FRAMEBUFFER, fbo.name());
    gl().BindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved.fbo());
    gl().BlitFramebuffer(0, 0, 64, 64, 0, 0, 64, 64, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    const auto actual = resolved.read();
    for (std::size_t i = 0; i < actual.size(); ++i)
        ASSERT_NEAR(actual[i], expected[i], 1);
    EXPECT_GT(*std::max_element(actual.begin(), actual.end() - 1), 60);
}

TEST_F(Composite, WorksOnTheWindowsFramebuffer) {
    Frame frame = make_frame(64, 64);
    const Pattern pattern = make_pattern(glare::screen_geometry(frame).pitch, {.radius_nodes = 20});
    glare::set_neutral_state(gl());
    gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl().ClearColor(0, 0, 0, 1);
    gl().Clear(GL_COLOR_BUFFER_BIT);
    renderer_->render(frame, {}, pattern, std::vector{source_at_px(frame, 32, 32)}, stats_);
    std::array<std::uint8_t, 4> pixel{};
    gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl().ReadPixels(31, 31, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
    EXPECT_GT(pixel[1], 100);
}

TEST_F(Composite, TellsRedGreenAndWhiteApartByStarlight) {
    const std::array<std::array<float, 3>, 3> colours = {
        {{4.703F, 0, 0}, {0.016F, 1.370F, 0.233F}, {1, 1, 1}}};
    const std::array<float, 3> scotopic_ratio = {0.046F, 2.77F, 2.464F};
    std::array<std::array<double, 3>, 3> seen{};
    for (std::size_t k = 0; k < 3; ++k) {
        Frame frame = make_frame(64, 64, 4);  // 720 lines of 45 degrees
        frame.adaptation_luminance_cd_m2 = 0.001;
        const Pattern pattern = make_pattern(glare::screen_geometry(frame).pitch, {.radius_nodes = 20});
        const Target target(gl(), 64, 64);
        target.fill({7, 8, 10, 255});
        frame.target_fbo = target.fbo();
        // 77 cd at 5 sea miles in clear air: the limit of a 5 mile light.
        PointSource source = source_at_px(frame, 32, 32, 1e-6, 9260, 0.1, colours[k]);
        source.illuminance_scotopic_lx = scotopic_ratio[k] * 1e-6F;
        renderer_->render(frame, {}, pattern, std::vector{source}, stats_);
        const auto pixels = target.read();
        for (std::size_t c = 0; c < 3; ++c)
            seen[k][c] = glare::srgb_decode(pixels[(31UL * 64 + 31) * 4 + c] / 255.0);
    }
    EXPECT_GT(seen[0][0], 2 * seen[0][1]);
    EXPECT_GT(seen[0][0], 2 * seen[0][2]);
    EXPECT_GT(seen[1][1], 2 * seen[1][0]);
    EXPECT_GT(seen[1][1], 1.5 * seen[1][2]);
    EXPECT_NEAR(seen[2][0] / seen[2][1], 1, 0.3);
    EXPECT_NEAR(seen[2][2] / seen[2][1], 1, 0.3);
}

TEST_F(Composite, DithersWithoutLightingWhatGlareReachesByLessThanAQuarterOfACode) {
    Frame frame = make_frame(200, 100);
    const Pattern pattern =
        make_pattern(glare::screen_geometry(frame).pitch, {.radius_nodes = 40, .with_tail = true});
    ToneSettings tone;
    tone.threshold_codes = 0;
    for (const auto& [format, encoding] : {std::pair{GL_RGBA8, TargetEncoding::srgb_values},
                                           std::pair{GL_SRGB8_ALPHA8, TargetEncoding::srgb_format}}) {
        const Target target(gl(), 200, 100, static_cast<GLenum>(format));
        target.fill({0, 0, 0, 255});
        frame.target_fbo = target.fbo();
        frame.target_encoding = encoding;
        renderer_->render(frame, tone, pattern, std::vector{source_at_px(frame, 30, 50, 6e-4)}, stats_);
        const auto pixels = target.read();
        const auto hdr = read_hdr();
        double sum = 0;
        double expected_sum = 0;
        int in_between = 0;
        for (std::size_t i = 0; i < hdr.size(); i += 4) {
            const Rgb delta = glare::display_delta(tone, frame.adaptation_luminance_cd_m2, 0, {0, 0, 0},
                                                   {hdr[i], hdr[i + 1], hdr[i + 2]}, hdr[i + 3]);
            const double code = glare::srgb_encode(delta[1]) * 255;
            if (code < 0.25) {
                ASSERT_EQ(pixels[i + 1], 0);
            }
            if (code > 0.7 && code < 6) {
                ++in_between;
                sum += pixels[i + 1];
                expected_sum += code;
            }
            ASSERT_NEAR(pixels[i + 1], code, encoding == TargetEncoding::srgb_format ? 1.5 : 1.01)
                << "a driver's own sRGB may be half a code off";
        }
        ASSERT_GT(in_between, 100);
        EXPECT_NEAR(sum / expected_sum, 1, 0.04);
    }
}

}  // namespace
}  // namespace seaglare::test
