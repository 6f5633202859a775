// What evaluation reads of a light in every frame, in an array of its own: the rest (names, places on the globe, texts)
// stands elsewhere, and so does what many lights share.
#pragma once

#include <cstdint>

#include "lightdb/chunked.h"
#include "lightdb/vector_math.h"

namespace seaglare::lightdb {

using LightIndex = std::uint32_t;  // slot
inline constexpr LightIndex no_light = 0xFFFFFFFFU;

// Of HotLight::flags.
namespace light_flag {
inline constexpr std::uint8_t live = 1;
inline constexpr std::uint8_t awake = 2;  // may shine: switched on, visible, with an intensity and a place
inline constexpr std::uint8_t on = 4;
inline constexpr std::uint8_t turned = 8;  // has an orientation of its own
inline constexpr std::uint8_t day_off = 16;
inline constexpr std::uint8_t geographic = 32;
}  // namespace light_flag

// One cache line. Those that pass culling are scattered over the slots, so that fetching a light is what a frame of a
// large database costs: an array for each number would take a line for each.
struct alignas(64) HotLight {
    Vec3 position_m{};  // scene, or body frame
    std::uint64_t stable_key = 0;
    double intensity_scale = 1;  // its intensities are this often those of its kind
    float radius_m = 0;
    float peak_cd = 0;  // at least what it ever sends in any direction, all colours together
    float visibility = 0;
    std::uint32_t body_id = 0;  // 0: fixed to the world
    std::uint32_t kind = 0;     // of light_kinds.h
    std::uint8_t flags = 0;
};
static_assert(sizeof(HotLight) == 64);

// By slot.
class LightArrays {
  public:
    std::size_t size() const { return lights_.size(); }
    std::size_t capacity() const { return lights_.capacity(); }
    void resize(std::size_t count) { lights_.resize(count); }
    HotLight& operator[](LightIndex light) { return lights_[light]; }
    const HotLight& operator[](LightIndex light) const { return lights_[light]; }
    bool is(LightIndex light, std::uint8_t flag) const { return (lights_[light].flags & flag) != 0; }
    void set(LightIndex light, std::uint8_t flag, bool value) {
        std::uint8_t& flags = lights_[light].flags;
        flags = static_cast<std::uint8_t>(value ? flags | flag : flags & ~flag);
    }

  private:
    Chunked<HotLight> lights_;
};

}  // namespace seaglare::lightdb
