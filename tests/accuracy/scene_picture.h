// A shipped scene's picture with its lights at one instant, at any budget: what is left out at each can be compared pixel by
// pixel, in parts of a display code.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "glare/tone/operators.h"
#include "host_stub/night_scene.h"
#include "host_stub/plugin.h"
#include "tests/scene_host.h"

namespace seaglare::host {

inline const std::filesystem::path config = std::filesystem::path(SEAGLARE_SOURCE_DIR) / "config";

struct Shown {
    std::vector<float> linear;  // RGBA of the target
    seaglare_stats stats{};
    std::string plan;
};

// A scene's picture without lights, drawn once, and the same with Seaglare at any budget.
class ScenePicture {
  public:
    ScenePicture(const std::string& name, const std::string& size)
        : simulation_(scene_options(name, size)),
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
        folder_ = std::filesystem::temp_directory_path() /
                  ("seaglare_picture_" + name + "_" + std::to_string(getpid()));
        std::filesystem::create_directories(folder_);
    }
    ~ScenePicture() { std::filesystem::remove_all(folder_); }
    ScenePicture(const ScenePicture&) = delete;
    ScenePicture& operator=(const ScenePicture&) = delete;

    Shown at_budget(double codes) {
        const std::unique_ptr<Glare> glare = attached(codes);
        return draw(*glare, SEAGLARE_FRAME_WAIT);
    }
    // With the scene's own quality, but for the budget and, where there are any, further members: R"("device_costs": …)".
    std::unique_ptr<Glare> attached(double codes, const std::string& members = "", double time_ms = 0) {
        Scene scene = simulation_.scene();
        scene.quality_file = quality(codes, members, time_ms);
        return std::make_unique<Glare>(plugin_, scene, simulation_.channel(), simulation_.observer(),
                                       HeadlessContext::get_proc, [](int, std::string_view) {});
    }
    // The scene's instant, however often. `flags` beside those that the scene asks for; WAIT: the pattern of this very
    // instant.
    Shown draw(Glare& glare, std::uint32_t flags, double interval_s = 1.0 / 60) {
        glare.move_lights(simulation_.time_s());
        glBindFramebuffer(GL_READ_FRAMEBUFFER, bare_->fbo());
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, lit_->fbo());
        glBlitFramebuffer(0, 0, lit_->width_px(), lit_->height_px(), 0, 0, lit_->width_px(),
                          lit_->height_px(), GL_COLOR_BUFFER_BIT, GL_NEAREST);
        glBindFramebuffer(GL_FRAMEBUFFER, lit_->fbo());
        seaglare_frame frame = make_frame(simulation_, simulation_.camera(), *bare_,
                                          scene_.adaptation_luminance_cd_m2(), interval_s);
        frame.target_fbo = lit_->fbo();
        frame.flags |= flags;
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
    std::filesystem::path quality(double codes, const std::string& members, double time_ms) const {
        std::filesystem::path file = simulation_.scene().quality_file;
        if (file.empty()) file = config / "quality" / "default.json";
        std::stringstream read;
        read << std::ifstream(file).rdbuf();
        std::string text = read.str();
        replace_number(text, "max_error_codes", codes);
        replace_number(text, "time_ms", time_ms);
        const std::string above = "\"../";
        for (std::size_t at = text.find(above); at != std::string::npos; at = text.find(above, at))
            text.replace(at, above.size(), "\"" + config.string() + "/");
        if (!members.empty()) text.insert(text.find('{') + 1, members + ",");
        std::filesystem::path written = folder_ / "quality.json";
        std::ofstream(written) << text;
        return written;
    }

    static void replace_number(std::string& text, const std::string& member, double number) {
        const std::string key = "\"" + member + "\": ";
        const std::size_t found = text.find(key);
        if (found == std::string::npos) throw std::runtime_error("the scene's quality has no " + member);
        const std::size_t value = found + key.size();
        text.replace(value, text.find_first_of(", }", value) - value, std::to_string(number));
    }

    Simulation simulation_;
    Plugin plugin_;
    NightScene scene_;
    std::unique_ptr<RenderTarget> bare_, lit_;
    std::filesystem::path folder_;
};

inline double codes_of(float linear) {
    return 255 * glare::srgb_encode(static_cast<double>(linear));
}

inline double largest_difference_codes(const Shown& a, const Shown& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.linear.size(); ++i) {
        if (i % 4 != 3) largest = std::max(largest, std::abs(codes_of(a.linear[i]) - codes_of(b.linear[i])));
    }
    return largest;
}

}  // namespace seaglare::host
