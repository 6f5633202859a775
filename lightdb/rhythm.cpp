#include "lightdb/rhythm.h"

#include <algorithm>
#include <cmath>

#include "lightdb/lamp_glow.h"

namespace seaglare::lightdb {

namespace {

double finite_or_zero(double value) {
    return std::isfinite(value) ? value : 0;
}

// `time_s` modulo the period, in [0, period).
double wrapped(double time_s, double period_s) {
    double position_s = std::fmod(time_s, period_s);
    if (position_s < 0) position_s += period_s;
    return position_s < period_s ? position_s : 0;  // -1e-20 + 10 is 10
}

// Whether the lamp follows its rhythm at once.
bool is_sharp(const Rhythm& rhythm) {
    return !(rhythm.rise_s > 0) && !(rhythm.fall_s > 0);
}

// Adds to each colour the seconds it is lit, weighted with their level, from `from_s` to `to_s`, both within
// one period.
void add_lit_seconds(const Rhythm& rhythm, double from_s, double to_s, LitFractions& lit_s) {
    double start_s = 0;
    for (const Phase& phase : rhythm.phases) {
        const double end_s = start_s + phase.duration_s;
        if (phase.lit) {
            const double overlap_s = std::min(end_s, to_s) - std::max(start_s, from_s);
            if (overlap_s > 0) lit_s[static_cast<std::size_t>(phase.colour)] += overlap_s * phase.level;
        }
        if (end_s >= to_s) return;
        start_s = end_s;
    }
}

LitFractions sample(const Rhythm& rhythm, double time_s) {
    LitFractions lit{};
    const double position_s = wrapped(time_s, rhythm.period_s);
    double end_s = 0;
    for (const Phase& phase : rhythm.phases) {
        end_s += phase.duration_s;
        if (position_s < end_s) {
            if (phase.lit) lit[static_cast<std::size_t>(phase.colour)] = phase.level;
            return lit;
        }
    }
    return lit;
}

// SplitMix64's finaliser (Steele, Lea and Flood 2014): every bit of the result hangs on every bit of the
// input.
std::uint64_t mixed(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15U;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9U;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBU;
    return x ^ (x >> 31);
}

}  // namespace

bool has_colours(const Rhythm& rhythm) {
    return !rhythm.phases.empty();
}

LitFractions mean_lit(const Rhythm& rhythm, double end_s, double duration_s) {
    LitFractions lit{};
    if (rhythm.phases.empty() || !(rhythm.period_s > 0)) {
        const Phase fixed = rhythm.phases.empty() ? Phase{0, true, Colour::white} : rhythm.phases.front();
        if (fixed.lit) lit[static_cast<std::size_t>(fixed.colour)] = fixed.level;
        return lit;
    }
    end_s = finite_or_zero(end_s);
    duration_s = finite_or_zero(duration_s);
    const bool sharp = is_sharp(rhythm);
    if (!(duration_s > 0)) {
        return sharp ? sample(rhythm, end_s) : glow_at(rhythm, wrapped(end_s, rhythm.period_s));
    }

    // The exposure is whole periods, then a rest shorter than one that ends at end_s and may reach into the
    // period before.
    const double period_s = rhythm.period_s;
    const double rest_s = std::fmod(duration_s, period_s);
    const double periods = std::round((duration_s - rest_s) / period_s);
    const auto add = sharp ? add_lit_seconds : add_glow_seconds;
    if (periods > 0) {
        add(rhythm, 0, period_s, lit);
        for (double& seconds : lit)
            seconds *= periods;
    }
    if (rest_s > 0) {
        const double to_s = wrapped(end_s, period_s);
        const double from_s = to_s - rest_s;
        add(rhythm, std::max(from_s, 0.0), to_s, lit);
        if (from_s < 0) add(rhythm, from_s + period_s, period_s, lit);
    }
    for (double& seconds : lit)
        seconds = std::min(seconds / duration_s, 1.0);
    return lit;
}

double exposure_used_s(double exposure_s) {
    return exposure_s > 0 ? std::min(exposure_s, longest_exposure_s) : 0;
}

LitFractions exposed_lit(const Rhythm& rhythm, double time_s, double exposure_s) {
    return mean_lit(rhythm, time_s, exposure_used_s(exposure_s));
}

double phase_offset_s(const Rhythm& rhythm, std::uint64_t stable_key, std::uint64_t seed) {
    const std::uint64_t key = rhythm.sync_group.empty() ? stable_key : fnv1a(rhythm.sync_group);
    const std::uint64_t bits = mixed(key ^ mixed(seed));
    // 0 ... 65536 s, many periods, in steps of 2^-20 s, so that adding it to a clock rounds next to nothing.
    return static_cast<double>(bits >> 28) * 0x1p-20 - finite_or_zero(rhythm.delay_s);
}

std::uint64_t fnv1a(std::string_view bytes, std::uint64_t hash) {
    for (const char byte : bytes) {
        hash ^= static_cast<unsigned char>(byte);
        hash *= 0x100000001B3U;
    }
    return hash;
}

}  // namespace seaglare::lightdb
