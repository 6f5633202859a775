#include "lightdb/light_store.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "lightdb/rhythm.h"
#include "lightdb/vector_math.h"

namespace seaglare::lightdb {

namespace {

constexpr LightId make_id(LightIndex slot, std::uint32_t generation) {
    return (LightId{generation} << 32) | (LightId{slot} + 1);
}

// Rounding it moves a lamp's edge by less than a micrometre.
float hot_radius_m(double radius_m) {
    constexpr double largest = std::numeric_limits<float>::max();
    if (std::isnan(radius_m)) return 0;
    return static_cast<float>(std::clamp(radius_m, -largest, largest));
}

}  // namespace

LightIndex LightStore::slot_of(LightId id) const {
    const std::uint64_t position = id & 0xFFFFFFFFU;
    if (position == 0 || position > arrays_.size()) return no_light;
    const auto slot = static_cast<LightIndex>(position - 1);
    return arrays_.is(slot, light_flag::live) && generation_[slot] == id >> 32 ? slot : no_light;
}

LightIndex LightStore::free_slot() {
    if (!free_.empty()) {
        const LightIndex slot = free_.back();
        free_.pop_back();
        return slot;
    }
    const std::size_t count = arrays_.size() + 1;
    if (count > LightIndex{no_light}) throw std::length_error("too many lights");
    // The arrays last: until then there is no such slot, whatever runs out of memory.
    if (generation_.size() < count) generation_.resize(count, 1);
    cold_.resize(count);
    arrays_.resize(count);
    return static_cast<LightIndex>(count - 1);
}

bool LightStore::may_shine(LightIndex slot) const {
    const Vec3& p = arrays_[slot].position_m;
    return arrays_.is(slot, light_flag::on) && arrays_[slot].visibility > 0 && arrays_[slot].peak_cd > 0 &&
           std::isfinite(p[0] + p[1] + p[2]);
}

// With a visibility that is a gain, too.
float LightStore::effective_peak_cd(LightIndex slot) const {
    const double scale =
        arrays_[slot].intensity_scale * std::max(1.0, static_cast<double>(arrays_[slot].visibility));
    return peak_of_kind_cd(kinds_[arrays_[slot].kind].peak_cd, scale);
}

// Everything of a light but its life and its place in the index.
void LightStore::set_data(LightIndex slot, Light light) {
    if (light.stable_key == 0) light.stable_key = stable_key_of(light);
    const Quaternion orientation = normalised(light.orientation);
    const bool turned = orientation != Quaternion{0, 0, 0, 1};
    if (turned) orientation_[slot] = orientation;
    cold_[slot] = {light.latitude_deg,   light.longitude_deg, light.height_m,
                   light.true_north_deg, light.radius_m,      texts_.add(light.name, light.source)};
    HotLight& hot = arrays_[slot];
    hot.stable_key = light.stable_key;
    hot.position_m = light.position_m;
    hot.radius_m = hot_radius_m(light.radius_m);
    hot.visibility = light.visibility;
    hot.body_id = light.body_id;
    arrays_.set(slot, light_flag::on, light.on);
    arrays_.set(slot, light_flag::turned, turned);
    arrays_.set(slot, light_flag::day_off, light.day_off);
    arrays_.set(slot, light_flag::geographic, light.geographic);
    const LightKinds::Member member = kinds_.intern(std::move(light));
    hot.kind = member.kind;
    hot.intensity_scale = member.scale;
    hot.peak_cd = effective_peak_cd(slot);
    arrays_.set(slot, light_flag::awake, may_shine(slot));
}

void LightStore::fill(LightIndex slot, Light light) {
    set_data(slot, std::move(light));
    awake_ += arrays_.is(slot, light_flag::awake) ? 1 : 0;
    index_.insert(arrays_, slot);
}

// What fill() did, undone.
void LightStore::empty(LightIndex slot) {
    index_.erase(arrays_, slot);
    if (arrays_.is(slot, light_flag::awake)) --awake_;
    if (arrays_.is(slot, light_flag::turned)) orientation_.erase(slot);
    kinds_.release(arrays_[slot].kind);
    texts_.forget(cold_[slot].text);
    cold_[slot] = {};
    arrays_[slot].flags = 0;
}

LightId LightStore::add(Light light) {
    const LightIndex slot = free_slot();
    fill(slot, std::move(light));
    arrays_.set(slot, light_flag::live, true);
    ++live_;
    const LightId id = make_id(slot, generation_[slot]);
    append_to_order(id);
    return id;
}

// In runs that are never so long that one more would move many.
void LightStore::append_to_order(LightId id) {
    constexpr std::size_t longest_run = 65536;
    if (order_.empty() || order_.back().size() >= longest_run) order_.emplace_back();
    order_.back().push_back(id);
    ++ordered_;
}

bool LightStore::take_in(LightBatch& batch, std::size_t most) {
    for (; most > 0 && batch.taken_ < batch.entry_.size(); --most) {
        const LightIndex slot = free_slot();
        const std::uint32_t which = batch.entry_[batch.taken_];
        index_.make_room(arrays_);
        set_data(slot, std::move(batch.lights_[which]));
        arrays_.set(slot, light_flag::live, true);
        batch.ids_[which] = make_id(slot, generation_[slot]);
        ++batch.taken_;
        const bool awake = arrays_.is(slot, light_flag::awake);
        batch.awake_ += awake ? 1 : 0;
        if (batch.block_ < batch.blocks_.size()) {
            batch.slots_.push_back(slot);
            LightBlock& block = batch.blocks_[batch.block_];
            if (batch.slots_.size() < block.order().size()) continue;
            block.renumber(batch.slots_);
            batch.slots_.clear();
            batch.numbers_.push_back(index_.take_block(arrays_, std::move(block)));
            ++batch.block_;
        } else if (awake) {
            batch.homeless_.push_back(slot);
        }
    }
    return batch.taken_ < batch.entry_.size();
}

void LightStore::show(LightBatch& batch) {
    order_.reserve(order_.size() + 2);
    for (; !batch.homeless_.empty(); batch.homeless_.pop_back())
        index_.insert(arrays_, batch.homeless_.back());
    // Nothing from here on needs memory.
    for (const std::size_t number : batch.numbers_)
        index_.show_block(number);
    live_ += batch.taken_;
    awake_ += batch.awake_;
    ordered_ += batch.ids_.size();
    order_.push_back(std::move(batch.ids_));
    order_.emplace_back();
    batch.taken_ = 0;
}

void LightStore::drop(LightBatch& batch) {
    live_ += batch.taken_;
    awake_ += batch.awake_;
    for (const LightId id : batch.ids_)
        remove(id);
    batch.taken_ = 0;
    batch.ids_.clear();
}

bool LightStore::replace(LightId id, Light light) {
    const LightIndex slot = slot_of(id);
    if (slot == no_light) return false;
    empty(slot);
    fill(slot, std::move(light));
    arrays_.set(slot, light_flag::live, true);
    if (texts_.wants_packing()) pack_texts();
    return true;
}

bool LightStore::remove(LightId id) {
    const LightIndex slot = slot_of(id);
    if (slot == no_light) return false;
    empty(slot);
    --live_;
    // A generation that would start again at its first value is not used: the slot stays empty for ever.
    if (++generation_[slot] != 0) free_.push_back(slot);
    if (ordered_ > 2 * live_ + 64) {
        ordered_ = 0;
        for (std::vector<LightId>& run : order_) {
            std::erase_if(run, [this](LightId old) { return !contains(old); });
            ordered_ += run.size();
        }
        std::erase_if(order_, [](const std::vector<LightId>& run) { return run.empty(); });
    }
    if (texts_.wants_packing()) pack_texts();
    return true;
}

void LightStore::clear() {
    free_.clear();
    order_.clear();
    ordered_ = 0;
    orientation_.clear();
    kinds_ = {};
    texts_ = {};
    index_.clear();
    live_ = 0;
    awake_ = 0;
    for (LightIndex slot = static_cast<LightIndex>(arrays_.size()); slot-- > 0;) {
        if (arrays_.is(slot, light_flag::live)) ++generation_[slot];
        arrays_[slot].flags = 0;
        cold_[slot] = {};
        if (generation_[slot] != 0) free_.push_back(slot);
    }
}

Quaternion LightStore::orientation(LightIndex slot) const {
    return arrays_.is(slot, light_flag::turned) ? orientation_.at(slot) : Quaternion{0, 0, 0, 1};
}

std::optional<Light> LightStore::find(LightId id) const {
    const LightIndex slot = slot_of(id);
    if (slot == no_light) return std::nullopt;
    const Cold& cold = cold_[slot];
    const auto [name, source] = texts_.get(cold.text);
    Light light = kinds_[arrays_[slot].kind].light;
    LightKinds::scale_up(light, arrays_[slot].intensity_scale);
    light.name = name;
    light.source = source;
    light.position_m = arrays_[slot].position_m;
    light.geographic = arrays_.is(slot, light_flag::geographic);
    light.latitude_deg = cold.latitude_deg;
    light.longitude_deg = cold.longitude_deg;
    light.height_m = cold.height_m;
    light.true_north_deg = cold.true_north_deg;
    light.radius_m = cold.radius_m;
    light.body_id = arrays_[slot].body_id;
    light.orientation = orientation(slot);
    light.day_off = arrays_.is(slot, light_flag::day_off);
    light.stable_key = arrays_[slot].stable_key;
    light.on = arrays_.is(slot, light_flag::on);
    light.visibility = arrays_[slot].visibility;
    return light;
}

bool LightStore::is_on_body(LightId id) const {
    const LightIndex slot = slot_of(id);
    return slot != no_light && arrays_[slot].body_id != 0;
}

LightId LightStore::id_of(LightIndex slot) const {
    return slot < arrays_.size() && arrays_.is(slot, light_flag::live) ? make_id(slot, generation_[slot]) : 0;
}

std::vector<LightId> LightStore::ids() const {
    std::vector<LightId> result;
    result.reserve(live_);
    for (const std::vector<LightId>& run : order_) {
        std::copy_if(run.begin(), run.end(), std::back_inserter(result),
                     [this](LightId id) { return contains(id); });
    }
    return result;
}

// After a change that leaves the light where it is.
void LightStore::wake_or_sleep(LightIndex slot) {
    const bool awake = may_shine(slot);
    if (awake == arrays_.is(slot, light_flag::awake)) return;
    arrays_.set(slot, light_flag::awake, awake);
    awake_ += awake ? 1 : ~std::size_t{0};
    index_.awake_changed(arrays_, slot);
}

bool LightStore::set_position(LightId id, const Vec3& position_m) {
    const LightIndex slot = slot_of(id);
    if (slot == no_light) return false;
    arrays_.set(slot, light_flag::geographic, false);
    if (arrays_[slot].position_m == position_m) return true;
    const bool was_awake = arrays_.is(slot, light_flag::awake);
    // Asleep in a block it would wake where it is no more.
    if (!was_awake) index_.erase(arrays_, slot);
    arrays_[slot].position_m = position_m;
    if (was_awake && may_shine(slot)) {
        index_.moved(arrays_, slot);
    } else if (was_awake) {
        index_.erase(arrays_, slot);
        arrays_.set(slot, light_flag::awake, false);
        --awake_;
    } else {
        wake_or_sleep(slot);
    }
    return true;
}

bool LightStore::set_height(LightId id, double height_m) {
    const LightIndex slot = slot_of(id);
    if (slot == no_light) return false;
    cold_[slot].height_m = height_m;
    return true;
}

bool LightStore::set_orientation(LightId id, const Quaternion& orientation) {
    const LightIndex slot = slot_of(id);
    if (slot == no_light) return false;
    const Quaternion turned = normalised(orientation);
    const bool is_turned = turned != Quaternion{0, 0, 0, 1};
    if (is_turned) {
        orientation_[slot] = turned;
    } else if (arrays_.is(slot, light_flag::turned)) {
        orientation_.erase(slot);
    }
    arrays_.set(slot, light_flag::turned, is_turned);
    return true;
}

bool LightStore::set_intensity(LightId id, double intensity_cd) {
    const LightIndex slot = slot_of(id);
    if (slot == no_light) return false;
    HotLight& hot = arrays_[slot];
    const LightKinds::Member member = kinds_.with_intensity({hot.kind, hot.intensity_scale}, intensity_cd);
    hot.kind = member.kind;
    hot.intensity_scale = member.scale;
    arrays_[slot].peak_cd = effective_peak_cd(slot);
    index_.intensity_changed(arrays_, slot);
    wake_or_sleep(slot);
    return true;
}

bool LightStore::set_visibility(LightId id, float visibility) {
    const LightIndex slot = slot_of(id);
    if (slot == no_light) return false;
    arrays_[slot].visibility = visibility;
    arrays_[slot].peak_cd = effective_peak_cd(slot);
    index_.intensity_changed(arrays_, slot);
    wake_or_sleep(slot);
    return true;
}

bool LightStore::set_on(LightId id, bool on) {
    const LightIndex slot = slot_of(id);
    if (slot == no_light) return false;
    arrays_.set(slot, light_flag::on, on);
    wake_or_sleep(slot);
    return true;
}

void LightStore::pack_texts() {
    TextPool packed;
    for (std::size_t slot = 0; slot < cold_.size(); ++slot) {
        Cold& cold = cold_[slot];
        const auto [name, source] = texts_.get(cold.text);
        cold.text = packed.add(name, source);
    }
    texts_ = std::move(packed);
}

void LightStore::set_body_pose(std::uint32_t body_id, const BodyPose& pose) {
    index_.set_body_pose(body_id, {pose.position_m, normalised(pose.orientation)});
}

std::size_t LightStore::memory_bytes() const {
    constexpr std::size_t per_slot = sizeof(HotLight) + sizeof(std::uint32_t) + sizeof(Cold);
    std::size_t order_bytes = order_.capacity() * sizeof(std::vector<LightId>);
    for (const std::vector<LightId>& run : order_)
        order_bytes += run.capacity() * sizeof(LightId);
    return arrays_.capacity() * per_slot + order_bytes + free_.capacity() * sizeof(LightIndex) +
           orientation_.size() * (sizeof(Quaternion) + 4 * sizeof(void*)) + kinds_.memory_bytes() +
           texts_.memory_bytes() + index_.memory_bytes();
}

}  // namespace seaglare::lightdb
