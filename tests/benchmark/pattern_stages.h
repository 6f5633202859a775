// The stages of one pattern, each waited for, and what crosses to GL told apart.
#pragma once

#include "tests/benchmark/pattern_cases.h"
#include "tests/benchmark/pattern_cost.h"

namespace seaglare::benchmark_pattern {

// Rows of CSV: pattern, stage, milliseconds and multiples of the yardstick. The upload needs a GL context: without one its row
// is left out.
void print_stages(const Case& c, const Cost& unit);

}  // namespace seaglare::benchmark_pattern
