#include "plugin_api/pattern_store.h"

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <exception>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "glare/device/cl_turns.h"
#include "plugin_api/fp_environment.h"

namespace seaglare::plugin {

namespace {

// Windows that are being resized ask for a new pitch in every frame, a bridge of five channels for five.
constexpr std::size_t most_channels = 8;
// A channel not asked for while the others were asked for so often makes room.
constexpr std::uint64_t idle_after = 128;
// A pattern is made for no later instant than this ahead, however slow the machine.
constexpr double longest_lead_s = 0.1;
// Of the largest disc in view: it comes nearer.
constexpr float disc_ahead = 1.1F;

double in_steps(double time_s, double step_s) {
    return step_s > 0 ? std::floor(time_s / step_s) * step_s : time_s;
}

glare::EyeMoment complete(const glare::EyeMoment& moment) {
    glare::EyeMoment whole = moment;
    if (whole.lamps) whole.request.lamp_list = whole.lamps.get();
    return whole;
}

}  // namespace

PatternLease::PatternLease(PatternSlot& slot) : slot_(&slot) {
    slot.pins.fetch_add(1, std::memory_order_relaxed);
}

PatternLease::~PatternLease() {
    // What was read is read before another thread may write it.
    if (slot_ != nullptr) slot_->pins.fetch_sub(1, std::memory_order_release);
}

PatternLease::PatternLease(PatternLease&& other) noexcept
    : slot_(std::exchange(other.slot_, nullptr)), reused_(other.reused_), behind_s_(other.behind_s_) {}

void PatternLease::note(bool reused, double frame_time_s) {
    reused_ = reused;
    behind_s_ = frame_time_s - slot_->request.time_s;
    slot_->shown = true;
}

PreparedLease::PreparedLease(std::shared_ptr<const glare::PreparedPattern> prepared)
    : prepared_(std::move(prepared)) {
    if (prepared_) prepared_->readers.fetch_add(1, std::memory_order_relaxed);
}

PreparedLease& PreparedLease::operator=(PreparedLease&& other) noexcept {
    if (this == &other) return *this;
    reset();
    prepared_ = std::move(other.prepared_);
    return *this;
}

void PreparedLease::reset() {
    // What was read is read before another thread may write it.
    if (prepared_) prepared_->readers.fetch_sub(1, std::memory_order_release);
    prepared_.reset();
}

PatternStore::PatternStore(const glare::EyeModel& eye, const glare::PatternSettings& settings,
                           std::uint64_t seed, bool use_opencl)
    : eye_(eye), settings_(settings), seed_(seed), maker_(eye, settings, seed, use_opencl) {
    note_facts();
}

PatternStore::~PatternStore() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    ends_.store(true, std::memory_order_relaxed);
    wake_.notify_all();
    if (thread_.joinable()) thread_.join();
}

std::shared_ptr<const PatternFacts> PatternStore::facts() const {
    const std::lock_guard lock(mutex_);
    return facts_;
}

glare::DeviceMemory PatternStore::device_memory() const {
    const std::lock_guard lock(mutex_);
    glare::DeviceMemory memory = device_memory_;
    for (const auto& channel : channels_)
        memory.accumulation += static_cast<double>(channel->device_bytes());
    return memory;
}

double PatternStore::host_memory_bytes() const {
    const std::lock_guard lock(mutex_);
    std::size_t total = kept_bytes_;
    for (const auto& channel : channels_)
        total += channel->host_bytes();
    return static_cast<double>(total);
}

// A request that the CPU serves, when it is the CPU that makes it.
glare::PatternRequest PatternStore::as_made(const glare::PatternRequest& request) const {
    return facts_->on_cpu ? PatternMaker::standing(request) : request;
}

// The layer that a disc needs, whatever its size below that layer's.
float PatternStore::layer_for(float largest_disc_nodes) const {
    if (!(largest_disc_nodes > 0)) return 0;
    for (const float radius : settings_.layer_radii_px)
        if (radius >= largest_disc_nodes) return radius;
    return settings_.layer_radii_px.empty() ? largest_disc_nodes : settings_.layer_radii_px.back();
}

