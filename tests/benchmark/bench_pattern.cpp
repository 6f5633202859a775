// The glare pattern: time per frame beside one 512 x 512 complex FFTW transform (single precision, one thread) of the same
// run, and beside the error: of the two scales against the 4096 x 4096 transform of every frame, of the others against the
// same transform, all with 480 wavelengths of which each has its own colour. Prints CSV, then the stages. `wall` is the median
// of the frames, `cpu` the processor time of all threads, the median of the frames, too; both also over the yardstick's, which
// is measured before and after. What is read back from the device is in a frame, what is uploaded to GL is not.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "glare/psf/pattern.h"
#include "glare/reference/field_loss.h"
#include "tests/benchmark/pattern_cases.h"
#include "tests/benchmark/pattern_cost.h"
#include "tests/benchmark/pattern_stages.h"

namespace {

using namespace seaglare;
using namespace seaglare::benchmark_pattern;

// Of the point layer; the core is left out of both.
reference::LuminanceField luminance_of(const glare::Pattern& pattern) {
    reference::LuminanceField field{pattern.radius_nodes, pattern.pitch, {}};
    const auto side = 2 * static_cast<std::size_t>(pattern.radius_nodes) + 1;
    field.per_sr.reserve(side * side);
    for (std::size_t node = 0; node < side * side; ++node) {
        const float* const v = pattern.skirt.data() + 4 * node;
        field.per_sr.push_back(0.2126 * static_cast<double>(v[0]) + 0.7152 * static_cast<double>(v[1]) +
                               0.0722 * static_cast<double>(v[2]));
    }
    return field;
}

// The worst of some frames.
reference::FieldLoss loss_of(const Case& c, glare::PatternSource& source) {
    const auto exact = glare::make_cl_pattern_source(c.eye, c.exact, 7);
    constexpr std::array rings_deg = {0.5, 1.0, 2.0, 3.0};
    reference::FieldLoss worst;
    for (const int frame : {30, 60, 95, 150, 200}) {
        const glare::PatternRequest request = request_at(c, frame);
        const reference::FieldLoss here = reference::field_loss(
            luminance_of(source.make(request)), luminance_of(exact->make(request)), rings_deg);
        worst.radial = std::max(worst.radial, here.radial);
        if (std::abs(here.contrast) > std::abs(worst.contrast)) worst.contrast = here.contrast;
        worst.codes = std::max(worst.codes, here.codes);
    }
    return worst;
}

void print_case(const Case& c, int frames) {
    const auto source = glare::make_cl_pattern_source(c.eye, c.settings, 7);
    source->warm_up(c.pitch);
    source->make(request_at(c, 0));
    const Cost before = yardstick();
    const int runs = c.settings.wide_field_size > 0 ? frames : 60;
    const Cost cost = measure(runs, [&](int f) { source->make(request_at(c, f + 1)); });
    const Cost after = yardstick();
    const double unit_wall = 0.5 * (before.wall_ms + after.wall_ms);
    const double unit_cpu = 0.5 * (before.cpu_ms + after.cpu_ms);
    const reference::FieldLoss loss = loss_of(c, *source);
    std::printf("\"%s\",%d,1/%.1f,%d,%.2f,%.2f,%.2f,%.2f,%.2f,%.1f,%.1f,%.1f,%.1f,%.4f,%.3f,%.2f\n",
                c.name.c_str(), static_cast<int>(c.moving), 1 / c.pitch, runs, cost.wall_ms, cost.cpu_ms,
                cost.mean_cpu_ms, cost.worst_ms, unit_wall, cost.wall_ms / unit_wall, cost.cpu_ms / unit_cpu,
                cost.mean_cpu_ms / unit_cpu, source->device_memory_bytes() / 1048576, loss.radial,
                loss.contrast, loss.codes);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    const int frames = argc > 1 ? std::atoi(argv[1]) : 240;
    const std::vector<Case> cases = pattern_cases();
    std::puts(
        "pattern,moving,pitch,frames,wall ms,cpu ms,mean cpu ms,worst ms,FFTW 512 ms,wall ratio,cpu "
        "ratio,mean cpu ratio,MiB,radial loss,contrast loss,codes");
    for (const Case& c : cases)
        print_case(c, frames);
    std::puts("pattern,moving,pitch,stage,wall ms,cpu ms,mean cpu ms,worst ms,wall ratio,cpu ratio");
    for (const Case& c : cases)
        if (c.stages) print_stages(c, yardstick());
    return 0;
}
