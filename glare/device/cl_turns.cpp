#include "glare/device/cl_turns.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <utility>

#include "glare/device/cl_device.h"

namespace seaglare::glare {

namespace {

// Of the process, as PoCL's pool is: contexts and views that know nothing of each other share its threads.
std::atomic<int> frames_under_way{0};
std::atomic<int> threads_waiting{0};
// A frame that ends says so without the mutex: who waits looks again after a millisecond at most.
std::mutex sleeping;
std::condition_variable frame_ended;
constexpr std::chrono::milliseconds longest_nap{1};

thread_local ClBehindFrames* behind_frames = nullptr;

}  // namespace

ClFrameTurn::ClFrameTurn() noexcept {
    frames_under_way.fetch_add(1, std::memory_order_relaxed);
}

int ClFrameTurn::under_way() {
    return frames_under_way.load(std::memory_order_relaxed);
}

ClFrameTurn::~ClFrameTurn() {
    if (frames_under_way.fetch_sub(1, std::memory_order_relaxed) == 1 &&
        threads_waiting.load(std::memory_order_relaxed) > 0)
        frame_ended.notify_all();
}

ClBehindFrames::ClBehindFrames(std::function<bool()> hurried, std::chrono::microseconds patience)
    : hurried_(std::move(hurried)), patience_(patience), last_(Clock::now()) {
    behind_frames = this;
}

ClBehindFrames::~ClBehindFrames() {
    behind_frames = nullptr;
}

ClBehindFrames* ClBehindFrames::of_this_thread() {
    return behind_frames;
}

int ClBehindFrames::waiting() {
    return threads_waiting.load(std::memory_order_relaxed);
}

bool ClBehindFrames::is_of_cpu(cl_command_queue queue) {
    if (queue == queue_) return of_cpu_;
    cl_device_id device = nullptr;
    cl_device_type type = 0;
    // A handle is what is asked for.
    check_cl(
        clGetCommandQueueInfo(queue, CL_QUEUE_DEVICE, sizeof device,  // NOLINT(bugprone-sizeof-expression)
                              &device, nullptr),
        "clGetCommandQueueInfo");
    check_cl(clGetDeviceInfo(device, CL_DEVICE_TYPE, sizeof type, &type, nullptr), "clGetDeviceInfo");
    of_cpu_ = (type & CL_DEVICE_TYPE_CPU) != 0;
    queue_ = queue;
    return of_cpu_;
}

void ClBehindFrames::before_launch() {
    if (ClOwned<cl_event>& oldest = under_way_.at(next_)) {
        cl_event event = oldest.get();
        check_cl(clWaitForEvents(1, &event), "clWaitForEvents(launch)");
        oldest.reset();
    }
    let_frames_pass();
}

void ClBehindFrames::note_under_way(cl_event event) {
    under_way_.at(next_).reset(event);
    next_ = (next_ + 1) % most_ahead;
}

void ClBehindFrames::let_frames_pass() {
    const auto begin = Clock::now();
    waited_ = std::max(waited_ - (begin - last_) / worked_for_waited, Clock::duration::zero());
    last_ = begin;
    if (impatient_ && waited_ > Clock::duration::zero()) return;
    impatient_ = false;
    if (frames_under_way.load(std::memory_order_relaxed) == 0) return;
    threads_waiting.fetch_add(1, std::memory_order_relaxed);
    {
        std::unique_lock lock(sleeping);
        while (frames_under_way.load(std::memory_order_relaxed) > 0 && !(hurried_ && hurried_())) {
            if (waited_ >= patience_) {
                impatient_ = true;
                break;
            }
            frame_ended.wait_for(lock, std::min<Clock::duration>(longest_nap, patience_ - waited_));
            const auto now = Clock::now();
            waited_ += now - last_;
            last_ = now;
        }
    }
    threads_waiting.fetch_sub(1, std::memory_order_relaxed);
}

}  // namespace seaglare::glare
