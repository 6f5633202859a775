// One OpenCL device with its context, which others may share, and a queue of its own, and the few things we ask of it. Every
// failure is a ClError that names the call and its code.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "glare/device/cl_shared.h"

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

// A kernel and its launches, which give way to frames where their thread does (cl_turns.h). Local sizes are always given: a
// driver that compiles for each one has then seen it.
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
    void enqueue(cl_command_queue queue, cl_uint dimensions, const std::size_t* global,
                 const std::size_t* local) const;
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
    // One more queue of a context that is there: starts no driver, so that any thread may. Throws ClError.
    explicit ClDevice(std::shared_ptr<ClShared> shared);

    const std::shared_ptr<ClShared>& shared() const { return shared_; }
    cl_device_id id() const { return shared_->device(); }
    cl_platform_id platform() const { return shared_->platform(); }
    cl_context context() const { return shared_->context(); }
    cl_command_queue queue() const { return queue_.get(); }
    const std::string& name() const { return name_; }
    std::size_t max_group_size() const { return max_group_size_; }
    // A few processors with wide vectors, for which some kernels have a form of their own.
    bool is_cpu() const { return shared_->is_cpu(); }

    // What the kernels of a set are made from: built once for all devices that share a context. Throws as build().
    cl_program program(KernelSet set) const { return shared_->program(set); }
    // Builds shaders/NAME; `options` such as -DNAME=VALUE. Throws std::runtime_error with the compiler's log.
    ClOwned<cl_program> build(std::string_view name, std::string_view options = {}) const {
        return shared_->build(name, options);
    }
    void finish() const;

  private:
    void open();
    std::shared_ptr<ClShared> shared_;
    ClOwned<cl_command_queue> queue_;
    std::string name_;
    std::size_t max_group_size_ = 0;
};

}  // namespace seaglare::glare
