// Sharing memory between OpenCL and OpenGL: when it is done, and in which order drivers are asked. The driver is this program:
// its textures are buffers of the OpenCL device, its functions stand in the way of the loader's.
#include <gtest/gtest.h>

#include <CL/cl_gl.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "glare/apply/cl_gather.h"
#include "glare/device/gl_sharing.h"
#include "glare/frame.h"
#include "tests/cl/cl_device.h"

namespace {

constexpr std::size_t pixel_bytes = 4 * sizeof(float);
constexpr std::size_t width = 96;

struct FakeDriver {
    std::vector<std::string> calls;
    std::vector<cl_mem> textures;  // in the order they were made
    bool refuses_to_copy = false;
};
FakeDriver driver;

}  // namespace

extern "C" {

CL_API_ENTRY cl_mem CL_API_CALL clCreateFromGLTexture(cl_context context, cl_mem_flags flags,
                                                      cl_GLenum target, cl_GLint level, cl_GLuint texture,
                                                      cl_int* code) {
    driver.calls.push_back("create " + std::to_string(texture));
    EXPECT_EQ(flags, static_cast<cl_mem_flags>(CL_MEM_WRITE_ONLY));
    EXPECT_EQ(target, 0x0DE1U);
    EXPECT_EQ(level, 0);
    cl_mem made = clCreateBuffer(context, CL_MEM_READ_WRITE,
                                 width * static_cast<std::size_t>(seaglare::glare::band_rows) * pixel_bytes,
                                 nullptr, code);
    driver.textures.push_back(made);
    return made;
}

CL_API_ENTRY cl_int CL_API_CALL clEnqueueAcquireGLObjects(cl_command_queue, cl_uint count, const cl_mem*,
                                                          cl_uint, const cl_event*, cl_event*) {
    EXPECT_EQ(count, 1U);
    driver.calls.emplace_back("acquire");
    return CL_SUCCESS;
}

CL_API_ENTRY cl_int CL_API_CALL clEnqueueReleaseGLObjects(cl_command_queue, cl_uint count, const cl_mem*,
                                                          cl_uint, const cl_event*, cl_event*) {
    EXPECT_EQ(count, 1U);
    driver.calls.emplace_back("release");
    return CL_SUCCESS;
}

CL_API_ENTRY cl_int CL_API_CALL clEnqueueCopyBufferToImage(cl_command_queue queue, cl_mem from, cl_mem to,
                                                           std::size_t offset, const std::size_t* origin,
                                                           const std::size_t* region, cl_uint,
                                                           const cl_event*, cl_event*) {
    driver.calls.emplace_back("copy");
    if (driver.refuses_to_copy) return CL_OUT_OF_RESOURCES;
    EXPECT_EQ(origin[0] + origin[1] + origin[2], 0U);
    EXPECT_EQ(region[0], width);
    EXPECT_EQ(region[2], 1U);
    return clEnqueueCopyBuffer(queue, from, to, offset, 0, region[0] * region[1] * pixel_bytes, 0, nullptr,
                               nullptr);
}
}

namespace seaglare::glare {
namespace {

constexpr const char* both = "cl_khr_fp64 cl_khr_gl_sharing cl_khr_gl_event";

TEST(SharingDecision, SharesWhereTheDeviceHasBothExtensionsAndDrawsTheContext) {
    for (const GlBinding binding : {GlBinding::egl, GlBinding::glx}) {
        const SharingDecision decision = decide_sharing({both, binding, true});
        EXPECT_TRUE(decision.shares);
        EXPECT_EQ(decision.reason, "");
    }
}

TEST(SharingDecision, SaysWhatIsMissing) {
    const auto reason = [](std::string_view extensions, GlBinding binding, bool same_device) {
        const SharingDecision decision = decide_sharing({extensions, binding, same_device});
        EXPECT_FALSE(decision.shares);
        return decision.reason;
    };
    EXPECT_NE(reason("", GlBinding::egl, true).find("no cl_khr_gl_sharing"), std::string::npos);
    EXPECT_NE(reason("cl_khr_gl_event", GlBinding::egl, true).find("no cl_khr_gl_sharing"),
              std::string::npos);
    // Without it every hand-over waits for the whole pipeline.
    EXPECT_NE(reason("cl_khr_gl_sharing", GlBinding::egl, true).find("no cl_khr_gl_event"),
              std::string::npos);
    EXPECT_NE(reason(both, GlBinding::none, true).find("neither EGL's nor GLX's"), std::string::npos);
    EXPECT_NE(reason(both, GlBinding::egl, false).find("another device"), std::string::npos);
}

TEST(SharingDecision, TakesNoNameForThePartOfAnother) {
    EXPECT_TRUE(has_name("a b", "b"));
    EXPECT_TRUE(has_name("b", "b"));
    EXPECT_FALSE(has_name("ab b_c", "b"));
    EXPECT_FALSE(has_name("", "b"));
    EXPECT_FALSE(decide_sharing({"cl_khr_gl_sharing_x cl_khr_gl_event", GlBinding::egl, true}).shares);
}

TEST(SharingDecision, WithoutAGlContextThereIsThePlainContextAndAReason) {
    SEAGLARE_CL_DEVICE(device);
    EXPECT_EQ(current_gl_context(), GlContext{});
    SharingDecision decision = {true, ""};
    const std::shared_ptr<ClShared> shared = ClShared::acquire(current_gl_context(), decision);
    EXPECT_FALSE(decision.shares);
    EXPECT_NE(decision.reason, "");
    EXPECT_FALSE(shared->shares_with_gl());
    EXPECT_EQ(shared->context(), device->context());
}

// One light over a picture of three bands, the last of them not whole.
class GatherIntoTextures : public ::testing::Test {
  protected:
    void SetUp() override {
        driver = {};
        std::string reason;
        device_ = cl_device(reason);
        if (!device_ && !says_no_device(reason)) FAIL() << reason;
        if (!device_) GTEST_SKIP() << reason;
        Frame frame;
        frame.viewport_px = {0, 0, static_cast<int>(width), 2 * band_rows + 40};
        auto& m = frame.clip_from_view;
        m[0] = m[5] = 1;
        m[10] = m[11] = -1;
        m[14] = -0.2;
        geometry_ = screen_geometry(frame);
        pattern_.pitch = geometry_.pitch;
        pattern_.tail_scale = 1;
        pattern_.window_inner = 2.5 * geometry_.pitch;
        pattern_.window_outer = 3 * geometry_.pitch;
        light_.direction = {0, 0, -1};
        light_.illuminance = {1, 2, 3, 4};
        light_.skirt_rect = {0, 0, static_cast<float>(width), 168};
        light_.tail_rect = light_.skirt_rect;
    }
    void prepare(ClGather& gather) {
        ReachSettings reach;
        reach.threshold_cd_m2 = 1e-6;
        gather.prepare({geometry_, pattern_, reach, std::span(&light_, 1), {}});
    }
    std::vector<float> read(cl_mem from, std::size_t rows) {
        std::vector<float> pixels(width * rows * 4);
        check_cl(clEnqueueReadBuffer(device_->queue(), from, CL_TRUE, 0, pixels.size() * sizeof(float),
                                     pixels.data(), 0, nullptr, nullptr),
                 "clEnqueueReadBuffer");
        return pixels;
    }

