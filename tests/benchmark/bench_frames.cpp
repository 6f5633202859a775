// Frames that do not wait for their pattern, as a host shows them that draws one after the other: what the call takes by the
// clock while the pattern of the next instant is made beside it. Prints CSV, milliseconds: the call and the picture (glFinish)
// by the clock, and the processor time of all threads, pattern included, per frame.
//
//   bench_frames [--frames N] [--size WxH] [--plugin FILE] [--timeline FILE] [SCENE...]
//
// `eye_hz` is how far the eye's time moves from frame to frame; `paced`: frames begin at those times by the clock, too, and not
// as soon as the one before is there. With --timeline every command of OpenCL and every frame is written to FILE, on one
// clock (frames_timeline.h): the commands' events cost time, so that the figures beside it are not to be compared.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "host_stub/gl_objects.h"
#include "host_stub/headless.h"
#include "host_stub/night_scene.h"
#include "host_stub/plugin.h"
#include "host_stub/simulation.h"
#include "tests/benchmark/frames_timeline.h"

namespace {

using namespace seaglare;

double clock_ms(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

// The value that this share of all values does not exceed.
double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const auto last = static_cast<double>(values.size() - 1);
    return values[static_cast<std::size_t>(std::lround(share * last))];
}

struct Options {
    int frames = 300;
    std::string size = "1280x720";
    std::filesystem::path plugin = SEAGLARE_PLUGIN_FILE;
    std::string timeline;  // empty: none
    std::vector<std::string> scenes;
};
struct Pace {
    double eye_hz;
    bool paced;
};

// One view of a scene; the host's own picture is drawn once, because it is the call that counts.
class Host {
  public:
    Host(const std::string& name, const Options& options)
        : simulation_(options_of(name, options.size)), plugin_(options.plugin) {
        host::Channel& channel = simulation_.channel();
        channel.target = host::TargetFormat::rgba8_srgb_values;
        host::NightScene picture(simulation_.scene());
        target_.emplace(channel.width_px, channel.height_px, channel.target);
        picture.set_moment(simulation_.moment());
        glBindFramebuffer(GL_FRAMEBUFFER, target_->multisampled_fbo());
        picture.draw(simulation_.camera(), channel);
        target_->resolve();
        adaptation_cd_m2_ = picture.adaptation_luminance_cd_m2();
        glare_ = std::make_unique<host::Glare>(plugin_, simulation_.scene(), channel, simulation_.observer(),
                                               host::HeadlessContext::get_proc, [](int, std::string_view) {});
    }

