#include "host_stub/frame_report.h"

namespace seaglare::host {
namespace {

std::string gl_string(GLenum name) {
    const auto* text = reinterpret_cast<const char*>(glGetString(name));
    return text ? text : "";
}

void number(json::Writer& out, const char* key, double value) {
    out.member(key, value);
}

}  // namespace

void write_setting(json::Writer& out, const Simulation& simulation, const NightScene& picture,
                   const Plugin* plugin, const Glare* glare) {
    const Channel& channel = simulation.channel();
    out.member("scene", simulation.scene().name.c_str());
    out.member("channel", channel.name.c_str());
    out.member("observer", simulation.observer().name.c_str());
    out.key("size_px");
    out.begin_array(json::Writer::Layout::line);
    out.value(static_cast<double>(channel.width_px));
    out.value(static_cast<double>(channel.height_px));
    out.end_array();
    number(out, "local_time_h", simulation.local_time_h());
    number(out, "sun_elevation_deg", picture.sun_elevation_deg());
    number(out, "adaptation_luminance_cd_m2", picture.adaptation_luminance_cd_m2());
    out.key("gl");
    out.begin_object();
    out.member("version", gl_string(GL_VERSION).c_str());
    out.member("renderer", gl_string(GL_RENDERER).c_str());
    out.end_object();
    if (!plugin || !glare) return;
    out.key("plugin");
    out.begin_object();
    out.member("path", plugin->path().string().c_str());
    number(out, "abi_major", SEAGLARE_ABI_MAJOR);
    number(out, "abi_minor", plugin->api().abi_minor);
    out.member("degraded", glare->degraded());
    number(out, "lights", glare->light_count());
    out.end_object();
}

void write_frame(json::Writer& out, const FrameRecord& frame, const Plugin& plugin) {
    const seaglare_stats& s = frame.stats;
    out.begin_object();
    number(out, "time_s", frame.time_s);
    out.member("result", plugin.api().result_string(frame.result));
    number(out, "scene_ms", frame.scene_ms);
    number(out, "plugin_ms", frame.plugin_ms);
    number(out, "call_ms", frame.call_ms);
    out.key("stats");
    out.begin_object();
    out.member("degraded", s.degraded != 0);
    number(out, "lights_total", s.lights_total);
    number(out, "lights_drawn", s.lights_drawn);
    number(out, "lights_dark", s.lights_dark);
    number(out, "lights_horizon", s.lights_horizon);
    number(out, "lights_outside", s.lights_outside);
    number(out, "lights_below_threshold", s.lights_below_threshold);
    number(out, "draw_calls", s.draw_calls);
    number(out, "kernel_launches", s.kernel_launches);
    number(out, "pattern_size", s.pattern_size);
    number(out, "pattern_radius_px", s.pattern_radius_px);
    number(out, "pattern_layers", s.pattern_layers);
    number(out, "pattern_wavelengths", s.pattern_wavelengths);
    number(out, "pattern_angular_scale", s.pattern_angular_scale);
    number(out, "pupil_mm", s.pupil_mm);
    number(out, "adaptation_luminance_cd_m2", s.adaptation_luminance_cd_m2);
    number(out, "device_memory_bytes", s.device_memory_bytes);
    number(out, "evaluate_ms", s.evaluate_ms);
    number(out, "pattern_ms", s.pattern_ms);
    number(out, "upload_ms", s.upload_ms);
    number(out, "accumulate_ms", s.accumulate_ms);
    number(out, "composite_ms", s.composite_ms);
    number(out, "render_ms", s.render_ms);
    number(out, "occlusion_ms", s.occlusion_ms);
    number(out, "gpu_frames_ago", s.gpu_frames_ago);
    number(out, "gpu_upload_ms", s.gpu_upload_ms);
    number(out, "gpu_occlusion_ms", s.gpu_occlusion_ms);
    number(out, "gpu_accumulate_ms", s.gpu_accumulate_ms);
    number(out, "gpu_composite_ms", s.gpu_composite_ms);
    number(out, "gpu_ms", s.gpu_ms);
    out.end_object();
    const seaglare_memory& m = frame.memory;
    out.key("device_memory_bytes");
    out.begin_object();
    number(out, "hdr", m.hdr_bytes);
    number(out, "coarse_grid", m.coarse_grid_bytes);
    number(out, "background", m.background_bytes);
    number(out, "occlusion", m.occlusion_bytes);
    number(out, "lights", m.lights_bytes);
    number(out, "pattern_layers", m.pattern_layers_bytes);
    number(out, "accumulation", m.accumulation_bytes);
    number(out, "pattern_core", m.pattern_core_bytes);
    number(out, "pattern_wide_field", m.pattern_wide_field_bytes);
    number(out, "pattern_screen", m.pattern_screen_bytes);
    number(out, "total", m.total_bytes);
    out.end_object();
    out.end_object();
}

}  // namespace seaglare::host
