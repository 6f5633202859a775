// The stub host's picture: is the horizon where it belongs, is the sea darker than the sky, is the depth true?
#include "host_stub/night_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "host_stub/render_target.h"
#include "tests/scene_host.h"

namespace seaglare::host {
namespace {

constexpr double deg = std::numbers::pi / 180;

class NightScenePicture : public testing::Test {
  protected:
    void SetUp() override {
        std::string why_not;
        gl = headless_context(why_not);
        if (!gl) GTEST_SKIP() << why_not;
        scene.origin = {55, 11};
        scene.local_time_h = 22;
        scene.sky.sun = {-9, 300};
        scene.sky.stars = false;
        scene.wind_speed_m_s = 3;
        Observer o;
        o.eye_height_m = 20;
        o.heading_deg = 90;
        scene.observers = {o};
        channel.width_px = 320;
        channel.height_px = 200;
        channel.up_deg = 20, channel.down_deg = -20;
        channel.right_deg = std::atan(std::tan(20 * deg) * 1.6) / deg;
        channel.left_deg = -channel.right_deg;
        scene.channels = {channel};
    }

    // Draws and keeps the picture (upper row first) and the depth (lower row first).
    void draw(double pitch_deg = 0) {
        const Observer& o = scene.observers[0];
        camera = make_camera(channel, {o.position_m, o.eye_height_m}, o.heading_deg, pitch_deg);
        target = std::make_unique<RenderTarget>(channel.width_px, channel.height_px, channel.target);
        NightScene picture(scene);
        glBindFramebuffer(GL_FRAMEBUFFER, target->multisampled_fbo());
        picture.draw(camera, channel);
        target->resolve();
        pixels = target->read_srgb_rgba8();
        depth = target->read_depth();
        ASSERT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    }
    // Mean code of a row, counted from the lower edge.
    double row_code(int row) const {
        double sum = 0;
        for (int x = 0; x < channel.width_px; ++x)
            for (int c = 0; c < 3; ++c)
                sum += pixels[(static_cast<std::size_t>(channel.height_px - 1 - row) * channel.width_px + x) *
                                  4 +
                              c];
        return sum / (3.0 * channel.width_px);
    }
    double depth_px(int x, int row) const {
        return depth[static_cast<std::size_t>(row) * channel.width_px + x];
    }

    std::unique_ptr<HeadlessContext> gl;
    Scene scene;
    Channel channel;
    Camera camera;
    std::unique_ptr<RenderTarget> target;
    std::vector<std::uint8_t> pixels;
    std::vector<float> depth;
};

TEST_F(NightScenePicture, TheHorizonLiesInItsRowAndTheSkyAboveItIsBrighterThanTheSea) {
    for (const double pitch_deg : {0.0, 6.0, -4.0}) {
        draw(pitch_deg);
        const double horizon = horizon_row_px(channel, camera);
        const int above = static_cast<int>(std::floor(horizon)) + 2,
                  below = static_cast<int>(std::floor(horizon)) - 3;
        EXPECT_GT(row_code(above), row_code(below) + 2) << "pitch " << pitch_deg;
        // The strongest step between neighbouring rows is there, too.
        int steepest = 0;
        double step = 0;
        for (int row = 40; row < channel.height_px - 40; ++row)
            if (const double s = row_code(row) - row_code(row - 1); s > step) {
                step = s;
                steepest = row;
            }
        EXPECT_NEAR(steepest, horizon, 1.01) << "pitch " << pitch_deg;
    }
}

TEST_F(NightScenePicture, TheSkyIsAtTheFarPlaneAndTheSeaAtItsDistance) {
    draw();
    EXPECT_EQ(depth_px(160, 150), 1.0F);
    const double focal_px = 100 / std::tan(20 * deg);
    for (const int row : {10, 50, 80, 95}) {
        // The plane z = 0 under the pixel's centre, 20 m below the eye: this far ahead.
        const double ahead_m = 20 * focal_px / (100 - (row + 0.5));
        EXPECT_NEAR(depth_px(160, row), depth_at(camera, ahead_m), 2e-6) << "row " << row;
    }
}

TEST_F(NightScenePicture, APierStandsBeforeTheSkyAsASilhouetteAtItsDistance) {
    Structure wall;
    wall.from_m = {500, -50};
    wall.to_m = {500, 50};
    wall.width_m = wall.top_width_m = 10;
    wall.top_m = wall.to_top_m = 60;
    scene.structures = {wall};
    draw();
    // Its near face is 495 m ahead.
    EXPECT_NEAR(depth_px(160, 105), depth_at(camera, 495), 1e-6);
    const auto code = [&](int x, int row) {
        return pixels[(static_cast<std::size_t>(channel.height_px - 1 - row) * channel.width_px + x) * 4 + 1];
    };
    EXPECT_LT(code(160, 105) + 3, code(280, 105));
}

TEST_F(NightScenePicture, ACoastRisesAboveTheHorizonAndHidesTheSky) {
    Coast coast;
    coast.shore_m = {{3000, 4000}, {3000, -4000}};  // land on the left hand going south: to the east
    coast.height_m = 60;
    coast.roughness = 0.3;
    scene.coasts = {coast};
    draw();
    const int above = static_cast<int>(horizon_row_px(channel, camera)) + 2;
    const double d = depth_px(160, above);
    EXPECT_GT(d, depth_at(camera, 3000));
    EXPECT_LT(d, depth_at(camera, 3000 + 2.2 * coast.setback_m + 10));
}

TEST_F(NightScenePicture, GradientsAreDitheredNotBanded) {
    draw();
    // In a banded sky most rows hold one code only; dithered, the codes of one row differ by one or two.
    int mixed_rows = 0, rows = 0;
    for (int row = 130; row < 190; ++row, ++rows) {
        bool mixed = false;
        for (int x = 150; x < 170; ++x) {
            const std::size_t i =
                (static_cast<std::size_t>(channel.height_px - 1 - row) * channel.width_px + x) * 4 + 2;
            mixed |= pixels[i] != pixels[i + 4];
        }
        mixed_rows += mixed;
    }
    EXPECT_EQ(mixed_rows, rows);
}

TEST_F(NightScenePicture, TheSameMomentGivesTheSamePicture) {
    draw();
    const auto first = pixels;
    draw();
    EXPECT_EQ(first, pixels);
}

TEST_F(NightScenePicture, TheThreeEncodingsShowTheSamePicture) {
    draw();
    const auto plain = pixels;
    for (const TargetFormat format : {TargetFormat::srgb8_alpha8, TargetFormat::rgba16f_linear}) {
        channel.target = format;
        draw();
        int worst = 0;
        double sum = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const int difference = std::abs(pixels[i] - plain[i]);
            worst = std::max(worst, difference);
            sum += difference;
        }
        // The linear target has no dither; the others differ by the rounding of a decode and an encode.
        EXPECT_LE(worst, 2);
        EXPECT_LT(sum / static_cast<double>(pixels.size()), 0.6);
    }
}

TEST_F(NightScenePicture, ByNightTheSkyIsDarkerThanAtDusk) {
    const double dusk = [&] {
        NightScene picture(scene);
        return picture.adaptation_luminance_cd_m2();
    }();
    scene.sky.sun = {-30, 0};
    NightScene picture(scene);
    EXPECT_LT(picture.adaptation_luminance_cd_m2(), dusk / 10);
    // Thirty degrees below at midnight; six hours on, the sun is near the horizon again.
    picture.set_moment({0, 30, {}});
    EXPECT_GT(picture.sun_elevation_deg(), -15);
}

}  // namespace
}  // namespace seaglare::host
