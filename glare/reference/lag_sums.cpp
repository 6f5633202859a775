#include "glare/reference/lag_sums.h"

namespace seaglare::reference {

namespace {

constexpr std::size_t rows_at_once = 4;
constexpr std::size_t columns_at_once = 4;

// Four rows share what is read of the waves.
template <std::size_t rows>
[[gnu::always_inline]] inline void add_rows(const double* __restrict lags, std::size_t lag_stride,
                                            std::size_t columns, const double* __restrict waves,
                                            std::size_t width, double* __restrict sums) {
    std::size_t x = 0;
    for (; x + columns_at_once <= columns; x += columns_at_once) {
        const double* const w0 = waves + x * width;
        const double* const w1 = w0 + width;
        const double* const w2 = w1 + width;
        const double* const w3 = w2 + width;
        double lag[rows][columns_at_once];
        for (std::size_t r = 0; r < rows; ++r)
            for (std::size_t i = 0; i < columns_at_once; ++i)
                lag[r][i] = lags[r * lag_stride + x + i];
        for (std::size_t a = 0; a < width; ++a) {
            for (std::size_t r = 0; r < rows; ++r)
                sums[r * width + a] +=
                    lag[r][0] * w0[a] + lag[r][1] * w1[a] + lag[r][2] * w2[a] + lag[r][3] * w3[a];
        }
    }
    for (; x < columns; ++x)
        for (std::size_t r = 0; r < rows; ++r)
            for (std::size_t a = 0; a < width; ++a)
                sums[r * width + a] += lags[r * lag_stride + x] * waves[x * width + a];
}

[[gnu::always_inline]] inline void add_all(const double* lags, std::size_t lag_stride, std::size_t rows,
                                           std::size_t columns, const double* waves, std::size_t width,
                                           double* sums) {
    std::size_t r = 0;
    for (; r + rows_at_once <= rows; r += rows_at_once)
        add_rows<rows_at_once>(lags + r * lag_stride, lag_stride, columns, waves, width, sums + r * width);
    for (; r < rows; ++r)
        add_rows<1>(lags + r * lag_stride, lag_stride, columns, waves, width, sums + r * width);
}

// The same with the wider vectors of processors that have them.
#ifdef __x86_64__
[[gnu::target("avx2,fma")]] void add_all_avx2(const double* lags, std::size_t lag_stride, std::size_t rows,
                                              std::size_t columns, const double* waves, std::size_t width,
                                              double* sums) {
    add_all(lags, lag_stride, rows, columns, waves, width, sums);
}
#endif

}  // namespace

void add_lag_sums(const double* lags, std::size_t lag_stride, std::size_t rows, std::size_t columns,
                  const double* waves, std::size_t width, double* sums) {
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
        add_all_avx2(lags, lag_stride, rows, columns, waves, width, sums);
        return;
    }
#endif
    add_all(lags, lag_stride, rows, columns, waves, width, sums);
}

}  // namespace seaglare::reference
