// The transform in strips against FFTW in double precision, and its rows outside the pupil.
#include <fftw3.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "glare/eye/noise.h"
#include "glare/psf/fft.h"
#include "glare/psf/fft_strips.h"
#include "tests/cl/cl_device.h"

namespace seaglare::glare {
namespace {

// Noise in rows first ... end - 1 of a plane of n rows of n + 2 reals.
std::vector<float> plane_of(int n, int first, int end) {
    const auto side = static_cast<std::size_t>(n);
    std::vector<float> plane(side * (side + 2));
    for (auto y = static_cast<std::size_t>(first); y < static_cast<std::size_t>(end); ++y)
        for (std::size_t x = 0; x < side; ++x)
            plane[y * (side + 2) + x] = static_cast<float>(uniform(3, x, y));
    return plane;
}

// The relative error, in the mean square, of all frequencies but the mean, which would drown the rest.
double error_against_fftw(const std::vector<float>& before, const std::vector<float>& after, int n) {
    const auto side = static_cast<std::size_t>(n);
    const std::size_t columns = side / 2 + 1;
    std::vector<double> reals(side * side);
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x)
            reals[y * side + x] = static_cast<double>(before[y * (side + 2) + x]);
    const std::unique_ptr<fftw_complex, void (*)(void*)> truth(fftw_alloc_complex(side * columns), fftw_free);
    const fftw_plan plan = fftw_plan_dft_r2c_2d(n, n, reals.data(), truth.get(), FFTW_ESTIMATE);
    fftw_execute(plan);
    fftw_destroy_plan(plan);
    double difference = 0;
    double total = 0;
    for (std::size_t i = 1; i < side * columns; ++i) {
        const fftw_complex& t = truth.get()[i];
        difference += std::pow(static_cast<double>(after[2 * i]) - t[0], 2) +
                      std::pow(static_cast<double>(after[2 * i + 1]) - t[1], 2);
        total += t[0] * t[0] + t[1] * t[1];
    }
    return std::sqrt(difference / total);
}

class StripSizes : public testing::TestWithParam<int> {};

// A butterfly rounds to 6e-8; ten layers of them, as independent errors, to under 2e-7.
TEST_P(StripSizes, EqualsFftwToSinglePrecision) {
    SEAGLARE_CL_DEVICE(device);
    const int n = GetParam();
    for (const int first : {0, n / 8 + 3}) {
        const std::vector<float> before = plane_of(n, first, n - first);
        std::vector<float> after(before.size());
        StripFft2d fft(*device, n);
        ClBuffer buffer;
        buffer.reserve(device->context(), device->queue(), RealFft2d::bytes(n), "data");
        buffer.write(device->queue(), before.size() * sizeof(float), before.data());
        fft.forward(device->queue(), buffer.get(), first, n - first);
        check_cl(clEnqueueReadBuffer(device->queue(), buffer.get(), CL_TRUE, 0, after.size() * sizeof(float),
                                     after.data(), 0, nullptr, nullptr),
                 "clEnqueueReadBuffer");
        EXPECT_LT(error_against_fftw(before, after, n), 4e-7) << "rows from " << first;
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, StripSizes, testing::Values(64, 128, 256, 512, 1024));

TEST(StripFft, RefusesSizesThatItHasNoRoomFor) {
    SEAGLARE_CL_DEVICE(device);
    for (const int n : {0, 32, 96, 2048})
        EXPECT_THROW(StripFft2d(*device, n), std::invalid_argument) << n;
}

}  // namespace
}  // namespace seaglare::glare
