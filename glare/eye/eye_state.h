// What accumulates in an eye, because the host drives it: how far it has adapted, and where its vitreous body hangs after the
// head has turned. A value that can be read and set; everything else that moves is a function of absolute time.
#pragma once

#include <array>
#include <optional>

#include "glare/eye/eye_model.h"
#include "glare/eye/vitreous.h"

namespace seaglare::glare {

struct EyeState {
    std::optional<double> adapted_cd_m2;    // nothing: no frame yet, and nobody has said
    std::optional<VitreousState> vitreous;  // likewise; then it rests
    std::optional<double> time_s;           // that it is of; nothing: no frame yet
    friend bool operator==(const EyeState&, const EyeState&) = default;
};

// What a frame says of the eye's surroundings.
struct EyeSurroundings {
    double luminance_cd_m2 = 0;
    std::array<double, 3> head_rad_s{};  // the head's rate: axes right, up, backwards
    double time_s = 0;
};

// The state at the frame's instant. One exact step over the time since the last; none for the first frame, nor when the
// time stands still, runs backwards or is no number: several views of one instant make one step. An eye that does not
// adapt in time has the frame's luminance at once.
EyeState advanced(const EyeState& state, const EyeModel& eye, const EyeSurroundings& frame);

}  // namespace seaglare::glare
