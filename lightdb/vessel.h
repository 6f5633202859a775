// A vessel as the rules of the road see her: what she is, what she is doing, how large she is. The lights that follow
// are in colreg.h.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace seaglare::lightdb {

// What she is or does, with the rule of COLREG 1972 that gives her lights.
enum class VesselKind : std::uint8_t {
    power_driven,            // under way: 23(a), (d); a rigid composite unit counts as one: 24(b)
    air_cushion,             // in the non-displacement mode: 23(b)
    towing,                  // astern: 24(a), 27(c)
    pushing,                 // ahead, or towing alongside: 24(c)
    towed,                   // astern: 24(e)
    pushed_ahead,            // not part of a composite unit: 24(f)(i)
    towed_alongside,         // 24(f)(ii)
    towed_submerged,         // an inconspicuous, partly submerged vessel or object: 24(g)
    sailing,                 // 25
    trawling,                // 26(b)
    fishing,                 // other than trawling: 26(c)
    not_under_command,       // 27(a)
    restricted,              // in her ability to manoeuvre, but by mines or a tow: 27(b), (d)
    mine_clearance,          // 27(f)
    constrained_by_draught,  // 28
    pilot,                   // on pilotage duty: 29
    at_anchor,               // 30(a) to (c)
    aground                  // 30(d)
};
inline constexpr int vessel_kind_count = 18;

enum class Side : std::uint8_t { none, port, starboard };

// Signals of vessels that fish close together: COLREG Annex II sections 2 and 3.
enum class FishingSignal : std::uint8_t { none, shooting_nets, hauling_nets, nets_fast, purse_seine };

// Lengths in metres. Fields that a kind does not use must keep their defaults: colreg_lights() refuses what contradicts.
struct Vessel {
    std::string name;
    VesselKind kind = VesselKind::power_driven;
    double length_m = 0;   // over all
    double breadth_m = 0;  // greatest
    std::uint32_t body_id = 0;

    // Not under command, restricted, fishing, trawling: sidelights and sternlight are for her who moves through the water.
    bool making_way = true;
    bool at_anchor = false;  // restricted, mine clearance, pilot
    double tow_length_m =
        0;  // towing: from her stern to the after end of the tow; more than 200 m has a third light
    bool restricted_by_tow =
        false;  // towing: severely restricted in her ability to deviate from her course, 27(c)
    Side obstruction_side =
        Side::none;                // restricted, dredging or under-water work: where others must not pass
    double gear_extent_m = 0;      // fishing: outlying gear, horizontally; more than 150 m has a light
    double gear_bearing_deg = 90;  // its direction, clockwise from ahead
    FishingSignal fishing_signal = FishingSignal::none;

    // What the rules leave to her.
    bool second_masthead = false;  // under 50 m: an after masthead light all the same
    bool all_round_white =
        false;  // power-driven, under 12 m: instead of masthead light and sternlight, 23(d)(i)
    bool no_sidelights = false;  // power-driven, under 7 m and at most 7 knots, all_round_white: 23(d)(ii)
    bool combined_sidelights = false;  // under 20 m: one lantern on the centreline, 21(b)
    bool tricolour = false;            // sailing, under 20 m: one lantern at the top of the mast, 25(b)
    bool red_over_green = false;       // sailing: all-round lights at the top of the mast, 25(c)
    bool two_anchor_lights = false;    // under 50 m: two all the same, 30(b)
    std::optional<double>
        deck_lights_cd;  // at anchor, aground: each of the working lights along her sides, 30(c)

    // Where she is not as we assume. 0: our default, in colreg_placement.h.
    double deck_height_m = 0;      // of the uppermost continuous deck ("hull") above the water
    double mast_height_m = 0;      // of the forward masthead light above the hull; sailing: of the masthead
    double mast_separation_m = 0;  // horizontally, from the forward masthead light to the after one
    std::array<double, 3>
        amidships_m{};  // half her length, on the centreline, at the water, in the frame of the body
    double intensity_factor = 1;  // of her lamps over the least that the rules allow
    double radius_m = 0.05;       // of each lamp
    bool day_off = false;
};

// What is wrong with a vessel, and in which field.
class VesselError : public std::invalid_argument {
  public:
    VesselError(std::string_view field, const std::string& text)
        : std::invalid_argument("'" + std::string(field) + "' " + text), field_(field) {}
    const std::string& field() const { return field_; }

  private:
    std::string field_;
};

// Throws VesselError for what is out of range or what the rules do not know for such a vessel.
void check_vessel(const Vessel& vessel);

// The kinds' names in files, in the order of the enumeration: "power_driven" …
std::span<const std::string_view> vessel_kind_names();

}  // namespace seaglare::lightdb
