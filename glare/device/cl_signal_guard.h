// Keeps the process's signal handlers as the host has set them, whatever a driver does.
#pragma once

#include <csignal>
#include <vector>

namespace seaglare::glare {

// While it lives, a driver may install handlers; afterwards every signal has the disposition it had before. PoCL
// replaces fifteen of them inside clGetDeviceIDs. Threads that a driver starts meanwhile are born with asynchronous
// signals blocked, so that the host's handlers never run on them.
class SignalGuard {
  public:
    SignalGuard();
    ~SignalGuard();
    SignalGuard(const SignalGuard&) = delete;
    SignalGuard& operator=(const SignalGuard&) = delete;

  private:
    struct Saved {
        int number;
        struct sigaction action;
    };
    std::vector<Saved> saved_;
    sigset_t mask_;
};

}  // namespace seaglare::glare
