// A steady frame compiles nothing and allocates nothing: neither GL objects, nor OpenCL's, nor memory of the heap, on any
// thread. Steady: nothing has come that was not there before, though all of it moves, flashes and burns.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "host_stub/plugin.h"
#include "tests/gl/measured_devices.h"
#include "tests/scene_host.h"

namespace seaglare::host {
namespace {

using test::CountedHeap;
using test::MeasuredCl;
using test::MeasuredGl;

// A scene with its ship and its crowd under way. Where every frame waits for its own pattern, what is counted does not hang on
// how far another thread has come; where none waits, it is the thread that draws that is counted.
enum class Counted : std::uint8_t { nothing, all_threads, this_thread };
class HostSteadyFrame : public testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        std::string why_not;
        gl_ = headless_context(why_not);
        if (!gl_) GTEST_SKIP() << why_not;
        const SceneOptions options = scene_options(GetParam(), "480x270");
        simulation_ = std::make_unique<Simulation>(options);
        plugin_ = std::make_unique<Plugin>(options.plugin);
        target_ = std::make_unique<RenderTarget>(480, 270, TargetFormat::rgba8_srgb_values);
        glare_ = std::make_unique<Glare>(*plugin_, simulation_->scene(), simulation_->channel(),
                                         simulation_->observer(), MeasuredGl::get_proc, Glare::Log{});
        start_s_ = simulation_->time_s();
        pin_the_gather();
        CountedHeap::watch("libseaglare.so");
    }

    // What lights are added up with follows what it takes here and now, and the first frame of another way makes what it needs.
    void pin_the_gather() {
        const std::filesystem::path file =
            std::filesystem::path(testing::TempDir()) /
            ("seaglare_steady_" + std::string(GetParam()) + std::to_string(getpid()) + ".json");
        std::ofstream(file) << R"({"device_costs": {"gl_skirt_px_ns": 1e5, "gl_tail_cell_ns": 1e5}})";
        ASSERT_GE(plugin_->api().load_config(glare_->context(), file.c_str()), SEAGLARE_OK)
            << glare_->last_error();
        std::filesystem::remove(file);
    }

    // What is counted is the plug-in's call alone: the host may do as it likes.
    void render(int i, bool waits, Counted counted) {
        simulation_->go_to(start_s_ + i * interval_s);
        glare_->move_lights(simulation_->time_s());
        seaglare_frame frame = make_frame(*simulation_, simulation_->camera(), *target_, 0.001, interval_s);
        if (waits) frame.flags |= SEAGLARE_FRAME_WAIT;
        MeasuredGl::reset();
        MeasuredCl::reset();
        CountedHeap::reset();
        if (counted != Counted::nothing && std::getenv("SEAGLARE_TRACE_ALLOCATIONS") != nullptr)
            CountedHeap::trace_next(32);
        const seaglare_result result = glare_->render(frame);
        const bool all = counted == Counted::all_threads;
        const std::uint64_t allocations =
            all ? CountedHeap::allocations() : CountedHeap::allocations_of_this_thread();
        const std::uint64_t cl_makings = all ? MeasuredCl::makings() : MeasuredCl::makings_of_this_thread();
        CountedHeap::trace_next(0);
        ASSERT_GE(result, 0) << glare_->last_error();
        if (counted == Counted::nothing) return;
        EXPECT_EQ(MeasuredGl::makings(), 0U) << "frame " << i << ": " << MeasuredGl::last_making();
        EXPECT_EQ(cl_makings, 0U) << "frame " << i << ": " << MeasuredCl::last_making();
        EXPECT_EQ(allocations, 0U) << "frame " << i << ": " << CountedHeap::bytes() << " bytes";
    }

    static constexpr double interval_s = 1.0 / 15;
    std::unique_ptr<HeadlessContext> gl_;
    std::unique_ptr<Simulation> simulation_;
    std::unique_ptr<Plugin> plugin_;
    std::unique_ptr<RenderTarget> target_;
    std::unique_ptr<Glare> glare_;
    double start_s_ = 0;
};

// Rhythms have periods of up to 15 s, and the wide field's tables change every 4 s: the first 16 s show all there is.
TEST_P(HostSteadyFrame, CompilesAndAllocatesNothing) {
    constexpr int warm_up = 240;
    constexpr int frames = 120;
    for (int i = 0; i < warm_up; ++i)
        render(i, true, Counted::nothing);
    for (int i = warm_up; i < warm_up + frames && !HasFailure(); ++i)
        render(i, true, Counted::all_threads);
}

// Patterns come when they are ready. The first frames wait, so that each kind of thing has been there once.
TEST_P(HostSteadyFrame, MakesNothingOnTheThreadThatDrawsWhenNoFrameWaits) {
    constexpr int warm_up = 240;
    constexpr int not_waiting = 60;
    constexpr int frames = 120;
    for (int i = 0; i < warm_up + not_waiting; ++i)
        render(i, i < warm_up, Counted::nothing);
    for (int i = warm_up + not_waiting; i < warm_up + not_waiting + frames && !HasFailure(); ++i)
        render(i, false, Counted::this_thread);
}

INSTANTIATE_TEST_SUITE_P(Scenes, HostSteadyFrame, testing::Values("great_belt_night", "ships_at_night"),
                         [](const auto& scene) { return std::string(scene.param); });

TEST(MeasuredDevices, SeeWhatTheLibraryAllocates) {
    // The counters would be silent, too, if the loader did not find them.
    try {
        const HeadlessContext gl;
        MeasuredGl::reset();
        MeasuredCl::reset();
        CountedHeap::reset();
        const Plugin plugin(SEAGLARE_PLUGIN_FILE);
        const Simulation simulation(scene_options("sonderborg_leading_line", "160x90"));
        const Glare glare(plugin, simulation.scene(), simulation.channel(), simulation.observer(),
                          MeasuredGl::get_proc, {});
        EXPECT_GT(MeasuredGl::makings(), 10U);
        EXPECT_GT(MeasuredGl::bytes(), 0);
        EXPECT_GT(CountedHeap::allocations(), 100U);
        EXPECT_GT(CountedHeap::allocations_of_this_thread(), 100U);
        if (glare.degraded()) GTEST_SKIP() << "there is no OpenCL here";
        EXPECT_GT(MeasuredCl::makings(), 10U);
        EXPECT_GT(MeasuredCl::bytes(), 0);
    } catch (const GlFailure& error) {
        GTEST_SKIP() << error.what();
    }
}

TEST(MeasuredDevices, CountWhatAWatchedLibraryAsksCFor) {
    if (!CountedHeap::watch("")) GTEST_SKIP() << "a sanitizer has malloc";  // this program
    CountedHeap::reset();
    void* volatile memory = std::malloc(16);
    EXPECT_EQ(CountedHeap::allocations_of_this_thread(), 1U);
    std::free(memory);
}

}  // namespace
}  // namespace seaglare::host
