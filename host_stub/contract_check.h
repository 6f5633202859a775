// A strict host: what the plug-in promised is compared before and after each call. GL state, the target after an error
// or an empty frame, signal handlers, locale and the floating-point environment.
#pragma once

#include <csignal>
#include <string>
#include <vector>

#include "host_stub/gl_objects.h"

namespace seaglare::host {

// Every GL 3.3 state that a renderer may be tempted to touch, as numbers with names.
class GlState {
  public:
    static GlState capture();
    // "GL_BLEND_SRC_RGB: 1 became 770", one a line; empty when equal.
    static std::vector<std::string> differences(const GlState& before, const GlState& after);

  private:
    struct Entry {
        std::string name;
        double value;
    };
    std::vector<Entry> entries_;
};

// Sets odd but valid values in the slots a careless renderer would leave as it likes them, and undoes it when it dies.
// The picture must not depend on any of them.
class GlPoison {
  public:
    GlPoison();
    ~GlPoison();
    GlPoison(const GlPoison&) = delete;
    GlPoison& operator=(const GlPoison&) = delete;

  private:
    GlName texture_, buffer_, vertices_, framebuffer_, sampler_;
};

// State of the process that a library must leave alone.
class ProcessState {
  public:
    static ProcessState capture();
    static std::vector<std::string> differences(const ProcessState& before, const ProcessState& after);

  private:
    std::vector<std::pair<int, struct sigaction>> handlers_;
    std::string locale_;
    int rounding_ = 0, traps_ = 0;
    unsigned control_ = 0;
};

}  // namespace seaglare::host
