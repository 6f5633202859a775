// Rounds a buffer of the pattern chain through fewer bits right after a kernel has written it, while the library runs as it is:
// OpenCL's functions of the same name in this program are found first.
#pragma once

#include <cstddef>
#include <string>

namespace seaglare::bench {

// A buffer, by the kernel that writes it and the name of that kernel's parameter.
struct Written {
    std::string kernel;
    std::string parameter;
    // Only launches in which this parameter, an int, lies within these bounds; empty: all.
    std::string of;
    int least = 0;
    int most = 0;
};

// The floats that were rounded, before they were. Zeros and what is not finite are not counted.
struct ValueRange {
    double largest = 0;
    double least = 0;  // above 0, in magnitude
    double values = 0;
    double overflown = 0;  // beyond 65504
    double subnormal = 0;  // below 2^-14, where bits are lost
    double vanished = 0;   // below 2^-25
};

struct RoundingRule {
    int fraction_bits = 10;  // of a half
    bool scaled = false;     // by a power of two that lets the buffer's largest value just fit
};

// From now on; nothing is rounded before the first call, nor after stop().
void round_after(const Written& what, RoundingRule rule);
void stop();
// Of everything rounded since round_after(). No values: no such launch was seen.
ValueRange range_seen();

// A float as a number with so many fraction bits and the exponents of a half, to nearest.
float rounded(float value, int fraction_bits);

}  // namespace seaglare::bench
