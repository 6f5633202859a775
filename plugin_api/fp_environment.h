// The floating-point environment at the border. Inside, arithmetic follows IEEE 754 with rounding to nearest, no traps
// and no flushing to zero, whatever the host has set; the host finds its own environment, flags included, on return
// and inside its callbacks.
#pragma once

#include <cfenv>

namespace seaglare::plugin {

class FpEnvironment {
  public:
    FpEnvironment() noexcept;
    ~FpEnvironment();
    FpEnvironment(const FpEnvironment&) = delete;
    FpEnvironment& operator=(const FpEnvironment&) = delete;

  private:
    friend class HostFpEnvironment;
    std::fenv_t host_{};
    const FpEnvironment* outer_ = nullptr;
};

// While it lives, the host's environment is back: put around every call of a host's function.
class HostFpEnvironment {
  public:
    HostFpEnvironment() noexcept;
    ~HostFpEnvironment();
    HostFpEnvironment(const HostFpEnvironment&) = delete;
    HostFpEnvironment& operator=(const HostFpEnvironment&) = delete;

  private:
    std::fenv_t ours_{};
};

}  // namespace seaglare::plugin
