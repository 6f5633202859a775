#include "lightdb/light_store.h"

#include <algorithm>
#include <bit>
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

std::uint64_t hashed(double number, std::uint64_t hash) {
    // + 0.0 makes one zero of the two. Byte order does not matter: machines that must agree run the same
    // build.
    const auto bits = std::bit_cast<std::array<char, sizeof(double)>>(number + 0.0);
    return fnv1a(std::string_view(bits.data(), bits.size()), hash);
}

}  // namespace

std::uint64_t stable_key_of(const Light& light) {
    // A separator that no text contains keeps ("ab", "c") apart from ("a", "bc").
    constexpr std::string_view end("\0", 1);
    std::uint64_t hash = fnv1a(end, fnv1a(light.name));
    hash = fnv1a(end, fnv1a(light.character, hash));
    if (light.geographic) {
        hash = hashed(light.longitude_deg, hashed(light.latitude_deg, hash));
    } else {
        for (const double coordinate_m : light.position_m)
            hash = hashed(coordinate_m, hash);
    }
    hash = hashed(static_cast<double>(light.body_id), hash);
    return hash != 0 ? hash : 1;  // 0 means "not yet known"
}

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
    generation_.resize(count, 1);
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
    const float peak = kinds_[arrays_[slot].kind].peak_cd;
    const float gain = arrays_[slot].visibility;
    return gain > 1 ? std::nextafter(peak * gain, std::numeric_limits<float>::infinity()) : peak;
}

// Everything of a light but its life; the slot is not in the index.
void LightStore::fill(LightIndex slot, Light light) {
    if (light.stable_key == 0) light.stable_key = stable_key_of(light);
    const Quaternion orientation = normalised(light.orientation);
    const bool turned = orientation != Quaternion{0, 0, 0, 1};
    if (turned) orientation_[slot] = orientation;
    cold_[slot] = {light.latitude_deg, light.longitude_deg, light.height_m, light.true_north_deg,
                   texts_.add(light.name, light.source)};
    arrays_[slot].stable_key = light.stable_key;
    arrays_[slot].position_m = light.position_m;
    arrays_[slot].radius_m = std::isnan(light.radius_m) ? 0 : light.radius_m;
    arrays_[slot].visibility = light.visibility;
    arrays_[slot].body_id = light.body_id;
    arrays_.set(slot, light_flag::on, light.on);
    arrays_.set(slot, light_flag::turned, turned);
    arrays_.set(slot, light_flag::day_off, light.day_off);
    arrays_.set(slot, light_flag::geographic, light.geographic);
    arrays_[slot].kind = kinds_.intern(std::move(light));
    arrays_[slot].peak_cd = effective_peak_cd(slot);
    const bool awake = may_shine(slot);
    arrays_.set(slot, light_flag::awake, awake);
    awake_ += awake ? 1 : 0;
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
    order_.push_back(make_id(slot, generation_[slot]));
    return order_.back();
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
    if (order_.size() > 2 * live_ + 64) std::erase_if(order_, [this](LightId old) { return !contains(old); });
    if (texts_.wants_packing()) pack_texts();
    return true;
}

void LightStore::clear() {
    free_.clear();
    order_.clear();
    poses_.clear();
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
    light.name = name;
    light.source = source;
    light.position_m = arrays_[slot].position_m;
    light.geographic = arrays_.is(slot, light_flag::geographic);
    light.latitude_deg = cold.latitude_deg;
    light.longitude_deg = cold.longitude_deg;
    light.height_m = cold.height_m;
    light.true_north_deg = cold.true_north_deg;
    light.radius_m = arrays_[slot].radius_m;
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
    std::copy_if(order_.begin(), order_.end(), std::back_inserter(result),
                 [this](LightId id) { return contains(id); });
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
    arrays_[slot].kind = kinds_.with_intensity(arrays_[slot].kind, intensity_cd);
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
    for (Cold& cold : cold_) {
        const auto [name, source] = texts_.get(cold.text);
        cold.text = packed.add(name, source);
    }
    texts_ = std::move(packed);
}

void LightStore::set_body_pose(std::uint32_t body_id, const BodyPose& pose) {
    poses_[body_id] = {pose.position_m, normalised(pose.orientation)};
}

const BodyPose* LightStore::body_pose(std::uint32_t body_id) const {
    const auto found = poses_.find(body_id);
    return found != poses_.end() ? &found->second : nullptr;
}

std::size_t LightStore::memory_bytes() const {
    constexpr std::size_t per_slot = sizeof(HotLight) + sizeof(std::uint32_t) + sizeof(Cold);
    return arrays_.capacity() * per_slot + order_.capacity() * sizeof(LightId) +
           free_.capacity() * sizeof(LightIndex) +
           orientation_.size() * (sizeof(Quaternion) + 4 * sizeof(void*)) + kinds_.memory_bytes() +
           texts_.memory_bytes() + index_.memory_bytes();
}

}  // namespace seaglare::lightdb
