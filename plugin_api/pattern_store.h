// The glare patterns of a context: one eye, shared by every view. A thread of its own makes the pattern of the next instant
// while the frame is drawn; who draws takes what is finished and never waits, unless it asks for determinism.
//
// What is shown when the pattern of an instant is not there yet:
//   the maker is slower than the frames   the newest that is finished: motion comes late, nothing else changes
//   the eye jumps (adaptation, squint),   the pattern before the jump, until the first after it is made; then both, mixed,
//   in a hitch or not                     for pattern_blend_s
//   a lamp comes into view                the pattern of the lamp nearest to it, then as after a jump
//   more lamps than patterns              lowest index first; who gains or loses a pattern of its own goes over as after a
//                                         jump, and for that time has one, whatever the limit. Who waits sees the change
//   a new pitch (zoom, window, channel)   the pattern whose pitch is nearest: angles and energy are right, nodes are not ours
//   the first frame of all                the one that attaching made for the configuration's own adaptation
// In each of them every light keeps its energy: patterns of one eye add up to what the eye transmits.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "glare/psf/motion_keys.h"
#include "plugin_api/frame_mutex.h"
#include "plugin_api/pattern_channel.h"
#include "plugin_api/pattern_maker.h"

namespace seaglare::plugin {

// What a frame asks for. The moment's request.lamp_list is taken from its `lamps`.
struct PatternDemand {
    glare::EyeMoment moment;
    double interval_s = 1.0 / 60;  // to the next frame
    bool wait = false;  // the pattern of this very moment: a pure function of moment, eye, settings and seed
    double step_s = 0;  // the instants that patterns are made for are whole numbers of these; 0: any
    const void* viewer = nullptr;  // who asks: others that ask at the same time get the same pattern
    glare::PatternUse use = {};    // what the viewer does with it: that is prepared with the next
};

// What was prepared with a pattern. Stays as it is while this lives, beyond the pattern's lease and the store.
class PreparedLease {
  public:
    PreparedLease() = default;
    explicit PreparedLease(std::shared_ptr<const glare::PreparedPattern> prepared);
    ~PreparedLease() { reset(); }
    PreparedLease(PreparedLease&& other) noexcept = default;
    PreparedLease& operator=(PreparedLease&& other) noexcept;
    PreparedLease(const PreparedLease&) = delete;
    PreparedLease& operator=(const PreparedLease&) = delete;
    void reset();
    const glare::PreparedPattern* get() const { return prepared_.get(); }

  private:
    std::shared_ptr<const glare::PreparedPattern> prepared_;
};

// A pattern that stays as it is while the lease lives. The store must outlive it.
class PatternLease {
  public:
    explicit PatternLease(PatternSlot& slot);
    ~PatternLease();
    PatternLease(PatternLease&& other) noexcept;
    PatternLease(const PatternLease&) = delete;
    PatternLease& operator=(const PatternLease&) = delete;
    PatternLease& operator=(PatternLease&&) = delete;

    const glare::Pattern& pattern() const { return slot_->pattern; }
    PreparedLease prepared() const { return PreparedLease(slot_->prepared); }
    bool reused() const { return reused_; }  // a lease before this had it: nothing was made for this one
    double behind_s() const {
        return behind_s_;
    }  // how far its instant lies before the frame's; < 0: after it

  private:
    friend class PatternStore;
    void note(bool reused, double frame_time_s);
    PatternSlot* slot_;
    bool reused_ = false;
    double behind_s_ = 0;
};

// What does not change from frame to frame.
struct PatternFacts {
    std::string device_name;
    std::string reason;   // why there is no OpenCL, or why the pattern stands still; empty: neither
    bool on_cpu = false;  // there is no OpenCL
};

class PatternStore {
  public:
    // Compiles kernels where there is OpenCL. Never fails for want of a device.
    PatternStore(const glare::EyeModel& eye, const glare::PatternSettings& settings, std::uint64_t seed,
                 bool use_opencl);
    // Lets what is being made come to its end, and joins the thread. No lease is left.
    ~PatternStore();
    PatternStore(const PatternStore&) = delete;
    PatternStore& operator=(const PatternStore&) = delete;

