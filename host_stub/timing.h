// Frame times and what to say of them.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "lightdb/json/writer.h"

namespace seaglare::host {

class Stopwatch {
  public:
    double ms() const {
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Nearest-rank quantile, q in 0 … 1; 0 of an empty list.
inline double quantile(std::vector<double> values, double q) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(values.size())));
    return values[std::clamp<std::size_t>(rank, 1, values.size()) - 1];
}

inline void write_summary(json::Writer& out, const char* key, const std::vector<double>& ms) {
    out.key(key);
    out.begin_object(json::Writer::Layout::line);
    out.member("median", quantile(ms, 0.5));
    out.member("p95", quantile(ms, 0.95));
    out.member("min", quantile(ms, 0));
    out.member("max", quantile(ms, 1));
    out.end_object();
}

}  // namespace seaglare::host
