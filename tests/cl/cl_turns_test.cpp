// Who works ahead of frames leaves OpenCL's threads on a processor to them: how many of its launches are under way, and that
// it launches nothing while a frame adds up its lights. The library's launches are met here before they go on.
#include "glare/device/cl_turns.h"

#include <gtest/gtest.h>

#include <dlfcn.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "tests/cl/pattern_fixture.h"

namespace {

using namespace seaglare::glare;

constexpr std::chrono::microseconds for_ever = std::chrono::hours(1);

struct Launches {
    std::mutex mutex;
    std::vector<cl_event> under_way;  // as far as is known
    std::size_t all = 0;
    std::size_t with_event = 0;
    std::size_t most_under_way = 0;  // at the moment of a launch, that one included
};
Launches& launches() {
    static Launches one;
    return one;
}

bool has_ended(cl_event event) {
    cl_int status = CL_QUEUED;
    clGetEventInfo(event, CL_EVENT_COMMAND_EXECUTION_STATUS, sizeof status, &status, nullptr);
    if (status > CL_COMPLETE) return false;
    clReleaseEvent(event);
    return true;
}

void begin_counting() {
    const std::lock_guard lock(launches().mutex);
    for (cl_event event : launches().under_way)
        clReleaseEvent(event);
    launches().under_way.clear();
    launches().all = launches().with_event = launches().most_under_way = 0;
}
std::size_t launched() {
    const std::lock_guard lock(launches().mutex);
    return launches().all;
}

// Fails when it never holds.
void until(const auto& holds) {
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!holds() && std::chrono::steady_clock::now() < give_up)
        std::this_thread::yield();
    EXPECT_TRUE(holds());
}

// Two scales, so that a pattern is some hundred launches, on a device where those give way.
class ClTurns : public testing::Test {
  protected:
    void SetUp() override {
        SEAGLARE_CL_DEVICE(device);
        on_cpu_ = device->is_cpu();
        PatternSettings settings;
        settings.transform_size = 256;
        settings.wide_field_size = 1024;
        settings.wavelengths = 4;
        settings.max_radius_nodes = 32;
        settings.layer_radii_px = {0, 2};
        source_ = make_cl_pattern_source(young_eye(), settings, 7);
        moment_.pupil_mm = 6;
        moment_.pitch = 1.0 / 869;
        wanted_ = made_at(0).skirt;
    }
    Pattern made_at(double time_s) {
        moment_.time_s = time_s;
        Pattern pattern;
        source_->make_into(moment_, pattern);
        return pattern;
    }
    // The same again, with everything but the wide field, which is there, made anew: what came between is another instant.
    std::vector<float> made_again() {
        made_at(0.5);
        return made_at(0).skirt;
    }

    bool on_cpu_ = false;
    std::unique_ptr<PatternSource> source_;
    PatternRequest moment_;
    std::vector<float> wanted_;
};

TEST_F(ClTurns, NoMoreThanTwoLaunchesAreUnderWayAndThePatternIsTheSame) {
    if (!on_cpu_) GTEST_SKIP() << "this device is no processor: launches follow one another as they come";
    begin_counting();
    std::vector<float> skirt;
    {
        const ClBehindFrames behind;
        skirt = made_again();
    }
    const std::lock_guard lock(launches().mutex);
    EXPECT_GT(launches().all, 20U);
    EXPECT_EQ(launches().with_event, launches().all);
    EXPECT_LE(launches().most_under_way, ClBehindFrames::most_ahead);
    EXPECT_EQ(skirt, wanted_);
}

TEST_F(ClTurns, WhoWaitsForItsOwnPatternLaunchesAllAtOnce) {
    begin_counting();
    EXPECT_EQ(made_again(), wanted_);
    const std::lock_guard lock(launches().mutex);
    EXPECT_GT(launches().all, 20U);
    EXPECT_EQ(launches().with_event, 0U);  // nothing to wait for one by one
}

TEST_F(ClTurns, NothingIsLaunchedWhileAFrameAddsUpItsLights) {
    if (!on_cpu_) GTEST_SKIP() << "this device is no processor: its queues run beside each other";
    begin_counting();
    std::optional<ClFrameTurn> frame(std::in_place);
    std::optional<ClFrameTurn> another(std::in_place);
    std::vector<float> skirt;
    std::thread maker([&] {
        const ClBehindFrames behind({}, for_ever);
        skirt = made_again();
    });
    until([] { return ClBehindFrames::waiting() == 1; });
    EXPECT_EQ(launched(), 0U);
    frame.reset();
    EXPECT_EQ(launched(), 0U) << "of two frames, one is still there";
    another.reset();
    maker.join();
    EXPECT_GT(launched(), 20U);
    EXPECT_EQ(ClBehindFrames::waiting(), 0);
    EXPECT_EQ(skirt, wanted_);
}

TEST_F(ClTurns, AFrameThatComesInTheMiddleStopsIt) {
    if (!on_cpu_) GTEST_SKIP() << "this device is no processor: its queues run beside each other";
    std::atomic<bool> ends{false};
    std::thread maker([&] {
        const ClBehindFrames behind([&] { return ends.load(); }, for_ever);
        for (int i = 0; !ends; ++i)
            made_at(0.1 * i);
    });
    for (int i = 0; i < 20; ++i) {
        const std::size_t before = launched();
        until([&] { return launched() > before; });
        const ClFrameTurn frame;
        until([] { return ClBehindFrames::waiting() == 1; });
        const std::size_t stopped = launched();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        EXPECT_EQ(launched(), stopped);
    }
    ends = true;
    maker.join();
}

// A host that draws all the time, and one whose frame never ends.
TEST_F(ClTurns, ItsPatienceEnds) {
    const ClFrameTurn frame;
    const ClBehindFrames behind({}, std::chrono::microseconds(100));
    EXPECT_EQ(made_again(), wanted_);
}

TEST_F(ClTurns, WhoIsWaitedForLetsNobodyPass) {
    const ClFrameTurn frame;
    const ClBehindFrames behind([] { return true; }, for_ever);
    EXPECT_EQ(made_again(), wanted_);
}

TEST_F(ClTurns, WhoIsWaitedForWhileItLetsFramesPassGoesOn) {
    if (!on_cpu_) GTEST_SKIP() << "this device is no processor: nobody lets frames pass";
    const ClFrameTurn frame;
    std::atomic<bool> hurried{false};
    std::vector<float> skirt;
    std::thread maker([&] {
        const ClBehindFrames behind([&] { return hurried.load(); }, for_ever);
        skirt = made_again();
    });
    until([] { return ClBehindFrames::waiting() == 1; });
    hurried = true;
    maker.join();
    EXPECT_EQ(skirt, wanted_);
}

}  // namespace

extern "C" cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                                         const std::size_t* offset, const std::size_t* global,
                                         const std::size_t* local, cl_uint wait_count, const cl_event* waits,
                                         cl_event* event) {
    static const auto launch =
        reinterpret_cast<decltype(&clEnqueueNDRangeKernel)>(dlsym(RTLD_NEXT, "clEnqueueNDRangeKernel"));
    Launches& all = launches();
    const std::lock_guard lock(all.mutex);
    std::erase_if(all.under_way, has_ended);
    const cl_int code = launch(queue, kernel, dimensions, offset, global, local, wait_count, waits, event);
    ++all.all;
    if (event == nullptr || code != CL_SUCCESS) return code;
    ++all.with_event;
    clRetainEvent(*event);
    all.under_way.push_back(*event);
    all.most_under_way = std::max(all.most_under_way, all.under_way.size());
    return code;
}
