#include "lightdb/culling.h"

#include <algorithm>

#include "lightdb/geodesy.h"
#include "lightdb/photometry.h"

namespace seaglare::lightdb {

namespace {

// Wider than the rounding of any distance or height below 1e8 m in double precision.
constexpr double relative_slack = 1e-9;
constexpr double slack_m = 1e-6;

}  // namespace

double most_lx(const CullingEye& eye, const GroupBounds& group) {
    const double distance_m = group.nearest_m * (1 - relative_slack) - slack_m;
    // A lamp's own size can only make it fainter: the eye may be inside it.
    const double peak_cd = group.peak_cd * (1 + relative_slack);
    return illuminance_lx(peak_cd, distance_m, 0, eye.extinction_per_m) * static_cast<double>(group.lights);
}

LeftOut left_out(const CullingEye& eye, const GroupBounds& group) {
    const double distance_m = group.nearest_m * (1 - relative_slack) - slack_m;
    if (!(distance_m > 0)) return LeftOut::no;
    if (eye.geographic_horizon) {
        const double highest_m = std::max(group.highest_m, 0.0) * (1 + relative_slack) + slack_m;
        const double radius_m = std::max(group.radius_m, 0.0) * (1 + relative_slack) + slack_m;
        if (fraction_above_horizon(distance_m, highest_m, radius_m, eye.height_m) == 0)
            return LeftOut::below_horizon;
    }
    return most_lx(eye, group) < eye.least_lx ? LeftOut::too_faint : LeftOut::no;
}

bool LeftOutCounts::leave_out(const CullingEye& eye, const GroupBounds& group) {
    switch (left_out(eye, group)) {
        case LeftOut::no:
            return false;
        case LeftOut::below_horizon:
            below_horizon += group.lights;
            return true;
        case LeftOut::too_faint:
            too_faint += group.lights;
            too_faint_lx += most_lx(eye, group);
    }
    return true;
}

double height_above_water_m(const Vec3& position_m, const CullingEye& eye) {
    double height_m = position_m[2] - eye.water_level_m;
    if (eye.round_earth) {
        height_m += (position_m[0] * position_m[0] + position_m[1] * position_m[1]) / (2 * earth_radius_m);
    }
    return height_m;
}

}  // namespace seaglare::lightdb
