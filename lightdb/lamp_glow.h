// Lamps that warm up and cool down. While the rhythm asks for a level, the lamp's light approaches it exponentially, with one
// time constant upwards and one downwards (rise_s / ln 10 and fall_s / ln 10: 90 % of the way after rise_s or fall_s).
//
// What is worked out is the state that repeats every period, as if the rhythm had always run: a pure function of the time, in
// closed form, so that no channel has to carry a lamp's temperature from frame to frame.
//
// Each colour has a lamp of its own, as in alternating lights that are switched: where white turns to red the white lamp cools
// while the red one heats. An alternating light made of one lamp that burns all the time behind a turning screen of coloured
// glass has sharp changes: it has no rise_s and no fall_s.
#pragma once

#include "lightdb/rhythm.h"

namespace seaglare::lightdb {

// All: preconditions that the rhythm has phases, period_s > 0, and that positions lie within 0 ... period_s from its beginning.
// Never throw, allocate nothing.

// The glow of each colour, 0 ... 1, at a position.
LitFractions glow_at(const Rhythm& rhythm, double position_s);

// Adds to each colour's `glow_s` the integral of its glow in seconds from `from_s` to `to_s`.
void add_glow_seconds(const Rhythm& rhythm, double from_s, double to_s, LitFractions& glow_s);

}  // namespace seaglare::lightdb