bool PatternStore::is_idle(const PatternChannel& channel) const {
    return channel.used + idle_after < clock_;
}

bool PatternStore::holds_idle() const {
    return std::any_of(channels_.begin(), channels_.end(), [this](const auto& channel) {
        return is_idle(*channel) && channel->device_bytes() + channel->prepared_host_bytes() > 0;
    });
}

std::vector<std::shared_ptr<glare::PreparedPattern>> PatternStore::take_idle() {
    std::vector<std::shared_ptr<glare::PreparedPattern>> idle;
    for (const auto& channel : channels_)
        if (is_idle(*channel)) channel->let_go_of_prepared(idle);
    return idle;
}

PatternChannel& PatternStore::channel_of(double pitch) {
    ++clock_;
    const auto found = std::find_if(channels_.begin(), channels_.end(),
                                    [pitch](const auto& channel) { return channel->pitch() == pitch; });
    PatternChannel* channel = found != channels_.end() ? found->get() : nullptr;
    if (channel == nullptr) {
        for (const auto& other : channels_) {
            if (other->busy()) continue;
            const bool idle = is_idle(*other) || channels_.size() >= most_channels;
            if (idle && (channel == nullptr || other->used < channel->used)) channel = other.get();
        }
        if (channel != nullptr)
            channel->take_over(pitch);
        else
            channel = channels_.emplace_back(std::make_unique<PatternChannel>(pitch)).get();
    }
    channel->used = clock_;
    return *channel;
}

PatternSlot* PatternStore::nearest(double pitch) const {
    PatternSlot* best = nullptr;
    double least = 0;
    for (const auto& channel : channels_) {
        if (channel->newest() == nullptr) continue;
        const double ratio = std::abs(std::log(channel->pitch() / pitch));
        if (best != nullptr && !(ratio < least)) continue;
        best = channel->newest();
        least = ratio;
    }
    return best;
}

PatternLease PatternStore::take(const PatternDemand& demand) {
    glare::EyeMoment moment = complete(demand.moment);
    glare::PatternRequest& request = moment.request;
    const double time_s = request.time_s;
    const float largest = request.largest_disc_nodes;
    request.largest_disc_nodes = layer_for(largest);
    const bool waits = demand.wait || settings_.motion.wait || !runs_.load(std::memory_order_acquire);
    if (!waits && request.pitch > 0 && std::isfinite(request.pitch)) {
        const double interval_s = demand.interval_s > 0 ? demand.interval_s : 1.0 / 60;
        const std::lock_guard lock(mutex_);
        // One that is made for the frames of another pitch is shown in the place of none.
        PatternChannel& channel = channel_of(request.pitch);
        channel.note_use(demand.use);
        PatternSlot* slot = channel.choose(time_s, demand.viewer);
        if (slot == nullptr) slot = nearest(request.pitch);
        if (slot != nullptr) {
            PatternLease lease(*slot);
            lease.note(slot->shown, time_s);
            request.lamps = channel.lingering_lamps(request.lamps, time_s);
            request.largest_disc_nodes = layer_for(disc_ahead * largest);
            const double lead_s = std::max(interval_s, std::min(lead_s_, longest_lead_s));
            moment.request = glare::request_at(eye_, seed_, moment, in_steps(time_s + lead_s, demand.step_s));
            const bool asked = channel.ask(moment, as_made(moment.request), interval_s, ++orders_);
            if (asked || holds_idle()) wake_.notify_one();
            return lease;
        }
    }
    if (demand.step_s > 0) request = glare::request_at(eye_, seed_, moment, in_steps(time_s, demand.step_s));
    return take_exactly(moment, demand.use);
}

