#include "tests/benchmark/pattern_stages.h"

#include <cstdio>
#include <functional>
#include <memory>
#include <stdexcept>

#include "glare/apply/pattern_texture.h"
#include "glare/psf/cl_eye_stage.h"
#include "glare/psf/cl_screen_stage.h"
#include "glare/psf/two_scale.h"
#include "tests/gl/headless_context.h"

namespace seaglare::benchmark_pattern {

namespace {

using namespace glare;

constexpr double pupil_mm = 6.4;
constexpr int runs = 40;

class Stages {
  public:
    Stages(const Case& c, const Cost& unit) : case_(c), unit_(unit) {}

    void print(const char* stage, const std::function<void(int)>& run) const {
        measure(4, run);
        row(stage, measure(runs, run));
    }
    void row(const char* stage, const Cost& cost) const {
        std::printf("\"%s\",%d,1/%.1f,%s,%.3f,%.3f,%.3f,%.3f,%.2f,%.2f\n", case_.name.c_str(),
                    static_cast<int>(case_.moving), 1 / case_.pitch, stage, cost.wall_ms, cost.cpu_ms,
                    cost.mean_cpu_ms, cost.worst_ms, cost.wall_ms / unit_.wall_ms,
                    cost.cpu_ms / unit_.cpu_ms);
        std::fflush(stdout);
    }

  private:
    const Case& case_;
    const Cost& unit_;
};

// Of the texture that lights are drawn from.
void print_upload(const Stages& stages, Pattern& pattern) {
    std::unique_ptr<test::HeadlessContext> context;
    try {
        context = std::make_unique<test::HeadlessContext>();
    } catch (const std::runtime_error& error) {
        std::fprintf(stderr, "no upload: %s\n", error.what());
        return;
    }
    PatternTexture texture(context->gl());
    stages.print("upload to GL", [&](int) {
        ++pattern.generation;
        texture.update(pattern);
        context->gl().Finish();
    });
}

}  // namespace

void print_stages(const Case& c, const Cost& unit) {
    const Stages stages(c, unit);
    const ClDevice device;
    ClEyeStage eye(device, c.eye, c.settings, 7);
    ClScreenStage screen(device, c.settings, sample_lamps(c.settings.wavelengths));
    const PatternGrid grid = plan_grid(c.settings, c.pitch);
    Pattern pattern;
    pattern.pitch = grid.pitch;
    pattern.radius_nodes = grid.radius;
    pattern.layer_radius_nodes = plan_layers(c.settings, grid, static_cast<float>(c.largest_disc));
    screen.reserve(grid, pattern.layer_radius_nodes.size());
    std::unique_ptr<WideField> wide;
    if (c.settings.wide_field_size > 0) {
        wide = std::make_unique<WideField>(device, c.eye, c.settings, 7);
        eye.fade(wide->join().inner, wide->join().outer);
        wide->advance(0, pupil_mm, c.pitch);
        device.finish();
    }
    const auto stage = [&](const char* name, const std::function<void(int)>& run) {
        stages.print(name, [&](int i) {
            run(i);
            device.finish();
        });
    };
    int frame = 0;
    stage("aperture", [&](int) {
        ++frame;
        eye.draw_aperture(pupil_mm + 1e-5 * frame, frame / 60.0);
    });
    stage("transform", [&](int) { eye.transform(); });
    eye.draw_aperture(pupil_mm, 0);
    eye.transform();
    stage("cumulative energy", [&](int) { eye.accumulate(pupil_mm); });
    if (wide) {
        stage("wide field (its share of a frame)", [&](int) {
            ++frame;
            wide->advance(frame / 60.0, pupil_mm, c.pitch);
        });
        stage("chromatic spread of the core; and join", [&](int) { screen.join(eye, *wide, grid, 0); });
    } else {
        stage("chromatic spread", [&](int) { screen.spread(eye, grid); });
    }
    stage("core and skirt", [&](int) { screen.split(grid, 1); });
    stage("disc layers", [&](int) { screen.average_discs(grid, pattern.layer_radius_nodes); });
    stage("read back", [&](int) { screen.read_back(grid, pattern); });
    print_upload(stages, pattern);
}

}  // namespace seaglare::benchmark_pattern
