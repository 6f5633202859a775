// What it costs to say what passes take: frames of a shipped scene drawn by views of one context by turns, with timestamp queries
// and debug groups and without, and by a second one without, which shows how far two equal views are apart. Prints CSV:
// processor time of all threads and of the thread that calls, of the call and until the picture is there; means, and of the
// differences their standard errors. Another view has the pattern of the instant made before, so that it is in no figure: of
// frames that make theirs, the share is less.
//
//   bench_timing [--frames N] [--size WxH] [SCENE...]
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <numeric>
#include <optional>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "host_stub/gl_objects.h"
#include "host_stub/headless.h"
#include "host_stub/night_scene.h"
#include "host_stub/plugin.h"
#include "host_stub/simulation.h"

namespace {

using namespace seaglare;

double clock_ms(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

// The mean without the largest and the least fiftieth, which another program made, and its standard error. Not the median: not every
// frame of a large picture is timed.
struct Mean {
    double value = 0;
    double error = 0;
};
Mean mean_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t cut = values.size() / 50;
    const std::span<const double> kept(values.begin() + static_cast<std::ptrdiff_t>(cut),
                                       values.end() - static_cast<std::ptrdiff_t>(cut));
    const auto count = static_cast<double>(kept.size());
    const double mean = std::accumulate(kept.begin(), kept.end(), 0.0) / count;
    double squares = 0;
    for (const double value : kept)
        squares += (value - mean) * (value - mean);
    return {mean, std::sqrt(squares / std::max(count - 1, 1.0) / count)};
}

enum Who : std::size_t { timed, untimed, also_untimed, who_count };

struct Cost {
    std::vector<double> all_threads_ms, caller_ms;
};

class Host {
  public:
    Host(const std::string& name, const std::string& size)
        : simulation_(options_of(name, size)), plugin_(SEAGLARE_PLUGIN_FILE) {
        host::Channel& channel = simulation_.channel();
        channel.target = host::TargetFormat::rgba8_srgb_values;
        host::NightScene picture(simulation_.scene());
        target_.emplace(channel.width_px, channel.height_px, channel.target);
        picture.set_moment(simulation_.moment());
        glBindFramebuffer(GL_FRAMEBUFFER, target_->multisampled_fbo());
        picture.draw(simulation_.camera(), channel);
        target_->resolve();
        adaptation_cd_m2_ = picture.adaptation_luminance_cd_m2();
        glare_.emplace(plugin_, simulation_.scene(), channel, simulation_.observer(),
                       host::HeadlessContext::get_proc, [](int, std::string_view) {});
        for (std::size_t who = 0; who < who_count; ++who) {
            seaglare_view_info info{};
            info.struct_size = sizeof info;
            info.get_proc = host::HeadlessContext::get_proc;
            info.channel_name = channel.name.c_str();
            info.flags = who == timed ? 0 : SEAGLARE_VIEW_NO_GPU_TIMES;
            if (plugin_.api().create_view(glare_->context(), &info, &views_[who]) < SEAGLARE_OK)
                throw std::runtime_error(glare_->last_error());
        }
    }
    ~Host() {
        for (seaglare_view* const view : views_)
            if (view != nullptr) plugin_.api().destroy_view(view, 0);
    }
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

    // Has the pattern of the next instant made. Frames that wait are planned alike by every view.
    void next() {
        constexpr double interval_s = 1.0 / 60;
        simulation_.go_to(simulation_.time_s() + interval_s);
        glare_->move_lights(simulation_.time_s());
        frame_ = make_frame(simulation_, simulation_.camera(), *target_, adaptation_cd_m2_, interval_s);
        frame_.flags |= SEAGLARE_FRAME_WAIT;
        blank();
        if (glare_->render(frame_) < SEAGLARE_OK) throw std::runtime_error(glare_->last_error());
        glFinish();
    }
    void draw(Who who, Cost& cost) {
        blank();
        const double all_ms = clock_ms(CLOCK_PROCESS_CPUTIME_ID);
        const double caller_ms = clock_ms(CLOCK_THREAD_CPUTIME_ID);
        if (plugin_.api().render(views_[who], &frame_) < SEAGLARE_OK)
            throw std::runtime_error(glare_->last_error());
        glFinish();
        cost.caller_ms.push_back(clock_ms(CLOCK_THREAD_CPUTIME_ID) - caller_ms);
        cost.all_threads_ms.push_back(clock_ms(CLOCK_PROCESS_CPUTIME_ID) - all_ms);
    }

  private:
    // Colours alone: what hides lights stays.
    void blank() const {
        glBindFramebuffer(GL_FRAMEBUFFER, target_->fbo());
        glClearColor(0, 0, 0, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        glFinish();
    }
    static host::SceneOptions options_of(const std::string& name, const std::string& size) {
        host::SceneOptions options;
        options.scene = std::filesystem::path(SEAGLARE_SOURCE_DIR) / "config" / "scenes" / (name + ".json");
        options.size = size;
        return options;
    }
    host::Simulation simulation_;
    host::Plugin plugin_;
    std::optional<host::RenderTarget> target_;
    std::optional<host::Glare> glare_;
    std::array<seaglare_view*, who_count> views_{};
    double adaptation_cd_m2_ = 0;
    seaglare_frame frame_{};
};

void print_row(const std::string& scene, const std::string& size, const char* threads, const char* what,
               const std::vector<double>& with, const std::vector<double>& without) {
    std::vector<double> more;
    for (std::size_t i = 0; i < with.size(); ++i)
        more.push_back(with[i] - without[i]);
    const double whole_ms = mean_of(without).value;
    const Mean added = mean_of(more);
    std::printf("%s,%s,%zu,%s,%s,%.3f,%.1f,%.1f,%.2f,%.2f\n", scene.c_str(), size.c_str(), with.size(), what,
                threads, whole_ms, 1e3 * added.value, 1e3 * added.error, 100 * added.value / whole_ms,
                100 * added.error / whole_ms);
}

void measure(const std::string& scene, const std::string& size, int frames) {
    // Everything is compiled, and has been there once.
    constexpr int not_counted = 20;
    Host host(scene, size);
    std::array<Cost, who_count> costs;
    std::array<Who, who_count> turns = {timed, untimed, also_untimed};
    std::mt19937 random(1);
    for (int i = -not_counted; i < frames; ++i) {
        if (i == 0) costs = {};
        host.next();
        std::shuffle(turns.begin(), turns.end(), random);
        for (const Who who : turns)
            host.draw(who, costs[who]);
    }
    const Cost& without = costs[untimed];
    const auto rows = [&](const char* what, const Cost& with) {
        print_row(scene, size, "all", what, with.all_threads_ms, without.all_threads_ms);
        print_row(scene, size, "the caller's", what, with.caller_ms, without.caller_ms);
    };
    rows("timings and groups", costs[timed]);
    rows("nothing", costs[also_untimed]);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    int frames = 400;
    std::string size = "1280x720";
    std::vector<std::string> scenes;
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "--frames") == 0 && i + 1 < argc)
            frames = std::max(std::atoi(argv[++i]), 1);
        else if (std::strcmp(argv[i], "--size") == 0 && i + 1 < argc)
            size = argv[++i];
        else
            scenes.emplace_back(argv[i]);
    }
    if (scenes.empty()) scenes = {"great_belt_night"};
    try {
        const host::HeadlessContext context;
        std::printf(
            "scene,size,frames,added,threads,without_ms,more_us,error_us,more_percent,error_percent\n");
        for (const std::string& scene : scenes)
            measure(scene, size, frames);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_timing: %s\n", error.what());
        return 1;
    }
    return 0;
}
