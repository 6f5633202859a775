// The transform against FFTW in double precision.
#include <fftw3.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "glare/eye/noise.h"
#include "glare/psf/fft.h"
#include "tests/cl/cl_device.h"

namespace seaglare::glare {
namespace {

class FftSizes : public testing::TestWithParam<int> {};

TEST_P(FftSizes, EqualsFftwToSinglePrecision) {
    SEAGLARE_CL_DEVICE(device);
    const int n = GetParam();
    const auto rows = static_cast<std::size_t>(n);
    const std::size_t columns = rows / 2 + 1;
    std::vector<float> data(rows * (rows + 2));
    std::vector<double> reference(rows * rows);
    for (std::size_t y = 0; y < rows; ++y) {
        for (std::size_t x = 0; x < rows; ++x) {
            const auto value = static_cast<float>(uniform(1, x, y));
            data[y * (rows + 2) + x] = value;
            reference[y * rows + x] = static_cast<double>(value);
        }
    }
    std::unique_ptr<fftw_complex, void (*)(void*)> spectrum(fftw_alloc_complex(rows * columns), fftw_free);
    const fftw_plan plan = fftw_plan_dft_r2c_2d(n, n, reference.data(), spectrum.get(), FFTW_ESTIMATE);
    fftw_execute(plan);
    fftw_destroy_plan(plan);

    RealFft2d fft(*device, n);
    ClBuffer buffer;
    buffer.reserve(device->context(), device->queue(), RealFft2d::bytes(n), "data");
    buffer.write(device->queue(), data.size() * sizeof(float), data.data());
    fft.forward(device->queue(), buffer.get());
    check_cl(clEnqueueReadBuffer(device->queue(), buffer.get(), CL_TRUE, 0, data.size() * sizeof(float),
                                 data.data(), 0, nullptr, nullptr),
             "clEnqueueReadBuffer");
    double difference = 0;
    double total = 0;
    for (std::size_t i = 1; i < rows * columns; ++i) {  // without the mean, which would drown the rest
        const fftw_complex& truth = spectrum.get()[i];
        difference += std::pow(static_cast<double>(data[2 * i]) - truth[0], 2) +
                      std::pow(static_cast<double>(data[2 * i + 1]) - truth[1], 2);
        total += truth[0] * truth[0] + truth[1] * truth[1];
    }
    EXPECT_LT(std::sqrt(difference / total), 2e-6);
}

INSTANTIATE_TEST_SUITE_P(Sizes, FftSizes, testing::Values(256, 512, 1024, 2048, 4096));

}  // namespace
}  // namespace seaglare::glare
