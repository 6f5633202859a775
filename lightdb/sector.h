// Which colours a sectored light shows in a direction, and what the direction is.
#pragma once

#include <array>
#include <span>

#include "lightdb/light.h"

namespace seaglare::lightdb {

// Factor on the intensity of each colour in one direction.
using SectorFactors = std::array<double, colour_count>;

// Degrees to [0, 360). Not finite: 0.
double wrapped_deg(double angle_deg);

// True bearing of the light as the navigator reads it, 0 ... 360: from the observer to the light, clockwise
// from the light's own true north, which lies `true_north_deg` clockwise from the scene's y axis.
// `to_light_m` is the light minus the eye in the scene (East-North-Up). Straight above or below there is no
// bearing: 0.
double bearing_from_seaward_deg(const std::array<double, 3>& to_light_m, double true_north_deg);

// Bearing of the observer as seen from the light, clockwise from ahead, 0 ... 360; `to_eye_m` is the eye
// minus the light in the light's frame: x to starboard, y ahead, z up. Straight above or below: 0.
double bearing_from_ahead_deg(const std::array<double, 3>& to_eye_m);

// What shows at a bearing given in the sectors' own reference and an elevation above the light's own horizon, degrees. A
// sector holds its lower limits and not its upper ones (but for the zenith). Where sectors overlap, the one that stands
// later in the list holds, so that "obscured" or an unintensified arc may be laid over a wide sector; where there is none
// it is dark. No sectors: 1 for every colour.
//
// Around a limit, of bearing or elevation, the two sides are mixed evenly over transition_deg: what an edge shows behind
// which a lamp of that angular width stands. The shares of what shows always sum to 1, so nothing is lost or won. Where two
// sectors meet at one limit the wider transition holds; limits that nobody sees because both sides look the same have none.
// Where transitions of different widths run into each other, the narrower keeps its shape and the wider gives way where it
// would show what lies behind a limit that is not passed yet: nothing shows across a sharp limit. At most 64 limits inside one transition are graded.
SectorFactors sector_factors(std::span<const Sector> sectors, double bearing_deg, double elevation_deg = 0);

// Width of a sector in degrees, more than 0 and at most 360 (a whole turn: 0 to 360); 0 if its limits are
// equal.
double sector_width_deg(const Sector& sector);

}  // namespace seaglare::lightdb
