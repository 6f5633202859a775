#include <array>
#include <cstdio>
#include <iostream>
#include <iterator>

#include "host_stub/commands.h"
#include "host_stub/frame_report.h"
#include "host_stub/headless.h"
#include "host_stub/timing.h"

namespace seaglare::host {

int bench_command(const BenchOptions& options) {
    Simulation simulation(options.scene);
    const Plugin plugin(options.scene.plugin);
    const HeadlessContext gl;
    NightScene picture(simulation.scene());
    RenderTarget target(simulation.channel().width_px, simulation.channel().height_px,
                        simulation.channel().target);
    Glare glare(plugin, simulation.scene(), simulation.channel(), simulation.observer(),
                HeadlessContext::get_proc, {});

    // Frames with and without take turns, so that a busy machine slows both alike. The first few are not counted.
    constexpr int warm_up = 3;
    constexpr double interval_s = 1.0 / 60;
    const double start_s = simulation.time_s();
    std::vector<double> without_ms, with_ms, plugin_ms, call_ms;
    // Of the passes, as the plug-in's own statistics have them.
    const struct {
        const char* name;
        double seaglare_stats::*ms;
    } passes[] = {{"CPU evaluate", &seaglare_stats::evaluate_ms},
                  {"CPU pattern", &seaglare_stats::pattern_ms},
                  {"CPU upload", &seaglare_stats::upload_ms},
                  {"CPU occlusion", &seaglare_stats::occlusion_ms},
                  {"CPU accumulate", &seaglare_stats::accumulate_ms},
                  {"CPU composite", &seaglare_stats::composite_ms},
                  {"GPU upload", &seaglare_stats::gpu_upload_ms},
                  {"GPU occlusion", &seaglare_stats::gpu_occlusion_ms},
                  {"GPU accumulate", &seaglare_stats::gpu_accumulate_ms},
                  {"GPU composite", &seaglare_stats::gpu_composite_ms},
                  {"GPU, all passes", &seaglare_stats::gpu_ms}};
    std::array<std::vector<double>, std::size(passes)> pass_ms;
    FrameRecord last;
    for (int i = -warm_up; i < options.frames; ++i) {
        simulation.go_to(start_s + (i + warm_up) * interval_s);
        picture.set_moment(simulation.moment());
        const Camera camera = simulation.camera();
        for (const bool with : {false, true}) {
            glFinish();
            const Stopwatch frame_watch;
            glBindFramebuffer(GL_FRAMEBUFFER, target.multisampled_fbo());
            picture.draw(camera, simulation.channel());
            target.resolve();
            if (with) {
                glFinish();
                const Stopwatch watch;
                glare.move_lights(simulation.time_s());
                last.result = glare.render(
                    make_frame(simulation, camera, target, picture.adaptation_luminance_cd_m2(), interval_s));
                last.call_ms = watch.ms();
                glFinish();
                last.plugin_ms = watch.ms();
                if (last.result < 0)
                    throw PluginError("rendering: " + std::string(plugin.api().result_string(last.result)) +
                                      ": " + glare.last_error());
            }
            glFinish();
            if (i < 0) continue;
            (with ? with_ms : without_ms).push_back(frame_watch.ms());
            if (with) {
                plugin_ms.push_back(last.plugin_ms);
                call_ms.push_back(last.call_ms);
                last.stats = glare.stats();
                for (std::size_t pass = 0; pass < std::size(passes); ++pass) {
                    const bool on_gpu = passes[pass].name[0] == 'G';
                    if (!on_gpu || last.stats.gpu_frames_ago > 0)
                        pass_ms[pass].push_back(last.stats.*passes[pass].ms);
                }
            }
        }
    }
    last.time_s = simulation.time_s();
    last.stats = glare.stats();
    last.memory = glare.memory();

    const struct {
        const char* name;
        const std::vector<double>& ms;
    } rows[] = {{"frame without the plug-in", without_ms},
                {"frame with the plug-in", with_ms},
                {"the plug-in, GPU work included", plugin_ms},
                {"the plug-in's call alone", call_ms}};
    if (options.json) {
        json::Writer out;
        out.begin_object();
        write_setting(out, simulation, picture, &plugin, &glare);
        out.member("frames", static_cast<double>(options.frames));
        out.key("timing_ms");
        out.begin_object();
        for (const auto& row : rows)
            write_summary(out, row.name, row.ms);
        out.end_object();
        out.key("pass_ms");
        out.begin_object();
        for (std::size_t pass = 0; pass < std::size(passes); ++pass)
            write_summary(out, passes[pass].name, pass_ms[pass]);
        out.end_object();
        out.key("last_frame");
        write_frame(out, last, plugin);
        out.end_object();
        std::cout << out.take();
        return 0;
    }
    std::printf("%s, %s, %dx%d, %d frames, %u lights drawn of %u\n", simulation.scene().name.c_str(),
                simulation.channel().name.c_str(), target.width_px(), target.height_px(), options.frames,
                last.stats.lights_drawn, last.stats.lights_total);
    std::printf("%-32s %9s %9s %9s %9s  ms\n", "", "median", "p95", "min", "max");
    const auto print = [](const char* name, const std::vector<double>& ms) {
        std::printf("%-32s %9.2f %9.2f %9.2f %9.2f\n", name, quantile(ms, 0.5), quantile(ms, 0.95),
                    quantile(ms, 0), quantile(ms, 1));
    };
    for (const auto& row : rows)
        print(row.name, row.ms);
    for (std::size_t pass = 0; pass < std::size(passes); ++pass)
        print(passes[pass].name, pass_ms[pass]);
    return 0;
}

}  // namespace seaglare::host
