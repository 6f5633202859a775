// A beam that turns: what of it an exposure sees from one direction. Never sampled at an instant unless the exposure is 0: a
// beam of one degree that turns in ten seconds passes an eye in 28 ms, between two frames of a slow channel.
#pragma once

#include "lightdb/light.h"

namespace seaglare::lightdb {

// Mean over [end_s - duration_s, end_s] of the beam's factor towards an eye at `bearing_from_ahead_deg` (clockwise from the
// light's ahead, seen from above), by the exact integral of the table's straight pieces. At time 0 the optic's zero points
// ahead; at t it points to 360 t / period_s degrees from ahead. `end_s` is on the light's own clock (time plus
// phase_offset_s(), as its rhythm's) and `duration_s` as rhythms are exposed (exposure_used_s() of the frame's interval).
//
// A whole number of turns gives the beam's mean around the circle from everywhere. duration_s <= 0 samples the instant end_s.
// A period of 0 (nothing turns) gives the beam's factor in that bearing at any time, an empty table 1. What is not finite
// counts as 0. Never throws, allocates nothing.
double mean_beam_factor(const RotatingBeam& rotation, double bearing_from_ahead_deg, double end_s,
                        double duration_s);

}  // namespace seaglare::lightdb
