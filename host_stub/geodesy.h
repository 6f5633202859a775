// Where things are: latitude and longitude to metres on the scene's tangent plane, and where sun and moon
// stand as the hours pass. The stub host's earth is flat: heights count from the plane z = 0 and nothing
// sinks below it.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace seaglare::host {

struct GeoPoint {
    double latitude_deg = 0;
    double longitude_deg = 0;
};

// East and north of `point` in metres on the plane that touches the WGS 84 ellipsoid at `origin`. The drop
// below that plane (8 m at 10 km) is left out, as SEAGLARE_EARTH_FLAT has it.
glm::dvec2 east_north_m(GeoPoint origin, GeoPoint point);

// Compass direction of a horizontal vector, degrees clockwise from north in [0, 360).
double bearing_deg(glm::dvec2 east_north);

// A direction in the sky: elevation above the horizon and azimuth clockwise from north.
struct SkyDirection {
    double elevation_deg = -90;
    double azimuth_deg = 0;
};

// Unit vector east, north, up.
glm::dvec3 unit_vector(SkyDirection direction);

// Where a body that stands at `now` at this latitude will stand `hours` later (or earlier), carried round by
// the Earth's rotation alone: 15 degrees an hour about the celestial pole. Good to the sun's degree per day
// and the moon's half degree per hour; a scene needs no date that way.
SkyDirection after_hours(SkyDirection now, double latitude_deg, double hours);

}  // namespace seaglare::host
