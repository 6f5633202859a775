// A scene in motion: which channel, which observer, what time it is, and the frame the plug-in is handed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host_stub/camera.h"
#include "host_stub/night_scene.h"
#include "host_stub/render_target.h"
#include "host_stub/scene.h"
#include "plugin_api/seaglare.h"

namespace seaglare::host {

// What the commands have in common.
struct SceneOptions {
    std::filesystem::path scene;
    std::string channel, observer;  // empty: the scene's first
    std::filesystem::path plugin;   // empty: plugin_candidates()
    std::filesystem::path quality;  // empty: the scene's
    std::string size;               // "WxH" or empty
    std::string time;               // "HH:MM[:SS]" local, or empty
    std::optional<double> start_s;  // absolute time of the first frame
};

// "HH:MM" or "HH:MM:SS" as hours in [0, 24). Throws std::invalid_argument that repeats the text.
double parse_time_of_day(const std::string& text);

class Simulation {
  public:
    // Loads the scene. Throws json::Error, std::system_error, std::invalid_argument (names what there is to choose from).
    explicit Simulation(const SceneOptions& options);

    const Scene& scene() const { return scene_; }
    Channel& channel() { return channel_; }
    const Channel& channel() const { return channel_; }
    Observer& observer() { return observer_; }
    const Observer& observer() const { return observer_; }

    // Moves to an absolute time; the ship sails on from where it is, the clock runs `time_of_day_rate` times as fast.
    void go_to(double time_s);
    double time_s() const { return time_s_; }
    double local_time_h() const { return local_time_h_; }
    void set_local_time_h(double hours);
    double time_of_day_rate = 1;

    Camera camera() const;
    Moment moment() const { return {time_s_, local_time_h_, observer_.position_m}; }

  private:
    Scene scene_;
    Channel channel_;
    Observer observer_;
    double time_s_ = 0;
    double local_time_h_ = 0;
};

// Everything the plug-in is told about one picture.
seaglare_frame make_frame(const Simulation& simulation, const Camera& camera, const RenderTarget& target,
                          double adaptation_cd_m2, double interval_s);

}  // namespace seaglare::host
