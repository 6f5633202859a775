#include "glare/psf/fft_strips.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace seaglare::glare {

namespace {

constexpr int rows_per_strip = 32;
constexpr int columns_per_strip = 16;

// Where decimation in frequency, by eights and at last by what remains, leaves each frequency.
std::vector<std::int32_t> places_of(int n) {
    std::vector<std::int32_t> places(static_cast<std::size_t>(n));
    for (int k = 0; k < n; ++k) {
        int rest = k;
        int block = n;
        int place = 0;
        while (block > 1) {
            const int radix = std::min(block, 8);
            block /= radix;
            place += rest % radix * block;
            rest /= radix;
        }
        places[static_cast<std::size_t>(k)] = place;
    }
    return places;
}

std::vector<std::array<float, 2>> roots_of(int n) {
    std::vector<std::array<float, 2>> roots(static_cast<std::size_t>(n));
    for (std::size_t k = 0; k < roots.size(); ++k) {
        const double angle = -2 * std::numbers::pi * static_cast<double>(k) / n;
        roots[k] = {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
    }
    return roots;
}

}  // namespace

StripTables::StripTables(const ClDevice& device, int n) {
    const auto places = places_of(n);
    const auto roots = roots_of(n);
    cl_command_queue queue = device.queue();
    // No buffer is empty; who asks for no samples is refused by the transform.
    places_.reserve(device.context(), queue, std::max<std::size_t>(places.size(), 1) * sizeof(places[0]),
                    "places of frequencies");
    places_.write(queue, places.size() * sizeof(places[0]), places.data());
    roots_.reserve(device.context(), queue, std::max<std::size_t>(roots.size(), 1) * sizeof(roots[0]),
                   "roots of one");
    roots_.write(queue, roots.size() * sizeof(roots[0]), roots.data());
    device.finish();  // the vectors end here
}

StripFft2d::StripFft2d(const ClDevice& device, int n)
    : n_(n),
      tables_(device, n),
      rows_(device.program(KernelSet::strips), "transform_rows"),
      columns_(device.program(KernelSet::strips), "transform_columns") {
    if (n < 64 || n > most_samples || !std::has_single_bit(static_cast<unsigned>(n)))
        throw std::invalid_argument("transform in strips: the size must be a power of two from 64 to 1024");
}

void StripFft2d::forward(cl_command_queue queue, cl_mem data, int first_row, int end_row) {
    // Whole strips, inside the plane.
    const int first = std::clamp(first_row, 0, n_ - 1) / rows_per_strip * rows_per_strip;
    const int end =
        (std::clamp(end_row, first + 1, n_) + rows_per_strip - 1) / rows_per_strip * rows_per_strip;
    const cl_int count = end - first;
    rows_.set(data, n_, first, count, tables_.roots(), tables_.places());
    rows_.launch(queue, static_cast<std::size_t>(count / rows_per_strip), 1);
    columns_.set(data, n_, first, count, tables_.roots(), tables_.places());
    columns_.launch(queue, static_cast<std::size_t>(n_ / 2 / columns_per_strip), 1);
}

}  // namespace seaglare::glare
