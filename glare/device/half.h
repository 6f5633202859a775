// IEEE 754 half precision: 1 sign, 5 exponent and 10 fraction bits; 2^-24 ... 65504, relative rounding error 2^-11 from
// 2^-14 on. For textures only: nothing is added up in it.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace seaglare::glare {

using Half = std::uint16_t;
inline constexpr float largest_half = 65504.0F;

// To nearest, ties to even; beyond the largest: the largest; NaN: the largest, too. Free of branches, so that a compiler
// makes vectors of a loop.
inline Half half_from_float(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t sign = bits >> 16 & 0x8000U;
    constexpr std::uint32_t largest_bits = 0x477FE000U;  // 65504 as a float
    const std::uint32_t magnitude_bits = bits & 0x7FFFFFFFU;
    const std::uint32_t magnitude = magnitude_bits < largest_bits ? magnitude_bits : largest_bits;
    // Normal: the exponent's bias falls from 127 to 15, thirteen bits are rounded away.
    const std::uint32_t normal = (magnitude + 0xFFFU + (magnitude >> 13 & 1U) - (112U << 23)) >> 13;
    // Below 2^-14: half a unit of the sum with 0.5 is half a unit of the result.
    const std::uint32_t subnormal =
        std::bit_cast<std::uint32_t>(std::bit_cast<float>(magnitude) + 0.5F) - 0x3F000000U;
    return static_cast<Half>(sign | (magnitude < (113U << 23) ? subnormal : normal));
}

inline float float_from_half(Half half) {
    const auto bits = static_cast<std::uint32_t>(half);
    const std::uint32_t sign = (bits & 0x8000U) << 16;
    const std::uint32_t shifted = (bits & 0x7FFFU) << 13;
    // 2^112 puts the bias right, for subnormal numbers as well; infinities and NaN become large numbers.
    const float magnitude = std::bit_cast<float>(shifted) * 0x1p112F;
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(magnitude) | sign);
}

// Pixels of four channels, each channel multiplied by a factor of its own. `to` is as long as `from`.
inline void halves_from_floats(std::span<const float> from, std::span<const float, 4> factor,
                               std::span<Half> to) {
    for (std::size_t i = 0; i + 4 <= from.size(); i += 4)
        for (std::size_t c = 0; c < 4; ++c)
            to[i + c] = half_from_float(from[i + c] * factor[c]);
}

// The same with one factor for all. Returns what the halves are to be multiplied by, a power of two that lets the largest fit.
inline float to_halves(std::span<const float> from, std::vector<Half>& to) {
    to.resize(from.size());
    float largest = 0;
    for (const float value : from)
        largest = std::max(largest, std::abs(value));
    const bool ordinary = largest > 1e-30F && largest < 1e30F;
    const float scale = ordinary ? std::ldexp(1.0F, std::ilogb(largest) - 14) : 1.0F;
    std::array<float, 4> factor{};
    factor.fill(1 / scale);
    halves_from_floats(from, factor, to);
    return scale;
}

}  // namespace seaglare::glare
