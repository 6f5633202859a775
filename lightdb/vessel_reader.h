// A vessel of a light file, from its JSON object to her lights.
//
//     "vessels": [ { "name": "Skagerrak", "kind": "power_driven", "length_m": 180, "breadth_m": 28,
//         "body": 7,                                    the host moves her; or, for one that lies still:
//         "position": [1200, 3400], "heading_deg": 40,  east and north of the origin, or "lat" and "lon"
//         "making_way": true, "at_anchor": false, "tow_length_m": 250, "restricted_by_tow": false,
//         "obstruction_side": "port", "gear_extent_m": 200, "gear_bearing_deg": 90,
//         "fishing_signal": "hauling_nets", "second_masthead": false, "all_round_white": false, "no_sidelights": false,
//         "combined_sidelights": false, "tricolour": false, "red_over_green": false, "two_anchor_lights": false,
//         "deck_lights_cd": 500, "deck_height_m": 8, "mast_height_m": 12, "mast_separation_m": 90,
//         "amidships": [0, 0, 0], "intensity_factor": 1.5, "radius_m": 0.05, "day": "off", "source": "…" } ]
//
// What each key means: vessel.h.
#pragma once

#include <string>
#include <vector>

#include "lightdb/json/value.h"
#include "lightdb/light.h"

namespace seaglare::lightdb {

// Her lights, on her body, or fixed to the world where she has a place and a heading of her own; a heading counts from
// the scene's north. Throws json::Error that points at what is wrong; appends to `warnings` ("FILE:LINE:COL: text").
std::vector<Light> read_vessel(const json::Value& value, const std::string& default_source,
                               std::vector<std::string>& warnings);

}  // namespace seaglare::lightdb
