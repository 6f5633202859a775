#include "glare/psf/wide_strips.h"

#include <bit>
#include <stdexcept>

namespace seaglare::glare {

namespace {

constexpr std::size_t rows_per_strip = 32;

}  // namespace

WideStrips::WideStrips(const ClDevice& device, int n)
    : n_(n),
      tables_(device, n),
      rows_(device.program(KernelSet::strips), "transform_rows"),
      columns_(device.program(KernelSet::strips), "sum_wide_columns") {
    if (n < 64 || n > most_samples || !std::has_single_bit(static_cast<unsigned>(n)))
        throw std::invalid_argument("wide field in strips: the size must be a power of two from 64 to 4096");
}

void WideStrips::transform_rows(cl_command_queue queue, cl_mem rows, int count) {
    rows_.set(rows, n_, cl_int{0}, static_cast<cl_int>(count), tables_.roots(), tables_.places());
    rows_.launch(queue, static_cast<std::size_t>(count) / rows_per_strip, 1);
}

void WideStrips::sum_columns(cl_command_queue queue, const Kept& kept, const Sums& sums) {
    columns_.set(kept.halves, kept.floats, kept.first_column, kept.first_row, kept.end_row, n_,
                 sums.first_column, sums.count, tables_.roots(), tables_.places(), sums.step, sums.edges,
                 sums.unbox, sums.scale, sums.join_inner, sums.join_outer, sums.out);
    columns_.launch(queue, static_cast<std::size_t>(sums.count) / columns_per_strip, 1);
}

}  // namespace seaglare::glare
