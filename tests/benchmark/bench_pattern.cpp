// The glare pattern: time per frame beside one 512 x 512 complex FFTW transform (single precision, one thread) of the same
// run, and beside the error: of the two scales against the 4096 x 4096 transform of every frame, of the others against 480
// wavelengths. Prints CSV, then the stages of the magnified pattern. `wall` is the median of the frames, `cpu` the processor
// time of all threads, the median of the frames, too; both also over the yardstick's, which is measured before and after.
#include <fftw3.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "glare/device/cl_device.h"
#include "glare/psf/cl_eye_stage.h"
#include "glare/psf/cl_screen_stage.h"
#include "glare/psf/pattern.h"
#include "glare/tone/operators.h"

namespace {

using namespace seaglare::glare;

struct Cost {
    double wall_ms = 0;
    double cpu_ms = 0;
    double worst_ms = 0;
};

double cpu_now_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

Cost measure(int runs, const std::function<void(int)>& run) {
    std::vector<double> wall;
    std::vector<double> cpu;
    for (int i = 0; i < runs; ++i) {
        const double cpu_start = cpu_now_ms();
        const auto start = std::chrono::steady_clock::now();
        run(i);
        wall.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        cpu.push_back(cpu_now_ms() - cpu_start);
    }
    return {median(wall), median(cpu), *std::max_element(wall.begin(), wall.end())};
}

Cost yardstick() {
    constexpr int n = 512;
    fftwf_complex* const plane = fftwf_alloc_complex(n * n);
    const fftwf_plan plan = fftwf_plan_dft_2d(n, n, plane, plane, FFTW_FORWARD, FFTW_MEASURE);
    std::memset(plane, 0, sizeof(fftwf_complex) * n * n);
    const Cost cost = measure(41, [&](int) { fftwf_execute(plan); });
    fftwf_destroy_plan(plan);
    fftwf_free(plane);
    return cost;
}

// Photopic luminance per illuminance at a node of the point layer; the core is left out of both.
double luminance(const Pattern& p, int a, int b) {
    const int side = 2 * p.radius_nodes + 1;
    const float* const v =
        p.skirt.data() + 4 * (static_cast<std::ptrdiff_t>(b + p.radius_nodes) * side + a + p.radius_nodes);
    return 0.2126 * static_cast<double>(v[0]) + 0.7152 * static_cast<double>(v[1]) +
           0.0722 * static_cast<double>(v[2]);
}

struct Loss {
    double radial =
        0;  // of the radial mean, the worst of rings of a tenth of their radius, 0.2 ... 4 degrees
    double contrast = 0;  // of sigma/mean at 1, 2 and 4 degrees, the worst, less one
    double codes = 0;     // the largest difference in 8-bit codes: 10 000 cd at 1 km by starlight
};

struct Ring {
    double mean = 0;
    double contrast = 0;
};
Ring ring(const Pattern& p, double degrees) {
    double sum = 0;
    double squares = 0;
    double count = 0;
    for (int b = -p.radius_nodes; b <= p.radius_nodes; ++b) {
        for (int a = -p.radius_nodes; a <= p.radius_nodes; ++a) {
            const double angle =
                std::asin(std::min(1.0, std::hypot(a, b) * p.pitch)) * 180 / std::numbers::pi;
            if (std::abs(angle - degrees) > 0.06 * degrees) continue;
            const double l = luminance(p, a, b) * angle * angle;  // about level over the ring
            sum += l;
            squares += l * l;
            count += 1;
        }
    }
    const double mean = sum / count;
    return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean)) / mean};
}

Loss loss(const Pattern& p, const Pattern& exact) {
    Loss loss;
    if (p.radius_nodes != exact.radius_nodes) return {NAN, NAN, NAN};
    for (double degrees = 0.25; degrees < 3.6; degrees *= 1.15)
        loss.radial = std::max(loss.radial, std::abs(ring(p, degrees).mean / ring(exact, degrees).mean - 1));
    for (double degrees : {0.5, 1.0, 2.0, 3.0}) {
        const double change = ring(p, degrees).contrast / ring(exact, degrees).contrast - 1;
        if (std::abs(change) > std::abs(loss.contrast)) loss.contrast = change;
    }
    constexpr double illuminance_lx = 1e-2;
    constexpr double background_cd_m2 = 1e-3;
    const ToneCurve curve = tone_curve({}, background_cd_m2);
    const auto code = [&](double l) {
        return 255 * srgb_encode(std::min(1.0, tone_map(curve, background_cd_m2 + illuminance_lx * l)));
    };
    for (int b = -p.radius_nodes; b <= p.radius_nodes; ++b)
        for (int a = -p.radius_nodes; a <= p.radius_nodes; ++a)
            loss.codes =
                std::max(loss.codes, std::abs(code(luminance(p, a, b)) - code(luminance(exact, a, b))));
    return loss;
}

struct Case {
    std::string name;
    PatternSettings settings;
    PatternSettings exact;
    EyeModel eye;
    double largest_disc = 0;
    double pitch = 1 / 869.1;
    bool moving = false;
};

PatternRequest request_at(const Case& c, int frame) {
    PatternRequest request;
    request.time_s = frame / 60.0;
    request.resting_pupil_mm = 6.4;
    request.pupil_mm = pupil_diameter_mm(
        [&] {
            EyeModel e = c.eye;
            e.fixed_pupil_mm = 6.4;
            return e;
        }(),
        0, request.time_s, 7);
    request.pitch = c.pitch;
    request.largest_disc_nodes = static_cast<float>(c.largest_disc);
    return request;
}

