// What evaluation reads of every light in every frame, one array for each thing: the rest of a light is only
// fetched for those that pass.
#pragma once

#include <cstdint>
#include <vector>

#include "lightdb/vector_math.h"

namespace seaglare::lightdb {

using LightIndex = std::uint32_t;  // slot
inline constexpr LightIndex no_light = 0xFFFFFFFFU;

// Of LightArrays::flags.
namespace light_flag {
inline constexpr std::uint8_t live = 1;
inline constexpr std::uint8_t awake = 2;  // may shine: switched on, visible, with an intensity and a place
inline constexpr std::uint8_t on = 4;
inline constexpr std::uint8_t turned = 8;  // has an orientation of its own
inline constexpr std::uint8_t day_off = 16;
inline constexpr std::uint8_t geographic = 32;
}  // namespace light_flag

// All of the same length, by slot.
struct LightArrays {
    std::vector<Vec3> position_m;  // scene, or body frame
    std::vector<double> radius_m;
    std::vector<float> peak_cd;  // at least what it ever sends in any direction, all colours together
    std::vector<float> visibility;
    std::vector<std::uint32_t> body_id;  // 0: fixed to the world
    std::vector<std::uint8_t> flags;

    std::size_t size() const { return flags.size(); }
    bool is(LightIndex light, std::uint8_t flag) const { return (flags[light] & flag) != 0; }
    void set(LightIndex light, std::uint8_t flag, bool value) {
        flags[light] = static_cast<std::uint8_t>(value ? flags[light] | flag : flags[light] & ~flag);
    }
};

}  // namespace seaglare::lightdb
