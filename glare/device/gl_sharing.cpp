#include "glare/device/gl_sharing.h"

#include <dlfcn.h>

#include <memory>

namespace seaglare::glare {

namespace {

struct Close {
    void operator()(void* library) const { dlclose(library); }
};

// Calls a function without arguments of a library that is loaded already; null where there is none.
void* ask(const char* library, const char* function) {
    const std::unique_ptr<void, Close> loaded(dlopen(library, RTLD_LAZY | RTLD_NOLOAD));
    if (!loaded) return nullptr;
    void* const address = dlsym(loaded.get(), function);
    return address == nullptr ? nullptr : reinterpret_cast<void* (*)()>(address)();
}

}  // namespace

GlContext current_gl_context() {
    if (void* const context = ask("libEGL.so.1", "eglGetCurrentContext"))
        return {GlBinding::egl, context, ask("libEGL.so.1", "eglGetCurrentDisplay")};
    for (const char* const library : {"libGLX.so.0", "libGL.so.1"})
        if (void* const context = ask(library, "glXGetCurrentContext"))
            return {GlBinding::glx, context, ask(library, "glXGetCurrentDisplay")};
    return {};
}

bool has_name(std::string_view names, std::string_view name) {
    while (!names.empty()) {
        const std::size_t end = names.find(' ');
        if (names.substr(0, end) == name) return true;
        if (end == std::string_view::npos) break;
        names.remove_prefix(end + 1);
    }
    return false;
}

SharingDecision decide_sharing(const SharingFacts& facts) {
    if (!has_name(facts.device_extensions, "cl_khr_gl_sharing"))
        return {false, "the OpenCL device has no cl_khr_gl_sharing"};
    if (!has_name(facts.device_extensions, "cl_khr_gl_event"))
        return {false, "the OpenCL device has no cl_khr_gl_event: each hand-over would wait for both"};
    if (facts.binding == GlBinding::none) return {false, "the GL context is neither EGL's nor GLX's"};
    if (!facts.same_device) return {false, "GL draws on another device than OpenCL's"};
    return {true, {}};
}

}  // namespace seaglare::glare
