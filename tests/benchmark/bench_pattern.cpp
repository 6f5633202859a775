// The glare pattern: time per frame beside one 512 x 512 complex FFTW transform (single precision, one thread) of the same
// run, and beside the error against the 4096 x 4096 transform of every frame. Prints CSV. `wall` is the median of the
// frames, `cpu` the processor time of all threads; both also over the yardstick's.
#include <fftw3.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <functional>
#include <numbers>
#include <vector>

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
    const double cpu = cpu_now_ms();
    for (int i = 0; i < runs; ++i) {
        const auto start = std::chrono::steady_clock::now();
        run(i);
        wall.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    }
    const double spent = (cpu_now_ms() - cpu) / runs;
    return {median(wall), spent, *std::max_element(wall.begin(), wall.end())};
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
    const char* name;
    PatternSettings settings;
    EyeModel eye;
    double largest_disc = 0;
    double pitch = 1 / 869.1;
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

}  // namespace

int main(int argc, char** argv) {
    const int frames = argc > 1 ? std::atoi(argv[1]) : 240;
    std::vector<Case> cases;
    const EyeModel still = young_eye();
    EyeModel moving = young_eye();
    for (ParticleFamily& family : moving.particles)
        family.drift_um = 60;
    Case thesis{"512, 30 wavelengths, 3 layers", thesis_settings(), thesis_eye(), 2};
    thesis.settings.layer_radii_px = {0, 1, 2};
    cases.push_back(thesis);
    thesis.name = "512, 60 wavelengths, layers to 10 px";
    thesis.settings.layer_radii_px = {0, 1.7F, 3.05F, 6.35F, 10};
    thesis.settings.wavelengths = 60;
    thesis.largest_disc = 10;
    cases.push_back(thesis);
    Case physical{"512 at physical angles, 30 wavelengths, 3 layers", {}, still, 2};
    physical.settings.transform_size = 512;
    physical.settings.layer_radii_px = {0, 1, 2};
    cases.push_back(physical);
    const std::size_t first_with_loss = cases.size();
    for (const double pitch : {1 / 869.1, 1 / 4030.6}) {
        for (const EyeModel* eye : {&still, static_cast<const EyeModel*>(&moving)}) {
            for (const int core : {512, 1024}) {
                Case two{
                    core == 512 ? "two scales 512 + 4096" : "two scales 1024 + 4096", {}, *eye, 0, pitch};
                two.settings.transform_size = core;
                two.settings.wide_field_size = 4096;
                cases.push_back(two);
            }
        }
    }

    std::puts(
        "case,moving,pitch,frames,wall ms,cpu ms,worst ms,FFTW 512 ms,wall ratio,cpu ratio,MiB,radial "
        "loss,contrast loss,codes");
    std::unique_ptr<PatternSource> exact;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const Case& c = cases[i];
        auto source = make_cl_pattern_source(c.eye, c.settings, 7);
        source->warm_up(c.pitch);
        source->make(request_at(c, 0));
        const Cost unit = yardstick();
        const Cost cost =
            measure(i < first_with_loss ? 60 : frames, [&](int f) { source->make(request_at(c, f + 1)); });
        Loss worst{NAN, NAN, NAN};
        if (i >= first_with_loss) {
            worst = {};
            exact = make_cl_pattern_source(c.eye, PatternSettings{}, 7);
            for (const int frame : {30, 60, 95, 150, 200}) {
                const Loss here = loss(source->make(request_at(c, frame)), exact->make(request_at(c, frame)));
                worst.radial = std::max(worst.radial, here.radial);
                if (std::abs(here.contrast) > std::abs(worst.contrast)) worst.contrast = here.contrast;
                worst.codes = std::max(worst.codes, here.codes);
            }
            exact.reset();
        }
        std::printf("\"%s\",%d,1/%.1f,%d,%.2f,%.2f,%.2f,%.2f,%.1f,%.1f,%.1f,%.4f,%.3f,%.2f\n", c.name,
                    c.eye.particles.empty() ? 0 : c.eye.particles[0].drift_um > 0, 1 / c.pitch, frames,
                    cost.wall_ms, cost.cpu_ms, cost.worst_ms, unit.wall_ms, cost.wall_ms / unit.wall_ms,
                    cost.cpu_ms / unit.cpu_ms, source->device_memory_bytes() / 1048576, worst.radial,
                    worst.contrast, worst.codes);
        std::fflush(stdout);
    }
    return 0;
}
