// Lash streaks turn and bend with a light's place in the picture: no light is lost, nothing jumps, eyes without lashes are
// as they were.
#include <algorithm>

#include "tests/gl/view_fixture.h"

namespace seaglare::test {
namespace {

class LashWarp : public ViewTest {
  protected:
    // The skirt alone, as one level streak: strong along u, narrow across.
    static Pattern streak(double pitch) {
        Pattern pattern = make_pattern(pitch);
        pattern.core_energy[0] = {};
        const int r = pattern.radius_nodes;
        std::size_t node = 0;
        for (int y = -r; y <= r; ++y) {
            for (int x = -r; x <= r; ++x, ++node) {
                const double fade = std::max(0.0, 1 - std::hypot(x, y) / (r - 8.0));
                const auto value = static_cast<float>(1e3 * fade * std::exp(-y * y / 8.0));
                for (std::size_t c = 0; c < 4; ++c)
                    pattern.skirt[node * 4 + c] = value;
            }
        }
        return pattern;
    }
    std::vector<float> drawn(const Frame& frame, Pattern pattern, double turn_rad, double bend_per_rad,
                             double x_px, double y_px) {
        pattern.generation = next_generation();
        pattern.lash_turn_rad = turn_rad;
        pattern.lash_bend_per_rad = bend_per_rad;
        ToneSettings tone;
        tone.threshold_codes = 0;
        return hdr_of(frame, pattern, {source_at_px(frame, x_px, y_px)}, tone);
    }
    // Mean height of the streak over the light, in pixels, `along_px` to its right.
    static double height_px(const Frame& frame, const std::vector<float>& hdr, int x_px, double y_px) {
        double sum = 0;
        double moment = 0;
        for (int y = 0; y < frame.viewport_px[3]; ++y) {
            const auto at = (static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.viewport_px[2]) +
                             static_cast<std::size_t>(x_px)) *
                                4 +
                            1;
            sum += static_cast<double>(hdr[at]);
            moment += static_cast<double>(hdr[at]) * (y + 0.5 - y_px);
        }
        return moment / sum;
    }
};

TEST_F(LashWarp, KeepsTheLightOfEveryPlace) {
    const Frame frame = make_frame(320, 240, 15);
    const Pattern pattern = streak(glare::screen_geometry(frame).pitch);
    for (const double x_px : {80.0, 120.0, 160.3, 240.0}) {
        for (const double y_px : {80.0, 120.4, 160.0}) {
            const double plain = energy_lx(frame, drawn(frame, pattern, 0, 0, x_px, y_px));
            const double warped = energy_lx(frame, drawn(frame, pattern, 0.2, 1.5, x_px, y_px));
            EXPECT_NEAR(warped / plain, 1, 0.003) << x_px << ", " << y_px;
        }
    }
}

TEST_F(LashWarp, TurnsOneWayLeftAndTheOtherRightAndNotInTheMiddle) {
    const Frame frame = make_frame(320, 240, 15);
    const Pattern pattern = streak(glare::screen_geometry(frame).pitch);
    const double turn = 0.15;
    const auto slope = [&](double x_px) {
        const auto hdr = drawn(frame, pattern, turn, 0, x_px, 120);
        const int at = static_cast<int>(x_px);
        return (height_px(frame, hdr, at + 20, 120) - height_px(frame, hdr, at - 20, 120)) / 40;
    };
    EXPECT_NEAR(slope(160), 0, 0.005);
    EXPECT_NEAR(slope(240), std::tan(turn), 0.015);  // half way to the edge the turn is largest
    EXPECT_NEAR(slope(80), -std::tan(turn), 0.015);
}

TEST_F(LashWarp, BendsAStreakByTheSquareOfItsAngle) {
    const Frame frame = make_frame(320, 240, 15);
    const double pitch = glare::screen_geometry(frame).pitch;
    const Pattern pattern = streak(pitch);
    const double bend = 3;
    const auto hdr = drawn(frame, pattern, 0, bend, 160.5, 120);
    for (const int along : {-30, -15, 15, 30})
        EXPECT_NEAR(height_px(frame, hdr, 160 + along, 120), bend * pitch * along * along, 0.15) << along;
}

// Half a pixel further nothing may jump: the difference of two neighbours is what moving the streak makes.
TEST_F(LashWarp, NothingPopsAsALightCrossesThePicture) {
    const Frame frame = make_frame(200, 150, 9.4);
    const Pattern pattern = streak(glare::screen_geometry(frame).pitch);
    std::vector<float> before;
    double still = 0;
    double largest = 0;
    for (double x_px = -20; x_px <= 220; x_px += 0.5) {
        const auto plain = drawn(frame, pattern, 0, 0, x_px, 75);
        const auto now = drawn(frame, pattern, 0.15, 1, x_px, 75);
        double peak = 0;
        double change = 0;
        for (std::size_t i = 1; i < now.size(); i += 4) {
            peak = std::max(peak, static_cast<double>(plain[i]));
            if (!before.empty()) change = std::max(change, static_cast<double>(std::abs(now[i] - before[i])));
        }
        still = std::max(still, peak);
        largest = std::max(largest, change);
        before = now;
    }
    EXPECT_LT(largest, 0.15 * still);
}

// Two channels that abut: a light on their common edge has one look in both.
TEST_F(LashWarp, AtTheSidesOfThePictureThereIsNoTurn) {
    const Frame frame = make_frame(200, 150, 9.4);
    const Pattern pattern = streak(glare::screen_geometry(frame).pitch);
    const auto left = drawn(frame, pattern, 0.3, 0, 0, 75);
    EXPECT_NEAR(height_px(frame, left, 20, 75), 0, 0.05);
    const auto right = drawn(frame, pattern, 0.3, 0, 200, 75);
    EXPECT_NEAR(height_px(frame, right, 180, 75), 0, 0.05);
}

}  // namespace
}  // namespace seaglare::test
