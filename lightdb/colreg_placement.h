// Where a vessel carries her lights: COLREG Annex I sections 2, 3 and 4. The rules give least heights and distances; where
// they leave room, what we assume has a name below. Heights are metres above the hull, which is her uppermost continuous
// deck (Annex I section 1), distances ahead of amidships.
#pragma once

#include "lightdb/vessel.h"

namespace seaglare::lightdb {

// Above the water. Our assumption where the vessel gives none: 0.5 m and 4 % of her length, 15 m at the most.
double hull_height_m(const Vessel& vessel);

// Vertical lines of two or three lights: Annex I section 2(i).
double line_spacing_m(double length_m);  // 2 m, under 20 m long 1 m
double line_lowest_m(double length_m);   // 4 m, under 20 m long 2 m

// Of the forward or only masthead light, at least: Annex I section 2(a)(i), (c), (d).
double least_masthead_height_m(double length_m, double breadth_m);

struct Placement {
    bool two_masts = false;  // carries an after masthead light when she shows masthead lights
    double spacing_m = 0;    // of lights in a vertical line
    double lowest_m = 0;     // the lowest of such a line
    double forward_y_m = 0;  // the forward or only mast
    double main_y_m = 0;     // the after mast, or the only one: carries the vertical lines
    double forward_z_m = 0;  // the forward or only masthead light
    double after_z_m = 0;    // the (lowest) after masthead light
    double line_top_m = 0;   // the highest light of the vertical line below it
    double side_x_m = 0;     // sidelights, from the centreline
    double side_y_m = 0;
    double side_z_m = 0;
    double stern_y_m = 0;
    double stern_z_m = 0;
    double obstruction_x_m = 0;  // lights that tell the obstructed from the clear side, from the centreline
};

// How many lights stand in the vertical line, and how high its lowest must be because of others beside it.
struct LineNeeds {
    int lights = 0;
    bool above_obstruction_lights = false;  // Annex I section 4(b)
    bool fishing = false;                   // Annex I section 2(j)
};

// Throws VesselError where the vessel's own mast is too low or her masts too near.
Placement place_vessel(const Vessel& vessel, const LineNeeds& line);

}  // namespace seaglare::lightdb
