// The OpenCL contexts of this process, and their programs: one for all, and one for each GL context that OpenCL shares memory
// with (gl_sharing.h): an OpenCL context belongs to one share group, and GL does not tell which contexts are of the same. Devices that live at the same time share one: the first build of a
// context is the dearest (PoCL 3.1 reads its library of built-in functions, 0.4 s), and what is built once need not be built
// for every view and every configuration that is tried.
#pragma once

#ifndef CL_TARGET_OPENCL_VERSION
#define CL_TARGET_OPENCL_VERSION 120
#endif
#include <CL/cl.h>

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <type_traits>

#include "glare/device/gl_sharing.h"

namespace seaglare::glare {

struct ClRelease {
    void operator()(cl_context p) const { clReleaseContext(p); }
    void operator()(cl_command_queue p) const { clReleaseCommandQueue(p); }
    void operator()(cl_program p) const { clReleaseProgram(p); }
    void operator()(cl_kernel p) const { clReleaseKernel(p); }
    void operator()(cl_mem p) const { clReleaseMemObject(p); }
    void operator()(cl_event p) const { clReleaseEvent(p); }
};
template <typename Handle>
using ClOwned = std::unique_ptr<std::remove_pointer_t<Handle>, ClRelease>;

// What is built together.
enum class KernelSet : unsigned char {
    pattern,  // aperture, energy table, spread, discs, wide field
    strips,   // transforms for processors with wide vectors
    gather,   // lights added up
};
inline constexpr std::size_t kernel_sets = 3;
// Nodes above one another that a work-item of the gather sums: on a CPU, and elsewhere (shaders/gather.cl).
inline constexpr int gather_rows_on_cpu = 16;
inline constexpr int gather_rows = 1;

class ClShared {
  public:
    // That of the devices that live; a new one where there are none. Throws as ClDevice does.
    static std::shared_ptr<ClShared> acquire();
    // One whose objects can be made from those of a GL context, which is current; where that cannot be, acquire()'s, and
    // `decision` says why. It must be let go of before the GL context ends. Throws as acquire().
    static std::shared_ptr<ClShared> acquire(const GlContext& gl, SharingDecision& decision);
    bool shares_with_gl() const { return gl_.binding != GlBinding::none; }

    cl_platform_id platform() const { return platform_; }
    cl_device_id device() const { return device_; }
    cl_context context() const { return context_.get(); }
    bool is_cpu() const { return is_cpu_; }

    // Any thread. Builds it the first time. On a CPU every set is the same program: PoCL takes 0.1 s for each beyond what
    // is in it, 0.02 s for each that it finds in its cache, and compiles no kernel before it is launched. Elsewhere kernels
    // are compiled with their program, so that what is not asked for is not built. Throws as build().
    cl_program program(KernelSet set);

    // Builds shaders/NAME. Throws std::runtime_error with the compiler's log.
    ClOwned<cl_program> build(std::string_view name, std::string_view options) const;

  private:
    ClShared();
    ClShared(const ClShared& plain, const GlContext& gl);
    ClOwned<cl_program> build_text(std::string_view what, const std::string& text,
                                   std::string_view options) const;

    cl_platform_id platform_ = nullptr;
    cl_device_id device_ = nullptr;
    bool is_cpu_ = false;
    GlContext gl_;
    ClOwned<cl_context> context_;
    std::mutex mutex_;  // of the programs
    std::array<ClOwned<cl_program>, kernel_sets> programs_;
};

}  // namespace seaglare::glare