PatternLease PatternStore::take_exactly(const glare::EyeMoment& moment, const glare::PatternUse& use) {
    const glare::PatternRequest& request = moment.request;
    if (!(request.pitch > 0) || !std::isfinite(request.pitch))
        throw std::invalid_argument("glare pattern: the pitch must be positive");
    const auto there = [&](PatternChannel& channel) -> std::optional<PatternLease> {
        PatternSlot* const slot = channel.serving(as_made(request));
        if (slot == nullptr) return std::nullopt;
        std::optional<PatternLease> lease(std::in_place, *slot);
        lease->note(slot->shown, request.time_s);
        return lease;
    };
    {
        const std::lock_guard lock(mutex_);
        PatternChannel& channel = channel_of(request.pitch);
        channel.note_use(use);
        if (auto lease = there(channel)) return std::move(*lease);
    }
    const std::lock_guard making(maker_mutex_);
    std::unique_lock lock(mutex_);
    PatternChannel& channel = channel_of(request.pitch);
    // Another view may have made it meanwhile.
    if (auto lease = there(channel)) return std::move(*lease);
    const std::uint64_t before = channel.newest() != nullptr ? channel.newest()->pattern.generation : 0;
    PatternSlot& slot = channel.claim();
    PatternLease lease(slot);
    const PatternChannel::Wish wish{moment, 0, 0, channel.uses()};
    lock.unlock();
    make(channel, slot, wish, false);
    lock.lock();
    channel.show(slot, request.time_s);
    lease.note(slot.pattern.generation == before, request.time_s);
    return lease;
}

void PatternStore::make(PatternChannel& channel, PatternSlot& slot, const PatternChannel::Wish& wish,
                        bool blended) {
    try {
        channel.make(maker_, preparer_, wish, slot, blended);
    } catch (...) {
        {
            const std::lock_guard lock(mutex_);
            channel.give_up();
        }
        note_facts();
        throw;
    }
    launches_.fetch_add(static_cast<std::uint64_t>(slot.pattern.kernel_launches), std::memory_order_relaxed);
    made_.fetch_add(1, std::memory_order_relaxed);
    note_facts();
    std::vector<std::shared_ptr<glare::PreparedPattern>> idle;  // outlives the lock
    const std::lock_guard lock(mutex_);
    channel.publish(slot);
    kept_bytes_ = maker_.kept_bytes();
    if (holds_idle()) idle = take_idle();
}

void PatternStore::note_facts() {
    {
        const std::lock_guard lock(mutex_);
        device_memory_ = maker_.device_memory();
    }
    const std::shared_ptr<const PatternFacts> known = facts();
    if (known && known->reason == maker_.reason()) return;
    auto facts = std::make_shared<const PatternFacts>(
        PatternFacts{maker_.device_name(), maker_.reason(), maker_.degraded()});
    const std::lock_guard lock(mutex_);
    facts_ = std::move(facts);
}

void PatternStore::prepare(const glare::LampList& lamps) {
    const std::lock_guard making(maker_mutex_);
    maker_.prepare(lamps);
    note_facts();
}

void PatternStore::warm_up(double pitch) {
    glare::EyeMoment moment;
    moment.request.pitch = pitch;
    moment.request.pupil_mm = 6;
    warm_up(moment);
}

void PatternStore::warm_up(const glare::EyeMoment& moment) {
    {
        const std::lock_guard making(maker_mutex_);
        maker_.warm_up(moment.request);
        note_facts();
    }
    if (settings_.motion.wait) return;
    take_exactly(complete(moment), {});
    start();
}

void PatternStore::warm_up_like(const PatternStore& other,
                                const std::shared_ptr<const glare::LampList>& lamps) {
    std::vector<glare::PatternRequest> shown;
    {
        const std::lock_guard lock(other.mutex_);
        for (const auto& channel : other.channels_)
            if (channel->newest() != nullptr) shown.push_back(channel->newest()->request);
    }
    for (const glare::PatternRequest& request : shown) {
        glare::EyeMoment moment;
        moment.request = request;
        moment.lamps = lamps;
        warm_up(moment);
    }
}

