// What a host waits for when it makes its first view: shaders, the OpenCL device, kernels, the first launch of each. Every
// line is a process of its own: the first with empty caches of PoCL and Mesa, the next with what that one has left behind.
// Prints CSV; `cpu` is the processor time of all threads, which a busy machine does not change much.
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "glare/apply/view_renderer.h"
#include "glare/psf/cl_eye_stage.h"
#include "glare/psf/cl_screen_stage.h"
#include "glare/psf/two_scale.h"
#include "tests/gl/headless_context.h"

namespace {

using namespace seaglare::glare;
using seaglare::test::HeadlessContext;

constexpr double pitch = 1 / 869.1;  // 45 degrees, 720 lines

double cpu_now_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

class Steps {
  public:
    explicit Steps(const char* caches) : caches_(caches) {}
    void done(const char* step) {
        const auto now = std::chrono::steady_clock::now();
        const double cpu_ms = cpu_now_ms();
        std::printf("%s,%s,%.0f,%.0f\n", caches_, step,
                    std::chrono::duration<double, std::milli>(now - wall_).count(), cpu_ms - cpu_ms_);
        std::fflush(stdout);
        wall_ = std::chrono::steady_clock::now();
        cpu_ms_ = cpu_now_ms();
    }

  private:
    const char* caches_;
    std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
    double cpu_ms_ = cpu_now_ms();
};

PatternSettings default_settings() {
    PatternSettings settings;
    settings.transform_size = 512;
    settings.wide_field_size = 4096;
    return settings;
}

// The parts one after the other.
void attach_in_parts(Steps& steps) {
    const HeadlessContext gl;
    steps.done("the host's GL context");
    const ViewRenderer renderer(gl.gl());
    steps.done("GL shaders");
    const ClDevice device;
    steps.done("OpenCL device");
    const PatternSettings settings = default_settings();
    const EyeModel eye;
    ClEyeStage core(device, eye, settings, 1);
    steps.done("core: programs and FFT plan");
    WideField wide(device, eye, settings, 1);
    core.fade(wide.join().inner, wide.join().outer);
    steps.done("wide field: programs and FFT plans");
    ClScreenStage screen(device, settings, sample_lamps(settings.wavelengths));
    steps.done("screen: program");
    core.update(6, 0);
    device.finish();
    steps.done("core: first launches");
    wide.advance(0, 6, pitch);
    device.finish();
    steps.done("wide field: first table");
}

// As the product does it.
void attach(Steps& steps) {
    const HeadlessContext gl;
    steps.done("the host's GL context");
    const ViewRenderer renderer(gl.gl());
    steps.done("whole: GL shaders");
    const auto source = make_cl_pattern_source(EyeModel{}, default_settings(), 1);
    steps.done("whole: create");
    source->warm_up(pitch);
    steps.done("whole: create_view");
    PatternRequest request;
    request.pupil_mm = 6;
    request.time_s = 1.0 / 60;
    request.pitch = pitch;
    source->make(request);
    steps.done("whole: first pattern");
}

int child(const char* program, const char* what, const char* caches) {
    std::fflush(stdout);
    const pid_t id = fork();
    if (id == 0) {
        execl(program, program, what, caches, nullptr);
        _exit(127);
    }
    int status = 0;
    waitpid(id, &status, 0);
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc == 3) {
            Steps steps(argv[2]);
            if (std::strcmp(argv[1], "parts") == 0)
                attach_in_parts(steps);
            else
                attach(steps);
            return 0;
        }
        std::printf("caches,step,wall_ms,cpu_ms\n");
        for (const char* what : {"whole", "parts"}) {
            std::string directory =
                (std::filesystem::temp_directory_path() / "seaglare_attach_XXXXXX").string();
            if (mkdtemp(directory.data()) == nullptr) throw std::runtime_error("no directory for the caches");
            setenv("POCL_CACHE_DIR", directory.c_str(), 1);
            setenv("MESA_SHADER_CACHE_DIR", directory.c_str(), 1);
            int status = 0;
            for (const char* caches : {"empty", "filled", "filled"})
                status |= child("/proc/self/exe", what, caches);
            std::filesystem::remove_all(directory);
            if (status != 0) throw std::runtime_error("a part of the run failed");
        }
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_attach: %s\n", error.what());
        return 1;
    }
}
