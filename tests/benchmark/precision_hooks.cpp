#include "tests/benchmark/precision_hooks.h"

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#define SEAGLARE_EXPORTED __attribute__((visibility("default")))

namespace seaglare::bench {

namespace {

constexpr double largest_half = 65504;

template <typename Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

struct State {
    std::map<std::string, std::vector<std::string>> parameters;  // by kernel
    std::map<std::pair<cl_kernel, cl_uint>, std::array<char, sizeof(std::uintptr_t)>>
        given;  // arguments as they were set
    std::optional<Written> wanted;
    RoundingRule rule;
    ValueRange seen;
};
State& state() {
    static State all;
    return all;
}

// "__kernel void NAME(TYPE a, TYPE b)": the last word of each parameter.
void learn_parameters(std::string_view text) {
    constexpr std::string_view begin_of_kernel = "__kernel void ";
    for (std::size_t at = text.find(begin_of_kernel); at != std::string_view::npos;
         at = text.find(begin_of_kernel, at + 1)) {
        const std::size_t name = at + begin_of_kernel.size();
        const std::size_t open = text.find('(', name);
        const std::size_t close = text.find(')', open);
        std::vector<std::string> names;
        for (std::size_t from = open + 1; from < close;) {
            const std::size_t end = std::min(text.find(',', from), close);
            const std::size_t word = text.find_last_of(" *\n", end - 1) + 1;
            names.emplace_back(text.substr(word, end - word));
            from = end + 1;
        }
        state().parameters[std::string(text.substr(name, open - name))] = std::move(names);
    }
}

std::optional<cl_uint> index_of(const std::string& kernel, const std::string& parameter) {
    const auto known = state().parameters.find(kernel);
    if (known == state().parameters.end()) return std::nullopt;
    const auto& names = known->second;
    const auto found = std::find(names.begin(), names.end(), parameter);
    if (found == names.end())
        throw std::logic_error("precision: kernel " + kernel + " has no parameter " + parameter);
    return static_cast<cl_uint>(found - names.begin());
}

cl_int number(cl_kernel kernel, cl_uint index) {
    cl_int value = 0;
    std::memcpy(&value, state().given.at({kernel, index}).data(), sizeof(value));
    return value;
}
cl_mem buffer(cl_kernel kernel, cl_uint index) {
    std::uintptr_t value = 0;
    std::memcpy(&value, state().given.at({kernel, index}).data(), sizeof(value));
    return reinterpret_cast<cl_mem>(value);
}

void note(const std::vector<float>& values) {
    ValueRange& seen = state().seen;
    for (const float v : values) {
        const double magnitude = std::abs(static_cast<double>(v));
        if (!(magnitude > 0) || !std::isfinite(magnitude)) continue;
        seen.values += 1;
        seen.largest = std::max(seen.largest, magnitude);
        seen.least = seen.least == 0 ? magnitude : std::min(seen.least, magnitude);
        seen.overflown += magnitude > largest_half ? 1 : 0;
        seen.subnormal += magnitude < 0x1p-14 ? 1 : 0;
        seen.vanished += magnitude < 0x1p-25 ? 1 : 0;
    }
}

void round_buffer(cl_command_queue queue, cl_mem memory) {
    std::size_t bytes = 0;
    clGetMemObjectInfo(memory, CL_MEM_SIZE, sizeof(bytes), &bytes, nullptr);
    std::vector<float> values(bytes / sizeof(float));
    clEnqueueReadBuffer(queue, memory, CL_TRUE, 0, values.size() * sizeof(float), values.data(), 0, nullptr,
                        nullptr);
    note(values);
    float largest = 0;
    for (const float v : values)
        if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
    const int exponent = state().rule.scaled && largest > 0 ? 14 - std::ilogb(largest) : 0;
    for (float& v : values)
        if (std::isfinite(v))
            v = std::ldexp(rounded(std::ldexp(v, exponent), state().rule.fraction_bits), -exponent);
    clEnqueueWriteBuffer(queue, memory, CL_TRUE, 0, values.size() * sizeof(float), values.data(), 0, nullptr,
                         nullptr);
}

void after_launch(cl_command_queue queue, cl_kernel kernel) {
    const State& s = state();
    if (!s.wanted) return;
    std::array<char, 64> name{};
    clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, name.size(), name.data(), nullptr);
    if (s.wanted->kernel != name.data()) return;
    if (!s.wanted->of.empty()) {
        const auto index = index_of(name.data(), s.wanted->of);
        const cl_int value = number(kernel, index.value());
        if (value < s.wanted->least || value > s.wanted->most) return;
    }
    round_buffer(queue, buffer(kernel, index_of(name.data(), s.wanted->parameter).value()));
}

}  // namespace

float rounded(float value, int fraction_bits) {
    if (value == 0 || !std::isfinite(value)) return value;
    const int exponent = std::max(std::ilogb(value), -14);
    const float unit = std::ldexp(1.0F, exponent - fraction_bits);
    const float nearest = std::nearbyint(value / unit) * unit;
    const auto limit = static_cast<float>(largest_half);
    return std::clamp(nearest, -limit, limit);
}

void round_after(const Written& what, RoundingRule rule) {
    state().wanted = what;
    state().rule = rule;
    state().seen = {};
}

void stop() {
    state().wanted.reset();
}

ValueRange range_seen() {
    return state().seen;
}

}  // namespace seaglare::bench

extern "C" {

SEAGLARE_EXPORTED cl_program clCreateProgramWithSource(cl_context context, cl_uint count, const char** texts,
                                                       const std::size_t* sizes, cl_int* code) {
    for (cl_uint i = 0; i < count; ++i)
        seaglare::bench::learn_parameters(sizes != nullptr && sizes[i] > 0
                                              ? std::string_view(texts[i], sizes[i])
                                              : std::string_view(texts[i]));
    return seaglare::bench::next<decltype(&clCreateProgramWithSource)>("clCreateProgramWithSource")(
        context, count, texts, sizes, code);
}

// Memory that no kernel has written holds zeros, and not what was there before: it is rounded with the rest.
SEAGLARE_EXPORTED cl_mem clCreateBuffer(cl_context context, cl_mem_flags flags, std::size_t bytes, void* data,
                                        cl_int* code) {
    const auto create = seaglare::bench::next<decltype(&clCreateBuffer)>("clCreateBuffer");
    if (data != nullptr) return create(context, flags, bytes, data, code);
    std::vector<char> zeros(bytes);
    return create(context, flags | CL_MEM_COPY_HOST_PTR, bytes, zeros.data(), code);
}

SEAGLARE_EXPORTED cl_int clSetKernelArg(cl_kernel kernel, cl_uint index, std::size_t size,
                                        const void* value) {
    auto& given = seaglare::bench::state().given[{kernel, index}];
    if (value != nullptr) std::memcpy(given.data(), value, std::min(size, given.size()));
    return seaglare::bench::next<decltype(&clSetKernelArg)>("clSetKernelArg")(kernel, index, size, value);
}

SEAGLARE_EXPORTED cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                                                const std::size_t* offset, const std::size_t* global,
                                                const std::size_t* local, cl_uint wait_count,
                                                const cl_event* wait_for, cl_event* event) {
    const cl_int code = seaglare::bench::next<decltype(&clEnqueueNDRangeKernel)>("clEnqueueNDRangeKernel")(
        queue, kernel, dimensions, offset, global, local, wait_count, wait_for, event);
    if (code == CL_SUCCESS) seaglare::bench::after_launch(queue, kernel);
    return code;
}

}  // extern "C"
