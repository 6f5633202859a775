#include "tests/gl/headless_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <sstream>
#include <stdexcept>

namespace seaglare::test {

namespace {

[[noreturn]] void fail(const char* call) {
    std::ostringstream text;
    text << call << " failed, EGL error 0x" << std::hex << eglGetError();
    throw std::runtime_error(text.str());
}

EGLDisplay open_display() {
    // Asked for by name: with EGL_DEFAULT_DISPLAY Mesa looks for X11 and Wayland first.
    if (EGLDisplay surfaceless =
            eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        surfaceless != EGL_NO_DISPLAY && eglInitialize(surfaceless, nullptr, nullptr) == EGL_TRUE) {
        return surfaceless;
    }
    EGLDisplay any = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    if (any == EGL_NO_DISPLAY) fail("eglGetDisplay");
    if (eglInitialize(any, nullptr, nullptr) != EGL_TRUE) fail("eglInitialize");
    return any;
}

}  // namespace

struct HeadlessContext::Impl {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLSurface surface = EGL_NO_SURFACE;
    EGLContext context = EGL_NO_CONTEXT;

    // The display is shared by the whole process: it stays open, or a second context of the test would lose
    // it.
    ~Impl() {
        if (display == EGL_NO_DISPLAY) return;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
        if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
    }
};

HeadlessContext::HeadlessContext(const HeadlessOptions& options) : impl_(std::make_unique<Impl>()) {
    impl_->display = open_display();
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) fail("eglBindAPI(EGL_OPENGL_API)");
    const std::array<EGLint, 17> config_attributes = {EGL_SURFACE_TYPE,
                                                      EGL_PBUFFER_BIT,
                                                      EGL_RENDERABLE_TYPE,
                                                      EGL_OPENGL_BIT,
                                                      EGL_RED_SIZE,
                                                      8,
                                                      EGL_GREEN_SIZE,
                                                      8,
                                                      EGL_BLUE_SIZE,
                                                      8,
                                                      EGL_DEPTH_SIZE,
                                                      24,
                                                      EGL_STENCIL_SIZE,
                                                      8,
                                                      EGL_SAMPLES,
                                                      0,
                                                      EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    if (eglChooseConfig(impl_->display, config_attributes.data(), &config, 1, &found) != EGL_TRUE ||
        found == 0) {
        fail("eglChooseConfig (RGB8, depth 24, stencil 8, pbuffer)");
    }
    const std::array<EGLint, 5> surface_attributes = {EGL_WIDTH, options.width_px, EGL_HEIGHT,
                                                      options.height_px, EGL_NONE};
    impl_->surface = eglCreatePbufferSurface(impl_->display, config, surface_attributes.data());
    if (impl_->surface == EGL_NO_SURFACE) fail("eglCreatePbufferSurface");
    const std::array<EGLint, 7> context_attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                                      options.major,
                                                      EGL_CONTEXT_MINOR_VERSION,
                                                      options.minor,
                                                      EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                      options.profile == GlProfile::core
                                                          ? EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT
                                                          : EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT,
                                                      EGL_NONE};
    impl_->context = eglCreateContext(impl_->display, config, EGL_NO_CONTEXT, context_attributes.data());
    if (impl_->context == EGL_NO_CONTEXT) fail("eglCreateContext");
    make_current();
    gl_ = glare::load_gl(&HeadlessContext::get_proc, nullptr);
}

HeadlessContext::~HeadlessContext() = default;

void HeadlessContext::make_current() const {
    if (eglMakeCurrent(impl_->display, impl_->surface, impl_->surface, impl_->context) != EGL_TRUE) {
        fail("eglMakeCurrent");
    }
}

void HeadlessContext::release() const {
    eglMakeCurrent(impl_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

void* HeadlessContext::get_proc(void* /*user*/, const char* name) {
    return reinterpret_cast<void*>(eglGetProcAddress(name));
}

}  // namespace seaglare::test
