// Randomness without state: every value is a pure function of a seed and a position, so that two channels, or a run
// resumed after months, agree to the last bit.
#pragma once

#include <cstdint>

namespace seaglare::glare {

// Mixes a seed with a position in up to three dimensions. Source: the finaliser of SplitMix64 (Steele, Lea & Flood
// 2014).
std::uint64_t hash(std::uint64_t seed, std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0);

// In [0, 1), 53 bits of the hash.
double uniform(std::uint64_t seed, std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0);

// Smooth noise over a phase: bounded to [-1, 1], twice differentiable, one independent value per unit of phase and a
// half as strong octave. A phase that is not finite counts as 0.
double smooth_noise(std::uint64_t seed, double phase);

}  // namespace seaglare::glare
