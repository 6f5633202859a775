// Two channels on two threads, each with a GL context of its own, and a third thread that changes the world under them:
// what a bridge of several windows in one process does. Run it in the tsan preset.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/abi/loaded_plugin.h"
#include "tests/gl/headless_context.h"

namespace {

using namespace seaglare;
using namespace seaglare::test;

constexpr int width_px = 64;
constexpr int height_px = 48;
constexpr int frames = 24;

constexpr const char* other_quality = R"({"pattern": {"transform_size": 256, "wavelengths": 5,
    "angular_scale": 4, "max_radius_nodes": 24, "layer_radii_px": [0, 3]}})";
constexpr const char* buoys = R"({"lights": [
    {"name": "first", "position": [20, 900, 4], "character": "F", "intensity_cd": 300},
    {"name": "second", "position": [-40, 700, 4], "character": "Q", "intensity_cd": 300}]})";

// One window of the host: made, used and given up on the thread that calls.
class Channel {
  public:
    Channel(const LoadedPlugin& plugin, seaglare_context* context) : plugin_(plugin) {
        const glare::Gl& gl = gl_context_.gl();
        gl.GenTextures(1, &texture_);
        gl.BindTexture(GL_TEXTURE_2D, texture_);
        gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width_px, height_px, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
        gl.GenFramebuffers(1, &framebuffer_);
        gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
        auto info = sized<seaglare_view_info>();
        info.get_proc = &HeadlessContext::get_proc;
        made_ = plugin_->create_view(context, &info, &view_);
    }
    ~Channel() { EXPECT_EQ(plugin_->destroy_view(view_, 0), SEAGLARE_OK); }
    Channel(const Channel&) = delete;
    Channel& operator=(const Channel&) = delete;

    seaglare_result made() const { return made_; }
    seaglare_result render(double time_s) {
        const glare::Gl& gl = gl_context_.gl();
        gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        gl.ClearColor(0.02F, 0.02F, 0.03F, 1);
        gl.Clear(GL_COLOR_BUFFER_BIT);
        seaglare_frame frame = looking_north(width_px, height_px);
        frame.target_fbo = framebuffer_;
        frame.time_s = time_s;
        return plugin_->render(view_, &frame);
    }
    std::vector<std::uint8_t> pixels() const {
        const glare::Gl& gl = gl_context_.gl();
        std::vector<std::uint8_t> result(4 * width_px * height_px);
        gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        gl.ReadPixels(0, 0, width_px, height_px, GL_RGBA, GL_UNSIGNED_BYTE, result.data());
        return result;
    }
    seaglare_stats stats() const {
        auto stats = sized<seaglare_stats>();
        const auto* api = plugin_.extension<seaglare_stats_api>("seaglare.stats/1");
        EXPECT_EQ(api->get_stats(view_, &stats), SEAGLARE_OK);
        return stats;
    }

  private:
    const LoadedPlugin& plugin_;
    HeadlessContext gl_context_;
    GLuint texture_ = 0;
    GLuint framebuffer_ = 0;
    seaglare_view* view_ = nullptr;
    seaglare_result made_ = SEAGLARE_OK;
};

seaglare_light light_at(double east_m, double north_m) {
    auto light = sized<seaglare_light>();
    light.position_m[0] = east_m;
    light.position_m[1] = north_m;
    light.position_m[2] = 8;
    light.intensity_cd = 500;
    return light;
}

