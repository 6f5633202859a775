// What a fuzz target may allocate: a stated multiple of its input. Counts the bytes that live during a call, and stops the
// fuzzer in the very allocation that goes beyond.
#pragma once

#include <cstddef>

namespace seaglare::fuzz {

// From construction to destruction, this thread's allocations less what it frees may at no time exceed
// `bytes_per_input_byte * input_bytes + constant_bytes`. Aborts where they do. One at a time.
class AllocationBound {
  public:
    AllocationBound(std::size_t input_bytes, std::size_t bytes_per_input_byte, std::size_t constant_bytes);
    ~AllocationBound();
    AllocationBound(const AllocationBound&) = delete;
    AllocationBound& operator=(const AllocationBound&) = delete;
};

// What even the smallest input may cost: a stream, a message, the first blocks of a few containers.
inline constexpr std::size_t small_change_bytes = std::size_t{8} << 10;

}  // namespace seaglare::fuzz