    // Of the eye's next instant. Colours alone are cleared: what hides lights stays.
    void next(double interval_s, bool waits) {
        simulation_.go_to(simulation_.time_s() + interval_s);
        glare_->move_lights(simulation_.time_s());
        glBindFramebuffer(GL_FRAMEBUFFER, target_->fbo());
        glClearColor(0, 0, 0, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        glFinish();
        frame_ = make_frame(simulation_, simulation_.camera(), *target_, adaptation_cd_m2_, interval_s);
        if (waits) frame_.flags |= SEAGLARE_FRAME_WAIT;
    }
    void render() {
        if (glare_->render(frame_) < SEAGLARE_OK) throw std::runtime_error(glare_->last_error());
    }
    seaglare_stats stats() const { return glare_->stats(); }

  private:
    static host::SceneOptions options_of(const std::string& name, const std::string& size) {
        host::SceneOptions options;
        options.scene = std::filesystem::path(SEAGLARE_SOURCE_DIR) / "config" / "scenes" / (name + ".json");
        options.size = size;
        return options;
    }
    host::Simulation simulation_;
    host::Plugin plugin_;
    std::optional<host::RenderTarget> target_;
    std::unique_ptr<host::Glare> glare_;
    double adaptation_cd_m2_ = 0;
    seaglare_frame frame_{};
};

void measure(const std::string& scene, const Pace& pace, const Options& options) {
    // Everything is compiled, and has been there once.
    constexpr int waiting = 3;
    constexpr int not_counted = 40;
    const double interval_s = 1 / pace.eye_hz;
    const int frames = options.frames;
    Host host(scene, options);
    std::vector<double> call_ms, picture_ms, accumulate_ms;
    double cpu_begin_ms = 0;
    double begin_ms = 0;
    int patterns = 0;
    std::uint64_t lights = 0;
    for (int i = -waiting - not_counted; i < frames; ++i) {
        if (i == 0) {
            cpu_begin_ms = clock_ms(CLOCK_PROCESS_CPUTIME_ID);
            begin_ms = clock_ms(CLOCK_MONOTONIC);
        }
        if (i > 0 && pace.paced) {
            const double early_ms = begin_ms + 1e3 * interval_s * i - clock_ms(CLOCK_MONOTONIC);
            if (early_ms > 0)
                std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(early_ms));
        }
        host.next(interval_s, i < -not_counted);
        const double from_ms = clock_ms(CLOCK_MONOTONIC);
        benchmark::note_frame(i, "call");
        host.render();
        const double called_ms = clock_ms(CLOCK_MONOTONIC);
        benchmark::note_frame(i, "returned");
        glFinish();
        const double drawn_ms = clock_ms(CLOCK_MONOTONIC);
        benchmark::note_frame(i, "drawn");
        if (i < 0) continue;
        const seaglare_stats stats = host.stats();
        call_ms.push_back(called_ms - from_ms);
        picture_ms.push_back(drawn_ms - from_ms);
        accumulate_ms.push_back(stats.accumulate_ms);
        patterns += stats.kernel_launches > 0 ? 1 : 0;
        lights = stats.lights_drawn;
    }
    const double cpu_ms = (clock_ms(CLOCK_PROCESS_CPUTIME_ID) - cpu_begin_ms) / frames;
    const double whole_s = (clock_ms(CLOCK_MONOTONIC) - begin_ms) / 1e3;
    std::printf("%s,%s,%llu,%.0f,%s,%d,%.1f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%d\n",
                scene.c_str(), options.size.c_str(), static_cast<unsigned long long>(lights), pace.eye_hz,
                pace.paced ? "yes" : "no", frames, frames / whole_s, quantile(call_ms, 0.5),
                quantile(call_ms, 0.95), quantile(call_ms, 1), quantile(picture_ms, 0.5),
                quantile(picture_ms, 0.95), quantile(picture_ms, 1), quantile(accumulate_ms, 0.5),
                quantile(accumulate_ms, 0.95), quantile(accumulate_ms, 1), cpu_ms, patterns);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; ++i) {
        const auto is = [&](const char* name) { return std::strcmp(argv[i], name) == 0 && i + 1 < argc; };
        if (is("--frames"))
            options.frames = std::max(std::atoi(argv[++i]), 1);
        else if (is("--size"))
            options.size = argv[++i];
        else if (is("--plugin"))
            options.plugin = argv[++i];
        else if (is("--timeline"))
            options.timeline = argv[++i];
        else
            options.scenes.emplace_back(argv[i]);
    }
    if (options.scenes.empty()) options.scenes = {"great_belt_night", "thesis_many_lights"};
    try {
        const host::HeadlessContext context;
        if (!options.timeline.empty()) benchmark::begin_timeline();
        std::printf(
            "scene,size,lights,eye_hz,paced,frames,frames_per_s,call_median_ms,call_p95_ms,call_largest_ms,"
            "picture_median_ms,picture_p95_ms,picture_largest_ms,accumulate_median_ms,accumulate_p95_ms,"
            "accumulate_largest_ms,processor_ms_a_frame,frames_with_a_new_pattern\n");
        for (const std::string& scene : options.scenes)
            for (const Pace& pace : {Pace{60, false}, Pace{60, true}, Pace{10, false}})
                measure(scene, pace, options);
        if (!options.timeline.empty()) benchmark::write_timeline(options.timeline);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_frames: %s\n", error.what());
        return 1;
    }
    return 0;
}
