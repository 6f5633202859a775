// The transforms of the wide field for processors with wide vectors: rows with the kernel of fft_strips.h, columns fused with
// what is made of them (shaders/wide_strips.cl). A table costs a quarter of what it does with a library's transforms, and two
// kernels are compiled in the place of six.
#pragma once

#include "glare/device/cl_device.h"
#include "glare/psf/fft_strips.h"

namespace seaglare::glare {

class WideStrips {
  public:
    static constexpr int most_samples = 4096;
    static constexpr int columns_per_strip = 16;

    // n is a power of two, 64 ... most_samples. Throws as ClDevice does.
    WideStrips(const ClDevice& device, int n);

    // Replaces `count` rows of n + 2 reals, a multiple of 32, by n/2 + 1 complex numbers. One launch.
    void transform_rows(cl_command_queue queue, cl_mem rows, int count);

    // Rows first_row ... end_row - 1 of the transformed plane, the others are zero; of each row `floats` halves from a column
    // on, zeros beyond the highest frequency.
    struct Kept {
        cl_mem halves = nullptr;
        int floats = 0;
        int first_column = 0;
        int first_row = 0;
        int end_row = 0;
    };
    // As sum_along_columns of two_scale.cl has them.
    struct Sums {
        int first_column = 0;
        int count = 0;  // a multiple of 16
        int step = 0;
        int edges = 0;
        cl_mem unbox = nullptr;
        float scale = 0;
        float join_inner = 0;
        float join_outer = 0;
        cl_mem out = nullptr;
    };
    // Transforms columns and sums their energy along them. One launch.
    void sum_columns(cl_command_queue queue, const Kept& kept, const Sums& sums);

    std::size_t device_bytes() const { return tables_.device_bytes(); }

  private:
    int n_;
    StripTables tables_;
    ClKernel rows_;
    ClKernel columns_;
};

}  // namespace seaglare::glare
