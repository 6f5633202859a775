#include "tests/benchmark/pattern_cost.h"

#include <fftw3.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <ctime>
#include <numeric>
#include <vector>

namespace seaglare::benchmark_pattern {

namespace {

double cpu_now_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

Cost measure(int runs, const std::function<void(int)>& run) {
    std::vector<double> wall;
    std::vector<double> cpu;
    for (int i = 0; i < runs; ++i) {
        const double cpu_start = cpu_now_ms();
        const auto start = std::chrono::steady_clock::now();
        run(i);
        wall.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        cpu.push_back(cpu_now_ms() - cpu_start);
    }
    const double mean = std::accumulate(cpu.begin(), cpu.end(), 0.0) / static_cast<double>(cpu.size());
    return {median(wall), median(cpu), mean, *std::max_element(wall.begin(), wall.end())};
}

Cost yardstick() {
    constexpr int n = 512;
    fftwf_complex* const plane = fftwf_alloc_complex(n * n);
    const fftwf_plan plan = fftwf_plan_dft_2d(n, n, plane, plane, FFTW_FORWARD, FFTW_MEASURE);
    std::memset(plane, 0, sizeof(fftwf_complex) * n * n);
    const Cost cost = measure(41, [&](int) { fftwf_execute(plan); });
    fftwf_destroy_plan(plan);
    fftwf_free(plane);
    return cost;
}

}  // namespace seaglare::benchmark_pattern
