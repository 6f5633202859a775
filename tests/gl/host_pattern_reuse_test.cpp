// A pattern that is used again is not made: no kernel is launched for it. Counted where the library calls OpenCL.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "host_stub/plugin.h"
#include "tests/gl/measured_devices.h"
#include "tests/scene_host.h"

namespace seaglare::host {
namespace {

using test::MeasuredCl;
using test::MeasuredGl;

// One light ahead, of 200 cd at 1 km, drawn as a rectangle: what is launched is the pattern's.
class PatternReuse : public testing::Test {
  protected:
    void SetUp() override {
        std::string why_not;
        gl_ = headless_context(why_not);
        if (!gl_) GTEST_SKIP() << why_not;
        const SceneOptions options = scene_options("sonderborg_leading_line", "96x64");
        simulation_ = std::make_unique<Simulation>(options);
        plugin_ = std::make_unique<Plugin>(options.plugin);
        target_ = std::make_unique<RenderTarget>(96, 64, TargetFormat::rgba8_srgb_values);
        make_glare();
        if (glare_->degraded()) GTEST_SKIP() << "without OpenCL nothing is launched";
        start_s_ = simulation_->time_s();
    }
    // A gather launches kernels, too: here it costs too much. The budget lets a pattern stand where little of it shows.
    void make_glare() {
        glare_.reset();
        const std::filesystem::path file =
            std::filesystem::temp_directory_path() / ("seaglare_reuse_" + std::to_string(getpid()) + ".json");
        std::ofstream(file) << R"({"device_costs": {"cl_pass_ns": 1e12}, "budget": {"max_error_codes": 2}})";
        Scene scene = simulation_->scene();
        scene.quality_file = file;
        glare_ = std::make_unique<Glare>(*plugin_, scene, simulation_->channel(), simulation_->observer(),
                                         MeasuredGl::get_proc, Glare::Log{});
        std::filesystem::remove(file);
        const Camera camera = simulation_->camera();
        const glm::dmat4& view = camera.view_from_world;
        const glm::dvec3 place = camera.eye_m - 1000.0 * glm::dvec3(view[0][2], view[1][2], view[2][2]);
        seaglare_light light{};
        light.struct_size = sizeof light;
        light.intensity_cd = 200;
        for (int k = 0; k < 3; ++k)
            light.position_m[k] = place[k];
        const seaglare_api& api = plugin_->api();
        ASSERT_EQ(api.clear_lights(glare_->context()), SEAGLARE_OK);
        ASSERT_EQ(api.add_light(glare_->context(), &light, nullptr), SEAGLARE_OK) << glare_->last_error();
    }

    struct Shown {
        std::uint64_t launches = 0;
        seaglare_stats stats{};
        std::string plan;
    };
    Shown frame_at(double seconds, double adaptation_cd_m2) {
        simulation_->go_to(start_s_ + seconds);
        glare_->move_lights(simulation_->time_s());
        seaglare_frame frame =
            make_frame(*simulation_, simulation_->camera(), *target_, adaptation_cd_m2, 1.0 / 15);
        frame.flags |= SEAGLARE_FRAME_WAIT;
        MeasuredCl::reset();
        EXPECT_GE(glare_->render(frame), SEAGLARE_OK) << glare_->last_error();
        return {MeasuredCl::launches(), glare_->stats(), glare_->plan()};
    }
    static bool says(const Shown& shown, const std::string& text) {
        return shown.plan.find(text) != std::string::npos;
    }

    std::unique_ptr<HeadlessContext> gl_;
    std::unique_ptr<Simulation> simulation_;
    std::unique_ptr<Plugin> plugin_;
    std::unique_ptr<RenderTarget> target_;
    std::unique_ptr<Glare> glare_;
    double start_s_ = 0;
};

TEST_F(PatternReuse, BrightLightsInTheDarkGetANewPatternInEveryFrame) {
    frame_at(0, 0.001);
    for (int i = 1; i < 5; ++i) {
        const Shown shown = frame_at(0.15 * i, 0.001);
        ASSERT_TRUE(says(shown, "\"gl_billboards\"")) << shown.plan;
        EXPECT_TRUE(says(shown, "\"pattern\": \"make\"")) << shown.plan;
        EXPECT_GT(shown.launches, 0U) << "frame " << i;
    }
}

TEST_F(PatternReuse, LaunchesNothingWhereTheEyesMotionDoesNotShow) {
    constexpr double by_day_cd_m2 = 300;
    frame_at(0, by_day_cd_m2);
    for (int i = 1; i < 6; ++i) {
        const Shown shown = frame_at(0.15 * i, by_day_cd_m2);
        ASSERT_TRUE(says(shown, "\"gl_billboards\"")) << shown.plan;
        EXPECT_TRUE(says(shown, "\"pattern\": \"reuse\"")) << shown.plan;
        EXPECT_EQ(shown.stats.lights_drawn, 1U);
        EXPECT_EQ(shown.launches, 0U) << "frame " << i;
    }
}

}  // namespace
}  // namespace seaglare::host
