#include "glare/eye/lids.h"

#include <algorithm>
#include <cmath>

#include "glare/eye/noise.h"

namespace seaglare::glare {

namespace {

// 0 to 1 with no slope and no curvature at both ends.
double eased(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * t * (t * (6 * t - 15) + 10);
}

double blink(const LidMotion& motion, double time_s, std::uint64_t seed) {
    if (!(motion.blink_interval_s > 0) || !(motion.blink_duration_s > 0)) return 0;
    constexpr std::uint64_t blink_stream = 0x626C696E;
    const double duration_s = std::min(motion.blink_duration_s, motion.blink_interval_s);
    const double phase = time_s / motion.blink_interval_s;
    const double interval = std::floor(phase);
    const auto cell = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::fmod(interval, 0x1p52)));
    const double begins_s = uniform(seed, blink_stream, cell) * (motion.blink_interval_s - duration_s);
    const double t = ((phase - interval) * motion.blink_interval_s - begins_s) / duration_s;
    if (!(t > 0 && t < 1)) return 0;
    constexpr double shutting = 1.0 / 3;
    return t < shutting ? eased(t / shutting) : eased((1 - t) / (1 - shutting));
}

double squint(const LidMotion& motion, double adaptation_luminance_cd_m2) {
    if (!(motion.squint > 0) || !(adaptation_luminance_cd_m2 > 0)) return 0;
    const double half = std::max(motion.squint_half_cd_m2, 1e-6);
    return std::min(motion.squint, 1.0) / (1 + half / adaptation_luminance_cd_m2);
}

}  // namespace

LidPose lid_pose(const LidMotion& motion, double adaptation_luminance_cd_m2, double time_s,
                 std::uint64_t seed) {
    return {squint(motion, adaptation_luminance_cd_m2),
            blink(motion, std::isfinite(time_s) ? time_s : 0, seed)};
}

double lid_closure(const LidMotion& motion, double adaptation_luminance_cd_m2, double time_s,
                   std::uint64_t seed) {
    const LidPose pose = lid_pose(motion, adaptation_luminance_cd_m2, time_s, seed);
    return std::clamp(1 - (1 - pose.squint) * (1 - pose.blink), 0.0, 1.0);
}

}  // namespace seaglare::glare
