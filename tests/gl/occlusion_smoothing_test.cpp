// What hides a light and shows it again, in time: values on the GPU, and on the CPU a little later.
#include <algorithm>
#include <cmath>
#include <optional>

#include "glare/apply/light_instance.h"
#include "glare/apply/occlusion.h"
#include "tests/gl/view_fixture.h"

namespace seaglare::test {
namespace {

constexpr int size_px = 64;
constexpr double wall_m = 500;

// One sampler of visibility as the renderer has it, without the rest of the renderer.
class OcclusionInTime : public ViewTest {
  protected:
    void SetUp() override {
        ViewTest::SetUp();
        if (IsSkipped()) return;
        glare::set_neutral_state(gl());
        vertex_array_ = GlObject(gl(), GlKind::vertex_array);
        gl().BindVertexArray(vertex_array_.name());
        light_buffer_ = std::make_unique<glare::LightBuffer>(gl());
        occlusion_ = std::make_unique<glare::Occlusion>(gl());
        depth_ = GlObject(gl(), GlKind::texture);
        frame_ = make_frame(size_px, size_px);
        frame_.depth_source = glare::DepthSource::texture;
        frame_.depth_object = depth_.name();
        frame_.occlusion.smoothing_s = 0.2;
        geometry_ = glare::screen_geometry(frame_);
        wall(false);
    }
    void TearDown() override {
        occlusion_.reset();
        light_buffer_.reset();
        vertex_array_.reset();
        depth_.reset();
        ViewTest::TearDown();
    }
    // Stands before all lights, in the columns from first_column on.
    void wall(bool there, int first_column = 0) {
        const auto& m = frame_.clip_from_view;
        const double stored = ((-m[10] * wall_m + m[14]) / wall_m + 1) / 2;
        std::vector<float> values(size_px * size_px, 1.0F);
        if (there) {
            for (std::size_t i = 0; i < values.size(); ++i) {
                if (static_cast<int>(i % size_px) >= first_column) values[i] = static_cast<float>(stored);
            }
        }
        gl().ActiveTexture(GL_TEXTURE2);
        gl().BindTexture(GL_TEXTURE_2D, depth_.name());
        gl().TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, size_px, size_px, 0, GL_DEPTH_COMPONENT,
                        GL_FLOAT, values.data());
        for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
            gl().TexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
        gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    }
    void add(std::uint32_t tag, double x_px) {
        sources_.push_back(source_at_px(frame_, x_px, 32, 1e-4, 1000, 0.05));
        sources_.back().tag = tag;
    }
    // Visibility of each source at a time.
    std::vector<float> at(double time_s) {
        frame_.time_s = time_s;
        instances_.clear();
        tags_.clear();
        const Pattern pattern = make_pattern(geometry_.pitch, {.radius_nodes = 4});
        glare::append_instances(geometry_, pattern, {}, sources_, instances_, &tags_);
        EXPECT_EQ(instances_.size(), sources_.size());
        occlusion_->begin(frame_, instances_, tags_);
        std::vector<float> seen;
        for (std::size_t first = 0; first < instances_.size(); first += glare::lights_per_chunk) {
            const std::size_t count = std::min(glare::lights_per_chunk, instances_.size() - first);
            light_buffer_->upload(std::span(instances_).subspan(first, count));
            draws_ = occlusion_->draw(frame_, geometry_, first, static_cast<int>(count));
            if (draws_ == 0) continue;
            const std::size_t rows = (count + 255) / 256;
            std::vector<float> texels(rows * 256);
            gl().ReadPixels(0, static_cast<GLint>(first / 256), 256, static_cast<GLsizei>(rows), GL_RED,
                            GL_FLOAT, texels.data());
            seen.insert(seen.end(), texels.begin(), texels.begin() + static_cast<std::ptrdiff_t>(count));
        }
        if (frame_.occlusion.wait) occlusion_->wait();
        occlusion_->end();
        return seen;
    }

