#include "lightdb/vessel.h"

#include <cmath>
#include <cstdio>
#include <initializer_list>

namespace seaglare::lightdb {

namespace {

constexpr std::string_view kind_names[vessel_kind_count] = {
    "power_driven", "air_cushion",       "towing",          "pushing",        "towed",
    "pushed_ahead", "towed_alongside",   "towed_submerged", "sailing",        "trawling",
    "fishing",      "not_under_command", "restricted",      "mine_clearance", "constrained_by_draught",
    "pilot",        "at_anchor",         "aground",
};

void check_number(double value, double low, double high, std::string_view field) {
    if (value >= low && value <= high) return;
    char text[96];
    std::snprintf(text, sizeof text, "is %g: it must lie between %g and %g", value, low, high);
    throw VesselError(field, text);
}

class KindCheck {
  public:
    explicit KindCheck(const Vessel& vessel) : vessel_(vessel) {}

    bool is(std::initializer_list<VesselKind> kinds) const {
        for (const VesselKind kind : kinds)
            if (vessel_.kind == kind) return true;
        return false;
    }
    // An option that is set needs one of these kinds.
    void option(bool set, std::string_view field, std::initializer_list<VesselKind> kinds,
                const char* rule) const {
        if (set && !is(kinds))
            throw VesselError(field, "is not for this kind of vessel: " + std::string(rule));
    }
    void shorter_than(bool set, std::string_view field, double limit_m, const char* rule) const {
        if (!set || vessel_.length_m < limit_m) return;
        char text[96];
        std::snprintf(text, sizeof text, "is for vessels of less than %g m in length: ", limit_m);
        throw VesselError(field, text + std::string(rule));
    }

  private:
    const Vessel& vessel_;
};

void check_numbers(const Vessel& vessel) {
    check_number(vessel.length_m, 1, 1000, "length_m");
    check_number(vessel.breadth_m, 0.2, 300, "breadth_m");
    check_number(vessel.tow_length_m, 0, 10000, "tow_length_m");
    check_number(vessel.gear_extent_m, 0, 10000, "gear_extent_m");
    check_number(vessel.gear_bearing_deg, -360, 360, "gear_bearing_deg");
    if (vessel.deck_lights_cd) check_number(*vessel.deck_lights_cd, 0, 1e6, "deck_lights_cd");
    check_number(vessel.deck_height_m, 0, 60, "deck_height_m");
    check_number(vessel.mast_height_m, 0, 150, "mast_height_m");
    check_number(vessel.mast_separation_m, 0, 1000, "mast_separation_m");
    for (const double coordinate_m : vessel.amidships_m)
        check_number(coordinate_m, -1000, 1000, "amidships");
    check_number(vessel.intensity_factor, 1, 100, "intensity_factor");
    check_number(vessel.radius_m, 1e-3, 10, "radius_m");
}

}  // namespace

void check_vessel(const Vessel& vessel) {
    using Kind = VesselKind;
    check_numbers(vessel);
    const KindCheck check(vessel);
    check.option(vessel.at_anchor, "at_anchor", {Kind::restricted, Kind::mine_clearance, Kind::pilot},
                 "COLREG Rules 27(b)(iv), (f), 29(a)(iii); a vessel that merely lies at anchor is of the "
                 "kind at_anchor");
    check.option(!vessel.making_way, "making_way",
                 {Kind::not_under_command, Kind::restricted, Kind::trawling, Kind::fishing},
                 "only COLREG Rules 26 and 27 tell who makes way from who does not");
    check.option(vessel.tow_length_m > 0, "tow_length_m", {Kind::towing}, "COLREG Rule 24(a)(i)");
    check.option(vessel.restricted_by_tow, "restricted_by_tow", {Kind::towing, Kind::pushing},
                 "COLREG Rule 27(c)");
    check.option(vessel.obstruction_side != Side::none, "obstruction_side", {Kind::restricted},
                 "COLREG Rule 27(d)");
    check.option(vessel.gear_extent_m > 0, "gear_extent_m", {Kind::fishing}, "COLREG Rule 26(c)(ii)");
    const FishingSignal signal = vessel.fishing_signal;
    check.option(signal != FishingSignal::none, "fishing_signal",
                 {signal == FishingSignal::purse_seine ? Kind::fishing : Kind::trawling},
                 "COLREG Annex II has signals for trawlers and one for purse seiners, who fish otherwise");
    check.option(vessel.second_masthead, "second_masthead",
                 {Kind::power_driven, Kind::air_cushion, Kind::towing, Kind::pushing, Kind::trawling,
                  Kind::restricted, Kind::mine_clearance, Kind::constrained_by_draught},
                 "she shows no masthead light");
    check.option(vessel.all_round_white, "all_round_white", {Kind::power_driven}, "COLREG Rule 23(d)(i)");
    check.shorter_than(vessel.all_round_white, "all_round_white", 12, "COLREG Rule 23(d)(i)");
    check.option(vessel.no_sidelights, "no_sidelights", {Kind::power_driven}, "COLREG Rule 23(d)(ii)");
    check.shorter_than(vessel.no_sidelights, "no_sidelights", 7, "COLREG Rule 23(d)(ii)");
    if (vessel.no_sidelights && !vessel.all_round_white)
        throw VesselError("no_sidelights", "goes with 'all_round_white': COLREG Rule 23(d)(ii)");
    check.shorter_than(vessel.combined_sidelights, "combined_sidelights", 20, "COLREG Rule 21(b)");
    check.option(vessel.tricolour, "tricolour", {Kind::sailing}, "COLREG Rule 25(b)");
    check.shorter_than(vessel.tricolour, "tricolour", 20, "COLREG Rule 25(b)");
    check.option(vessel.red_over_green, "red_over_green", {Kind::sailing}, "COLREG Rule 25(c)");
    if (vessel.tricolour && vessel.red_over_green)
        throw VesselError("red_over_green", "does not go with 'tricolour': COLREG Rule 25(c)");
    const bool lies = check.is({Kind::at_anchor, Kind::aground}) || vessel.at_anchor;
    if (vessel.two_anchor_lights && !lies)
        throw VesselError("two_anchor_lights", "is for vessels at anchor or aground: COLREG Rule 30");
    if (vessel.deck_lights_cd && !lies)
        throw VesselError("deck_lights_cd", "is for vessels at anchor or aground: COLREG Rule 30(c)");
    if (vessel.mast_separation_m > 0 && vessel.length_m < 50 && !vessel.second_masthead)
        throw VesselError("mast_separation_m", "is for vessels with a second masthead light");
}

std::span<const std::string_view> vessel_kind_names() {
    return kind_names;
}

}  // namespace seaglare::lightdb
