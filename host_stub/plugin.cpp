#include "host_stub/plugin.h"

#include <dlfcn.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>

#include "host_stub/camera.h"

namespace seaglare::host {
namespace {

void SEAGLARE_CALL forward_log(void* user, int32_t level, const char* message) {
    const auto& log = *static_cast<const Glare::Log*>(user);
    if (log) log(level, message);
}

// Uniform in [0, 1), the same on every machine: std::uniform_real_distribution is not.
double uniform(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

double log_uniform(std::mt19937_64& random, double low, double high) {
    return low * std::pow(high / low, uniform(random));
}

}  // namespace

std::vector<std::filesystem::path> plugin_candidates(const std::filesystem::path& wanted) {
    if (!wanted.empty()) return {wanted};
    if (const char* set = std::getenv("SEAGLARE_PLUGIN"); set && *set) return {set};
    std::vector<std::filesystem::path> candidates;
    std::error_code ignored;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
    if (!program.empty()) {
        const auto folder = program.parent_path();
        for (const char* relative :
             {"../plugin_api/libseaglare.so", "../../plugin_api/libseaglare.so", "../lib/libseaglare.so",
              "../lib/x86_64-linux-gnu/libseaglare.so", "libseaglare.so"})
            if (const auto path = (folder / relative).lexically_normal(); std::filesystem::exists(path))
                candidates.push_back(path);
    }
    candidates.emplace_back("libseaglare.so");
    return candidates;
}

Plugin::Plugin(const std::filesystem::path& wanted) {
    std::string tried;
    for (const auto& candidate : plugin_candidates(wanted)) {
        void* library = dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (!library) {
            const char* why = dlerror();
            tried += "\n  " + candidate.string() + ": " + (why ? why : "unknown error");
            continue;
        }
        path_ = candidate;
        auto* get_api = reinterpret_cast<seaglare_get_api_fn>(dlsym(library, "seaglare_get_api"));
        if (!get_api)
            throw PluginError(candidate.string() + " is not Seaglare: it has no symbol seaglare_get_api");
        api_.struct_size = sizeof api_;
        const seaglare_result result = get_api(SEAGLARE_ABI_MAJOR, &api_);
        if (result < 0)
            throw PluginError(candidate.string() + " does not offer ABI version " +
                              std::to_string(SEAGLARE_ABI_MAJOR) + " (seaglare_get_api gave " +
                              std::to_string(result) + ")");
        find_extensions();
        return;
    }
    throw PluginError("cannot load the plug-in; tried" + tried +
                      "\nname it with --plugin or in the environment variable SEAGLARE_PLUGIN");
}

Plugin::Plugin(const seaglare_api& api) : api_(api) {
    find_extensions();
}

void Plugin::find_extensions() {
    stats_ = static_cast<const seaglare_stats_api*>(api_.get_extension("seaglare.stats/1"));
    hdr_ = static_cast<const seaglare_hdr_api*>(api_.get_extension("seaglare.hdr/1"));
    memory_ = static_cast<const seaglare_memory_api*>(api_.get_extension("seaglare.memory/1"));
}

Glare::Glare(const Plugin& plugin, const Scene& scene, const Channel& channel, const Observer& observer,
             seaglare_get_proc_fn get_proc, Log log, std::uint32_t flags)
    : plugin_(plugin), log_(std::move(log)) {
    seaglare_create_info info{};
    info.struct_size = sizeof info;
    info.flags = flags;
    info.axes = SEAGLARE_AXES_EAST_NORTH_UP;
    info.earth = SEAGLARE_EARTH_FLAT;
    info.origin_latitude_deg = scene.origin.latitude_deg;
    info.origin_longitude_deg = scene.origin.longitude_deg;
    info.seed = scene.seed;
    const std::string quality = scene.quality_file.string();
    info.config_path = quality.empty() ? nullptr : quality.c_str();
    info.log = forward_log;
    info.log_user = &log_;
    try {
        require(plugin_.api().create(&info, &context_), "creating the plug-in's context");
        for (const auto& file : scene.light_files)
            require(plugin_.api().load_lights(context_, file.c_str()), "loading " + file.string());
        if (scene.crowd) add_crowd(scene, channel, observer);

        seaglare_view_info view{};
        view.struct_size = sizeof view;
        view.get_proc = get_proc;
        view.channel_name = channel.name.c_str();
        const seaglare_result made = plugin_.api().create_view(context_, &view, &view_);
        require(made, "creating the plug-in's view");
    } catch (...) {
        if (context_) plugin_.api().destroy(context_);
        throw;
    }
}

Glare::~Glare() {
    if (view_) plugin_.api().destroy_view(view_, 0);
    if (context_) plugin_.api().destroy(context_);
}

std::string Glare::last_error() const {
    std::array<char, 2048> text{};
    if (plugin_.api().copy_last_error(context_, text.data(), text.size()) < 0) return {};
    return text.data();
}

void Glare::require(seaglare_result result, std::string_view doing) const {
    if (result == SEAGLARE_DEGRADED) const_cast<Glare*>(this)->degraded_ = true;
    if (result >= 0) return;
    throw PluginError(std::string(doing) + ": " + plugin_.api().result_string(result) + ": " + last_error());
}

void Glare::add_crowd(const Scene& scene, const Channel& channel, const Observer& observer) {
    const Crowd& crowd = *scene.crowd;
    const glm::dvec3 eye(observer.position_m, observer.eye_height_m);
    const Camera camera = make_camera(channel, eye, observer.heading_deg, observer.pitch_deg);
    const glm::dmat3 world_from_view = glm::transpose(glm::dmat3(camera.view_from_world));
    const glm::dmat4& p = camera.clip_from_view;
    std::mt19937_64 random(crowd.seed);
    static constexpr std::array<int32_t, 8> colours{
        SEAGLARE_COLOUR_WHITE, SEAGLARE_COLOUR_WHITE, SEAGLARE_COLOUR_WHITE, SEAGLARE_COLOUR_RED,
        SEAGLARE_COLOUR_RED,   SEAGLARE_COLOUR_GREEN, SEAGLARE_COLOUR_GREEN, SEAGLARE_COLOUR_YELLOW};
    static constexpr std::array<const char*, 4> characters{"Fl 3s", "Fl(2) 6s", "Iso 4s", "Oc 5s"};
    sway_m_ = crowd.sway_m;
    for (std::uint32_t i = 0; i < crowd.count; ++i) {
        // Anywhere in the picture; below the horizon no deeper than nine tenths of the way to the water.
        const double x = (2 * uniform(random) - 1) * (1 - 2 * crowd.margin);
        const double y = (2 * uniform(random) - 1) * (1 - 2 * crowd.margin);
        const glm::dvec3 ray = glm::normalize(
            world_from_view * glm::dvec3((x + p[2][0]) / p[0][0], (y + p[2][1]) / p[1][1], -1));
        double distance_m = log_uniform(random, crowd.distance_min_m, crowd.distance_max_m);
        if (ray.z < 0) distance_m = std::min(distance_m, 0.9 * eye.z / -ray.z);
        const glm::dvec3 at = eye + ray * distance_m;

        seaglare_light light{};
        light.struct_size = sizeof light;
        for (int k = 0; k < 3; ++k)
            light.position_m[k] = at[k];
        light.intensity_cd = log_uniform(random, crowd.intensity_min_cd, crowd.intensity_max_cd);
        light.radius_m = log_uniform(random, crowd.radius_min_m, crowd.radius_max_m);
        light.colour = colours[random() % colours.size()];
        if (uniform(random) < crowd.flashing) light.character = characters[random() % characters.size()];
        SwayingLight swaying{0, at, 2 * std::numbers::pi * uniform(random)};
        require(plugin_.api().add_light(context_, &light, &swaying.id), "adding a light of the crowd");
        crowd_.push_back(swaying);
    }
}

void Glare::move_lights(double time_s) {
    if (sway_m_ <= 0 || crowd_.empty()) return;
    constexpr double sway_period_s = 6;
    updates_.resize(crowd_.size());
    for (std::size_t i = 0; i < crowd_.size(); ++i) {
        const SwayingLight& light = crowd_[i];
        const double angle = 2 * std::numbers::pi * time_s / sway_period_s + light.phase_rad;
        seaglare_light_update& update = updates_[i];
        update = {};
        update.struct_size = sizeof update;
        update.set = SEAGLARE_SET_POSITION;
        update.id = light.id;
        update.position_m[0] = light.home_m.x + sway_m_ * std::cos(angle);
        update.position_m[1] = light.home_m.y;
        update.position_m[2] = light.home_m.z + sway_m_ * std::sin(angle);
    }
    require(
        plugin_.api().update_lights(context_, updates_.data(), static_cast<std::uint32_t>(updates_.size()),
                                    sizeof(seaglare_light_update)),
        "moving the crowd");
}

seaglare_result Glare::render(const seaglare_frame& frame) {
    return plugin_.api().render(view_, &frame);
}

seaglare_stats Glare::stats() const {
    seaglare_stats stats{};
    stats.struct_size = sizeof stats;
    if (plugin_.stats()) require(plugin_.stats()->get_stats(view_, &stats), "reading the statistics");
    return stats;
}

seaglare_memory Glare::memory() const {
    seaglare_memory memory{};
    memory.struct_size = sizeof memory;
    if (plugin_.memory()) require(plugin_.memory()->get_memory(view_, &memory), "reading the memory held");
    return memory;
}

std::string Glare::plan() const {
    if (!plugin_.stats()) return {};
    uint32_t size = 0;
    plugin_.stats()->copy_plan(view_, nullptr, 0, &size);
    if (size == 0) return {};
    std::string text(size, '\0');
    require(plugin_.stats()->copy_plan(view_, text.data(), size, &size), "reading the plan");
    text.resize(text.find('\0') == std::string::npos ? text.size() : text.find('\0'));
    return text;
}

std::vector<float> Glare::hdr(int width_px, int height_px) const {
    if (!plugin_.hdr()) return {};
    std::vector<float> pixels(static_cast<std::size_t>(width_px) * height_px * 4);
    int32_t size[2] = {0, 0};
    require(plugin_.hdr()->read(view_, pixels.data(), pixels.size(), size), "reading the glare");
    if (size[0] != width_px || size[1] != height_px)
        throw PluginError("the glare has another size than the picture: " + std::to_string(size[0]) + "x" +
                          std::to_string(size[1]));
    return pixels;
}

std::uint32_t Glare::light_count() const {
    uint32_t count = 0;
    require(plugin_.api().list_lights(context_, nullptr, 0, &count), "counting the lights");
    return count;
}

}  // namespace seaglare::host
