#include "lightdb/colreg.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lightdb/colreg_rules.h"

namespace seaglare::lightdb {

namespace {

using Kind = VesselKind;

LineNeeds line_needs(const Vessel& vessel) {
    LineNeeds needs;
    switch (vessel.kind) {
        case Kind::towing:
        case Kind::pushing:
            needs.lights = vessel.restricted_by_tow ? 3 : 0;
            break;
        case Kind::restricted:
        case Kind::constrained_by_draught:
            needs.lights = 3;
            break;
        case Kind::not_under_command:
        case Kind::pilot:
        case Kind::aground:
            needs.lights = 2;
            break;
        case Kind::trawling:
        case Kind::fishing:
            needs.lights = 2;
            needs.fishing = true;
            break;
        case Kind::air_cushion:
            needs.lights = 1;
            break;
        default:
            break;
    }
    needs.above_obstruction_lights = vessel.obstruction_side != Side::none;
    return needs;
}

}  // namespace

ColregRules::ColregRules(const Vessel& vessel)
    : vessel_(vessel),
      ranges_(colreg_ranges(vessel.length_m)),
      place_(place_vessel(vessel, line_needs(vessel))) {}

const char* colreg_colour_word(Colour colour) {
    switch (colour) {
        case Colour::red:
            return "red";
        case Colour::green:
            return "green";
        case Colour::yellow:
            return "yellow";
        default:
            return "white";
    }
}

void ColregRules::mastheads(const std::string& rule) {
    const LampPlace forward = {0, place_.forward_y_m, place_.forward_z_m};
    if (!place_.two_masts) {
        masthead("masthead light", forward, rule + "(i)");
        return;
    }
    masthead("forward masthead light", forward, rule + "(i)");
    masthead("after masthead light", {0, place_.main_y_m, place_.after_z_m}, rule + "(ii)");
}

// Two or three in a vertical line instead of one. The lowest stands where the masthead light of her mast would: Annex I
// section 2(e). With two masts it is the after one that carries them.
void ColregRules::towing_mastheads(int lights, const std::string& rule) {
    if (place_.two_masts)
        masthead("forward masthead light", {0, place_.forward_y_m, place_.forward_z_m},
                 "Rules 24(d), 23(a)(i)");
    const double lowest_m = place_.two_masts ? place_.after_z_m : place_.forward_z_m;
    static constexpr const char* names_of_two[] = {"upper", "lower"};
    static constexpr const char* names_of_three[] = {"upper", "middle", "lower"};
    for (int i = 0; i < lights; ++i) {
        const std::string which = lights == 2 ? names_of_two[i] : names_of_three[i];
        masthead(which + " towing masthead light",
                 {0, place_.main_y_m, lowest_m + (lights - 1 - i) * place_.spacing_m}, rule);
    }
}

void ColregRules::sidelights(double y_m, double z_m, const std::string& rule) {
    add("port sidelight", Colour::red, ranges_.sidelight_nm, {-place_.side_x_m, y_m, z_m}, rule).sectors =
        sidelight_arc(Side::port);
    add("starboard sidelight", Colour::green, ranges_.sidelight_nm, {place_.side_x_m, y_m, z_m}, rule)
        .sectors = sidelight_arc(Side::starboard);
}

void ColregRules::sternlight(const std::string& rule) {
    add("sternlight", Colour::white, ranges_.sternlight_nm, {0, place_.stern_y_m, place_.stern_z_m}, rule)
        .sectors = stern_arc(Colour::white);
}

void ColregRules::line(std::initializer_list<Colour> colours, const LampPlace& top, double range_nm,
                       const std::string& what, const std::string& rule) {
    const auto count = static_cast<int>(colours.size());
    int i = 0;
    for (const Colour colour : colours) {
        const char* const position = i == 0 ? "upper" : i == count - 1 ? "lower" : "middle";
        add(std::string(position) + " all-round " + colreg_colour_word(colour) + " light" + what, colour,
            range_nm, {top.x_m, top.y_m, top.z_m - i * place_.spacing_m}, rule);
        ++i;
    }
}

// Rule 30(a), (b); Annex I section 2(k).
void ColregRules::anchor_lights(const std::string& rule) {
    const bool large = vessel_.length_m >= 50;
    const double fore_y_m = 0.45 * vessel_.length_m;
    if (!large && !vessel_.two_anchor_lights) {
        // Not so high that it would count as an all-round light of a masthead, nor below what stands in a line.
        all_round("anchor light", Colour::white, {0, fore_y_m, place_.lowest_m}, rule + "(b)");
        return;
    }
    constexpr double above_the_after_m = 4.5;
    const double least_m = large ? 6 : place_.lowest_m;
    const double forward_z_m = std::max(least_m, place_.stern_z_m + above_the_after_m);
    all_round("forward anchor light", Colour::white, {0, fore_y_m, forward_z_m}, rule + "(a)(i)");
    all_round("after anchor light", Colour::white, {0, place_.stern_y_m, place_.stern_z_m}, rule + "(a)(ii)");
}

// Working lights 2 m above the deck, along both sides: the rule asks that the decks be lit, not with what.
void ColregRules::deck_lights(const std::string& rule) {
    if (!vessel_.deck_lights_cd || *vessel_.deck_lights_cd == 0) return;
    constexpr double apart_m = 25;
    const int pairs = std::max(2, static_cast<int>(vessel_.length_m / apart_m));
    for (int i = 0; i < pairs; ++i) {
        const double y_m = vessel_.length_m * ((i + 0.5) / pairs - 0.5);
        for (const double side : {-1.0, 1.0}) {
            Light& light = add("working light " + std::to_string(2 * i + (side < 0 ? 1 : 2)), Colour::white,
                               1, {side * 0.45 * vessel_.breadth_m, y_m, 2}, rule);
            light.intensity_cd[static_cast<std::size_t>(Colour::white)] = *vessel_.deck_lights_cd;
        }
    }
}

void ColregRules::power_driven() {
    if (vessel_.all_round_white) {
        all_round("all-round white light", Colour::white, {0, place_.forward_y_m, place_.forward_z_m},
                  "Rule 23(d)(i)");
        if (!vessel_.no_sidelights) sidelights("Rule 23(d)(i)");
        return;
    }
    mastheads("Rule 23(a)");
    sidelights("Rule 23(a)(iii)");
    sternlight("Rule 23(a)(iv)");
}

void ColregRules::towing() {
    const bool astern = vessel_.kind == Kind::towing;
    const std::string rule = astern ? "Rule 24(a)" : "Rule 24(c)";
    constexpr double long_tow_m = 200;
    towing_mastheads(vessel_.tow_length_m > long_tow_m ? 3 : 2, rule + "(i)");
    sidelights(rule + "(ii)");
    sternlight(rule + "(iii)");
    if (astern) {
        add("towing light", Colour::yellow, ranges_.sternlight_nm,
            {0, place_.stern_y_m, place_.stern_z_m + place_.spacing_m}, rule + "(iv)")
            .sectors = stern_arc(Colour::yellow);
    }
    if (vessel_.restricted_by_tow) line({Colour::red, Colour::white, Colour::red}, "Rule 27(c)");
}

// Rule 24(g): white all-round lights at both ends and, from 25 m of breadth, at both sides; no more than 100 m apart.
void ColregRules::towed_submerged() {
    const double half_m = vessel_.length_m / 2;
    constexpr double above_hull_m = 1;  // ours
    const auto white = [&](const std::string& name, double x_m, double y_m, const char* rule) {
        add(name, Colour::white, submerged_tow_range_nm, {x_m, y_m, above_hull_m}, rule);
    };
    white("forward all-round white light", 0, half_m, "Rule 24(g)(i)");
    white("after all-round white light", 0, -half_m, "Rule 24(g)(i)");
    if (vessel_.breadth_m >= 25) {
        white("port all-round white light", -vessel_.breadth_m / 2, 0, "Rule 24(g)(ii)");
        white("starboard all-round white light", vessel_.breadth_m / 2, 0, "Rule 24(g)(ii)");
    }
    const int gaps = static_cast<int>(std::ceil(vessel_.length_m / 100));
    for (int i = 1; i < gaps; ++i)
        white("all-round white light " + std::to_string(i), 0, half_m - vessel_.length_m * i / gaps,
              "Rule 24(g)(iii)");
}

void ColregRules::sailing() {
    // Ours where none is given: a mast 1.2 times her length, 50 m at the most.
    const double top_m =
        vessel_.mast_height_m > 0 ? vessel_.mast_height_m : std::min(1.2 * vessel_.length_m, 50.0);
    const LampPlace top = {0, place_.main_y_m, top_m};
    if (vessel_.tricolour) {
        const double range_nm = ranges_.sidelight_nm;
        add("tricolour lantern, port", Colour::red, range_nm, top, "Rule 25(b)").sectors =
            sidelight_arc(Side::port);
        add("tricolour lantern, starboard", Colour::green, range_nm, top, "Rule 25(b)").sectors =
            sidelight_arc(Side::starboard);
        add("tricolour lantern, stern", Colour::white, ranges_.sternlight_nm, top, "Rule 25(b)").sectors =
            stern_arc(Colour::white);
        return;
    }
    sidelights("Rule 25(a)(i)");
    sternlight("Rule 25(a)(ii)");
    if (vessel_.red_over_green)
        line({Colour::red, Colour::green}, top, ranges_.all_round_nm, "", "Rule 25(c)");
}

std::vector<Light> ColregRules::all() {
    const double fore_end_m = 0.45 * vessel_.length_m;
    switch (vessel_.kind) {
        case Kind::power_driven:
            power_driven();
            break;
        case Kind::air_cushion: {
            power_driven();
            Light& light = add("flashing yellow light", Colour::yellow, ranges_.all_round_nm,
                               {0, place_.main_y_m, place_.line_top_m}, "Rule 23(b)");
            // 120 flashes a minute, the least of Rule 21(f).
            light.character.clear();
            light.rhythm.phases = {{0.25, true, Colour::yellow}, {0.25, false, Colour::white}};
            light.rhythm.period_s = 0.5;
            break;
        }
        case Kind::towing:
        case Kind::pushing:
            towing();
            break;
        case Kind::towed:
            sidelights("Rule 24(e)(i)");
            sternlight("Rule 24(e)(ii)");
            break;
        case Kind::pushed_ahead:
            sidelights(fore_end_m, place_.side_z_m, "Rule 24(f)(i)");
            break;
        case Kind::towed_alongside:
            sidelights(fore_end_m, place_.side_z_m, "Rule 24(f)(ii)");
            sternlight("Rule 24(f)(ii)");
            break;
        case Kind::towed_submerged:
            towed_submerged();
            break;
        case Kind::sailing:
            sailing();
            break;
        case Kind::trawling:
            trawling();
            break;
        case Kind::fishing:
            fishing();
            break;
        case Kind::not_under_command:
            if (vessel_.making_way) {
                sidelights("Rule 27(a)(iii)");
                sternlight("Rule 27(a)(iii)");
            }
            line({Colour::red, Colour::red}, "Rule 27(a)(i)");
            break;
        case Kind::restricted:
            restricted();
            break;
        case Kind::mine_clearance:
            mine_clearance();
            break;
        case Kind::constrained_by_draught:
            power_driven();
            line({Colour::red, Colour::red, Colour::red}, "Rule 28");
            break;
        case Kind::pilot:
            pilot();
            break;
        case Kind::at_anchor:
            anchor_lights("Rule 30");
            deck_lights("Rule 30(c)");
            break;
        case Kind::aground:
            anchor_lights("Rules 30(d), 30");
            // Under 12 m she need not show them: Rule 30(f).
            if (vessel_.length_m >= 12) line({Colour::red, Colour::red}, "Rule 30(d)(i)");
            deck_lights("Rule 30(c)");
            break;
    }
    if (vessel_.at_anchor) deck_lights("Rule 30(c)");
    return std::move(lights_);
}

std::vector<Light> colreg_lights(const Vessel& vessel) {
    check_vessel(vessel);
    return ColregRules(vessel).all();
}

std::vector<std::string> colreg_notes(const Vessel& vessel) {
    std::vector<std::string> notes;
    // Rule 27(d)(iii) puts other lights in the place of all of Rule 30.
    const bool by_rule_30 =
        vessel.kind == Kind::at_anchor || (vessel.at_anchor && vessel.obstruction_side == Side::none);
    if (by_rule_30 && vessel.length_m >= 100 && !vessel.deck_lights_cd) {
        notes.emplace_back(
            "of 100 m and more at anchor she shall also light her decks (COLREG Rule 30(c)): give "
            "'deck_lights_cd'");
    }
    return notes;
}

}  // namespace seaglare::lightdb