// Everything that may be called from any thread, over and over until the channels are done.
void change_the_world(const LoadedPlugin& plugin, seaglare_context* context, const std::atomic<bool>& done,
                      const TemporaryFile& lights, const std::array<const TemporaryFile*, 2>& qualities) {
    const auto ok = [&](seaglare_result result) { EXPECT_GE(result, 0) << plugin.last_error(context); };
    for (int round = 0; !done; ++round) {
        const seaglare_light fixed = light_at(10, 600);
        seaglare_light_id id = 0;
        ok(plugin->add_light(context, &fixed, &id));
        seaglare_light aboard = light_at(1, 2);
        aboard.body_id = 7;
        ok(plugin->add_light(context, &aboard, nullptr));
        const double at[3] = {5.0 * (round % 9) - 20, 500, 6};
        const double turned[4] = {0, 0, std::sin(0.1 * round), std::cos(0.1 * round)};
        ok(plugin->set_body_pose(context, 7, at, turned));
        auto update = sized<seaglare_light_update>();
        update.id = id;
        update.set = SEAGLARE_SET_POSITION | SEAGLARE_SET_INTENSITY;
        update.position_m[0] = round % 40 - 20;
        update.position_m[1] = 800;
        update.intensity_cd = 100 + round % 100;
        ok(plugin->update_lights(context, &update, 1, 0));
        ok(plugin->load_lights(context, lights.path()));
        std::uint32_t count = 0;
        ok(plugin->list_lights(context, nullptr, 0, &count));
        EXPECT_GE(count, 4U);
        auto eye = sized<seaglare_eye_state>();
        ok(plugin->get_eye_state(context, &eye));
        ok(plugin->remove_light(context, id));
        EXPECT_EQ(plugin->remove_light(context, id), SEAGLARE_ERROR_STALE_ID);
        if (round % 4 == 3) ok(plugin->clear_lights(context));
        if (round % 8 == 5) ok(plugin->load_config(context, qualities[round / 8 % 2]->path()));
    }
}

class PluginThreads : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(PluginThreads, TwoChannelsDrawWhileAThirdThreadChangesTheWorld) {
    try {
        const HeadlessContext probe;
    } catch (const std::exception& error) {
        GTEST_SKIP() << error.what();
    }
    const LoadedPlugin plugin;
    const QuickContext context(plugin, GetParam());
    if (GetParam() == 0 && context.created() == SEAGLARE_DEGRADED) GTEST_SKIP() << plugin.last_error(context);
    const TemporaryFile lights("lights.json", buoys);
    const TemporaryFile quality("quality.json", small_quality);
    const TemporaryFile magnified("magnified.json", other_quality);

    std::atomic<bool> done{false};
    std::atomic<int> drawn{0};
    std::thread changer([&] { change_the_world(plugin, context, done, lights, {&magnified, &quality}); });
    // The last frame is drawn when the world has come to rest: both channels must agree on it.
    std::array<std::vector<std::uint8_t>, 2> last;
    std::atomic<int> waiting{0};
    std::atomic<bool> at_rest{false};
    const auto run = [&](std::size_t number) {
        Channel channel(plugin, context);
        EXPECT_GE(channel.made(), 0) << plugin.last_error(context);
        for (int i = 0; i < frames; ++i) {
            const seaglare_result result = channel.render(0.02 * i);
            EXPECT_GE(result, 0) << plugin.last_error(context);
            if (result != SEAGLARE_NOTHING_TO_DRAW) ++drawn;
            const seaglare_stats s = channel.stats();
            EXPECT_EQ(s.lights_total, s.lights_drawn + s.lights_dark + s.lights_horizon + s.lights_outside +
                                          s.lights_below_threshold);
        }
        ++waiting;
        at_rest.wait(false);
        EXPECT_GE(channel.render(1), 0) << plugin.last_error(context);
        EXPECT_EQ(channel.stats().lights_drawn, 2U);
        last[number] = channel.pixels();
    };
    std::thread left(run, 0);
    std::thread right(run, 1);
    while (waiting < 2)
        std::this_thread::yield();
    done = true;
    changer.join();
    EXPECT_EQ(plugin->clear_lights(context), SEAGLARE_OK);
    for (const double east_m : {-30.0, 30.0}) {
        const seaglare_light light = light_at(east_m, 600);
        EXPECT_EQ(plugin->add_light(context, &light, nullptr), SEAGLARE_OK);
    }
    at_rest = true;
    at_rest.notify_all();
    left.join();
    right.join();
    EXPECT_GT(drawn, 0);
    EXPECT_EQ(last[0], last[1]);
}

INSTANTIATE_TEST_SUITE_P(Sources, PluginThreads, ::testing::Values(SEAGLARE_CREATE_NO_OPENCL, 0U),
                         [](const auto& given) { return given.param == 0 ? "OpenCl" : "Cpu"; });

}  // namespace
