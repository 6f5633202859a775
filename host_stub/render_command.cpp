#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <optional>

#include "host_stub/commands.h"
#include "host_stub/contract_check.h"
#include "host_stub/frame_report.h"
#include "host_stub/headless.h"
#include "host_stub/image_files.h"
#include "host_stub/timing.h"

namespace seaglare::host {
namespace {

void log_to_stderr(int level, std::string_view message) {
    if (level >= SEAGLARE_LOG_WARNING)
        std::cerr << (level == SEAGLARE_LOG_ERROR ? "error: " : "warning: ") << message << "\n";
}

void write_text(const std::filesystem::path& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

class Progress {
  public:
    explicit Progress(int frames) : frames_(frames), shown_(frames > 1 && isatty(STDERR_FILENO)) {}
    ~Progress() {
        if (shown_) std::fputs("\r\033[K", stderr);
    }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void done(int frame, double ms) const {
        if (!shown_) return;
        constexpr int width = 32;
        const int filled = width * frame / frames_;
        std::fprintf(stderr, "\r[%s%s] frame %d of %d, %.1f ms\033[K", std::string(filled, '#').c_str(),
                     std::string(width - filled, '.').c_str(), frame, frames_, ms);
    }

  private:
    int frames_;
    bool shown_;
};

// Around one render(): what must be equal before and after.
class Checked {
  public:
    Checked(bool on, const RenderTarget& target) : on_(on), target_(target) {
        if (!on_) return;
        pixels_ = target_.read_raw();
        poison_.emplace();
        gl_ = GlState::capture();
        process_ = ProcessState::capture();
    }
    std::vector<std::string> broken(seaglare_result result) {
        if (!on_) return {};
        glFinish();
        std::vector<std::string> found = ProcessState::differences(process_, ProcessState::capture());
        for (auto& text : GlState::differences(gl_, GlState::capture()))
            found.push_back(std::move(text));
        poison_.reset();
        if ((result < 0 || result == SEAGLARE_NOTHING_TO_DRAW) && target_.read_raw() != pixels_)
            found.emplace_back("the target was touched although render() said that it was not");
        return found;
    }

  private:
    bool on_;
    const RenderTarget& target_;
    std::vector<std::uint8_t> pixels_;
    std::optional<GlPoison> poison_;
    GlState gl_;
    ProcessState process_;
};

}  // namespace

int render_command(const RenderOptions& options) {
    Simulation simulation(options.scene);
    std::optional<Plugin> plugin;
    if (!options.without_plugin) plugin.emplace(options.scene.plugin);
    std::filesystem::create_directories(options.out);

    const HeadlessContext gl;
    NightScene picture(simulation.scene());
    RenderTarget target(simulation.channel().width_px, simulation.channel().height_px,
                        simulation.channel().target);
    std::vector<std::string> broken;
    std::optional<Glare> glare;
    if (plugin) {
        const ProcessState before = ProcessState::capture();
        glare.emplace(*plugin, simulation.scene(), simulation.channel(), simulation.observer(),
                      HeadlessContext::get_proc, log_to_stderr);
        if (options.check) broken = ProcessState::differences(before, ProcessState::capture());
    }

    std::vector<std::filesystem::path> written;
    std::vector<FrameRecord> records;
    std::vector<std::uint8_t> before;
    const double interval_s = 1 / options.frame_rate_hz, start_s = simulation.time_s();
    {
        const Progress progress(options.frames);
        for (int i = 0; i < options.frames; ++i) {
            FrameRecord record;
            simulation.go_to(start_s + i * interval_s);
            record.time_s = simulation.time_s();
            picture.set_moment(simulation.moment());
            const Camera camera = simulation.camera();
            const Stopwatch scene_watch;
            glBindFramebuffer(GL_FRAMEBUFFER, target.multisampled_fbo());
            picture.draw(camera, simulation.channel());
            target.resolve();
            glFinish();
            record.scene_ms = scene_watch.ms();
            check_gl("drawing the scene");
            const bool last = i + 1 == options.frames;
            if (last) before = target.read_srgb_rgba8();

            if (glare) {
                glare->move_lights(record.time_s);
                seaglare_frame frame =
                    make_frame(simulation, camera, target, picture.adaptation_luminance_cd_m2(), interval_s);
                frame.flags |= SEAGLARE_FRAME_WAIT;  // the same picture with every run
                Checked checked(options.check, target);
                const Stopwatch watch;
                record.result = glare->render(frame);
                record.call_ms = watch.ms();
                glFinish();
                record.plugin_ms = watch.ms();
                for (auto& text : checked.broken(record.result))
                    broken.push_back("frame " + std::to_string(i) + ": " + text);
                if (record.result < 0)
                    throw PluginError("rendering frame " + std::to_string(i) + ": " +
                                      plugin->api().result_string(record.result) + ": " +
                                      glare->last_error());
                record.stats = glare->stats();
                record.memory = glare->memory();
            }
            records.push_back(record);
            if (options.sequence) {
                char name[32];
                std::snprintf(name, sizeof name, "after_%05d.png", i);
                written.push_back(options.out / name);
                write_png(written.back(), target.width_px(), target.height_px(), target.read_srgb_rgba8());
            }
            progress.done(i + 1, record.plugin_ms);
        }
    }

    const auto path = [&](const char* name) { return written.emplace_back(options.out / name); };
    write_png(path("before.png"), target.width_px(), target.height_px(), before);
    if (glare) {
        const std::vector<float> hdr = glare->hdr(target.width_px(), target.height_px());
        if (!hdr.empty()) write_exr(path("glare.exr"), target.width_px(), target.height_px(), hdr);
        write_png(path("after.png"), target.width_px(), target.height_px(), target.read_srgb_rgba8());
        if (const std::string plan = glare->plan(); !plan.empty()) {
            write_text(path("plan.json"), plan);
            if (options.print_plan) std::cout << plan << "\n";
        }
        json::Writer out;
        out.begin_object();
        write_setting(out, simulation, picture, &*plugin, &*glare);
        std::vector<double> scene_ms, plugin_ms, call_ms;
        for (const FrameRecord& r : records) {
            scene_ms.push_back(r.scene_ms);
            plugin_ms.push_back(r.plugin_ms);
            call_ms.push_back(r.call_ms);
        }
        out.key("timing_ms");
        out.begin_object();
        write_summary(out, "scene", scene_ms);
        write_summary(out, "plugin", plugin_ms);
        write_summary(out, "plugin_call", call_ms);
        out.end_object();
        out.key("frames");
        out.begin_array();
        for (const FrameRecord& r : records)
            write_frame(out, r, *plugin);
        out.end_array();
        out.end_object();
        write_text(path("stats.json"), out.take());
    }
    for (const auto& file : written)
        std::cout << "wrote " << file.string() << "\n";
    for (const std::string& text : broken)
        std::cerr << "contract broken: " << text << "\n";
    return broken.empty() ? 0 : exit_contract_broken;
}

}  // namespace seaglare::host
