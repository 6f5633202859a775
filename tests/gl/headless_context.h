// A GL context without a display, for tests: EGL on Mesa's surfaceless platform, software rendering where
// there is no GPU. It has a pbuffer, so framebuffer 0 exists, with depth and stencil.
#pragma once

#include <memory>

#include "glare/device/gl.h"

namespace seaglare::test {

enum class GlProfile { core, compatibility };

struct HeadlessOptions {
    GlProfile profile = GlProfile::core;
    int major = 3;
    int minor = 3;
    int width_px = 64;  // of framebuffer 0
    int height_px = 64;
};

class HeadlessContext {
  public:
    // Made current on the calling thread. Throws std::runtime_error saying which EGL call failed: a test
    // skips then.
    explicit HeadlessContext(const HeadlessOptions& options = {});
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

    void make_current() const;
    void release() const;  // no context is current on this thread afterwards
    const glare::Gl& gl() const { return gl_; }

    // What a host hands to the plug-in: eglGetProcAddress. `user` is not used.
    static void* get_proc(void* user, const char* name);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
    glare::Gl gl_;
};

}  // namespace seaglare::test
