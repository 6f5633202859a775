// A two-dimensional real-to-complex transform on the device, in place: what we need of an FFT library, and no more.
#pragma once

#include <memory>

#include "glare/device/cl_device.h"

namespace seaglare::glare {

// n x n reals in rows padded to n + 2, replaced by n rows of n/2 + 1 complex numbers: F(kx, ky), kx = 0 ... n/2, row ky
// for ky >= 0 and row n + ky below, sum of f exp(-2 pi i (kx x + ky y) / n). Not normalised.
class RealFft2d {
  public:
    // Plans, compiles and runs nothing yet. Throws std::runtime_error naming the size and the library's code. Neither
    // the locale nor the signal handlers of the process change.
    RealFft2d(const ClDevice& device, int n);
    ~RealFft2d();
    RealFft2d(const RealFft2d&) = delete;
    RealFft2d& operator=(const RealFft2d&) = delete;

    static std::size_t bytes(int n) {
        return static_cast<std::size_t>(n) * (static_cast<std::size_t>(n) + 2) * sizeof(float);
    }
    void forward(cl_command_queue queue, cl_mem data);
    // Memory that the library holds besides the data.
    std::size_t own_bytes() const;
    int launches() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Many transforms of one length side by side, in place: for transforms that are done a few rows at a time.
class BatchFft {
  public:
    enum class Kind {
        real,     // rows of n reals, padded to n + 2, replaced by n/2 + 1 complex numbers
        complex,  // rows of n complex numbers
    };
    // As RealFft2d; `rows` transforms of n samples each.
    BatchFft(const ClDevice& device, int n, int rows, Kind kind);
    ~BatchFft();
    BatchFft(const BatchFft&) = delete;
    BatchFft& operator=(const BatchFft&) = delete;

    void forward(cl_command_queue queue, cl_mem data);
    // Memory that the library holds besides the data.
    std::size_t own_bytes() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace seaglare::glare
