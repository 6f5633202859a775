#include "plugin_api/pattern_channel.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "glare/psf/pattern_mix.h"

namespace seaglare::plugin {

namespace {

std::uint64_t version_of(const glare::PatternRequest& request) {
    return request.lamp_list != nullptr ? request.lamp_list->version : 0;
}

// More than the eye does of itself from one pattern to the next: seen at once, the picture would jump. After a hitch, too,
// and when the clock is set: whoever looks sees the frame before it and the one after.
bool is_jump(const glare::PatternRequest& from, const glare::PatternRequest& to) {
    constexpr double pupil_share = 0.05;
    constexpr double squint = 0.05;
    constexpr double roll_rad = 0.1;
    return std::abs(to.pupil_mm - from.pupil_mm) > pupil_share * from.pupil_mm ||
           std::abs(to.lids.squint - from.lids.squint) > squint ||
           std::abs(to.vitreous_roll_rad - from.vitreous_roll_rad) > roll_rad ||
           (to.lamps & ~from.lamps) != 0;
}

// Whether a lamp fewer may give another its own pattern back: more were in view than had one.
bool frees_a_pattern(const glare::Pattern& shown, const glare::PatternRequest& from,
                     const glare::PatternRequest& to) {
    return from.lamps != to.lamps && static_cast<std::size_t>(std::popcount(from.lamps)) > shown.lamps.size();
}

double smooth(double t) {
    return t * t * (3 - 2 * t);
}

}  // namespace

void PatternChannel::take_over(double pitch) {
    pitch_ = pitch;
    newest_ = nullptr;
    shown_ = nullptr;
    viewer_count_ = 0;
    wish_.reset();
    lamps_seen_ = 0;
    blending_ = false;
    last_.reset();
    blend_ = false;
    for (const auto& slot : slots_) {
        slot->pattern.generation = 0;
        slot->exact = false;
    }
}

bool PatternChannel::busy() const {
    return claimed_ != nullptr || std::any_of(slots_.begin(), slots_.end(), [](const auto& slot) {
               return slot->pins.load(std::memory_order_acquire) != 0;
           });
}

PatternSlot* PatternChannel::choose(double time_s, const void* viewer) {
    if (newest_ == nullptr) return nullptr;
    const auto end = viewers_.begin() + static_cast<std::ptrdiff_t>(viewer_count_);
    const bool same_time = shown_ != nullptr && shown_time_s_ == time_s;
    if (same_time && std::find(viewers_.begin(), end, viewer) == end && viewer_count_ < viewers_.size()) {
        viewers_[viewer_count_++] = viewer;
        return shown_;
    }
    viewers_[0] = viewer;
    viewer_count_ = 1;
    shown_time_s_ = time_s;
    const double later = newest_->request.time_s - time_s;
    const bool too_early =
        shown_ != nullptr && later > 0 && std::abs(shown_->request.time_s - time_s) < later;
    if (!too_early || same_time) shown_ = newest_;
    return shown_;
}

void PatternChannel::show(PatternSlot& slot, double time_s) {
    shown_ = &slot;
    shown_time_s_ = time_s;
    viewer_count_ = 0;
}

PatternSlot* PatternChannel::serving(const glare::PatternRequest& request) const {
    for (PatternSlot* slot : {newest_, shown_}) {
        if (slot != nullptr && slot->exact &&
            PatternMaker::serves(slot->request, slot->lamp_list, request, version_of(request)))
            return slot;
    }
    return nullptr;
}

std::uint32_t PatternChannel::lingering_lamps(std::uint32_t lamps, double time_s) {
    for (std::size_t lamp = 0; lamp < lamp_seen_s_.size(); ++lamp) {
        const std::uint32_t bit = 1U << lamp;
        if ((lamps & bit) != 0) {
            lamp_seen_s_[lamp] = time_s;
            lamps_seen_ |= bit;
        } else if (std::abs(time_s - lamp_seen_s_[lamp]) > lamp_linger_s) {
            lamps_seen_ &= ~bit;
        }
    }
    return lamps | lamps_seen_;
}

bool PatternChannel::ask(const glare::EyeMoment& moment, const glare::PatternRequest& as_made,
                         double interval_s, std::uint64_t order) {
    const bool there = newest_ != nullptr && PatternMaker::serves(newest_->request, newest_->lamp_list,
                                                                  as_made, version_of(as_made));
    if (there && !blending_) {
        wish_.reset();
        return false;
    }
    // It keeps its place in the row.
    if (wish_) order = wish_->order;
    wish_ = {moment, interval_s, order, {}};
    return true;
}

void PatternChannel::note_use(const glare::PatternUse& use) {
    ++asked_;
    if (use.draws) draws_at_ = asked_;
    if (use.grids) grids_at_ = asked_;
    if (!use.gather) return;
    const auto known = std::find_if(gathers_.begin(), gathers_.end(),
                                    [&](const Use& other) { return other.use.gather == use.gather; });
    const auto oldest = std::min_element(gathers_.begin(), gathers_.end(),
                                         [](const Use& a, const Use& b) { return a.at < b.at; });
    *(known != gathers_.end() ? known : oldest) = {use, asked_};
}

glare::PatternUses PatternChannel::uses() const {
    const auto lately = [this](std::uint64_t at) { return at != 0 && at + use_lingers > asked_; };
    glare::PatternUses uses;
    uses.draws = lately(draws_at_);
    uses.grids = lately(grids_at_);
    for (const Use& gather : gathers_)
        if (lately(gather.at)) uses.add({.gather = gather.use.gather});
    return uses;
}

void PatternChannel::forget_use(const glare::ClShared& context) {
    for (Use& gather : gathers_)
        if (gather.use.gather.get() == &context) gather = {};
}

bool PatternChannel::wish_is_due() const {
    if (!wish_) return false;
    if (newest_ == nullptr || newest_ == shown_) return true;
    // Where the host's time has gone back nobody will show what was made for later.
    constexpr double gone_back_s = 0.5;
    return newest_->request.time_s > wish_->moment.request.time_s + gone_back_s;
}

PatternChannel::Wish PatternChannel::take_wish() {
    Wish wish = std::move(*wish_);
    wish_.reset();
    wish.uses = uses();
    return wish;
}

PatternSlot& PatternChannel::claim() {
    const auto free = std::find_if(slots_.begin(), slots_.end(), [this](const auto& slot) {
        return slot.get() != newest_ && slot.get() != shown_ &&
               slot->pins.load(std::memory_order_acquire) == 0;
    });
    claimed_ =
        free != slots_.end() ? free->get() : slots_.emplace_back(std::make_unique<PatternSlot>()).get();
    claimed_->exact = false;
    claimed_->shown = false;
    renew_prepared(*claimed_);
    return *claimed_;
}

// Views read what is prepared for longer than the pattern: until their next frame, for who wants to see the last one's glare.
void PatternChannel::renew_prepared(PatternSlot& slot) {
    const auto is_free = [](const std::shared_ptr<glare::PreparedPattern>& prepared) {
        return prepared->readers.load(std::memory_order_acquire) == 0;
    };
    if (is_free(slot.prepared)) return;
    const auto free = std::find_if(read_on_.begin(), read_on_.end(), is_free);
    if (free != read_on_.end()) {
        std::swap(*free, slot.prepared);
    } else {
        read_on_.push_back(slot.prepared);
        slot.prepared = std::make_shared<glare::PreparedPattern>();
    }
}

void PatternChannel::publish(PatternSlot& slot) {
    newest_ = &slot;
    claimed_ = nullptr;
    blending_ = blend_;
    prepared_host_bytes_ = 0;
    device_bytes_ = 0;
    const auto count = [this](const glare::PreparedPattern& prepared) {
        prepared_host_bytes_ += prepared.host_bytes();
        device_bytes_ += prepared.device_bytes();
    };
    for (const auto& each : slots_)
        count(*each->prepared);
    for (const auto& each : read_on_)
        count(*each);
}

void PatternChannel::let_go_of_prepared(std::vector<std::shared_ptr<glare::PreparedPattern>>& to) {
    for (const auto& slot : slots_) {
        to.push_back(std::make_shared<glare::PreparedPattern>());
        std::swap(to.back(), slot->prepared);
    }
    to.insert(to.end(), read_on_.begin(), read_on_.end());
    read_on_.clear();
    prepared_host_bytes_ = 0;
    device_bytes_ = 0;
}

void PatternChannel::give_up() {
    claimed_ = nullptr;
}

void PatternChannel::begin_or_end_blend(const Wish& wish) {
    const glare::PatternRequest& request = wish.moment.request;
    const auto last_made = [this]() -> const glare::Pattern& { return blend_ ? target_ : newest_->pattern; };
    if (last_ && newest_ != nullptr &&
        (is_jump(*last_, request) || frees_a_pattern(last_made(), *last_, request))) {
        from_ = newest_->pattern;  // blended or not: what was last seen
        blended_s_ = 0;
        blend_ = true;
    }
    if (!blend_) return;
    // Time stands still while the host pauses, and leaps when a pattern took long to make.
    const double passed = last_ ? request.time_s - last_->time_s : 0;
    blended_s_ += passed > 0 ? std::min(passed, 2 * wish.interval_s) : wish.interval_s;
    if (blended_s_ >= pattern_blend_s) blend_ = false;
}

void PatternChannel::make(PatternMaker& maker, glare::PatternPreparer& preparer, const Wish& wish,
                          PatternSlot& slot, bool blended) {
    const glare::EyeMoment& moment = wish.moment;
    if (blended)
        begin_or_end_blend(wish);
    else
        blend_ = false;
    last_ = moment.request;
    last_->lamp_list = nullptr;  // it may end before this does
    const bool mixes = blended && blend_;
    if (mixes) {
        maker.make(moment, target_);
        if (glare::can_mix(from_, target_)) {
            glare::mix_patterns(from_, target_, smooth(blended_s_ / pattern_blend_s), slot.pattern, 1,
                                moment.request.lamps);
        } else {
            slot.pattern = target_;
            blend_ = false;
        }
    } else {
        maker.make(moment, slot.pattern);
    }
    slot.request = maker.degraded() ? PatternMaker::standing(moment.request) : moment.request;
    slot.lamp_list = version_of(moment.request);
    slot.request.lamp_list = nullptr;
    slot.exact = !mixes;
    preparer.prepare(slot.pattern, wish.uses, *slot.prepared);
}

std::size_t PatternChannel::host_bytes() const {
    std::size_t total = prepared_host_bytes_;
    for (const auto& slot : slots_)
        total += slot->pattern.skirt.capacity() * sizeof(float);
    return total;
}

}  // namespace seaglare::plugin
