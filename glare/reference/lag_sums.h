// The reference's inner loop: sums over lags of an autocorrelation times cosines, for many rows of lags and many pixels. A
// product of matrices; here because it is nearly all of what a reference pattern costs.
#pragma once

#include <cstddef>

namespace seaglare::reference {

// sums[r][a] += sum over x < columns of lags[r][x] * waves[x][a], for `rows` rows r and `width` columns a. All are dense and
// row by row: lags with `lag_stride` numbers in a row, waves and sums with `width`. Every sum runs over x upwards in groups
// of four, so that it does not depend on how many rows are taken at once.
void add_lag_sums(const double* lags, std::size_t lag_stride, std::size_t rows, std::size_t columns,
                  const double* waves, std::size_t width, double* sums);

}  // namespace seaglare::reference
