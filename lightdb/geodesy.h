// From latitude and longitude to the metres of a scene: WGS 84 and the East-North-Up frame at the scene's
// origin.
#pragma once

#include <vector>

#include "lightdb/light.h"
#include "lightdb/vector_math.h"

namespace seaglare::lightdb {

// Where the scene's origin lies. The height is that of the origin above the water.
struct GeographicPoint {
    double latitude_deg = 0;   // -90 ... 90
    double longitude_deg = 0;  // any; east positive
    double height_m = 0;
    friend bool operator==(const GeographicPoint&, const GeographicPoint&) = default;
};

enum class Earth {
    flat,  // east and north as on the tangent plane, up = height: the sea is the plane z = -origin height
    round  // on the ellipsoid: distant lights sink below the tangent plane
};

// Mean radius of the Earth (IUGG), for what needs no more than a sphere.
inline constexpr double earth_radius_m = 6371008.8;

// Earth-centred, Earth-fixed metres of a point (WGS 84, height taken as ellipsoidal).
Vec3 earth_centred_from_geographic(const GeographicPoint& point);

// The frame whose axes are east, north and up at `origin`.
struct LocalFrame {
    explicit LocalFrame(const GeographicPoint& origin);
    Vec3 local_from_earth_centred(const Vec3& position_m) const;
    Vec3 earth_centred_from_local(const Vec3& position_m) const;
    Vec3 turned_to_local(const Vec3& earth_centred_direction) const;

    Vec3 origin_m;  // Earth-centred
    Vec3 east;      // unit vectors, Earth-centred
    Vec3 north;
    Vec3 up;
};

// Position in the scene of a point given by latitude, longitude and height above the water.
Vec3 scene_from_geographic(const GeographicPoint& point, const GeographicPoint& origin, Earth earth);

// Direction of true north at a point, degrees clockwise from the scene's y axis. East of the origin it is
// negative on the northern hemisphere.
double true_north_in_scene_deg(const GeographicPoint& point, const GeographicPoint& origin);

// Fills position_m and true_north_deg of every light whose position is geographic; the others keep theirs.
// May be called again with another origin.
void place_lights(std::vector<Light>& lights, const GeographicPoint& origin, Earth earth);
void place_light(Light& light, const GeographicPoint& origin, Earth earth);

}  // namespace seaglare::lightdb