    // Any thread. Waits for nothing but another thread's look into the store, unless the demand or the settings say so, or
    // nothing was ever made. Throws as PatternMaker::make when it waits, or has nothing to show.
    PatternLease take(const PatternDemand& demand);

    // Any thread; these wait for the maker. Samples the spectra of a list now instead of with the first pattern that has
    // them.
    void prepare(const glare::LampList& lamps);
    // Pays once for what the first patterns of this pitch would, makes one, and starts the thread.
    void warm_up(const glare::EyeMoment& moment);
    void warm_up(double pitch);
    // Makes what another store shows now, for who is about to change over from it.
    void warm_up_like(const PatternStore& other, const std::shared_ptr<const glare::LampList>& lamps);

    // Any thread, and waits for the maker. Nothing is prepared any more in that OpenCL context, nor kept: its last user goes.
    void forget(const glare::ClShared& context);

    // Every lamp is drawn as the white one.
    bool filters() const { return settings_.spectra == glare::SpectraMode::filter; }
    const glare::PatternMotion& motion() const { return settings_.motion; }
    std::uint32_t layers_configured() const {
        return static_cast<std::uint32_t>(settings_.layer_radii_px.size());
    }
    std::shared_ptr<const PatternFacts> facts() const;
    bool degraded() const { return !facts()->reason.empty(); }
    glare::DeviceMemory device_memory() const;
    // Host memory of patterns: what views draw with, what is prepared for them, the pages of flip books.
    double host_memory_bytes() const;
    // Of all patterns so far, whoever they were made for.
    std::uint64_t patterns_made() const { return made_.load(std::memory_order_relaxed); }
    std::uint64_t kernel_launches() const { return launches_.load(std::memory_order_relaxed); }

  private:
    PatternChannel& channel_of(double pitch);                                   // with mutex_
    PatternSlot* nearest(double pitch) const;                                   // with mutex_
    glare::PatternRequest as_made(const glare::PatternRequest& request) const;  // with mutex_
    float layer_for(float largest_disc_nodes) const;
    bool is_idle(const PatternChannel& channel) const;  // with mutex_
    // Whether a pitch that nobody asks for any more has something prepared; takes it off the channels, to be released
    // without mutex_. Both with mutex_; the second by the maker.
    bool holds_idle() const;
    std::vector<std::shared_ptr<glare::PreparedPattern>> take_idle();
    PatternLease take_exactly(const glare::EyeMoment& moment, const glare::PatternUse& use);
    // With maker_mutex_, without mutex_.
    void make(PatternChannel& channel, PatternSlot& slot, const PatternChannel::Wish& wish, bool blended);
    void note_facts();  // with maker_mutex_
    void start();
    void run() noexcept;
    bool grant_a_wish();
    bool release_idle() noexcept;
    void complain(const std::string& what) noexcept;

    const glare::EyeModel eye_;
    const glare::PatternSettings settings_;
    const std::uint64_t seed_;

    FrameMutex maker_mutex_;  // of the maker; taken before mutex_, and never by who only looks
    PatternMaker maker_;
    glare::PatternPreparer preparer_;  // the maker's, too

    mutable std::mutex mutex_;  // of what follows up to the blank line; held for moments
    std::condition_variable wake_;
    std::vector<std::unique_ptr<PatternChannel>> channels_;
    std::uint64_t clock_ = 0;
    std::uint64_t orders_ = 0;
    std::shared_ptr<const PatternFacts> facts_;
    bool stop_ = false;
    bool pages_left_ = false;  // of a flip book
    std::size_t kept_bytes_ = 0;
    glare::DeviceMemory device_memory_;  // of the maker
    double lead_s_ = 0;                  // how long the last pattern took to make

    std::atomic<double> device_bytes_{0};
    std::atomic<std::uint64_t> made_{0};
    std::atomic<std::uint64_t> launches_{0};
    std::once_flag started_;
    std::atomic<bool> runs_{false};
    std::atomic<bool> ends_{false};  // the thread shall: it hurries
    std::thread thread_;
};

}  // namespace seaglare::plugin
