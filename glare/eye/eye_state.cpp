#include "glare/eye/eye_state.h"

#include <cmath>

#include "glare/eye/adaptation.h"

namespace seaglare::glare {

EyeState advanced(const EyeState& state, const EyeModel& eye, const EyeSurroundings& frame) {
    EyeState result = state;
    const double step_s = state.time_s ? frame.time_s - *state.time_s : 0;
    if (!result.vitreous) result.vitreous = VitreousState{};
    if (step_s > 0 && std::isfinite(step_s))
        result.vitreous = turned(*result.vitreous, frame.head_rad_s, eye.vitreous_drag_per_s, step_s);
    if (!eye.adapts || !state.adapted_cd_m2) {
        result.adapted_cd_m2 = frame.luminance_cd_m2;
    } else if (step_s > 0 && std::isfinite(step_s)) {
        result.adapted_cd_m2 = light_adapted_cd_m2(*state.adapted_cd_m2, frame.luminance_cd_m2, step_s);
    }
    if (std::isfinite(frame.time_s)) result.time_s = frame.time_s;
    return result;
}

}  // namespace seaglare::glare
