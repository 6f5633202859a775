#include "tests/benchmark/frames_timeline.h"

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#define SEAGLARE_EXPORTED __attribute__((visibility("default")))

namespace seaglare::benchmark {

namespace {

template <typename Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

struct Command {
    cl_command_queue queue = nullptr;  // null: a frame
    std::string what;
    std::size_t items = 0;
    cl_event event = nullptr;
    double at_ms = 0;
};
struct Timeline {
    std::atomic<bool> on{false};
    std::mutex mutex;
    std::vector<Command> commands;
};
Timeline& timeline() {
    static Timeline one;
    return one;
}

double now_ms() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC_RAW, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

// Launches through `enqueue`, which is given where to put the event; `wanted` is the caller's own, or null.
template <typename Enqueue>
cl_int watched(cl_command_queue queue, const char* what, std::size_t items, cl_event* wanted,
               const Enqueue& enqueue) {
    if (!timeline().on) return enqueue(wanted);
    cl_event event = nullptr;
    const double at_ms = now_ms();
    const cl_int code = enqueue(&event);
    if (code != CL_SUCCESS) return code;
    if (wanted != nullptr) {
        clRetainEvent(event);
        *wanted = event;
    }
    const std::lock_guard lock(timeline().mutex);
    timeline().commands.push_back({queue, what, items, event, at_ms});
    return code;
}

double time_ms(cl_event event, cl_profiling_info what) {
    cl_ulong ns = 0;
    clGetEventProfilingInfo(event, what, sizeof ns, &ns, nullptr);
    return static_cast<double>(ns) * 1e-6;
}

}  // namespace

void begin_timeline() {
    timeline().on = true;
}

void note_frame(int frame, const char* what) {
    if (!timeline().on) return;
    const std::lock_guard lock(timeline().mutex);
    timeline().commands.push_back({nullptr, std::to_string(frame) + ' ' + what, 0, nullptr, now_ms()});
}

void write_timeline(const std::string& file) {
    timeline().on = false;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(std::fopen(file.c_str(), "w"), &std::fclose);
    if (!out) throw std::runtime_error("cannot write " + file);
    std::fprintf(out.get(), "queue,command,items,called_ms,queued_ms,submitted_ms,started_ms,ended_ms\n");
    std::map<cl_command_queue, int> queues;
    const std::lock_guard lock(timeline().mutex);
    for (const Command& c : timeline().commands) {
        if (c.queue == nullptr) {
            std::fprintf(out.get(), "frame,%s,,%.4f,,,,\n", c.what.c_str(), c.at_ms);
            continue;
        }
        const int queue = queues.try_emplace(c.queue, static_cast<int>(queues.size())).first->second;
        std::fprintf(
            out.get(), "%d,%s,%zu,%.4f,%.4f,%.4f,%.4f,%.4f\n", queue, c.what.c_str(), c.items, c.at_ms,
            time_ms(c.event, CL_PROFILING_COMMAND_QUEUED), time_ms(c.event, CL_PROFILING_COMMAND_SUBMIT),
            time_ms(c.event, CL_PROFILING_COMMAND_START), time_ms(c.event, CL_PROFILING_COMMAND_END));
        clReleaseEvent(c.event);
    }
    timeline().commands.clear();
}

}  // namespace seaglare::benchmark

using seaglare::benchmark::next;
using seaglare::benchmark::watched;

extern "C" {

SEAGLARE_EXPORTED cl_command_queue clCreateCommandQueue(cl_context context, cl_device_id device,
                                                        cl_command_queue_properties properties,
                                                        cl_int* code) {
    if (seaglare::benchmark::timeline().on) properties |= CL_QUEUE_PROFILING_ENABLE;
    return next<decltype(&clCreateCommandQueue)>("clCreateCommandQueue")(context, device, properties, code);
}

SEAGLARE_EXPORTED cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                                                const std::size_t* offset, const std::size_t* global,
                                                const std::size_t* local, cl_uint wait_count,
                                                const cl_event* waits, cl_event* event) {
    static const auto launch = next<decltype(&clEnqueueNDRangeKernel)>("clEnqueueNDRangeKernel");
    std::array<char, 64> name{};
    std::size_t items = 1;
    if (seaglare::benchmark::timeline().on) {
        clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, name.size(), name.data(), nullptr);
        for (cl_uint i = 0; i < dimensions; ++i)
            items *= global[i];
    }
    return watched(queue, name.data(), items, event, [&](cl_event* out) {
        return launch(queue, kernel, dimensions, offset, global, local, wait_count, waits, out);
    });
}

SEAGLARE_EXPORTED cl_int clEnqueueWriteBuffer(cl_command_queue queue, cl_mem buffer, cl_bool blocking,
                                              size_t offset, size_t size, const void* data,
                                              cl_uint wait_count, const cl_event* waits, cl_event* event) {
    static const auto write = next<decltype(&clEnqueueWriteBuffer)>("clEnqueueWriteBuffer");
    return watched(queue, "(write)", size, event, [&](cl_event* out) {
        return write(queue, buffer, blocking, offset, size, data, wait_count, waits, out);
    });
}

SEAGLARE_EXPORTED cl_int clEnqueueReadBuffer(cl_command_queue queue, cl_mem buffer, cl_bool blocking,
                                             size_t offset, size_t size, void* data, cl_uint wait_count,
                                             const cl_event* waits, cl_event* event) {
    static const auto read = next<decltype(&clEnqueueReadBuffer)>("clEnqueueReadBuffer");
    return watched(queue, "(read)", size, event, [&](cl_event* out) {
        return read(queue, buffer, blocking, offset, size, data, wait_count, waits, out);
    });
}

SEAGLARE_EXPORTED void* clEnqueueMapBuffer(cl_command_queue queue, cl_mem buffer, cl_bool blocking,
                                           cl_map_flags flags, size_t offset, size_t size, cl_uint wait_count,
                                           const cl_event* waits, cl_event* event, cl_int* code) {
    static const auto map = next<decltype(&clEnqueueMapBuffer)>("clEnqueueMapBuffer");
    void* mapped = nullptr;
    const cl_int result = watched(queue, "(map)", size, event, [&](cl_event* out) {
        cl_int done = CL_SUCCESS;
        mapped = map(queue, buffer, blocking, flags, offset, size, wait_count, waits, out, &done);
        return done;
    });
    if (code != nullptr) *code = result;
    return mapped;
}

}  // extern "C"
