// Device memory: what the statistics say is what was asked for, to the byte, and it keeps within a bound at 1080 lines.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "host_stub/plugin.h"
#include "tests/gl/measured_devices.h"
#include "tests/scene_host.h"

namespace seaglare::host {
namespace {

using test::MeasuredCl;
using test::MeasuredGl;

// What a channel of 1920x1080 holds at most, and the context with it: 64 MB of 10^6 bytes.
constexpr double most_bytes = 64e6;

struct Held {
    seaglare_memory memory{};
    double allocated = 0;
    bool degraded = false;
};

// A scene as its file has it, at 1920x1080 in the dark, where pupils are widest; the host's own picture is not drawn. The
// frames lie within one interval of the wide field and its end, so that all its tables are there.
Held held_by(const std::string& name) {
    const SceneOptions options = scene_options(name, "1920x1080");
    Simulation simulation(options);
    const Plugin plugin(options.plugin);
    RenderTarget target(1920, 1080, TargetFormat::rgba8_srgb_values);
    Glare glare(plugin, simulation.scene(), simulation.channel(), simulation.observer(), MeasuredGl::get_proc,
                {});
    const double start_s = simulation.time_s();
    for (const double seconds : {0.0, 2.0, 3.9, 4.1}) {
        simulation.go_to(start_s + seconds);
        glare.move_lights(simulation.time_s());
        seaglare_frame frame = make_frame(simulation, simulation.camera(), target, 0.001, 1.0 / 60);
        frame.flags |= SEAGLARE_FRAME_WAIT;
        const seaglare_result result = glare.render(frame);
        EXPECT_GE(result, 0) << name << ": " << glare.last_error();
    }
    // And frames that wait for nothing, while patterns are made ahead of them.
    Held most{glare.memory(), MeasuredGl::bytes() + MeasuredCl::bytes(), glare.degraded()};
    for (int i = 0; i < 40; ++i) {
        simulation.go_to(start_s + 4.1 + i / 60.0);
        glare.move_lights(simulation.time_s());
        const seaglare_frame frame = make_frame(simulation, simulation.camera(), target, 0.001, 1.0 / 60);
        EXPECT_GE(glare.render(frame), 0) << name << ": " << glare.last_error();
        if (glare.memory().total_bytes > most.memory.total_bytes)
            most = {glare.memory(), glare.memory().total_bytes, glare.degraded()};
    }
    return most;
}

double sum_of_parts(const seaglare_memory& m) {
    return m.hdr_bytes + m.coarse_grid_bytes + m.background_bytes + m.occlusion_bytes + m.lights_bytes +
           m.pattern_layers_bytes + m.accumulation_bytes + m.pattern_core_bytes + m.pattern_wide_field_bytes +
           m.pattern_screen_bytes;
}

class HostMemory : public testing::TestWithParam<ShippedScene> {
  protected:
    void SetUp() override {
        std::string why_not;
        gl_ = headless_context(why_not);
        if (!gl_) GTEST_SKIP() << why_not;
    }
    std::unique_ptr<HeadlessContext> gl_;
};

TEST_P(HostMemory, IsWhatWasAskedForAndWithinItsBoundAt1080Lines) {
    const Held held = held_by(GetParam().name);
    const seaglare_memory& m = held.memory;
    EXPECT_EQ(m.total_bytes, sum_of_parts(m));
    EXPECT_EQ(m.total_bytes, held.allocated);
    EXPECT_LE(m.total_bytes, most_bytes)
        << "hdr " << m.hdr_bytes << ", coarse grid " << m.coarse_grid_bytes << ", background "
        << m.background_bytes << ", occlusion " << m.occlusion_bytes << ", lights " << m.lights_bytes
        << ", layers " << m.pattern_layers_bytes << ", accumulation " << m.accumulation_bytes << ", core "
        << m.pattern_core_bytes << ", wide field " << m.pattern_wide_field_bytes << ", screen "
        << m.pattern_screen_bytes;
}

INSTANTIATE_TEST_SUITE_P(Scenes, HostMemory, testing::ValuesIn(shipped_scenes), name_of);

}  // namespace
}  // namespace seaglare::host
