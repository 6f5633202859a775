#include "host_stub/simulation.h"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <numbers>
#include <stdexcept>

namespace seaglare::host {
namespace {

constexpr double knot_m_s = 1852.0 / 3600;

template <class List>
std::string names_of(const List& list) {
    std::string text;
    for (const auto& item : list)
        text += (text.empty() ? "" : ", ") + item.name;
    return text;
}

int32_t encoding_of(TargetFormat format) {
    switch (format) {
        case TargetFormat::srgb8_alpha8:
            return SEAGLARE_TARGET_SRGB_FORMAT;
        case TargetFormat::rgba16f_linear:
            return SEAGLARE_TARGET_LINEAR;
        case TargetFormat::rgba8_srgb_values:
            break;
    }
    return SEAGLARE_TARGET_SRGB_VALUES;
}

}  // namespace

double parse_time_of_day(const std::string& text) {
    int hours = 0, minutes = 0, used = 0;
    double seconds = 0;
    const char* const end = text.c_str() + text.size();
    const bool plain = std::sscanf(text.c_str(), "%2d:%2d%n", &hours, &minutes, &used) == 2;
    const char* rest = text.c_str() + (plain ? used : 0);
    if (plain && rest != end && std::sscanf(rest, ":%lf%n", &seconds, &used) == 1) rest += used;
    if (!plain || rest != end || hours < 0 || hours > 23 || minutes < 0 || minutes > 59 ||
        !(seconds >= 0 && seconds < 60))
        throw std::invalid_argument("time '" + text + "' is not HH:MM or HH:MM:SS");
    return hours + minutes / 60.0 + seconds / 3600;
}

Simulation::Simulation(const SceneOptions& options) : scene_(load_scene(options.scene)) {
    const Channel* channel = scene_.find_channel(options.channel);
    if (!channel)
        throw std::invalid_argument("scene '" + scene_.name + "' has no channel '" + options.channel +
                                    "'; it has " + names_of(scene_.channels));
    channel_ = *channel;
    const Observer* observer = scene_.find_observer(options.observer);
    if (!observer)
        throw std::invalid_argument("scene '" + scene_.name + "' has no observer '" + options.observer +
                                    "'; it has " + names_of(scene_.observers));
    observer_ = *observer;
    if (!options.size.empty()) {
        int width = 0, height = 0, used = 0;
        if (std::sscanf(options.size.c_str(), "%dx%d%n", &width, &height, &used) != 2 ||
            static_cast<std::size_t>(used) != options.size.size() || width < 1 || height < 1 ||
            width > 16384 || height > 16384)
            throw std::invalid_argument("size '" + options.size +
                                        "' is not WIDTHxHEIGHT from 1x1 to 16384x16384");
        channel_.resize(width, height);
    }
    if (!options.quality.empty()) scene_.quality_file = options.quality;
    time_s_ = options.start_s.value_or(scene_.start_s);
    local_time_h_ = options.time.empty() ? scene_.local_time_h : parse_time_of_day(options.time);
}

void Simulation::go_to(double time_s) {
    const double dt = time_s - time_s_;
    const double course = observer_.heading_deg * std::numbers::pi / 180;
    observer_.position_m +=
        glm::dvec2(std::sin(course), std::cos(course)) * (observer_.speed_kn * knot_m_s * dt);
    set_local_time_h(local_time_h_ + time_of_day_rate * dt / 3600);
    time_s_ = time_s;
}

void Simulation::set_local_time_h(double hours) {
    local_time_h_ = hours - 24 * std::floor(hours / 24);
}

Camera Simulation::camera() const {
    return make_camera(channel_, {observer_.position_m, observer_.eye_height_m}, observer_.heading_deg,
                       observer_.pitch_deg);
}

seaglare_frame make_frame(const Simulation& simulation, const Camera& camera, const RenderTarget& target,
                          double adaptation_cd_m2, double interval_s) {
    seaglare_frame frame{};
    frame.struct_size = sizeof frame;
    frame.flags = SEAGLARE_FRAME_HAS_ADAPTATION | SEAGLARE_FRAME_HAS_TIME_OF_DAY;
    frame.target_fbo = target.fbo();
    frame.target_encoding = encoding_of(target.format());
    frame.viewport_px[2] = target.width_px();
    frame.viewport_px[3] = target.height_px();
    frame.depth_source = SEAGLARE_DEPTH_TEXTURE;
    frame.depth_object = target.depth_texture();
    frame.depth_convention = SEAGLARE_DEPTH_STANDARD;
    std::memcpy(frame.view_from_world, glm::value_ptr(camera.view_from_world), sizeof frame.view_from_world);
    std::memcpy(frame.clip_from_view, glm::value_ptr(camera.clip_from_view), sizeof frame.clip_from_view);
    frame.time_s = simulation.time_s();
    frame.frame_interval_s = interval_s;
    frame.adaptation_luminance_cd_m2 = adaptation_cd_m2;
    frame.local_time_of_day_h = simulation.local_time_h();
    // ldr_white_luminance_cd_m2 stays 0: this host draws with the same photographic curve as the plug-in's default, so
    // that the plug-in's own inverse is exact where one luminance for white would only be near.
    if (simulation.scene().visibility_m) {
        frame.flags |= SEAGLARE_FRAME_HAS_FOG;
        frame.meteorological_visibility_m = *simulation.scene().visibility_m;
    }
    return frame;
}

}  // namespace seaglare::host
