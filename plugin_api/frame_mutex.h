// A mutex whose holder can tell that others wait for it. Long work is done in short pieces, each under the mutex; between
// two pieces it lets all who wait go first. With a plain mutex the thread that has just released it is the one that is
// running, and mostly takes it again: a frame could wait for the whole of the work.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

namespace seaglare::plugin {

class FrameMutex {
  public:
    void lock() {
        waiting_.fetch_add(1, std::memory_order_relaxed);
        mutex_.lock();
        waiting_.fetch_sub(1, std::memory_order_relaxed);
    }
    void unlock() { mutex_.unlock(); }

    // For who holds it: whether it should hurry.
    bool others_wait() const { return waiting_.load(std::memory_order_relaxed) > 0; }
    // Not while holding it. Returns once nobody waits, or after some 10 ms: who waits all the time does not starve others.
    void let_others_pass() const {
        constexpr int most_tries = 100;
        constexpr std::chrono::microseconds pause(50);
        for (int i = 0; i < most_tries && waiting_.load(std::memory_order_relaxed) > 0; ++i)
            std::this_thread::sleep_for(pause);
    }

  private:
    std::mutex mutex_;
    std::atomic<int> waiting_{0};
};

}  // namespace seaglare::plugin
