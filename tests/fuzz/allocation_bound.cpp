#include "tests/fuzz/allocation_bound.h"

#include <sanitizer/allocator_interface.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace seaglare::fuzz {

namespace {

struct Count {
    bool running = false;
    std::ptrdiff_t live_bytes = 0;  // below zero once it frees what was there before
    std::ptrdiff_t peak_bytes = 0;
    std::ptrdiff_t most_bytes = 0;
    std::size_t input_bytes = 0;
};
thread_local Count count;

// The largest share of its bound that any call has used, said when the fuzzer ends: a bound that nothing comes near is
// no check.
double largest_share = 0;
Count largest;

void say_largest() {
    std::fprintf(stderr,
                 "allocation: at most %td of %td bytes allowed, for an input of %zu bytes (%.0f %%)\n",
                 largest.peak_bytes, largest.most_bytes, largest.input_bytes, 100 * largest_share);
}

void on_malloc(const volatile void*, std::size_t size) {
    if (!count.running) return;
    count.live_bytes += static_cast<std::ptrdiff_t>(size);
    count.peak_bytes = std::max(count.peak_bytes, count.live_bytes);
    if (count.live_bytes <= count.most_bytes) return;
    count.running = false;
    std::fprintf(stderr, "error: %td bytes allocated at once for an input of %zu bytes; %td are allowed\n",
                 count.live_bytes, count.input_bytes, count.most_bytes);
    std::abort();
}

void on_free(const volatile void* block) {
    if (!count.running || block == nullptr) return;
    count.live_bytes -=
        static_cast<std::ptrdiff_t>(__sanitizer_get_allocated_size(const_cast<const void*>(block)));
}

bool install_hooks() {
    if (__sanitizer_install_malloc_and_free_hooks(on_malloc, on_free) == 0) {
        std::fputs("error: no room for another allocation hook\n", stderr);
        std::abort();
    }
    std::atexit(say_largest);
    return true;
}

}  // namespace

AllocationBound::AllocationBound(std::size_t input_bytes, std::size_t bytes_per_input_byte,
                                 std::size_t constant_bytes) {
    static const bool installed = install_hooks();
    count = {installed, 0, 0,
             static_cast<std::ptrdiff_t>(bytes_per_input_byte * input_bytes + constant_bytes), input_bytes};
}

AllocationBound::~AllocationBound() {
    count.running = false;
    const double share = static_cast<double>(count.peak_bytes) / static_cast<double>(count.most_bytes);
    if (share <= largest_share) return;
    largest_share = share;
    largest = count;
}

}  // namespace seaglare::fuzz
