// Whether OpenCL and OpenGL can work on the same memory here (cl_khr_gl_sharing), so that what is summed in one is drawn from in
// the other without a copy through the CPU. Asked for when a view is made, while its GL context is current.
//
// Written against the OpenCL 1.2 Extension Specification, sections 9.6 (gl_sharing) and 9.7 (gl_event); no driver that has it was
// at hand. The decision and the order of calls are tested (tests/cl/gl_sharing_test.cpp), a picture is where there is a driver.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace seaglare::glare {

enum class GlBinding : std::uint8_t { none, egl, glx };

// The GL context that is current on this thread, as the window system knows it. Starts and loads nothing: a library that the
// host has not loaded has no context either.
struct GlContext {
    GlBinding binding = GlBinding::none;
    void* context = nullptr;
    void* display = nullptr;
    friend bool operator==(const GlContext&, const GlContext&) = default;
};
GlContext current_gl_context();

struct SharingFacts {
    std::string_view device_extensions;  // of the OpenCL device, as CL_DEVICE_EXTENSIONS has them
    GlBinding binding = GlBinding::none;
    bool same_device = false;  // the GL context draws on that device (CL_CURRENT_DEVICE_FOR_GL_CONTEXT_KHR)
};
struct SharingDecision {
    bool shares = false;
    std::string reason;  // why not; empty where it does
};
// Shares where nothing has to be waited for: without cl_khr_gl_event each hand-over is a glFinish and a clFinish (9.6.6), which
// costs more than a copy that nobody waits for.
SharingDecision decide_sharing(const SharingFacts& facts);

// Whether a list of names separated by spaces has this one.
bool has_name(std::string_view names, std::string_view name);

}  // namespace seaglare::glare
