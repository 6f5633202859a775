#include "lightdb/colreg_lamps.h"

#include "lightdb/character.h"
#include "lightdb/colreg_placement.h"
#include "lightdb/light_store.h"
#include "lightdb/photometry.h"
#include "lightdb/profile.h"

namespace seaglare::lightdb {

namespace {

constexpr double abaft_the_beam_deg = 22.5;

// Annex I section 9(a)(ii): full intensity to 5 degrees inside the limit, half of it at the limit, dark 5 degrees outside.
constexpr double edge_deg = 10;

// Annex I section 9(a)(i): a sidelight keeps its intensity up to right ahead and is cut off 1 to 3 degrees beyond. Ours
// fades evenly and is dark at 2.
constexpr double ahead_edge_deg = 2;

Sector sector(Colour colour, double from_deg, double to_deg, double transition_deg) {
    Sector result;
    result.colour = colour;
    result.from_deg = from_deg;
    result.to_deg = to_deg;
    result.transition_deg = transition_deg;
    return result;
}

// On charts.
char letter_of(Colour colour) {
    switch (colour) {
        case Colour::red:
            return 'R';
        case Colour::green:
            return 'G';
        case Colour::yellow:
            return 'Y';
        default:
            return 'W';
    }
}

}  // namespace

ColregRanges colreg_ranges(double length_m) {
    if (length_m >= 50) return {6, 3, 3, 3};
    if (length_m >= 20) return {5, 2, 2, 2};
    if (length_m >= 12) return {3, 2, 2, 2};
    return {2, 1, 2, 2};
}

std::vector<Sector> masthead_arc() {
    return {sector(Colour::white, 270 - abaft_the_beam_deg, 90 + abaft_the_beam_deg, edge_deg)};
}

std::vector<Sector> sidelight_arc(Side side) {
    // Two sectors, for each has one width for both of its edges. Where they meet, on the bow, nothing changes.
    constexpr double bow_deg = 45;
    constexpr double beyond_deg = ahead_edge_deg / 2;
    if (side == Side::starboard) {
        return {sector(Colour::green, 360 - beyond_deg, bow_deg, ahead_edge_deg),
                sector(Colour::green, bow_deg, 90 + abaft_the_beam_deg, edge_deg)};
    }
    return {sector(Colour::red, 360 - bow_deg, beyond_deg, ahead_edge_deg),
            sector(Colour::red, 270 - abaft_the_beam_deg, 360 - bow_deg, edge_deg)};
}

std::vector<Sector> stern_arc(Colour colour) {
    return {sector(colour, 90 + abaft_the_beam_deg, 270 - abaft_the_beam_deg, edge_deg)};
}

Light colreg_lamp(const Vessel& vessel, const std::string& name, Colour colour, double range_nm,
                  const LampPlace& place, const std::string& rule) {
    Light light;
    light.name = vessel.name.empty() ? name : vessel.name + ": " + name;
    light.body_id = vessel.body_id;
    light.height_m = hull_height_m(vessel) + place.z_m;
    light.position_m = {vessel.amidships_m[0] + place.x_m, vessel.amidships_m[1] + place.y_m,
                        vessel.amidships_m[2] + light.height_m};
    light.radius_m = vessel.radius_m;
    light.intensity_cd[static_cast<std::size_t>(colour)] =
        colreg_intensity_cd(range_nm) * vessel.intensity_factor;
    light.character = std::string("F ") + letter_of(colour);
    light.rhythm = parse_character(light.character).rhythm;
    light.sector_reference = SectorReference::outward_from_ahead;
    // Section 10(b) is for sailing vessels under way, 10(a) for all others.
    light.vertical =
        *named_vertical_profile(vessel.kind == VesselKind::sailing ? "colreg_sail" : "colreg_power");
    light.day_off = vessel.day_off;
    light.source = "COLREG 1972 " + rule;
    light.stable_key = stable_key_of(light);
    return light;
}

}  // namespace seaglare::lightdb
