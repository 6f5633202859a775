#include "glare/device/cl_signal_guard.h"

#include <pthread.h>

namespace seaglare::glare {

namespace {

bool same(const struct sigaction& a, const struct sigaction& b) {
    if (a.sa_flags != b.sa_flags) return false;
    // One member of a union: the bits of the handler, whichever of the two forms it has.
    if (a.sa_sigaction != b.sa_sigaction) return false;
    for (int number = 1; number <= SIGRTMAX; ++number)
        if (sigismember(&a.sa_mask, number) != sigismember(&b.sa_mask, number)) return false;
    return true;
}

}  // namespace

SignalGuard::SignalGuard() {
    sigset_t blocked;
    sigfillset(&blocked);
    // A fault must still reach its handler: blocked, it would end the process without a word.
    for (int fault : {SIGSEGV, SIGFPE, SIGILL, SIGBUS, SIGTRAP, SIGABRT, SIGSYS})
        sigdelset(&blocked, fault);
    pthread_sigmask(SIG_BLOCK, &blocked, &mask_);
    saved_.reserve(static_cast<std::size_t>(SIGRTMAX));
    for (int number = 1; number <= SIGRTMAX; ++number) {
        Saved saved{number, {}};
        // Fails for the two signals that the C library keeps for itself: nobody can change those.
        if (sigaction(number, nullptr, &saved.action) == 0) saved_.push_back(saved);
    }
}

SignalGuard::~SignalGuard() {
    for (const Saved& saved : saved_) {
        struct sigaction now = {};
        if (sigaction(saved.number, nullptr, &now) == 0 && !same(now, saved.action))
            sigaction(saved.number, &saved.action, nullptr);
    }
    pthread_sigmask(SIG_SETMASK, &mask_, nullptr);
}

}  // namespace seaglare::glare
