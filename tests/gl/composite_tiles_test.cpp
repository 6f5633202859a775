// Tiles that cannot change a code are left out of the last pass: that spares work and changes no byte.
#include <algorithm>
#include <cmath>
#include <random>

#include "glare/apply/compositor.h"
#include "glare/tone/operators.h"
#include "tests/gl/view_fixture.h"

namespace seaglare::test {
namespace {

using glare::Compositor;
using glare::HdrSum;
using glare::RowRange;
using glare::TargetEncoding;

constexpr int width_px = 200;
constexpr int height_px = 100;

class CompositeTiles : public ViewTest {
  protected:
    void SetUp() override {
        ViewTest::SetUp();
        if (!context_) return;
        vertex_array_ = std::make_unique<GlObject>(gl(), GlKind::vertex_array);
        compositor_ = std::make_unique<Compositor>(gl());
        sum_ = std::make_unique<HdrSum>(gl());
        // Every code of a channel beside every other.
        std::mt19937 random(3);
        for (int i = 0; i < width_px * height_px * 4; ++i)
            picture_.push_back(static_cast<std::uint8_t>(random() % 256));
    }
    void TearDown() override {
        sum_.reset();
        compositor_.reset();
        vertex_array_.reset();
        ViewTest::TearDown();
    }
    struct Drawn {
        std::vector<std::uint8_t> bytes;
        std::uint32_t draws = 0;
    };
    double least(Frame frame, const Target& target, const ToneSettings& tone) {
        frame.target_fbo = target.fbo();
        compositor_->begin(frame);
        return compositor_->least_cd_m2(frame, tone);
    }
    // The sum over the picture, with what is below `least_cd_m2` left out.
    Drawn draw(Frame frame, const Target& target, const ToneSettings& tone, const std::vector<float>& rgbv,
               double least_cd_m2) {
        glare::set_neutral_state(gl());
        gl().BindVertexArray(vertex_array_->name());
        target.upload(picture_);
        frame.target_fbo = target.fbo();
        compositor_->begin(frame);
        sum_->begin(width_px, height_px, 0, least_cd_m2);
        Drawn drawn;
        for (int first = 0; first < height_px; first += glare::band_rows) {
            const RowRange band{first, std::min(glare::band_rows, height_px - first)};
            const auto row = static_cast<std::size_t>(width_px) * 4;
            sum_->fill(band, std::span(rgbv).subspan(row * static_cast<std::size_t>(first),
                                                     row * static_cast<std::size_t>(band.count)));
            drawn.draws += compositor_->draw(frame, tone, *sum_, {0, band.first, width_px, band.end()});
        }
        drawn.bytes = target.read();
        return drawn;
    }

    std::unique_ptr<GlObject> vertex_array_;
    std::unique_ptr<Compositor> compositor_;
    std::unique_ptr<HdrSum> sum_;
    std::vector<std::uint8_t> picture_;
};

TEST_F(CompositeTiles, JustBelowTheLeastChangeNoByteOfAnyHostPixelAndAreNotDrawn) {
    for (const auto& [format, encoding] :
         {std::pair{GL_RGBA8, TargetEncoding::srgb_values}, std::pair{GL_RGBA8, TargetEncoding::linear}}) {
        for (const double adaptation : {1e-3, 1.0, 300.0}) {
            for (const bool dither : {true, false}) {
                Frame frame = make_frame(width_px, height_px);
                frame.target_encoding = encoding;
                frame.adaptation_luminance_cd_m2 = adaptation;
                const Target target(gl(), width_px, height_px, static_cast<GLenum>(format));
                ToneSettings tone;
                tone.dither = dither;
                const double least_cd_m2 = least(frame, target, tone);
                ASSERT_GT(least_cd_m2, 0);
                const auto l = static_cast<float>(0.999 * least_cd_m2);
                // White, one channel, a colour outside the gamut whose channels are the least apart, rods alone.
                for (const std::array<float, 4>& colour : {std::array<float, 4>{l, l, l, l},
                                                           {l, 0, 0, 0},
                                                           {-0.3F * l, 0.7F * l, 0, 0},
                                                           {0, 0, 0, 1.95F * l}}) {
                    std::vector<float> rgbv;
                    for (int i = 0; i < width_px * height_px; ++i)
                        rgbv.insert(rgbv.end(), colour.begin(), colour.end());
                    const Drawn all = draw(frame, target, tone, rgbv, 0);
                    EXPECT_EQ(all.draws, 2U);
                    EXPECT_EQ(all.bytes, picture_) << adaptation;
                    EXPECT_EQ(draw(frame, target, tone, rgbv, least_cd_m2).draws, 0U);
                    for (float& value : rgbv)
                        value *= 1.01F;
                    EXPECT_EQ(draw(frame, target, tone, rgbv, least_cd_m2).draws, 2U);
                }
            }
        }
    }
}

TEST_F(CompositeTiles, OfALightThatFallsOffLeaveOutMostAndChangeNoByte) {
    Frame frame = make_frame(width_px, height_px);
    const Target target(gl(), width_px, height_px);
    const ToneSettings tone;
    const double least_cd_m2 = least(frame, target, tone);
    std::vector<float> rgbv;
    for (int y = 0; y < height_px; ++y) {
        for (int x = 0; x < width_px; ++x) {
            const double l = least_cd_m2 * 400 / (1 + std::pow(x - 40.3, 2) + std::pow(y - 50.7, 2));
            for (const double part : {1.2, 0.9, 0.7, 2.0})
                rgbv.push_back(static_cast<float>(part * l));
        }
    }
    const Drawn all = draw(frame, target, tone, rgbv, 0);
    const Drawn lit = draw(frame, target, tone, rgbv, least_cd_m2);
    EXPECT_EQ(lit.bytes, all.bytes);
    EXPECT_NE(lit.bytes, picture_);
    double covered_px = 0;
    sum_->fill({0, 64}, std::span(rgbv).first(64UL * width_px * 4));
    for (const glare::PixelBox& box : sum_->tiles().boxes_in({0, 0, width_px, 64}))
        covered_px += box.width() * box.height();
    EXPECT_LT(covered_px, 0.5 * 64 * width_px);
}

TEST_F(CompositeTiles, OfATargetThatShowsEverythingAreAllThatHaveAnyLight) {
    const Frame frame = make_frame(width_px, height_px);
    const Target floating(gl(), width_px, height_px, GL_RGBA32F);
    EXPECT_EQ(least(frame, floating, {}), 0);
    // Where white is below 1 the curve is steeper far up than at its beginning.
    ToneSettings steep;
    steep.white = 0.5;
    const Target target(gl(), width_px, height_px);
    EXPECT_EQ(least(frame, target, steep), 0);
    std::vector<float> rgbv(static_cast<std::size_t>(width_px) * height_px * 4);
    EXPECT_EQ(draw(frame, floating, {}, rgbv, 0).draws, 0U);
    rgbv[1] = 1e-30F;
    EXPECT_EQ(draw(frame, floating, {}, rgbv, 0).draws, 1U);
}

}  // namespace
}  // namespace seaglare::test
