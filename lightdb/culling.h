// Why a group of lights, or one, cannot matter to an eye. The same formulas serve both, so that a group is left
// out only where each of its lights would be.
#pragma once

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
};

// Whether a whole group is out of it. Never where one of its lights is not, whatever the rounding; anything that
// is not a number keeps it in.
LeftOut left_out(const CullingEye& eye, const GroupBounds& group);

// Height above the water of a point of the scene.
double height_above_water_m(const Vec3& position_m, const CullingEye& eye);

}  // namespace seaglare::lightdb
