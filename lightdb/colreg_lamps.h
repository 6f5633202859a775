// One lamp of a ship: arcs by COLREG Rule 21 and Annex I section 9, ranges by Rule 22, intensity by Annex I section 8,
// vertical sector by section 10. Its colour is one of the navigation colours of glare/colour, whose chromaticities lie
// inside the regions of section 7.
#pragma once

#include <string>
#include <vector>

#include "lightdb/light.h"
#include "lightdb/vessel.h"

namespace seaglare::lightdb {

// Nautical miles at which a vessel's lights must be visible: Rule 22.
struct ColregRanges {
    double masthead_nm = 0;
    double sidelight_nm = 0;
    double sternlight_nm = 0;  // and the towing light
    double all_round_nm = 0;
};
ColregRanges colreg_ranges(double length_m);
inline constexpr double submerged_tow_range_nm = 3;   // Rule 22(d), whatever the length
inline constexpr double fishing_signal_range_nm = 1;  // Annex II section 1

// Arcs in degrees outward from ahead, clockwise, with their edges.
std::vector<Sector> masthead_arc();  // 225 degrees: to 22.5 abaft either beam; white
std::vector<Sector> sidelight_arc(
    Side side);  // 112.5 degrees: from ahead to 22.5 abaft her own beam; red or green
std::vector<Sector> stern_arc(Colour colour);  // 135 degrees: white, or yellow for a towing light

struct LampPlace {
    double x_m = 0;  // to starboard of the centreline
    double y_m = 0;  // ahead of amidships
    double z_m = 0;  // above the hull
};

// A light of one colour all round; the arcs above make it another. `rule` is what the light's source will say.
Light colreg_lamp(const Vessel& vessel, const std::string& name, Colour colour, double range_nm,
                  const LampPlace& place, const std::string& rule);

}  // namespace seaglare::lightdb
