// How the pattern follows the eye's motion: made for every frame; made at a lower rate and mixed in between; or turned over
// like the pages of a book that is made once (the 2021 thesis's flip books, of whole patterns instead of apertures). What is
// shown at a time depends on the time, the eye and its adaptation alone: channels with other frame times agree. In between
// two patterns are mixed whose weights add up to 1, so that energy is conserved and nothing jumps.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "glare/eye/eye_model.h"
#include "glare/psf/pattern.h"

namespace seaglare::glare {

// Where the eye is: what a pattern is asked for, and what the pupil and the lids follow, so that the request of another
// instant can be worked out.
struct EyeMoment {
    PatternRequest request;
    std::optional<double> adaptation_cd_m2;  // nothing: pupil and lids stay as the request has them
    std::shared_ptr<const LampList> lamps;   // what request.lamp_list points to, for who keeps a moment
    bool still = false;                      // nothing moves: the request serves every time
};

// The eye at rest: no hippus, no blink, nothing drifts. The same for all times and, in steps of a 64th of a millimetre of the
// pupil and a 64th of a radian of the vitreous body, for nearly equal adaptations and heads.
EyeMoment at_rest(const EyeMoment& moment);

// The request of the same eye at another time: pupil and lids move, what the host drives (adaptation, head) stands.
PatternRequest request_at(const EyeModel& eye, std::uint64_t seed, const EyeMoment& moment, double time_s);

// The patterns that are mixed at a moment. `adaptation` is rounded to steps of a 256th of a decade, the roll of the vitreous
// body to a 64th of a radian: what the host drives changes by steps smaller than hippus makes from frame to frame, and while
// it stands still the same patterns serve.
struct MotionKeys {
    struct Key {
        PatternRequest request;
        double weight = 0;
        int page = 0;  // of a flip book
    };
    std::array<Key, 2> list;
    int count = 0;     // 1 when the moment falls on a key
    double share = 1;  // a blink, which no page of a flip book has, dims what is mixed
};

// Throws std::invalid_argument for MotionMode::every_frame, which needs no keys.
MotionKeys motion_keys(const EyeModel& eye, const PatternMotion& motion, std::uint64_t seed,
                       const EyeMoment& moment);
// A page of the book that the moment belongs to.
PatternRequest flip_book_page(const EyeModel& eye, const PatternMotion& motion, std::uint64_t seed,
                              const EyeMoment& moment, int page);

// Throws std::invalid_argument naming what is out of range.
void validate(const PatternMotion& motion);

}  // namespace seaglare::glare
