// The error budget is kept: whatever a plan leaves out, no channel of any pixel of a shipped scene is off by more codes than
// the budget says, against the same frame with nothing left out.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "glare/tone/operators.h"
#include "host_stub/gl_objects.h"
#include "host_stub/headless.h"
#include "host_stub/night_scene.h"
#include "host_stub/plugin.h"
#include "host_stub/simulation.h"

namespace seaglare::host {
namespace {

const std::filesystem::path config = std::filesystem::path(SEAGLARE_SOURCE_DIR) / "config";

struct Shown {
    std::vector<float> linear;  // RGBA of the target
    seaglare_stats stats{};
    std::string plan;
};

// A scene's picture without lights, drawn once, and the same with Seaglare at any budget.
class ScenePicture {
  public:
    ScenePicture(const std::string& name, const std::string& size)
        : simulation_(options(name, size)),
          plugin_(std::filesystem::path(SEAGLARE_PLUGIN_FILE)),
          scene_(simulation_.scene()) {
        Channel& channel = simulation_.channel();
        channel.target = TargetFormat::rgba16f_linear;  // shows parts of a code
        bare_ = std::make_unique<RenderTarget>(channel.width_px, channel.height_px, channel.target);
        lit_ = std::make_unique<RenderTarget>(channel.width_px, channel.height_px, channel.target);
        scene_.set_moment(simulation_.moment());
        glBindFramebuffer(GL_FRAMEBUFFER, bare_->multisampled_fbo());
        scene_.draw(simulation_.camera(), channel);
        bare_->resolve();
        folder_ = std::filesystem::temp_directory_path() / ("seaglare_budget_" + name);
        std::filesystem::create_directories(folder_);
    }
    ~ScenePicture() { std::filesystem::remove_all(folder_); }
    ScenePicture(const ScenePicture&) = delete;
    ScenePicture& operator=(const ScenePicture&) = delete;

    Shown at_budget(double codes) {
        Scene scene = simulation_.scene();
        scene.quality_file = quality(codes);
        Glare glare(plugin_, scene, simulation_.channel(), simulation_.observer(), HeadlessContext::get_proc,
                    [](int, std::string_view) {});
        glare.move_lights(simulation_.time_s());
        glBindFramebuffer(GL_READ_FRAMEBUFFER, bare_->fbo());
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, lit_->fbo());
        glBlitFramebuffer(0, 0, lit_->width_px(), lit_->height_px(), 0, 0, lit_->width_px(),
                          lit_->height_px(), GL_COLOR_BUFFER_BIT, GL_NEAREST);
        glBindFramebuffer(GL_FRAMEBUFFER, lit_->fbo());
        seaglare_frame frame = make_frame(simulation_, simulation_.camera(), *bare_,
                                          scene_.adaptation_luminance_cd_m2(), 1.0 / 60);
        frame.target_fbo = lit_->fbo();
        frame.flags |= SEAGLARE_FRAME_WAIT;  // the pattern of this very instant
        const seaglare_result result = glare.render(frame);
        EXPECT_GE(result, SEAGLARE_OK) << glare.last_error();
        Shown shown;
        const std::vector<std::uint8_t> raw = lit_->read_raw();
        shown.linear.resize(raw.size() / sizeof(float));
        std::memcpy(shown.linear.data(), raw.data(), raw.size());
        shown.stats = glare.stats();
        shown.plan = glare.plan();
        return shown;
    }

  private:
    static SceneOptions options(const std::string& name, const std::string& size) {
        SceneOptions options;
        options.scene = config / "scenes" / (name + ".json");
        options.size = size;
        return options;
    }
    // The scene's own quality with another budget.
    std::filesystem::path quality(double codes) const {
        std::filesystem::path file = simulation_.scene().quality_file;
        if (file.empty()) file = config / "quality" / "default.json";
        std::stringstream read;
        read << std::ifstream(file).rdbuf();
        std::string text = read.str();
        const std::string key = "\"max_error_codes\": ";
        const std::size_t value = text.find(key) + key.size();
        text.replace(value, text.find_first_of(", }", value) - value, std::to_string(codes));
        const std::string above = "\"../";
        for (std::size_t at = text.find(above); at != std::string::npos; at = text.find(above, at))
            text.replace(at, above.size(), "\"" + config.string() + "/");
        std::filesystem::path written = folder_ / "quality.json";
        std::ofstream(written) << text;
        return written;
    }

    Simulation simulation_;
    Plugin plugin_;
    NightScene scene_;
    std::unique_ptr<RenderTarget> bare_, lit_;
    std::filesystem::path folder_;
};

double codes_of(float linear) {
    return 255 * glare::srgb_encode(static_cast<double>(linear));
}

double largest_difference_codes(const Shown& a, const Shown& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.linear.size(); ++i) {
        if (i % 4 != 3) largest = std::max(largest, std::abs(codes_of(a.linear[i]) - codes_of(b.linear[i])));
    }
    return largest;
}

struct Case {
    const char* scene;
    const char* size;
};

class Budget : public testing::TestWithParam<Case> {};

TEST_P(Budget, NoPixelIsOffByMoreThanItAllows) {
    std::unique_ptr<HeadlessContext> gl;
    try {
        gl = std::make_unique<HeadlessContext>();
    } catch (const GlFailure& e) {
        GTEST_SKIP() << e.what();
    }
    ScenePicture picture(GetParam().scene, GetParam().size);
    const Shown everything = picture.at_budget(0);
    EXPECT_EQ(everything.stats.max_error_codes, 0);
    EXPECT_GT(everything.stats.lights_drawn, 0U);
    // Half floats are rounded to 0.06 codes at white when light is added.
    constexpr double of_the_target = 0.15;
    for (const double budget : {0.5, 1.0, 2.0, 4.0}) {
        const Shown shown = picture.at_budget(budget);
        const double error = largest_difference_codes(everything, shown);
        std::printf("%-24s budget %.2f: off by %.3f codes, bound %.3f, %.1f ms\n", GetParam().scene, budget,
                    error, shown.stats.error_bound_codes, shown.stats.accumulate_ms);
        EXPECT_LE(error, budget + of_the_target) << shown.plan;
        EXPECT_LE(shown.stats.error_bound_codes, budget * 1.000001) << shown.plan;
        EXPECT_GT(shown.stats.omissions, 2U);
    }
}

INSTANTIATE_TEST_SUITE_P(OfEveryShippedScene, Budget,
                         testing::Values(Case{"great_belt_night", "480x270"},
                                         Case{"ships_at_night", "480x270"},
                                         Case{"sonderborg_leading_line", "480x270"},
                                         Case{"storebaelt_dusk", "480x270"},
                                         Case{"thesis_many_lights", "320x180"}),
                         [](const auto& given) { return std::string(given.param.scene); });

}  // namespace
}  // namespace seaglare::host
