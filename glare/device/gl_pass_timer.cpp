#include "glare/device/gl_pass_timer.h"

#include <algorithm>

namespace seaglare::glare {

namespace {

using Clock = std::chrono::steady_clock;

// A frame of 4320 rows in bands stays below; a longer one goes untimed on the GPU from there on.
constexpr std::size_t most_stamps = 160;

}  // namespace

const char* name_of(Pass pass) {
    switch (pass) {
        case Pass::upload:
            return "Seaglare: upload";
        case Pass::occlusion:
            return "Seaglare: occlusion";
        case Pass::accumulate:
            return "Seaglare: accumulate";
        case Pass::composite:
            break;
    }
    return "Seaglare: composite";
}

PassTimer::PassTimer(const Gl& gl, bool enabled) : gl_(gl), enabled_(enabled) {
    if (!enabled || gl.QueryCounter == nullptr || gl.GetQueryObjectui64v == nullptr) return;
    GLint bits = 0;
    gl.GetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
    has_clock_ = bits > 0;
    if (bits > 0 && bits < 64) clock_mask_ = (std::uint64_t{1} << bits) - 1;
}

PassTimer::~PassTimer() {
    for (Slot& slot : slots_) {
        if (!slot.queries.empty())
            gl_.DeleteQueries(static_cast<GLsizei>(slot.queries.size()), slot.queries.data());
    }
}

void PassTimer::forget() {
    for (Slot& slot : slots_)
        slot.queries.clear();
    has_clock_ = false;
    enabled_ = false;
}

void PassTimer::collect() {
    for (Slot& slot : slots_) {
        if (slot.pending && read(slot)) slot.pending = false;
    }
    gpu_.frames_ago = known_frame_ == 0 ? 0 : static_cast<std::uint32_t>(frame_ - known_frame_);
}

// False while a timestamp is missing.
bool PassTimer::read(const Slot& slot) {
    std::array<GLuint64, most_stamps> times{};
    for (std::size_t i = slot.stamps; i-- > 0;) {
        GLuint64 available = GL_FALSE;
        gl_.GetQueryObjectui64v(slot.queries[i], GL_QUERY_RESULT_AVAILABLE, &available);
        if (available == GL_FALSE) return false;
    }
    if (slot.frame < known_frame_) return true;
    for (std::size_t i = 0; i < slot.stamps; ++i)
        gl_.GetQueryObjectui64v(slot.queries[i], GL_QUERY_RESULT, &times[i]);
    // The counter may wrap; a driver that works in tiles may put neighbouring stamps in the wrong order.
    const auto between_ms = [&](std::size_t from, std::size_t to) {
        const std::uint64_t ns = (times[to] - times[from]) & clock_mask_;
        return ns <= clock_mask_ / 2 ? static_cast<double>(ns) * 1e-6 : 0.0;
    };
    gpu_.passes = {};
    for (std::size_t i = 0; i + 1 < slot.stamps; ++i)
        gpu_.passes.of(slot.passes[i]) += between_ms(i, i + 1);
    gpu_.whole_ms = between_ms(0, slot.stamps - 1);
    known_frame_ = slot.frame;
    return true;
}

PassTimer::Frame::Frame(PassTimer& timer, Pass first) : timer_(timer), pass_(first), since_(Clock::now()) {
    if (!timer.enabled_) return;
    ++timer.frame_;
    timer.current_ = nullptr;
    if (timer.has_clock_) {
        timer.collect();
        const auto unused = timer.rests_ > 0 ? timer.slots_.end()
                                             : std::find_if(timer.slots_.begin(), timer.slots_.end(),
                                                            [](const Slot& slot) { return !slot.pending; });
        timer.rests_ -= timer.rests_ > 0 ? 1 : 0;
        if (unused != timer.slots_.end()) {
            timer.current_ = &*unused;
            unused->passes.clear();
            unused->stamps = 0;
            unused->frame = timer.frame_;
        }
    }
    group_.emplace(timer.gl_, "Seaglare");
    open_group();
    stamp();
}

PassTimer::Frame::~Frame() {
    close_group();
    if (!finished_) timer_.current_ = nullptr;
}

void PassTimer::Frame::stamp() {
    Slot* const slot = timer_.current_;
    if (slot == nullptr || slot->stamps == most_stamps) return;
    if (slot->queries.size() == slot->stamps) {
        GLuint name = 0;
        timer_.gl_.GenQueries(1, &name);
        slot->queries.push_back(name);
    }
    timer_.gl_.QueryCounter(slot->queries[slot->stamps++], GL_TIMESTAMP);
    slot->passes.push_back(pass_);
}

void PassTimer::Frame::open_group() {
    if (!group_ || !group_->open()) return;
    timer_.gl_.PushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, name_of(pass_));
    group_open_ = true;
}

void PassTimer::Frame::close_group() {
    if (group_open_) timer_.gl_.PopDebugGroup();
    group_open_ = false;
}

void PassTimer::Frame::enter(Pass pass) {
    if (pass == pass_) return;
    const auto now = Clock::now();
    cpu_.of(pass_) += std::chrono::duration<double, std::milli>(now - since_).count();
    since_ = now;
    close_group();
    pass_ = pass;
    open_group();
    stamp();
}

const PassTimes& PassTimer::Frame::finish() {
    if (finished_) return cpu_;
    finished_ = true;
    cpu_.of(pass_) += std::chrono::duration<double, std::milli>(Clock::now() - since_).count();
    stamp();
    close_group();
    if (timer_.current_ != nullptr) {
        const std::size_t stamps = timer_.current_->stamps;
        timer_.current_->pending = stamps > 1;
        timer_.rests_ = stamps > enough_stamps ? (stamps - 1) / few_stamps : 0;
    }
    timer_.current_ = nullptr;
    return cpu_;
}

}  // namespace seaglare::glare