    const SignalGuard guard_;
    std::unique_ptr<ClDevice> device_;
    ScreenGeometry geometry_;
    Pattern pattern_;
    LightInstance light_;
};

TEST_F(GatherIntoTextures, FillsThemWithWhatItGivesOtherwise) {
    ClGather gather;
    prepare(gather);
    std::vector<std::vector<float>> wanted;
    gather.sum({0, geometry_.height_px},
               [&](RowRange, std::span<const float> rgbv) { wanted.emplace_back(rgbv.begin(), rgbv.end()); });
    ASSERT_EQ(wanted.size(), 3U);
    EXPECT_GT(*std::max_element(wanted[1].begin(), wanted[1].end()), 0.0F);
    std::vector<RowRange> bands;
    gather.sum_into({0, geometry_.height_px}, {7, 8}, [&](RowRange band) {
        const std::size_t i = bands.size();
        bands.push_back(band);
        gather.settle();  // a driver would see to it that GL finds it
        EXPECT_EQ(read(driver.textures.at(i % 2), static_cast<std::size_t>(band.count)), wanted.at(i)) << i;
    });
    ASSERT_EQ(bands.size(), 3U);
    EXPECT_EQ(bands[2].first, 2 * band_rows);
    EXPECT_EQ(bands[2].count, 40);
}

TEST_F(GatherIntoTextures, AcquiresAndReleasesEachBandOnceAndMakesAnImageOfATextureOnce) {
    ClGather gather;
    prepare(gather);
    std::size_t calls_before_use = 0;
    const auto use = [&](RowRange) {
        if (calls_before_use == 0) calls_before_use = driver.calls.size();
    };
    gather.sum_into({0, geometry_.height_px}, {7, 8}, use);
    EXPECT_EQ(driver.calls,
              (std::vector<std::string>{"create 7", "acquire", "copy", "release", "create 8", "acquire",
                                        "copy", "release", "acquire", "copy", "release"}));
    // While the first is drawn from, the second is summed.
    EXPECT_EQ(calls_before_use, 8U);
    driver.calls.clear();
    gather.sum_into({0, band_rows}, {7, 8}, [](RowRange) {});
    EXPECT_EQ(driver.calls, (std::vector<std::string>{"acquire", "copy", "release"}));
    // The next frame begins with the other texture.
    driver.calls.clear();
    gather.sum_into({0, band_rows}, {8, 7}, [](RowRange) {});
    EXPECT_EQ(driver.calls, (std::vector<std::string>{"acquire", "copy", "release"}));
    driver.calls.clear();
    gather.forget_textures();
    gather.sum_into({0, band_rows}, {7, 8}, [](RowRange) {});
    EXPECT_EQ(driver.calls, (std::vector<std::string>{"create 7", "acquire", "copy", "release"}));
}

TEST_F(GatherIntoTextures, GivesBackWhatItAcquiredWhenTheCopyFails) {
    ClGather gather;
    prepare(gather);
    driver.refuses_to_copy = true;
    EXPECT_THROW(gather.sum_into({0, band_rows}, {7, 8}, [](RowRange) {}), ClError);
    EXPECT_EQ(driver.calls.back(), "release");
}

}  // namespace
}  // namespace seaglare::glare
