#include "host_stub/headless.h"

#include <epoxy/egl.h>

#include <array>
#include <sstream>

#include "host_stub/gl_objects.h"

namespace seaglare::host {

HeadlessContext::HeadlessContext() {
    const char* list = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const std::string extensions = list ? list : "";
    const auto has = [&](const char* name) { return extensions.find(name) != std::string::npos; };

    const bool platforms = has("EGL_EXT_platform_base");
    if (platforms && has("EGL_MESA_platform_surfaceless") &&
        try_display(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr), "surfaceless"))
        return;
    if (platforms && has("EGL_EXT_platform_device") && has("EGL_EXT_device_enumeration")) {
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        eglQueryDevicesEXT(devices.size(), devices.data(), &count);
        for (EGLint i = 0; i < count; ++i)
            if (try_display(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr),
                            "device " + std::to_string(i)))
                return;
    }
    if (try_display(eglGetDisplay(EGL_DEFAULT_DISPLAY), "default display")) return;
    throw GlFailure("no GL 3.3 core context without a display; tried" +
                    (tried_.empty() ? " nothing" : tried_));
}

bool HeadlessContext::try_display(void* display, const std::string& platform) {
    const auto failed = [&](const char* at) {
        std::ostringstream text;
        text << "; " << platform << ": " << at << " failed (EGL error 0x" << std::hex << eglGetError() << ")";
        tried_ += text.str();
        if (display) eglTerminate(display);
        return false;
    };
    if (!display) return failed("getting the display");
    if (!eglInitialize(display, nullptr, nullptr)) return failed("eglInitialize");
    if (!eglBindAPI(EGL_OPENGL_API)) return failed("eglBindAPI(OpenGL)");
    const EGLint config_attributes[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                        EGL_OPENGL_BIT, EGL_NONE};
    const EGLint any_surface[] = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                  EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    bool pbuffer = true;
    if (!eglChooseConfig(display, config_attributes, &config, 1, &count) || count == 0) {
        pbuffer = false;
        if (!eglChooseConfig(display, any_surface, &config, 1, &count) || count == 0)
            return failed("eglChooseConfig");
    }
    const EGLint context_attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                         3,
                                         EGL_CONTEXT_MINOR_VERSION,
                                         3,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                         EGL_NONE};
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, context_attributes);
    if (!context) return failed("eglCreateContext(3.3 core)");
    EGLSurface surface = EGL_NO_SURFACE;
    if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        const EGLint size[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
        if (pbuffer) surface = eglCreatePbufferSurface(display, config, size);
        if (!surface || !eglMakeCurrent(display, surface, surface, context)) {
            eglDestroyContext(display, context);
            return failed("eglMakeCurrent");
        }
    }
    display_ = display;
    context_ = context;
    surface_ = surface;
    platform_ = platform;
    return true;
}

HeadlessContext::~HeadlessContext() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (surface_) eglDestroySurface(display_, surface_);
    eglDestroyContext(display_, context_);
    eglTerminate(display_);
}

void* HeadlessContext::get_proc(void*, const char* name) {
    return reinterpret_cast<void*>(eglGetProcAddress(name));
}

}  // namespace seaglare::host
