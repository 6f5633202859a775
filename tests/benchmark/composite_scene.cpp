#include "tests/benchmark/composite_scene.h"

#include <filesystem>
#include <stdexcept>

#include "host_stub/gl_objects.h"
#include "host_stub/headless.h"
#include "host_stub/night_scene.h"
#include "host_stub/plugin.h"
#include "host_stub/simulation.h"

namespace seaglare::benchmark {

Captured capture(const std::string& name) {
    const std::filesystem::path config = std::filesystem::path(SEAGLARE_SOURCE_DIR) / "config";
    host::SceneOptions options;
    options.scene = config / "scenes" / (name + ".json");
    options.size = "1280x720";
    host::Simulation simulation(options);
    const host::Plugin plugin{std::filesystem::path(SEAGLARE_PLUGIN_FILE)};
    host::NightScene scene(simulation.scene());
    host::Channel& channel = simulation.channel();
    channel.target = host::TargetFormat::rgba8_srgb_values;
    host::RenderTarget target(channel.width_px, channel.height_px, channel.target);
    scene.set_moment(simulation.moment());
    glBindFramebuffer(GL_FRAMEBUFFER, target.multisampled_fbo());
    scene.draw(simulation.camera(), channel);
    target.resolve();
    Captured captured{channel.width_px, channel.height_px, scene.adaptation_luminance_cd_m2(), 0, {}, {}};
    captured.codes.resize(static_cast<std::size_t>(captured.width_px) *
                          static_cast<std::size_t>(captured.height_px) * 4);
    glBindFramebuffer(GL_FRAMEBUFFER, target.fbo());
    glReadPixels(0, 0, captured.width_px, captured.height_px, GL_RGBA, GL_UNSIGNED_BYTE,
                 captured.codes.data());
    host::Glare glare(plugin, simulation.scene(), channel, simulation.observer(),
                      host::HeadlessContext::get_proc, [](int, std::string_view) {});
    glare.move_lights(simulation.time_s());
    seaglare_frame frame =
        make_frame(simulation, simulation.camera(), target, captured.adaptation_cd_m2, 1.0 / 60);
    frame.flags |= SEAGLARE_FRAME_WAIT;
    captured.ldr_white_cd_m2 = frame.ldr_white_luminance_cd_m2;
    if (glare.render(frame) < SEAGLARE_OK) throw std::runtime_error(glare.last_error());
    captured.rgbv = glare.hdr(captured.width_px, captured.height_px);
    return captured;
}

}  // namespace seaglare::benchmark
