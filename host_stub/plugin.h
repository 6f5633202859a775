// The plug-in as any host meets it: a file to dlopen, one symbol to look up, a table of functions.
#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "host_stub/scene.h"
#include "plugin_api/seaglare.h"

namespace seaglare::host {

// Says what was being done, the plug-in's result in words and its last error.
class PluginError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// Where the library is looked for: `wanted` alone if it is not empty, else $SEAGLARE_PLUGIN alone if set, else beside
// this program as built and as installed, else wherever the loader looks.
std::vector<std::filesystem::path> plugin_candidates(const std::filesystem::path& wanted);

// A loaded library. It is never unloaded: OpenCL drivers leave threads behind that still run in it.
class Plugin {
  public:
    // Throws PluginError that lists every path tried with the loader's own words.
    explicit Plugin(const std::filesystem::path& wanted);
    // Of a table that the caller has already: the product linked into a tool that also looks at its parts.
    explicit Plugin(const seaglare_api& api);

    const std::filesystem::path& path() const { return path_; }
    const seaglare_api& api() const { return api_; }
    // nullptr when the library does not have the extension.
    const seaglare_stats_api* stats() const { return stats_; }
    const seaglare_hdr_api* hdr() const { return hdr_; }
    const seaglare_memory_api* memory() const { return memory_; }

  private:
    void find_extensions();

    std::filesystem::path path_;
    seaglare_api api_{};
    const seaglare_stats_api* stats_ = nullptr;
    const seaglare_memory_api* memory_ = nullptr;
    const seaglare_hdr_api* hdr_ = nullptr;
};

// A light the host moves every frame.
struct SwayingLight {
    seaglare_light_id id = 0;
    glm::dvec3 home_m{};
    double phase_rad = 0;
};

// One context and one view for a scene and the GL context that is current.
class Glare {
  public:
    using Log = std::function<void(int level, std::string_view message)>;

    // Loads the scene's quality and light files and its crowd. `flags`: SEAGLARE_CREATE_*. Throws PluginError.
    Glare(const Plugin& plugin, const Scene& scene, const Channel& channel, const Observer& observer,
          seaglare_get_proc_fn get_proc, Log log, std::uint32_t flags = 0);
    ~Glare();
    Glare(const Glare&) = delete;
    Glare& operator=(const Glare&) = delete;

    // Swings the crowd's lights to where they are at this time. Throws PluginError.
    void move_lights(double time_s);
    // The bare call: no check, no throw.
    seaglare_result render(const seaglare_frame& frame);
    // Empty after success without remark.
    std::string last_error() const;

    seaglare_stats stats() const;
    seaglare_memory memory() const;
    std::string plan() const;  // JSON text, or empty without the extension
    // Floats as seaglare_hdr_api has them, of a frame whose viewport is this large; empty without the extension.
    std::vector<float> hdr(int width_px, int height_px) const;
    bool degraded() const { return degraded_; }
    std::uint32_t light_count() const;
    seaglare_context* context() const { return context_; }

  private:
    void require(seaglare_result result, std::string_view doing) const;
    void add_crowd(const Scene& scene, const Channel& channel, const Observer& observer);

    const Plugin& plugin_;
    Log log_;
    seaglare_context* context_ = nullptr;
    seaglare_view* view_ = nullptr;
    std::vector<SwayingLight> crowd_;
    std::vector<seaglare_light_update> updates_;
    double sway_m_ = 0;
    bool degraded_ = false;
};

}  // namespace seaglare::host
