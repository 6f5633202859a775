// What OpenCL's programs and the first launches of kernels cost in this process, as the library makes them: its calls of OpenCL's
// functions are met here before they go on.
#pragma once

#include <functional>
#include <string>

namespace seaglare::bench {

struct Spent {
    double wall_ms = 0;
    double cpu_ms = 0;  // of all threads, and of the linker that PoCL starts for every kernel
};
Spent spent_now();
Spent operator-(const Spent& a, const Spent& b);

// Called after every build of a program and every first launch of a kernel. While it is set, first launches are waited for.
using Watch = std::function<void(const std::string& what, const Spent& cost)>;
void watch(Watch watcher);

// A program and a kernel with nothing in them, in a context of their own: what PoCL costs without us.
void build_nothing();

}  // namespace seaglare::bench
