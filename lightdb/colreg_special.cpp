// Who fishes, who is restricted in her ability to manoeuvre, who brings a pilot: COLREG Rules 26, 27, 29 and Annex II.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "lightdb/colreg_rules.h"

namespace seaglare::lightdb {

void ColregRules::trawling() {
    // Abaft of and higher than the green light: section (b)(ii). Under 50 m she need not carry it.
    if (place_.two_masts) {
        const double behind_m = std::min(2.0, 0.05 * vessel_.length_m);
        masthead("masthead light", {0, place_.main_y_m - behind_m, place_.after_z_m}, "Rule 26(b)(ii)");
    }
    if (vessel_.making_way) {
        sidelights("Rule 26(b)(iii)");
        sternlight("Rule 26(b)(iii)");
    }
    line({Colour::green, Colour::white}, "Rule 26(b)(i)");
    trawl_signal();
}

// At least 0.9 m apart and lower than the lights of Rule 26: Annex II section 1.
void ColregRules::trawl_signal() {
    constexpr double apart_m = 0.9;
    const LampPlace top = {1, place_.main_y_m, place_.line_top_m - place_.spacing_m - 1};
    const auto two = [&](Colour upper, Colour lower, const char* rule) {
        add(std::string("upper signal light, ") + colreg_colour_word(upper), upper, fishing_signal_range_nm,
            top, rule);
        add(std::string("lower signal light, ") + colreg_colour_word(lower), lower, fishing_signal_range_nm,
            {top.x_m, top.y_m, top.z_m - apart_m}, rule);
    };
    switch (vessel_.fishing_signal) {
        case FishingSignal::shooting_nets:
            two(Colour::white, Colour::white, "Annex II section 2(a)(i)");
            break;
        case FishingSignal::hauling_nets:
            two(Colour::white, Colour::red, "Annex II section 2(a)(ii)");
            break;
        case FishingSignal::nets_fast:
            two(Colour::red, Colour::red, "Annex II section 2(a)(iii)");
            break;
        default:
            break;
    }
}

// Two yellow lights in a vertical line that flash in turn every second, as long lit as dark: Annex II section 3.
void ColregRules::purse_seine_signal(double top_z_m) {
    constexpr double apart_m = 0.9;
    for (int i = 0; i < 2; ++i) {
        Light& light =
            add(i == 0 ? "upper purse seine light" : "lower purse seine light", Colour::yellow,
                fishing_signal_range_nm, {1, place_.main_y_m, top_z_m - i * apart_m}, "Annex II section 3");
        light.character.clear();
        light.rhythm.phases = {{1, true, Colour::yellow}, {1, false, Colour::white}};
        light.rhythm.period_s = 2;
        light.rhythm.delay_s = i;
        light.rhythm.sync_group = "purse seine of " + vessel_.name + std::to_string(vessel_.body_id);
    }
}

void ColregRules::fishing() {
    if (vessel_.making_way) {
        sidelights("Rule 26(c)(iii)");
        sternlight("Rule 26(c)(iii)");
    }
    line({Colour::red, Colour::white}, "Rule 26(c)(i)");
    const double white_z_m = place_.line_top_m - place_.spacing_m;
    constexpr double long_gear_m = 150;
    if (vessel_.gear_extent_m > long_gear_m) {
        // 2 to 6 m from the two lights, not above the white one, not below the sidelights: Annex I section 4(a).
        constexpr double away_m = 4;
        const double bearing_rad = vessel_.gear_bearing_deg * std::numbers::pi / 180;
        all_round("all-round white light towards the gear", Colour::white,
                  {away_m * std::sin(bearing_rad), place_.main_y_m + away_m * std::cos(bearing_rad),
                   (white_z_m + place_.side_z_m) / 2},
                  "Rule 26(c)(ii)");
    }
    if (vessel_.fishing_signal == FishingSignal::purse_seine) purse_seine_signal(white_z_m - 1);
}

// Red on the side of the obstruction, green where others may pass: Rule 27(d).
void ColregRules::obstruction() {
    const double to_obstruction = vessel_.obstruction_side == Side::port ? -1 : 1;
    const double top_z_m = place_.lowest_m + place_.spacing_m;
    const double x_m = place_.obstruction_x_m;
    line({Colour::red, Colour::red}, {to_obstruction * x_m, place_.main_y_m, top_z_m}, ranges_.all_round_nm,
         ", obstructed side", "Rule 27(d)(i)");
    line({Colour::green, Colour::green}, {-to_obstruction * x_m, place_.main_y_m, top_z_m},
         ranges_.all_round_nm, ", clear side", "Rule 27(d)(ii)");
}

void ColregRules::restricted() {
    const bool works_under_water = vessel_.obstruction_side != Side::none;
    if (!vessel_.at_anchor && vessel_.making_way) {
        mastheads("Rules 27(b)(iii), 23(a)");
        sidelights("Rule 27(b)(iii)");
        sternlight("Rule 27(b)(iii)");
    }
    // Dredging at anchor she shows no anchor lights: Rule 27(d)(iii).
    if (vessel_.at_anchor && !works_under_water) anchor_lights("Rules 27(b)(iv), 30");
    line({Colour::red, Colour::white, Colour::red}, "Rule 27(b)(i)");
    if (works_under_water) obstruction();
}

// Three green lights, one near the foremast head and one at each end of the fore yard: Rule 27(f).
void ColregRules::mine_clearance() {
    if (vessel_.at_anchor) {
        anchor_lights("Rules 27(f), 30");
    } else {
        power_driven();
    }
    const double top_m = place_.forward_z_m - 0.5 * place_.spacing_m;
    const double yard_m = std::max(1.0, 0.3 * vessel_.breadth_m);
    const double y_m = place_.forward_y_m;
    all_round("all-round green light, foremast head", Colour::green, {0, y_m, top_m}, "Rule 27(f)");
    all_round("all-round green light, port yardarm", Colour::green, {-yard_m, y_m, top_m - place_.spacing_m},
              "Rule 27(f)");
    all_round("all-round green light, starboard yardarm", Colour::green,
              {yard_m, y_m, top_m - place_.spacing_m}, "Rule 27(f)");
}

void ColregRules::pilot() {
    if (vessel_.at_anchor) {
        anchor_lights("Rules 29(a)(iii), 30");
    } else {
        sidelights("Rule 29(a)(ii)");
        sternlight("Rule 29(a)(ii)");
    }
    line({Colour::white, Colour::red}, "Rule 29(a)(i)");
}

}  // namespace seaglare::lightdb