// The steps of the chain one after another, each waited for.
void print_stages(const Case& c, const Cost& unit) {
    const ClDevice device;
    ClEyeStage eye(device, c.eye, c.settings, 7);
    ClScreenStage screen(device, c.settings, sample_lamps(c.settings.wavelengths));
    const PatternGrid grid = plan_grid(c.settings, c.pitch);
    Pattern pattern;
    pattern.layer_radius_nodes = plan_layers(c.settings, grid, static_cast<float>(c.largest_disc));
    screen.reserve(grid, pattern.layer_radius_nodes.size());
    constexpr double pupil_mm = 6.4;
    const auto print = [&](const char* stage, const std::function<void(int)>& run) {
        const auto waited = [&](int i) {
            run(i);
            device.finish();
        };
        measure(4, waited);
        const Cost cost = measure(40, waited);
        std::printf("\"%s\",%s,%.3f,%.3f,%.2f,%.2f\n", c.name.c_str(), stage, cost.wall_ms, cost.cpu_ms,
                    cost.wall_ms / unit.wall_ms, cost.cpu_ms / unit.cpu_ms);
    };
    print("aperture", [&](int i) { eye.draw_aperture(pupil_mm + 1e-5 * i, i / 60.0); });
    print("transform", [&](int /*i*/) { eye.transform(); });
    eye.draw_aperture(pupil_mm, 0);
    eye.transform();
    print("cumulative energy", [&](int /*i*/) { eye.accumulate(pupil_mm); });
    print("chromatic spread", [&](int /*i*/) { screen.spread(eye, grid); });
    print("core and skirt", [&](int /*i*/) { screen.split(grid, 1); });
    print("disc layers", [&](int /*i*/) { screen.average_discs(grid, pattern.layer_radius_nodes); });
    print("read back", [&](int /*i*/) { screen.read_back(grid, pattern); });
}

Case thesis_case(const std::string& name, int wavelengths, const std::vector<float>& layers) {
    Case c;
    c.name = name;
    c.settings = thesis_settings();
    c.settings.wavelengths = wavelengths;
    c.settings.layer_radii_px = layers;
    c.exact = c.settings;
    c.exact.wavelengths = 480;
    c.eye = thesis_eye();
    c.largest_disc = static_cast<double>(layers.back());
    return c;
}

Case physical_case() {
    Case c;
    c.name = "512 at physical angles, 30 wavelengths, 3 layers";
    c.settings.transform_size = 512;
    c.settings.layer_radii_px = {0, 1, 2};
    c.exact = c.settings;
    c.exact.wavelengths = 480;
    c.eye = young_eye();
    c.largest_disc = 2;
    return c;
}

Case two_scale_case(int core, bool moving, double pitch) {
    Case c;
    c.name = "two scales " + std::to_string(core) + " + 4096";
    c.settings.transform_size = core;
    c.settings.wide_field_size = 4096;
    c.eye = young_eye();
    c.pitch = pitch;
    c.moving = moving;
    if (moving)
        for (ParticleFamily& family : c.eye.particles)
            family.drift_um = 60;
    return c;
}

}  // namespace

int main(int argc, char** argv) {
    const int frames = argc > 1 ? std::atoi(argv[1]) : 240;
    std::vector<Case> cases;
    cases.push_back(thesis_case("512, 30 wavelengths, 3 layers", 30, {0, 1, 2}));
    cases.push_back(thesis_case("512, 60 wavelengths, layers to 10 px", 60, {0, 1.7F, 3.05F, 6.35F, 10}));
    cases.push_back(physical_case());
    const std::size_t first_of_two_scales = cases.size();
    for (const double pitch : {1 / 869.1, 1 / 4030.6})
        for (const bool moving : {false, true})
            for (const int core : {512, 1024})
                cases.push_back(two_scale_case(core, moving, pitch));

    std::puts(
        "case,moving,pitch,frames,wall ms,cpu ms,worst ms,FFTW 512 ms,wall ratio,cpu ratio,MiB,radial "
        "loss,contrast loss,codes");
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const Case& c = cases[i];
        const auto source = make_cl_pattern_source(c.eye, c.settings, 7);
        source->warm_up(c.pitch);
        source->make(request_at(c, 0));
        const Cost before = yardstick();
        const int runs = i < first_of_two_scales ? 60 : frames;
        const Cost cost = measure(runs, [&](int f) { source->make(request_at(c, f + 1)); });
        const Cost after = yardstick();
        const double unit_wall = 0.5 * (before.wall_ms + after.wall_ms);
        const double unit_cpu = 0.5 * (before.cpu_ms + after.cpu_ms);
        Loss worst;
        const auto exact = make_cl_pattern_source(c.eye, c.exact, 7);
        for (const int frame : {30, 60, 95, 150, 200}) {
            const Loss here = loss(source->make(request_at(c, frame)), exact->make(request_at(c, frame)));
            worst.radial = std::max(worst.radial, here.radial);
            if (std::abs(here.contrast) > std::abs(worst.contrast)) worst.contrast = here.contrast;
            worst.codes = std::max(worst.codes, here.codes);
        }
        std::printf("\"%s\",%d,1/%.1f,%d,%.2f,%.2f,%.2f,%.2f,%.1f,%.1f,%.1f,%.4f,%.3f,%.2f\n", c.name.c_str(),
                    static_cast<int>(c.moving), 1 / c.pitch, runs, cost.wall_ms, cost.cpu_ms, cost.worst_ms,
                    unit_wall, cost.wall_ms / unit_wall, cost.cpu_ms / unit_cpu,
                    source->device_memory_bytes() / 1048576, worst.radial, worst.contrast, worst.codes);
        std::fflush(stdout);
    }
    std::puts("case,stage,wall ms,cpu ms,wall ratio,cpu ratio");
    for (std::size_t i = 0; i < first_of_two_scales; ++i)
        print_stages(cases[i], yardstick());
    return 0;
}
