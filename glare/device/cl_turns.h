// Frames first, where OpenCL runs on the processor. PoCL has one pool of threads for all queues of a process; it runs kernels
// in the order in which they become ready, and knows no priorities. A frame whose lights are added up while the next pattern is
// being made would wait behind a kernel of the pattern for each of its own, and share the cores with them in between.
//
// So who works ahead of frames has no more than most_ahead launches under way, and before each of them lets those frames
// pass that are having their lights added up. A frame never waits for it, and takes no lock that it has. It waits for
// frames no longer than its patience lasts, so that a host that draws all the time has its patterns, too.
//
// On any other device nothing of this happens: queues of a GPU run beside each other, and waiting for launches one by one
// would leave it idle in between. Nor is anything computed in another way anywhere: only when.
#pragma once

#include <array>
#include <chrono>
#include <functional>

#include "glare/device/cl_shared.h"

namespace seaglare::glare {

// While one lives, a frame is having its lights added up. Any thread, any number of them; waits for nothing.
class ClFrameTurn {
  public:
    ClFrameTurn() noexcept;
    ~ClFrameTurn();
    ClFrameTurn(const ClFrameTurn&) = delete;
    ClFrameTurn& operator=(const ClFrameTurn&) = delete;
    // In this process, at this moment.
    static int under_way();
};

// While one lives, what its thread launches (ClKernel) gives way to frames. One at a time on a thread.
class ClBehindFrames {
  public:
    // Longer than a host that is in time takes to add up the lights of a frame: then all of the pattern is made between frames.
    static constexpr std::chrono::microseconds usual_patience{8000};
    // Who has waited for a time has its patience back after so many times that: three quarters of its time are its own.
    static constexpr int worked_for_waited = 3;
    // One that runs, and one that the pool finds ready when that is done.
    static constexpr std::size_t most_ahead = 2;

    // `hurried`: whether somebody waits for what is made. Asked again and again while frames pass: it must not block.
    explicit ClBehindFrames(std::function<bool()> hurried = {},
                            std::chrono::microseconds patience = usual_patience);
    ~ClBehindFrames();
    ClBehindFrames(const ClBehindFrames&) = delete;
    ClBehindFrames& operator=(const ClBehindFrames&) = delete;

    // That of this thread; null: there is none.
    static ClBehindFrames* of_this_thread();
    // Threads that are letting frames pass at this moment.
    static int waiting();

    // Lets frames pass, and launches under way end; then has `enqueue` put one more on the queue. It is given where to put the
    // event, or null where none is wanted.
    template <typename Enqueue>
    cl_int launch(cl_command_queue queue, const Enqueue& enqueue) {
        if (!is_of_cpu(queue)) return enqueue(nullptr);
        before_launch();
        cl_event event = nullptr;
        const cl_int code = enqueue(&event);
        if (code == CL_SUCCESS) note_under_way(event);
        return code;
    }

  private:
    using Clock = std::chrono::steady_clock;
    bool is_of_cpu(cl_command_queue queue);
    void before_launch();
    void let_frames_pass();
    void note_under_way(cl_event event);

    std::function<bool()> hurried_;
    Clock::duration patience_;
    Clock::duration waited_{};          // for frames, of its patience; what came back is taken off
    Clock::time_point last_;            // until when that is counted
    bool impatient_ = false;            // it has none left: until it has it all back
    cl_command_queue queue_ = nullptr;  // that was asked about last
    bool of_cpu_ = false;
    std::array<ClOwned<cl_event>, most_ahead> under_way_;
    std::size_t next_ = 0;  // of which: the oldest
};

}  // namespace seaglare::glare
