// The wide field's two ways to transform make the same table: strips of vectors, and a library's transforms with what is made
// of them in kernels of their own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "glare/psf/two_scale.h"
#include "tests/cl/cl_device.h"

namespace seaglare::glare {
namespace {

std::vector<float> table_of(const ClDevice& device, int samples, bool in_strips) {
    PatternSettings settings;
    settings.transform_size = 512;
    settings.wide_field_size = samples;
    settings.plane_width_mm = 9.0 * samples / 4096;
    WideField wide(device, young_eye(), settings, 7);
    wide.transform_in_strips(in_strips);
    // A pupil between two steps, that fits the plane.
    wide.advance(0, 0.6 * settings.plane_width_mm, 1 / 869.1);
    const WideTable& table = *wide.tables()[0];
    std::vector<float> entries(2 * static_cast<std::size_t>(wide.edges()) *
                               static_cast<std::size_t>(wide.stride()));
    check_cl(clEnqueueReadBuffer(device.queue(), table.energy.get(), CL_TRUE, 0,
                                 entries.size() * sizeof(float), entries.data(), 0, nullptr, nullptr),
             "clEnqueueReadBuffer");
    return entries;
}

class WideStripSizes : public testing::TestWithParam<int> {};

// Rows are kept in halves: where the two round to either side of a tie, single values differ by 2^-11 of themselves.
TEST_P(WideStripSizes, MakeTheTableThatTheLibraryMakes) {
    SEAGLARE_CL_DEVICE(device);
    if (!device->is_cpu()) GTEST_SKIP() << "strips are for a CPU; this is " << device->name();
    const std::vector<float> strips = table_of(*device, GetParam(), true);
    const std::vector<float> library = table_of(*device, GetParam(), false);
    ASSERT_EQ(strips.size(), library.size());
    double apart = 0;
    double total = 0;
    double worst = 0;
    for (std::size_t i = 0; i < library.size(); ++i) {
        const double difference = std::abs(static_cast<double>(strips[i]) - static_cast<double>(library[i]));
        apart += difference;
        total += static_cast<double>(library[i]);
        if (library[i] > 1e-7F) worst = std::max(worst, difference / static_cast<double>(library[i]));
    }
    EXPECT_GT(total, 0);
    EXPECT_LT(apart / total, 1e-5);
    EXPECT_LT(worst, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Sizes, WideStripSizes, testing::Values(1024, 2048, 4096));

TEST(WideStrips, RefuseSizesThatTheyHaveNoRoomFor) {
    SEAGLARE_CL_DEVICE(device);
    if (!device->is_cpu()) GTEST_SKIP() << "strips are for a CPU; this is " << device->name();
    for (const int n : {32, 96, 8192})
        EXPECT_THROW(WideStrips(*device, n), std::invalid_argument) << n;
}

}  // namespace
}  // namespace seaglare::glare
