// A frame that adds its lights up in OpenCL says so for as long as it does, and no longer: who makes the next pattern leaves the
// processor to it meanwhile (glare/device/cl_turns.h). The gather's launches are met here before they go on.
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <string_view>

#include "glare/device/cl_turns.h"
#include "tests/gl/view_fixture.h"

namespace {

std::atomic<int> gathered{0};     // launches of the gather
std::atomic<int> out_of_turn{0};  // of those, while no frame said that it was its turn

}  // namespace

namespace seaglare::test {

namespace {

using glare::Accumulation;
using glare::ClFrameTurn;

class GatherTurn : public ViewTest {
  protected:
    void SetUp() override {
        ViewTest::SetUp();
        if (renderer_ && !renderer_->enable_gather()) GTEST_SKIP() << "no OpenCL device here";
        gathered = out_of_turn = 0;
    }
    RenderStats drawn(Accumulation method) {
        Frame frame = make_frame(128, 128);
        const Target target(gl(), 128, 128);
        frame.target_fbo = target.fbo();
        frame.adaptation_luminance_cd_m2 = 0.001;
        SyntheticPattern settings;
        settings.with_tail = true;
        const Pattern pattern = make_pattern(glare::screen_geometry(frame).pitch, settings);
        const std::array<PointSource, 1> lights = {source_at_px(frame, 60, 70, 1e-3, 1000, 0, {1, 1, 1})};
        glare::AccumulationPlan plan;
        plan.method = method;
        plan.skirt_threshold_cd_m2 = plan.tail_threshold_cd_m2 = 1e-5;
        RenderStats stats;
        renderer_->render(frame, {}, pattern, lights, plan, stats);
        return stats;
    }
};

TEST_F(GatherTurn, LastsFromTheFirstKernelToTheLast) {
    const RenderStats stats = drawn(Accumulation::cl_tiles);
    EXPECT_GE(gathered, 2);  // of two bands
    EXPECT_EQ(gathered, static_cast<int>(stats.kernel_launches));
    EXPECT_EQ(out_of_turn, 0);
    EXPECT_EQ(ClFrameTurn::under_way(), 0);
}

TEST_F(GatherTurn, AFrameThatGathersNothingHasNone) {
    EXPECT_EQ(drawn(Accumulation::gl_billboards).kernel_launches, 0U);
    EXPECT_EQ(gathered, 0);
    EXPECT_EQ(ClFrameTurn::under_way(), 0);
}

}  // namespace

}  // namespace seaglare::test

extern "C" cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                                         const std::size_t* offset, const std::size_t* global,
                                         const std::size_t* local, cl_uint wait_count, const cl_event* waits,
                                         cl_event* event) {
    static const auto launch =
        reinterpret_cast<decltype(&clEnqueueNDRangeKernel)>(dlsym(RTLD_NEXT, "clEnqueueNDRangeKernel"));
    std::array<char, 64> name{};
    clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, name.size(), name.data(), nullptr);
    if (std::string_view(name.data()).starts_with("gather_")) {
        ++gathered;
        if (seaglare::glare::ClFrameTurn::under_way() == 0) ++out_of_turn;
    }
    return launch(queue, kernel, dimensions, offset, global, local, wait_count, waits, event);
}
