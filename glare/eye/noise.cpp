#include "glare/eye/noise.h"

#include <cmath>

namespace seaglare::glare {

namespace {

std::uint64_t mixed(std::uint64_t z) {
    z += 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
}

double value_noise(std::uint64_t seed, std::uint64_t octave, double phase) {
    const double floor = std::floor(phase);
    const double t = phase - floor;
    // Wraps after 2^52 periods, which is later than anyone will look.
    const auto cell = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::fmod(floor, 0x1p52)));
    const double before = 2 * uniform(seed, octave, cell) - 1;
    const double after = 2 * uniform(seed, octave, cell + 1) - 1;
    const double blend = t * t * t * (t * (6 * t - 15) + 10);
    return before + (after - before) * blend;
}

}  // namespace

std::uint64_t hash(std::uint64_t seed, std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    return mixed(mixed(mixed(mixed(seed) ^ a) ^ b) ^ c);
}

double uniform(std::uint64_t seed, std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    return static_cast<double>(hash(seed, a, b, c) >> 11U) * 0x1p-53;
}

double smooth_noise(std::uint64_t seed, double phase) {
    if (!std::isfinite(phase)) phase = 0;
    return (value_noise(seed, 0, phase) + 0.5 * value_noise(seed, 1, 2 * phase)) / 1.5;
}

}  // namespace seaglare::glare
