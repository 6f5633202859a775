// Why a group of lights, or one, cannot matter to an eye. The same formulas serve both, so that a group is left
// out only where each of its lights would be.
#pragma once

#include <cstdint>

#include "lightdb/vector_math.h"

namespace seaglare::lightdb {

enum class LeftOut { no, below_horizon, too_faint };

// What culling needs to know of the eye.
struct CullingEye {
    Vec3 eye_m{};
    double least_lx = 0;  // a light below it is left out; more than 0
    double extinction_per_m = 0;
    bool geographic_horizon = true;
    bool round_earth = false;
    double water_level_m = 0;
    double height_m = 0;  // of the eye above the water
    bool is_day = false;
};

// What bounds a group of lights: none is nearer, higher, brighter or larger.
struct GroupBounds {
    double nearest_m = 0;
    double highest_m = 0;  // above the water
    double peak_cd = 0;
    double radius_m = 0;
    std::uint32_t lights = 1;
};

// Whether a whole group is out of it. Never where one of its lights is not, whatever the rounding; anything that
// is not a number keeps it in. Too faint is what is so with all its lights in one place: lights left out add up.
LeftOut left_out(const CullingEye& eye, const GroupBounds& group);

// At least the illuminance in lux that the group's lights give at the eye together.
double most_lx(const CullingEye& eye, const GroupBounds& group);

// Lights left out, by reason.
struct LeftOutCounts {
    std::uint32_t below_horizon = 0;
    std::uint32_t too_faint = 0;
    std::uint32_t off_by_day = 0;
    double too_faint_lx = 0;  // at least what those give at the eye together

    // Counts the lights of a group if it is left out; else false.
    bool leave_out(const CullingEye& eye, const GroupBounds& group);
};

// Height above the water of a point of the scene.
double height_above_water_m(const Vec3& position_m, const CullingEye& eye);

}  // namespace seaglare::lightdb
