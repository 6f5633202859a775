#include "glare/eye/adaptation.h"

#include <algorithm>
#include <cmath>

#include "glare/eye/exact_step.h"

namespace seaglare::glare {

namespace {

constexpr double half_rod_luminance_cd_m2 = 0.04;
constexpr double rod_gain_time_s = 0.4;
constexpr double cone_gain_time_s = 0.1;

struct PigmentKind {
    double regeneration_s;
    double bleaching_cd_s_m2;
};
constexpr PigmentKind rod_pigment = {400, 16};
constexpr PigmentKind cone_pigment = {110, 2.2e8};

double luminance_or_zero(double luminance_cd_m2) {
    return luminance_cd_m2 > 0 ? luminance_cd_m2 : 0;
}

double rate_per_s(const PigmentKind& kind, double luminance_cd_m2) {
    return 1 / kind.regeneration_s + luminance_cd_m2 / kind.bleaching_cd_s_m2;
}

double rest_of(const PigmentKind& kind, double luminance_cd_m2) {
    return 1 / (1 + luminance_cd_m2 * (kind.regeneration_s / kind.bleaching_cd_s_m2));
}

double bleached(const PigmentKind& kind, double share, double luminance_cd_m2, double step_s) {
    return approached(std::clamp(share, 0.0, 1.0), rest_of(kind, luminance_cd_m2), step_s,
                      1 / rate_per_s(kind, luminance_cd_m2));
}

}  // namespace

double rod_share(double luminance_cd_m2) {
    return half_rod_luminance_cd_m2 / (half_rod_luminance_cd_m2 + luminance_or_zero(luminance_cd_m2));
}

double light_adapted_cd_m2(double adapted_cd_m2, double goal_cd_m2, double step_s) {
    if (!std::isfinite(goal_cd_m2)) return adapted_cd_m2;
    const double goal = luminance_or_zero(goal_cd_m2);
    const double rods = rod_share(goal);
    return approached(luminance_or_zero(adapted_cd_m2), goal, step_s,
                      rods * rod_gain_time_s + (1 - rods) * cone_gain_time_s);
}

Pigments bleached(const Pigments& pigments, double luminance_cd_m2, double step_s) {
    const double luminance = luminance_or_zero(luminance_cd_m2);
    return {bleached(rod_pigment, pigments.rod, luminance, step_s),
            bleached(cone_pigment, pigments.cone, luminance, step_s)};
}

Pigments pigments_at_rest(double luminance_cd_m2) {
    const double luminance = luminance_or_zero(luminance_cd_m2);
    return {rest_of(rod_pigment, luminance), rest_of(cone_pigment, luminance)};
}

}  // namespace seaglare::glare