    Frame frame_;
    glare::ScreenGeometry geometry_;
    GlObject vertex_array_;
    GlObject depth_;
    std::unique_ptr<glare::LightBuffer> light_buffer_;
    std::unique_ptr<glare::Occlusion> occlusion_;
    std::vector<PointSource> sources_;
    std::vector<glare::LightInstance> instances_;
    std::vector<std::uint32_t> tags_;
    std::uint32_t draws_ = 0;
};

TEST_F(OcclusionInTime, HasTheSameValueAt24And60And240Frames) {
    add(3, 32);
    double start_s = 10;
    for (const int rate_hz : {24, 60, 240}) {
        start_s += 100;  // a jump
        wall(false);
        EXPECT_EQ(at(start_s).at(0), 1) << "first sight";
        wall(true);
        for (int frame = 1; frame <= rate_hz / 4; ++frame) {
            const double passed_s = static_cast<double>(frame) / rate_hz;
            EXPECT_NEAR(at(start_s + passed_s).at(0), std::exp(-passed_s / 0.2), 2e-4)
                << rate_hz << " Hz, frame " << frame;
        }
        wall(false);
        const double low = std::exp(-0.25 / 0.2);
        for (int frame = 1; frame <= rate_hz / 4; ++frame) {
            const double passed_s = static_cast<double>(frame) / rate_hz;
            EXPECT_NEAR(at(start_s + 0.25 + passed_s).at(0), 1 - (1 - low) * std::exp(-passed_s / 0.2), 3e-4);
        }
    }
}

TEST_F(OcclusionInTime, ComesToRestAtDarkAndAtFree) {
    add(3, 32);
    at(0);
    wall(true);
    for (int frame = 1; frame <= 150; ++frame)
        at(frame / 60.0);
    EXPECT_EQ(at(151 / 60.0).at(0), 0);
    wall(false);
    for (int frame = 152; frame <= 300; ++frame)
        at(frame / 60.0);
    EXPECT_EQ(at(301 / 60.0).at(0), 1);
}

TEST_F(OcclusionInTime, EachLightKeepsItsOwnHistoryHoweverTheListChanges) {
    for (std::uint32_t i = 0; i < 600; ++i)
        add(i, 4 + 56.0 * i / 600);
    wall(true, 32);
    const auto half = [](std::uint32_t tag) { return 4 + 56.0 * tag / 600 > 34; };
    at(0);
    wall(false);
    // Those that were hidden come back; others come, go and change places meanwhile.
    sources_.erase(sources_.begin(), sources_.begin() + 100);
    add(5000, 60);
    std::reverse(sources_.begin(), sources_.end());
    const auto seen = at(0.1);
    const double expected = 1 - std::exp(-0.1 / 0.2);
    for (std::size_t i = 0; i < sources_.size(); ++i) {
        const std::uint32_t tag = sources_[i].tag;
        const double x_px = 4 + 56.0 * tag / 600;
        if (tag < 5000 && std::abs(x_px - 32) < 2.5) continue;  // partly hidden before
        EXPECT_NEAR(seen.at(i), tag < 5000 && half(tag) ? expected : 1, 2e-4) << tag;
    }
}

TEST_F(OcclusionInTime, WorksAcrossChunksOfLights) {
    constexpr std::uint32_t many = 9000;
    static_assert(many > glare::lights_per_chunk);
    for (std::uint32_t i = 0; i < many; ++i)
        add(i, i % 2 == 0 ? 16 : 48);
    wall(true, 32);
    at(0);
    wall(false);
    sources_.erase(sources_.begin());  // every index moves, some to another chunk
    const auto seen = at(0.1);
    ASSERT_EQ(seen.size(), many - 1);
    const double expected = 1 - std::exp(-0.1 / 0.2);
    for (std::size_t i = 0; i < seen.size(); ++i)
        ASSERT_NEAR(seen[i], sources_[i].tag % 2 == 0 ? 1 : expected, 2e-4) << i;
}

TEST_F(OcclusionInTime, WithoutSmoothingWhatIsSeenCountsAtOnce) {
    frame_.occlusion.smoothing_s = 0;
    add(3, 32);
    EXPECT_EQ(at(0).at(0), 1);
    wall(true);
    EXPECT_EQ(at(0.01).at(0), 0);
}

TEST_F(OcclusionInTime, AFrameWithoutDepthDrawsNothingAndForgets) {
    add(3, 32);
    wall(true);
    EXPECT_EQ(at(0).at(0), 0);
    frame_.depth_source = glare::DepthSource::none;
    EXPECT_TRUE(at(0.02).empty());
    EXPECT_EQ(draws_, 0U);
    EXPECT_FALSE(occlusion_->can_hide());
    EXPECT_EQ(occlusion_->known(3), std::optional<float>(1.0F));
    frame_.depth_source = glare::DepthSource::texture;
    wall(false);
    EXPECT_EQ(at(0.04).at(0), 1) << "seen for the first time again";
}

TEST_F(OcclusionInTime, AFrameThatFailedLeavesNothingBehind) {
    add(3, 32);
    wall(true);
    at(0);
    frame_.time_s = 0.02;
    occlusion_->begin(frame_, instances_, tags_);  // and never ends
    wall(false);
    EXPECT_EQ(at(0.04).at(0), 1);
}

TEST_F(OcclusionInTime, IsKnownOnTheCpuAFrameLaterToThoseWhoWantToKnow) {
    add(3, 16);
    add(9, 48);
    wall(true, 32);
    at(0);
    gl().Finish();
    EXPECT_EQ(occlusion_->known(3), std::nullopt) << "nobody has asked";
    occlusion_->want_known(true);
    at(0.1);
    EXPECT_EQ(occlusion_->known(3), std::nullopt) << "it cannot have arrived yet";
    gl().Finish();
    wall(false);
    const auto seen = at(0.2);
    EXPECT_EQ(occlusion_->known(3), std::optional<float>(1.0F));
    EXPECT_EQ(occlusion_->known(9), std::optional<float>(0.0F)) << "the frame before";
    EXPECT_EQ(occlusion_->known(4), std::nullopt) << "it was not there";
    gl().Finish();
    at(0.3);
    EXPECT_EQ(occlusion_->known(9), std::optional<float>(seen.at(1))) << "smoothed, as the GPU has it";
    gl().Finish();
    at(100);
    EXPECT_EQ(occlusion_->known(9), std::nullopt) << "time has jumped";
}

TEST_F(OcclusionInTime, IsKnownInThisVeryFrameToWhoWaits) {
    add(3, 16);
    add(9, 48);
    occlusion_->want_known(true);
    frame_.occlusion.wait = true;
    for (int i = 0; i < 8; ++i) {
        wall(i % 2 == 0, 32);
        const std::vector<float> seen = at(0.03 * i);
        EXPECT_EQ(occlusion_->known(3), std::optional<float>(seen.at(0))) << "frame " << i;
        EXPECT_EQ(occlusion_->known(9), std::optional<float>(seen.at(1))) << "frame " << i;
    }
}

TEST_F(OcclusionInTime, ALampsOwnBodyDoesNotHideIt) {
    // A wall 0.5 m before a lamp of 5 cm at 100 m, with a depth that tells such distances apart: the tolerance of
    // two thousandths of the distance is 0.2 m.
    frame_.clip_from_view = frustum(-0.4, 0.4, -0.4, 0.4, 10, 1000);
    geometry_ = glare::screen_geometry(frame_);
    const auto& m = frame_.clip_from_view;
    for (const double body_m : {0.0, 0.6}) {
        frame_.occlusion.body_m = body_m;
        for (const double before_m : {0.1, 0.5, 1.0}) {
            const double at_m = 100 - before_m;
            const auto stored = static_cast<float>(((-m[10] * at_m + m[14]) / at_m + 1) / 2);
            const std::vector<float> values(size_px * size_px, stored);
            gl().ActiveTexture(GL_TEXTURE2);
            gl().BindTexture(GL_TEXTURE_2D, depth_.name());
            gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size_px, size_px, GL_DEPTH_COMPONENT, GL_FLOAT,
                               values.data());
            sources_ = {source_at_px(frame_, 32, 32, 1e-4, 100, 0.05)};
            const bool hidden = before_m > 0.05 + 0.2 + body_m;
            EXPECT_EQ(at(frame_.time_s + 10).at(0), hidden ? 0 : 1)
                << before_m << " m before a body of " << body_m << " m";
        }
    }
}

