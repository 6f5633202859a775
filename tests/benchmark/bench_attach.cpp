// What a host waits for when it loads the plug-in: create() and create_view(), through the C interface, with empty caches of PoCL
// and Mesa and with what such a run has left in them. Every run is a process of its own. Prints CSV: mean, standard deviation
// and least of the runs, beside the target; then where it goes, program by program and kernel by kernel. `cpu` is processor
// time of all threads and of the linker, which a busy machine does not change much.
#include <dlfcn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "plugin_api/seaglare.h"
#include "tests/benchmark/attach_hooks.h"
#include "tests/gl/headless_context.h"

namespace {

using namespace seaglare::bench;
using seaglare::test::HeadlessContext;

constexpr double target_empty_ms = 2000;
constexpr double target_filled_ms = 300;

void must(seaglare_result result, const char* what) {
    if (result < 0) throw std::runtime_error(std::string(what) + " failed with " + std::to_string(result));
}

// A light straight ahead by starlight, 45 degrees.
seaglare_frame frame_of(std::uint32_t flags) {
    seaglare_frame frame{};
    frame.struct_size = sizeof frame;
    frame.flags = SEAGLARE_FRAME_HAS_ADAPTATION | flags;
    frame.viewport_px[2] = frame.viewport_px[3] = 64;
    for (const int i : {0, 5, 10, 15})
        frame.view_from_world[i] = 1;
    frame.clip_from_view[0] = frame.clip_from_view[5] = 2.414;
    frame.clip_from_view[10] = frame.clip_from_view[11] = -1;
    frame.clip_from_view[14] = -1;
    frame.adaptation_luminance_cd_m2 = 0.001;
    frame.time_s = 1;
    return frame;
}

// Prints "step,wall ms,cpu ms".
class Steps {
  public:
    void done(const char* step) {
        const Spent cost = spent_now() - begin_;
        std::printf("%s,%.2f,%.2f\n", step, cost.wall_ms, cost.cpu_ms);
        begin_ = spent_now();
    }

  private:
    Spent begin_ = spent_now();
};

void attach(bool in_parts) {
    const HeadlessContext gl;
    if (in_parts) {
        watch([](const std::string& what, const Spent& cost) {
            std::printf("%s,%.2f,%.2f\n", what.c_str(), cost.wall_ms, cost.cpu_ms);
        });
        build_nothing();
    }
    Steps steps;
    void* const library = dlopen(SEAGLARE_PLUGIN_FILE, RTLD_NOW | RTLD_LOCAL);
    const auto get_api = library != nullptr
                             ? reinterpret_cast<seaglare_get_api_fn>(dlsym(library, "seaglare_get_api"))
                             : nullptr;
    if (get_api == nullptr) throw std::runtime_error("no plug-in at " SEAGLARE_PLUGIN_FILE);
    seaglare_api api{};
    api.struct_size = sizeof api;
    must(get_api(SEAGLARE_ABI_MAJOR, &api), "get_api");
    const Spent begin = spent_now();
    seaglare_create_info info{};
    info.struct_size = sizeof info;
    info.axes = SEAGLARE_AXES_EAST_UP_SOUTH;
    seaglare_context* context = nullptr;
    must(api.create(&info, &context), "create");
    steps.done("create");
    seaglare_light light{};
    light.struct_size = sizeof light;
    light.position_m[2] = -1000;
    light.intensity_cd = 10000;
    must(api.add_light(context, &light, nullptr), "add_light");
    seaglare_view_info channel{};
    channel.struct_size = sizeof channel;
    channel.get_proc = &HeadlessContext::get_proc;
    seaglare_view* view = nullptr;
    steps.done("add_light");
    must(api.create_view(context, &channel, &view), "create_view");
    steps.done("create_view");
    const Spent attached = spent_now() - begin;
    seaglare_frame frame = frame_of(0);
    must(api.render(view, &frame), "render");
    steps.done("first frame");
    frame = frame_of(SEAGLARE_FRAME_WAIT);
    must(api.render(view, &frame), "render");
    steps.done("first frame with the pattern of its own instant");
    std::printf("attached,%.2f,%.2f\n", attached.wall_ms, attached.cpu_ms);
    std::fflush(stdout);
    watch({});
    api.destroy_view(view, 0);
    api.destroy(context);
}

// The lines of a run in a process of its own.
std::vector<std::string> run(const char* what) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    std::fflush(stdout);
    const pid_t id = fork();
    if (id == 0) {
        dup2(ends[1], 1);
        execl("/proc/self/exe", "bench_attach", what, nullptr);
        _exit(127);
    }
    close(ends[1]);
    std::string text;
    char block[4096];
    for (ssize_t size = 0; (size = read(ends[0], block, sizeof block)) > 0;)
        text.append(block, static_cast<std::size_t>(size));
    close(ends[0]);
    int status = 0;
    waitpid(id, &status, 0);
    if (status != 0) throw std::runtime_error("a run failed");
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

class Caches {
  public:
    Caches() : directory_((std::filesystem::temp_directory_path() / "seaglare_attach_XXXXXX").string()) {
        if (mkdtemp(directory_.data()) == nullptr) throw std::runtime_error("no directory for the caches");
        setenv("POCL_CACHE_DIR", directory_.c_str(), 1);
        setenv("MESA_SHADER_CACHE_DIR", directory_.c_str(), 1);
    }
    ~Caches() {
        std::error_code ignored;
        std::filesystem::remove_all(directory_, ignored);
    }
    Caches(const Caches&) = delete;
    Caches& operator=(const Caches&) = delete;

