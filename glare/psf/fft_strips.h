// The same transform as RealFft2d for processors with wide vectors, up to 1024 samples a side: sixteen rows or columns side by
// side in a vector (shaders/fft_strips.cl). On such a device it takes a fifth of the time, because rows outside the pupil are
// left out, too.
#pragma once

#include "glare/device/cl_device.h"

namespace seaglare::glare {

// What a transform of n samples looks up: roots of one, and where each frequency ends up.
class StripTables {
  public:
    StripTables(const ClDevice& device, int n);
    cl_mem roots() const { return roots_.get(); }
    cl_mem places() const { return places_.get(); }
    std::size_t device_bytes() const { return roots_.bytes() + places_.bytes(); }

  private:
    ClBuffer roots_;
    ClBuffer places_;
};

class StripFft2d {
  public:
    static constexpr int most_samples = 1024;

    // n is a power of two, 64 ... most_samples. Throws as ClDevice does.
    StripFft2d(const ClDevice& device, int n);

    // As RealFft2d::forward. Rows outside first_row ... end_row - 1 are zero; those before and after it may be there in
    // part, as rows are taken by 32.
    void forward(cl_command_queue queue, cl_mem data, int first_row, int end_row);
    static constexpr int launches = 2;
    std::size_t device_bytes() const { return tables_.device_bytes(); }

  private:
    int n_;
    StripTables tables_;
    ClKernel rows_;
    ClKernel columns_;
};

}  // namespace seaglare::glare
