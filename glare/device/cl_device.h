// One OpenCL device with its context and queue, and the few things we ask of it. Every failure is a ClError that names
// the call and its code.
#pragma once

#ifndef CL_TARGET_OPENCL_VERSION
#define CL_TARGET_OPENCL_VERSION 120
#endif
#include <CL/cl.h>

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace seaglare::glare {

class ClError : public std::runtime_error {
  public:
    ClError(std::string_view call, cl_int code);
    cl_int code() const { return code_; }

  private:
    cl_int code_;
};

// "CL_OUT_OF_RESOURCES" for -5, and so on; the number for what OpenCL 1.2 does not name.
std::string cl_code_name(cl_int code);
// Throws ClError when `code` is not CL_SUCCESS.
void check_cl(cl_int code, std::string_view call);

struct ClRelease {
    void operator()(cl_context p) const { clReleaseContext(p); }
    void operator()(cl_command_queue p) const { clReleaseCommandQueue(p); }
    void operator()(cl_program p) const { clReleaseProgram(p); }
    void operator()(cl_kernel p) const { clReleaseKernel(p); }
    void operator()(cl_mem p) const { clReleaseMemObject(p); }
};
template <typename Handle>
using ClOwned = std::unique_ptr<std::remove_pointer_t<Handle>, ClRelease>;

// A kernel and its launches. Local sizes are always given: a driver that compiles for each one has then seen it.
class ClKernel {
  public:
    ClKernel() = default;
    ClKernel(cl_program program, const char* name);

    // Sets all arguments in order: cl_mem handles and plain numbers.
    template <typename... Arguments>
    void set(const Arguments&... arguments) {
        cl_uint index = 0;
        // A handle is passed by its own size.
        (set_argument(index++, sizeof(Arguments), &arguments), ...);  // NOLINT(bugprone-sizeof-expression)
    }
    // Global sizes are rounded up to a whole number of groups: the kernel returns beyond its range.
    void launch(cl_command_queue queue, std::size_t items, std::size_t group) const;
    void launch(cl_command_queue queue, std::size_t columns, std::size_t rows, std::size_t group_columns,
                std::size_t group_rows) const;

  private:
    void set_argument(cl_uint index, std::size_t size, const void* value);
    ClOwned<cl_kernel> kernel_;
    std::string name_;
};

// Device memory that grows when more is wanted and never shrinks.
class ClBuffer {
  public:
    // Contents are lost when it grows. `zeroed` fills new memory with zeros.
    void reserve(cl_context context, cl_command_queue queue, std::size_t bytes, std::string_view what,
                 bool zeroed = false);
    void write(cl_command_queue queue, std::size_t bytes, const void* data);
    cl_mem get() const { return memory_.get(); }
    std::size_t bytes() const { return bytes_; }

  private:
    ClOwned<cl_mem> memory_;
    std::size_t bytes_ = 0;
};

class ClDevice {
  public:
    // The first GPU of any platform, else the first device of any kind that can run our kernels. Signal handlers of
    // the process are as before when it returns. Throws ClError or std::runtime_error saying what is missing.
    ClDevice();

    cl_device_id id() const { return device_; }
    cl_platform_id platform() const { return platform_; }
    cl_context context() const { return context_.get(); }
    cl_command_queue queue() const { return queue_.get(); }
    const std::string& name() const { return name_; }
    std::size_t max_group_size() const { return max_group_size_; }
    // A few processors with wide vectors, for which some kernels have a form of their own.
    bool is_cpu() const { return is_cpu_; }

    // Builds shaders/NAME; `options` such as -DNAME=VALUE. Throws std::runtime_error with the compiler's log.
    ClOwned<cl_program> build(std::string_view name, std::string_view options = {}) const;
    void finish() const;

  private:
    cl_platform_id platform_ = nullptr;
    cl_device_id device_ = nullptr;
    ClOwned<cl_context> context_;
    ClOwned<cl_command_queue> queue_;
    std::string name_;
    std::size_t max_group_size_ = 0;
    bool is_cpu_ = false;
};

}  // namespace seaglare::glare
