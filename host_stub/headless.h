// A GL 3.3 core context without a display.
#pragma once

#include <memory>
#include <string>

namespace seaglare::host {

class HeadlessContext {
  public:
    // Tries Mesa's surfaceless platform, then each EGL device, then the default display; makes the context
    // current without a surface, or with a 1x1 pbuffer where that is not allowed. Throws GlFailure that lists
    // what was tried.
    HeadlessContext();
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

    // "surfaceless", "device 0", "default display".
    const std::string& platform() const { return platform_; }
    // For seaglare_view_info.get_proc; user is not used.
    static void* get_proc(void* user, const char* name);

  private:
    bool try_display(void* display, const std::string& platform);
    void* display_ = nullptr;
    void* context_ = nullptr;
    void* surface_ = nullptr;
    std::string platform_;
    std::string tried_;
};

}  // namespace seaglare::host
