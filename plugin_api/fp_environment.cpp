#include "plugin_api/fp_environment.h"

namespace seaglare::plugin {

namespace {

// The innermost call in progress on this thread. Trivial, so that no destructor pins the library in a host's thread.
thread_local const FpEnvironment* current = nullptr;

}  // namespace

FpEnvironment::FpEnvironment() noexcept : outer_(current) {
    std::fegetenv(&host_);
    std::fesetenv(FE_DFL_ENV);  // in glibc this also ends flush-to-zero and denormals-are-zero
    current = this;
}

FpEnvironment::~FpEnvironment() {
    current = outer_;
    std::fesetenv(&host_);
}

HostFpEnvironment::HostFpEnvironment() noexcept {
    std::fegetenv(&ours_);
    if (current != nullptr) std::fesetenv(&current->host_);
}

HostFpEnvironment::~HostFpEnvironment() {
    std::fesetenv(&ours_);
}

}  // namespace seaglare::plugin