TEST_F(OcclusionInTime, ALampAsLargeAsItsDiscIsNotHiddenByItsOwnSphere) {
    // The host draws the lamp: a sphere of its radius, at distances from far to touching.
    frame_.clip_from_view = frustum(-0.4, 0.4, -0.4, 0.4, 0.5, 5000);
    geometry_ = glare::screen_geometry(frame_);
    const auto& m = frame_.clip_from_view;
    for (const double distance_m : {2.0, 5.0, 20.0, 100.0, 1000.0}) {
        const double radius_m = 0.3;
        std::vector<float> values(size_px * size_px, 1.0F);
        for (int y = 0; y < size_px; ++y) {
            for (int x = 0; x < size_px; ++x) {
                const glare::Vec3 ray = glare::ray_of_px(geometry_, x + 0.5, y + 0.5);
                // |t ray - (0, 0, -d)| = radius, the nearer root.
                const double along = -ray[2] * distance_m;
                const double inside = along * along - distance_m * distance_m + radius_m * radius_m;
                if (inside < 0) continue;
                const double depth_m = -(along - std::sqrt(inside)) * ray[2];
                values[static_cast<std::size_t>(y) * size_px + static_cast<std::size_t>(x)] =
                    static_cast<float>(((-m[10] * depth_m + m[14]) / depth_m + 1) / 2);
            }
        }
        gl().ActiveTexture(GL_TEXTURE2);
        gl().BindTexture(GL_TEXTURE_2D, depth_.name());
        gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size_px, size_px, GL_DEPTH_COMPONENT, GL_FLOAT,
                           values.data());
        sources_ = {source_at_px(frame_, 32, 32, 1e-4, distance_m, radius_m)};
        EXPECT_EQ(at(frame_.time_s + 10).at(0), 1) << distance_m << " m";
    }
}

