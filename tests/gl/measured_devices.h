// What the library asks devices and the heap for, while it runs as a host has it, loaded from its file: GL objects through a
// get_proc of ours, OpenCL through functions of the same name in this program, which the loader finds first, and so operator
// new. A program that links this must export its symbols (ENABLE_EXPORTS).
#pragma once

#include <cstdint>

namespace seaglare::test {

// Bytes of textures and buffers that live, by the formats and sizes asked for. Throws std::logic_error for a format it does
// not know.
class MeasuredGl {
  public:
    // `user` is not used: functions come from host::HeadlessContext.
    static void* get_proc(void* user, const char* name);
    static double bytes();
    // Calls since reset() that make something or make it larger: images of textures, buffers that grow (one that is orphaned
    // at its size does not), names, shaders compiled, programs linked.
    static std::uint64_t makings();
    static const char* last_making();  // of any kind; empty: none
    static void reset();
};

class MeasuredCl {
  public:
    static double bytes();  // of buffers that live
    // Since reset(): contexts, queues, buffers, programs built, kernels.
    static std::uint64_t makings();
    static std::uint64_t launches();  // of kernels, since reset()
    static std::uint64_t makings_of_this_thread();
    static const char* last_making();
    static void reset();
};

// Since reset(), of every thread: operator new in every library of the process; malloc and its kin where a library that is
// watched calls them (drivers call them for every command).
class CountedHeap {
  public:
    static std::uint64_t allocations();
    static std::uint64_t allocations_of_this_thread();
    // Counts what code of the loaded library of this file (empty: the program) asks C for, from now on. False: it is not loaded, or a sanitizer
    // has these functions.
    static bool watch(const char* library);
    static std::uint64_t bytes();
    static void reset();
    // Prints where the next allocations came from to stderr: for who looks for them.
    static void trace_next(int count);
};

}  // namespace seaglare::test
