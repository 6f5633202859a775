#include "glare/psf/motion_keys.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "glare/eye/eye_instant.h"
#include "glare/eye/veil.h"

namespace seaglare::glare {

namespace {

constexpr double adaptation_steps_per_decade = 256;
constexpr double roll_steps_per_rad = 64;
constexpr double pupil_steps_per_mm = 64;

EyeMoment in_steps(const EyeMoment& moment) {
    EyeMoment rounded = moment;
    if (moment.adaptation_cd_m2 && *moment.adaptation_cd_m2 > 0) {
        const double steps = std::round(std::log10(*moment.adaptation_cd_m2) * adaptation_steps_per_decade);
        rounded.adaptation_cd_m2 = std::pow(10.0, steps / adaptation_steps_per_decade);
    }
    double& roll = rounded.request.vitreous_roll_rad;
    roll = std::round(roll * roll_steps_per_rad) / roll_steps_per_rad;
    return rounded;
}

// Light that passes the lids with this blink, of what passes without it.
double open_share(const EyeModel& eye, const PatternRequest& request, std::uint64_t seed) {
    if (!(request.lids.blink > 0)) return 1;
    const Veil veil(eye, seed);
    std::vector<Quad> quads;
    const auto transmitted = [&](LidPose lids) {
        const EyeInstant instant =
            eye_instant(eye, request.pupil_mm, request.time_s, lids, request.vitreous_roll_rad, seed);
        veil.place(instant, quads);
        return transmitted_fraction(eye, instant, quads);
    };
    const double open = transmitted({request.lids.squint, 0});
    return open > 0 ? std::clamp(transmitted(request.lids) / open, 0.0, 1.0) : 0;
}

}  // namespace

PatternRequest request_at(const EyeModel& eye, std::uint64_t seed, const EyeMoment& moment, double time_s) {
    PatternRequest request = moment.request;
    if (moment.still) return request;
    request.time_s = time_s;
    if (!moment.adaptation_cd_m2) return request;
    const double adaptation = *moment.adaptation_cd_m2;
    request.resting_pupil_mm = resting_pupil_diameter_mm(eye, adaptation);
    request.pupil_mm = pupil_diameter_mm(eye, adaptation, time_s, seed);
    request.lids = lid_pose(eye.lids.motion, adaptation, time_s, seed);
    return request;
}

EyeMoment at_rest(const EyeMoment& moment) {
    EyeMoment rest = moment;
    PatternRequest& request = rest.request;
    if (request.resting_pupil_mm > 0) request.pupil_mm = request.resting_pupil_mm;
    request.pupil_mm = std::round(request.pupil_mm * pupil_steps_per_mm) / pupil_steps_per_mm;
    request.resting_pupil_mm = request.pupil_mm;
    request.time_s = 0;
    request.lids.blink = 0;
    request.vitreous_roll_rad =
        std::round(request.vitreous_roll_rad * roll_steps_per_rad) / roll_steps_per_rad;
    rest.still = true;
    return rest;
}

PatternRequest flip_book_page(const EyeModel& eye, const PatternMotion& motion, std::uint64_t seed,
                              const EyeMoment& moment, int page) {
    PatternRequest request =
        request_at(eye, seed, in_steps(moment), page * motion.loop_s / std::max(motion.frames, 1));
    request.lids.blink = 0;
    return request;
}

MotionKeys motion_keys(const EyeModel& eye, const PatternMotion& motion, std::uint64_t seed,
                       const EyeMoment& moment) {
    if (motion.mode == MotionMode::every_frame)
        throw std::invalid_argument("glare pattern: made for every frame, there are no keys");
    MotionKeys keys;
    const double time_s = std::isfinite(moment.request.time_s) ? moment.request.time_s : 0;
    const bool book = motion.mode == MotionMode::flip_book;
    const double passed = book ? (time_s / motion.loop_s - std::floor(time_s / motion.loop_s)) * motion.frames
                               : time_s * motion.rate_hz;
    const double first = std::floor(passed);
    const double later = passed - first;
    const EyeMoment rounded = in_steps(moment);
    for (int i = 0; i < 2; ++i) {
        const double weight = i == 0 ? 1 - later : later;
        if (!(weight > 0)) continue;
        MotionKeys::Key& key = keys.list[static_cast<std::size_t>(keys.count++)];
        key.weight = weight;
        if (book) {
            key.page = (static_cast<int>(first) + i) % motion.frames;
            key.request = flip_book_page(eye, motion, seed, moment, key.page);
        } else {
            key.request = request_at(eye, seed, rounded, (first + i) / motion.rate_hz);
        }
    }
    if (book) keys.share = open_share(eye, moment.request, seed);
    return keys;
}

void validate(const PatternMotion& motion) {
    if (!(motion.rate_hz > 0) || !std::isfinite(motion.rate_hz))
        throw std::invalid_argument("glare pattern: the rate of its motion must be positive");
    if (motion.frames < 2 || motion.frames > most_flip_book_frames)
        throw std::invalid_argument("glare pattern: a flip book has 2 to 256 frames");
    if (!(motion.loop_s > 0) || !std::isfinite(motion.loop_s))
        throw std::invalid_argument("glare pattern: a flip book's loop must take time");
}

}  // namespace seaglare::glare
