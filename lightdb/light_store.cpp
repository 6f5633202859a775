#include "lightdb/light_store.h"

#include <bit>
#include <cmath>
#include <stdexcept>
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

LightId LightStore::add(Light light) {
    light.orientation = normalised(light.orientation);
    if (light.stable_key == 0) light.stable_key = stable_key_of(light);

    LightIndex index = 0;
    if (!free_.empty()) {
        index = free_.back();
        free_.pop_back();
    } else {
        if (slots_.size() >= 0xFFFFFFFEU) throw std::length_error("too many lights");
        index = static_cast<LightIndex>(slots_.size());
        slots_.emplace_back();
    }
    Slot& slot = slots_[index];
    slot.light = std::move(light);
    slot.live = true;
    ++live_;
    order_.push_back(make_id(index, slot.generation));
    return order_.back();
}

bool LightStore::remove(LightId id) {
    if (find(id) == nullptr) return false;
    const auto index = static_cast<LightIndex>((id & 0xFFFFFFFFU) - 1);
    Slot& slot = slots_[index];
    slot.light = {};
    slot.live = false;
    --live_;
    // A generation that would start again at its first value is not used: the slot stays empty for ever.
    if (++slot.generation != 0) free_.push_back(index);
    if (order_.size() > 2 * live_ + 64)
        std::erase_if(order_, [this](LightId old) { return find(old) == nullptr; });
    return true;
}

void LightStore::clear() {
    free_.clear();
    order_.clear();
    bodies_.clear();
    live_ = 0;
    for (std::size_t index = slots_.size(); index-- > 0;) {
        Slot& slot = slots_[index];
        if (slot.live) {
            slot.light = {};
            slot.live = false;
            ++slot.generation;
        }
        if (slot.generation != 0) free_.push_back(static_cast<LightIndex>(index));
    }
}

Light* LightStore::find(LightId id) {
    return const_cast<Light*>(std::as_const(*this).find(id));
}

const Light* LightStore::find(LightId id) const {
    const std::uint64_t position = id & 0xFFFFFFFFU;
    if (position == 0 || position > slots_.size()) return nullptr;
    const Slot& slot = slots_[position - 1];
    return slot.live && slot.generation == id >> 32 ? &slot.light : nullptr;
}

LightId LightStore::id_of(LightIndex slot) const {
    return slot < slots_.size() && slots_[slot].live ? make_id(slot, slots_[slot].generation) : 0;
}

std::vector<LightId> LightStore::ids() const {
    std::vector<LightId> result;
    result.reserve(live_);
    for (const LightId id : order_) {
        if (find(id) != nullptr) result.push_back(id);
    }
    return result;
}

void LightStore::set_body_pose(std::uint32_t body_id, const BodyPose& pose) {
    bodies_[body_id] = {pose.position_m, normalised(pose.orientation)};
}

const BodyPose* LightStore::body_pose(std::uint32_t body_id) const {
    const auto found = bodies_.find(body_id);
    return found != bodies_.end() ? &found->second : nullptr;
}

}  // namespace seaglare::lightdb
