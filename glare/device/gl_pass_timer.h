// How long each pass of a frame takes, on the CPU and on the GPU, in production: timestamps are read when they are there, a
// frame or more late, and nothing ever waits for them. Each pass is a group in GL debuggers.
//
// GL_TIMESTAMP counters only: nothing begins or ends, so that queries the host has active go on undisturbed.
//
// A timestamp costs 26 us of llvmpipe's processor time. Frames of few parts are all timed on the GPU; of those that come and go
// between passes, band by band, one in so many that an average frame asks for few_stamps (tests/benchmark/README.md has what is
// left).
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "glare/device/gl.h"
#include "glare/device/gl_debug.h"

namespace seaglare::glare {

enum class Pass : std::uint8_t {
    upload,      // to the GPU: lights, pattern; checks of target and depth
    occlusion,   // how much of each light the host's picture leaves free
    accumulate,  // lights into the HDR sum
    composite,   // tone mapping into the host's target
};
inline constexpr std::size_t pass_count = 4;
const char* name_of(Pass pass);  // as a debugger shows it

struct PassTimes {
    std::array<double, pass_count> ms{};
    double of(Pass pass) const { return ms[static_cast<std::size_t>(pass)]; }
    double& of(Pass pass) { return ms[static_cast<std::size_t>(pass)]; }
};
// Of the latest frame whose timestamps have come in.
struct GpuTimes {
    PassTimes passes;
    double whole_ms = 0;           // from the frame's first timestamp to its last
    std::uint32_t frames_ago = 0;  // 0: the GPU has no clock, or no frame has come in yet
};

class PassTimer {
  public:
    // `enabled` false: neither queries nor groups. Asks GL whether it has a clock; makes no query yet.
    PassTimer(const Gl& gl, bool enabled);
    ~PassTimer();
    PassTimer(const PassTimer&) = delete;
    PassTimer& operator=(const PassTimer&) = delete;

    const GpuTimes& gpu() const { return gpu_; }
    // Frames begun while it is off are neither timed nor counted.
    void set_enabled(bool enabled) { enabled_ = enabled; }
    void forget();  // the context is gone

    // One frame, from its first pass to its end, also when an exception ends it: its time is then not counted.
    class Frame {
      public:
        Frame(PassTimer& timer, Pass first);
        ~Frame();
        Frame(const Frame&) = delete;
        Frame& operator=(const Frame&) = delete;
        // Ends the pass before it. A pass may come again: its parts are added up. The same again does nothing.
        void enter(Pass pass);
        // Ends the last pass. CPU time of each so far.
        const PassTimes& finish();

      private:
        void stamp();
        void open_group();
        void close_group();

        PassTimer& timer_;
        std::optional<OuterDebugGroup> group_;
        bool group_open_ = false;
        bool finished_ = false;
        Pass pass_;
        std::chrono::steady_clock::time_point since_;
        PassTimes cpu_;
    };

  private:
    // Timestamps that one frame has asked for; pass i runs from timestamp i to i + 1.
    struct Slot {
        std::vector<GLuint> queries;  // made once, used again
        std::vector<Pass> passes;
        std::size_t stamps = 0;
        std::uint64_t frame = 0;
        bool pending = false;
    };
    void collect();
    bool read(const Slot& slot);

    const Gl& gl_;
    bool enabled_;
    bool has_clock_ = false;
    std::uint64_t clock_mask_ = ~std::uint64_t{0};
    // On average of frames that ask for more than enough_stamps.
    static constexpr std::size_t few_stamps = 3;
    static constexpr std::size_t enough_stamps = 8;
    std::size_t rests_ = 0;      // so many frames are not timed now
    std::array<Slot, 4> slots_;  // a GPU further behind is not timed: nothing grows
    Slot* current_ = nullptr;
    std::uint64_t frame_ = 0;
    std::uint64_t known_frame_ = 0;
    GpuTimes gpu_;
};

}  // namespace seaglare::glare
