// The lights that a vessel shows by the International Regulations for Preventing Collisions at Sea, 1972, as amended
// (COLREG): Part C, Rules 20 to 30, and Annexes I and II. A pure function of what she is. Not here: seaplanes and
// wing-in-ground craft (Rules 23(c), 31), whose lights the rules give neither place nor strength.
#pragma once

#include <string>
#include <vector>

#include "lightdb/light.h"
#include "lightdb/vessel.h"

namespace seaglare::lightdb {

// Her lights in the frame of her body: x to starboard, y ahead, z up, metres. Each is named ("Skagerrak: port sidelight"),
// has its arc as sectors outward from ahead, the least intensity that its range asks for, and its rule as `source`. The
// order is: masthead lights, sidelights, sternlight, then what tells her kind, from the highest down. Throws VesselError.
std::vector<Light> colreg_lights(const Vessel& vessel);

// What the rules ask of her beside these lights, in words. Usually nothing.
std::vector<std::string> colreg_notes(const Vessel& vessel);

}  // namespace seaglare::lightdb
