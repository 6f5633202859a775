// What something costs: by the clock and in processor time of all threads, which a busy machine does not change as much.
#pragma once

#include <functional>

namespace seaglare::benchmark_pattern {

struct Cost {
    double wall_ms = 0;
    double cpu_ms = 0;
    double mean_cpu_ms = 0;
    double worst_ms = 0;  // by the clock
};

// Medians of so many runs, which are told their number.
Cost measure(int runs, const std::function<void(int)>& run);

// One complex 512 x 512 transform of FFTW, single precision, one thread.
Cost yardstick();

}  // namespace seaglare::benchmark_pattern