TEST_F(OcclusionInTime, ADiscGoesBehindAnEdgeInManySmallSteps) {
    frame_.occlusion.smoothing_s = 0;
    for (const double radius_px : {0.5, 1.5, 3.0, 8.0}) {
        wall(true, 32);
        double last = 1;
        double largest_step = 0;
        for (double x_px = 20; x_px <= 44; x_px += 0.1) {
            sources_ = {source_at_px(frame_, x_px, 32.3, 1e-4, 1000, radius_px * geometry_.pitch * 1000)};
            const double now = at(frame_.time_s + 0.01).at(0);
            EXPECT_LE(now, last + 0.06) << radius_px << " px at " << x_px;
            largest_step = std::max(largest_step, last - now);
            last = now;
        }
        std::printf("  radius %.1f px: largest step %.3f of 0.1 px\n", radius_px, largest_step);
        EXPECT_LT(largest_step, radius_px < 1 ? 0.13 : 0.22);
        EXPECT_EQ(last, 0);
    }
}

TEST_F(OcclusionInTime, PartialOcclusionDimsAndNeverShrinks) {
    // Half of a disc of 3 px behind a wall: the whole disc is drawn, half as bright.
    const double radius_m = 3 * geometry_.pitch * 1000;
    sources_ = {source_at_px(frame_, 32, 32, 1e-4, 1000, radius_m)};
    const Pattern pattern = make_pattern(geometry_.pitch, {.radius_nodes = 4});
    frame_.depth_source = glare::DepthSource::none;
    const auto free = hdr_of(frame_, pattern, sources_);
    wall(true, 32);
    frame_.depth_source = glare::DepthSource::texture;
    const auto half = hdr_of(frame_, pattern, sources_);
    const double visible = energy_lx(frame_, half) / energy_lx(frame_, free);
    EXPECT_NEAR(visible, 0.5, 0.08);
    for (std::size_t i = 1; i < free.size(); i += 4)
        ASSERT_NEAR(half[i], visible * free[i], 1e-4 * free[i] + 1e-12);
}

}  // namespace
}  // namespace seaglare::test