  private:
    std::string directory_;
};

struct Column {
    std::vector<double> values;
    void print() const {
        double mean = 0;
        for (const double v : values)
            mean += v / static_cast<double>(values.size());
        double square = 0;
        for (const double v : values)
            square += (v - mean) * (v - mean);
        const double deviation =
            values.size() > 1 ? std::sqrt(square / static_cast<double>(values.size() - 1)) : 0;
        std::printf(",%.0f,%.0f,%.0f", mean, deviation, *std::min_element(values.begin(), values.end()));
    }
};

struct Rows {
    std::vector<std::string> names;
    std::map<std::string, std::pair<Column, Column>> columns;
    void add(const std::vector<std::string>& lines) {
        for (const std::string& line : lines) {
            const std::size_t wall = line.find(',');
            const std::size_t cpu = line.find(',', wall + 1);
            const std::string name = line.substr(0, wall);
            if (columns.count(name) == 0) names.push_back(name);
            columns[name].first.values.push_back(std::stod(line.substr(wall + 1)));
            columns[name].second.values.push_back(std::stod(line.substr(cpu + 1)));
        }
    }
};

void print_runs(int runs) {
    Rows empty;
    Rows filled;
    for (int i = 0; i < runs; ++i) {
        const Caches caches;
        empty.add(run("run"));
        filled.add(run("run"));
    }
    double load = 0;
    std::ifstream("/proc/loadavg") >> load;
    std::printf("load %.1f on %ld cores, %d runs\n", load, sysconf(_SC_NPROCESSORS_ONLN), runs);
    std::puts("caches,step,target ms,wall ms,sd,least,cpu ms,sd,least");
    for (const auto& [caches, rows, target] :
         {std::tuple("empty", &empty, target_empty_ms), std::tuple("filled", &filled, target_filled_ms)}) {
        for (const std::string& name : rows->names) {
            std::printf("%s,%s,", caches, name.c_str());
            if (name == "attached") std::printf("%.0f", target);
            rows->columns.at(name).first.print();
            rows->columns.at(name).second.print();
            std::puts("");
        }
    }
}

void print_parts() {
    const Caches caches;
    for (const char* state : {"empty", "filled"}) {
        std::printf("caches,part,wall ms,cpu ms\n");
        for (const std::string& line : run("parts"))
            std::printf("%s,%s\n", state, line.c_str());
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const std::string what = argc > 1 ? argv[1] : "";
        if (what == "run" || what == "parts") {
            attach(what == "parts");
            return 0;
        }
        print_runs(what.empty() ? 5 : std::max(1, std::atoi(what.c_str())));
        print_parts();
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_attach: %s\n", error.what());
        return 1;
    }
}
