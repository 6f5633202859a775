#include "lightdb/colreg_placement.h"

#include <algorithm>
#include <cstdio>

namespace seaglare::lightdb {

namespace {

constexpr double after_above_forward_m = 4.5;  // Annex I section 2(a)(ii)

// Annex I section 2(b): from 1000 m before the stem, at the water, the after light stands above the forward one and apart.
constexpr double seen_from_m = 1000;
constexpr double seen_apart_rad = 1e-3;  // our reading of "separate": three times what the eye resolves

// Ours. The forward mast, when there are two, an eighth of the length from the stem: the rule allows a quarter. A single
// mast an eighth of the length forward of amidships. Sidelights two thirds as high as the masthead light: the rule allows
// three quarters.
constexpr double forward_mast_from_stem = 1.0 / 8;
constexpr double single_mast_ahead = 1.0 / 8;
constexpr double sidelight_height = 2.0 / 3;

std::string metres(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f m", value);
    return text;
}

double masthead_height_m(const Vessel& vessel) {
    const double least_m = least_masthead_height_m(vessel.length_m, vessel.breadth_m);
    if (vessel.mast_height_m == 0 || vessel.kind == VesselKind::sailing) return least_m;
    if (vessel.mast_height_m < least_m) {
        throw VesselError("mast_height_m",
                          "is less than " + metres(least_m) + " above the hull (COLREG Annex I section 2)");
    }
    return vessel.mast_height_m;
}

double separation_m(const Vessel& vessel) {
    const double least_m = std::min(vessel.length_m / 2, 100.0);  // Annex I section 3(a)
    if (vessel.mast_separation_m == 0) return least_m;
    if (vessel.mast_separation_m < least_m) {
        throw VesselError("mast_separation_m",
                          "is less than " + metres(least_m) + " (COLREG Annex I section 3(a))");
    }
    return vessel.mast_separation_m;
}

double after_height_m(const Vessel& vessel, const Placement& place) {
    const double hull_m = hull_height_m(vessel);
    const double to_forward_m = seen_from_m + vessel.length_m / 2 - place.forward_y_m;
    const double to_after_m = seen_from_m + vessel.length_m / 2 - place.main_y_m;
    const double seen_over_m =
        to_after_m * ((hull_m + place.forward_z_m) / to_forward_m + seen_apart_rad) - hull_m;
    return std::max(place.forward_z_m + after_above_forward_m, seen_over_m);
}

}  // namespace

double hull_height_m(const Vessel& vessel) {
    if (vessel.deck_height_m > 0) return vessel.deck_height_m;
    return std::min(0.5 + 0.04 * vessel.length_m, 15.0);
}

double line_spacing_m(double length_m) {
    return length_m >= 20 ? 2 : 1;
}

double line_lowest_m(double length_m) {
    return length_m >= 20 ? 4 : 2;
}

double least_masthead_height_m(double length_m, double breadth_m) {
    if (length_m >= 20) return std::clamp(breadth_m, 6.0, 12.0);
    if (length_m >= 12) return 2.5;
    return 2;  // ours: the rule asks only for 1 m above the sidelights
}

Placement place_vessel(const Vessel& vessel, const LineNeeds& line) {
    const double length_m = vessel.length_m;
    const bool large = length_m >= 20;
    Placement place;
    place.two_masts = length_m >= 50 || vessel.second_masthead;
    place.spacing_m = line_spacing_m(length_m);
    place.lowest_m = line_lowest_m(length_m);
    place.forward_z_m = masthead_height_m(vessel);
    // A combined lantern stands at least 1 m below the masthead light, and so do the sidelights of the smallest vessels:
    // Annex I section 2(d), (h). Section 2(g): not above three quarters of its height.
    place.side_z_m = large ? sidelight_height * place.forward_z_m : std::min(place.forward_z_m - 1, 1.5);

    // Masthead lights stand above and clear of all others, section 2(f)(i): a mast too short for the line is made longer.
    if (line.lights > 0) {
        double bottom_m = place.lowest_m;
        if (line.above_obstruction_lights) bottom_m += place.spacing_m;
        if (line.fishing) bottom_m = std::max(bottom_m, place.side_z_m + 2 * place.spacing_m);
        const double needed_m = bottom_m + line.lights * place.spacing_m;
        if (place.forward_z_m < needed_m) {
            if (vessel.mast_height_m > 0) {
                throw VesselError("mast_height_m",
                                  "leaves no room for the lights below the masthead light: they need " +
                                      metres(needed_m) + " above the hull (COLREG Annex I section 2)");
            }
            place.forward_z_m = needed_m;
        }
        place.line_top_m = place.forward_z_m - place.spacing_m;
    }

    if (place.two_masts) {
        place.forward_y_m = length_m * (0.5 - forward_mast_from_stem);
        place.main_y_m = place.forward_y_m - separation_m(vessel);
        if (place.main_y_m < -length_m / 2)
            throw VesselError("mast_separation_m", "puts the after mast behind the stern");
        place.after_z_m = after_height_m(vessel, place);
    } else {
        place.forward_y_m = place.main_y_m = length_m * single_mast_ahead;
    }

    // Near the side, and not before the forward masthead light: section 3(b). By the after mast, where the bridge is.
    place.side_x_m = vessel.combined_sidelights ? 0 : 0.48 * vessel.breadth_m;
    place.side_y_m = place.main_y_m;
    place.stern_y_m = -length_m / 2;
    place.stern_z_m = large ? 2.5 : 1;  // ours: no rule says
    // As far out as can be, and at least 2 m from the line on the centreline: section 4(b).
    place.obstruction_x_m = std::max(2.0, 0.48 * vessel.breadth_m);
    return place;
}

}  // namespace seaglare::lightdb