void PatternStore::start() {
    std::call_once(started_, [this] {
        // Born with asynchronous signals blocked: the host's handlers never run on it. A fault must still reach its handler.
        sigset_t blocked;
        sigset_t before;
        sigfillset(&blocked);
        for (const int fault : {SIGSEGV, SIGFPE, SIGILL, SIGBUS, SIGTRAP, SIGABRT, SIGSYS})
            sigdelset(&blocked, fault);
        pthread_sigmask(SIG_BLOCK, &blocked, &before);
        try {
            thread_ = std::thread([this] { run(); });
            runs_.store(true, std::memory_order_release);
        } catch (const std::system_error&) {
            // No thread to be had: who draws makes the pattern, as with `wait`.
            runs_.store(false, std::memory_order_release);
        }
        pthread_sigmask(SIG_SETMASK, &before, nullptr);
    });
}

void PatternStore::run() noexcept {
    pthread_setname_np(pthread_self(), "seaglare-eye");
    // Woken by who draws, it must not take its core from it.
    const sched_param no_priority{};
    pthread_setschedparam(pthread_self(), SCHED_BATCH, &no_priority);
    const FpEnvironment ours;
    // But for who waits for the maker, or for its end.
    const glare::ClBehindFrames behind_frames(
        [this] { return ends_.load(std::memory_order_relaxed) || maker_mutex_.others_wait(); });
    std::unique_lock lock(mutex_);
    while (!stop_) {
        const bool wished = std::any_of(channels_.begin(), channels_.end(),
                                        [](const auto& channel) { return channel->wish_is_due(); });
        if (!wished && !pages_left_) {
            if (holds_idle()) {
                lock.unlock();
                const bool released = release_idle();
                lock.lock();
                if (released) continue;
            }
            wake_.wait(lock);
            continue;
        }
        lock.unlock();
        bool pages_left = true;
        try {
            maker_mutex_.let_others_pass();
            const std::lock_guard making(maker_mutex_);
            if (!grant_a_wish()) pages_left = maker_.turn_ahead();
        } catch (const std::exception& error) {
            complain(error.what());
            pages_left = false;
        }
        lock.lock();
        pages_left_ = pages_left && settings_.motion.mode == glare::MotionMode::flip_book;
    }
}

bool PatternStore::release_idle() noexcept {
    std::vector<std::shared_ptr<glare::PreparedPattern>> idle;  // outlives the locks
    try {
        const std::lock_guard making(maker_mutex_);
        const std::lock_guard lock(mutex_);
        idle = take_idle();
    } catch (const std::exception&) {
        return false;  // no memory for the list: it stays until the next try
    }
    return true;
}

void PatternStore::forget(const glare::ClShared& context) {
    std::vector<std::shared_ptr<glare::PreparedPattern>> let_go;  // outlives the locks
    const std::lock_guard making(maker_mutex_);
    const std::lock_guard lock(mutex_);
    preparer_.forget(context);
    for (const auto& channel : channels_) {
        channel->forget_use(context);
        channel->let_go_of_prepared(let_go);
    }
}

bool PatternStore::grant_a_wish() {
    PatternChannel* channel = nullptr;
    PatternChannel::Wish wish;
    PatternSlot* slot = nullptr;
    {
        const std::lock_guard lock(mutex_);
        for (const auto& other : channels_) {
            if (!other->wish_is_due()) continue;
            if (channel == nullptr || other->wish()->order < channel->wish()->order) channel = other.get();
        }
        if (channel == nullptr) return false;
        wish = channel->take_wish();
        slot = &channel->claim();
    }
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    make(*channel, *slot, wish, true);
    const double took_s = std::chrono::duration<double>(Clock::now() - begin).count();
    const std::lock_guard lock(mutex_);
    lead_s_ = took_s;
    return true;
}

// The pattern stands still; the next frame asks anew, and is told.
void PatternStore::complain(const std::string& what) noexcept {
    try {
        const std::shared_ptr<const PatternFacts> known = this->facts();
        auto facts = std::make_shared<const PatternFacts>(
            PatternFacts{known->device_name, "the glare pattern stands still: " + what, known->on_cpu});
        const std::lock_guard lock(mutex_);
        facts_ = std::move(facts);
    } catch (...) {
        return;  // no memory for the words: the next failure may find some
    }
}

}  // namespace seaglare::plugin
