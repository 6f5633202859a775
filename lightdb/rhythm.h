// What a rhythm shows during an exposure. Never sampled at an instant unless the exposure is 0: a flash of 5
// ms would fall between two frames.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "lightdb/light.h"

namespace seaglare::lightdb {

inline constexpr double longest_exposure_s = 0.05;

// Mean over a time of what each colour shows, 0 ... 1. The colours sum to at most 1, but for alternating lamps that cool more
// slowly than they heat: for a moment one still glows while the next already burns.
using LitFractions = std::array<double, colour_count>;

// A lamp that cools never goes out quite. Below this share the brightest light there is (1e8 cd) would need an eye at a metre
// to be seen.
inline constexpr double faintest_fraction = 1e-15;

// Mean over [end_s - duration_s, end_s] by the exact integral modulo the period; a whole number of periods
// gives exactly the duty cycle. duration_s <= 0 samples the instant end_s. A fixed light (no phases, or a
// period of 0) is 1 in the colour of its first phase, or in white: see has_colours(). Times that are not
// finite count as 0. Lamps that warm up and cool down (rise_s, fall_s) are in the state that they keep when the rhythm has run
// for long: see lamp_glow.h. Allocates nothing.
LitFractions mean_lit(const Rhythm& rhythm, double end_s, double duration_s);

// The time that a frame of this nominal interval exposes: 0 ... longest_exposure_s; NaN is 0.
double exposure_used_s(double exposure_s);

// The same over a frame's exposure: clamped to 0 ... longest_exposure_s, because averaging over a hitch of
// seconds would show a flashing light as a steady dim one.
LitFractions exposed_lit(const Rhythm& rhythm, double time_s, double exposure_s);

// Whether the phases say which colours are shown: not so for a fixed light without phases.
bool has_colours(const Rhythm& rhythm);

// By how many seconds a light's rhythm runs ahead of the clock: a pure function of its group (of its own key,
// where it has no group) and the seed, so that every channel agrees without talking. Lights of a group begin
// a period together also when their periods differ, but for what each is delayed: a light with a delay_s begins that much later.
double phase_offset_s(const Rhythm& rhythm, std::uint64_t stable_key, std::uint64_t seed);

// 64-bit FNV-1a, to be continued from an earlier hash. Stable for ever: phases hang on it.
inline constexpr std::uint64_t fnv_start = 0xCBF29CE484222325U;
std::uint64_t fnv1a(std::string_view bytes, std::uint64_t hash = fnv_start);

}  // namespace seaglare::lightdb
