// Which lights vessels show by COLREG 1972 as amended, Rules 23 to 30.
#include "lightdb/colreg.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "lightdb/evaluate.h"
#include "lightdb/light_store.h"
#include "lightdb/photometry.h"
#include "tests/unit/vessels.h"

namespace seaglare::lightdb {
namespace {

using Kind = VesselKind;
using test::colour_of;
using test::find;
using test::vessel_of;

std::vector<std::string> names_of(const Vessel& vessel) {
    std::vector<std::string> names;
    for (const Light& light : colreg_lights(vessel))
        names.push_back(light.name);
    return names;
}
using Names = std::vector<std::string>;

const Names sidelights = {"port sidelight", "starboard sidelight"};
Names joined(std::initializer_list<Names> parts) {
    Names result;
    for (const Names& part : parts)
        result.insert(result.end(), part.begin(), part.end());
    return result;
}
const Names under_way = {"port sidelight", "starboard sidelight", "sternlight"};
const Names one_mast = joined({{"masthead light"}, under_way});
const Names two_masts = joined({{"forward masthead light", "after masthead light"}, under_way});

TEST(ColregRule23, PowerDriven) {
    EXPECT_EQ(names_of(vessel_of(Kind::power_driven, 49.99)), one_mast);
    EXPECT_EQ(names_of(vessel_of(Kind::power_driven, 50)), two_masts);
    Vessel small = vessel_of(Kind::power_driven, 49.99);
    small.second_masthead = true;
    EXPECT_EQ(names_of(small), two_masts);
    small = vessel_of(Kind::power_driven, 11.9);
    small.all_round_white = true;
    EXPECT_EQ(names_of(small), joined({{"all-round white light"}, sidelights}));
    small.length_m = 12;
    EXPECT_THROW(names_of(small), VesselError);
    small.length_m = 6.9;
    small.no_sidelights = true;
    EXPECT_EQ(names_of(small), Names{"all-round white light"});
    small.length_m = 7;
    EXPECT_THROW(names_of(small), VesselError);
}

TEST(ColregRule23, AnAirCushionVesselFlashesYellow120TimesAMinute) {
    const std::vector<Light> lights = colreg_lights(vessel_of(Kind::air_cushion, 30));
    const Light& flashing = lights.back();
    EXPECT_EQ(flashing.name, "flashing yellow light");
    EXPECT_EQ(flashing.rhythm.period_s, 0.5);
    EXPECT_EQ(flashing.source, "COLREG 1972 Rule 23(b)");
    EXPECT_EQ(lights.size(), one_mast.size() + 1);
}

TEST(ColregRule24, TowingAsternHasAThirdMastheadLightBeyond200Metres) {
    Vessel tug = vessel_of(Kind::towing, 30);
    const Names astern = joined({under_way, {"towing light"}});
    tug.tow_length_m = 200;
    EXPECT_EQ(names_of(tug),
              joined({{"upper towing masthead light", "lower towing masthead light"}, astern}));
    tug.tow_length_m = 200.1;
    const Names three = {"upper towing masthead light", "middle towing masthead light",
                         "lower towing masthead light"};
    EXPECT_EQ(names_of(tug), joined({three, astern}));
    tug.restricted_by_tow = true;  // 27(c)
    EXPECT_EQ(
        names_of(tug),
        joined({three,
                astern,
                {"upper all-round red light", "middle all-round white light", "lower all-round red light"}}));
    tug.length_m = 50;  // 24(d): the forward light as well
    EXPECT_EQ(names_of(tug).front(), "forward masthead light");
}

TEST(ColregRule24, PushingHasNoTowingLight) {
    EXPECT_EQ(names_of(vessel_of(Kind::pushing, 30)),
              joined({{"upper towing masthead light", "lower towing masthead light"}, under_way}));
}

TEST(ColregRule24, WhatIsTowed) {
    EXPECT_EQ(names_of(vessel_of(Kind::towed, 60)), under_way);
    EXPECT_EQ(names_of(vessel_of(Kind::pushed_ahead, 60)), sidelights);
    EXPECT_EQ(names_of(vessel_of(Kind::towed_alongside, 60)), under_way);
    EXPECT_EQ(names_of(vessel_of(Kind::towed_submerged, 100, 24.9)).size(), 2U);
    EXPECT_EQ(names_of(vessel_of(Kind::towed_submerged, 100, 25)).size(), 4U);
    EXPECT_EQ(names_of(vessel_of(Kind::towed_submerged, 101, 20)).size(), 3U);
    for (const Light& light : colreg_lights(vessel_of(Kind::towed_submerged, 8, 2)))
        EXPECT_DOUBLE_EQ(light.intensity_cd[0], colreg_intensity_cd(3)) << "Rule 22(d), whatever the length";
}

TEST(ColregRule24, LightsOnAnObjectAwashAreNoMoreThan100MetresApart) {
    for (const double length_m : {30.0, 100.0, 150.0, 430.0}) {
        std::vector<double> y;
        for (const Light& light : colreg_lights(vessel_of(Kind::towed_submerged, length_m, 10)))
            y.push_back(light.position_m[1]);
        std::sort(y.begin(), y.end());
        EXPECT_DOUBLE_EQ(y.back() - y.front(), length_m);
        for (std::size_t i = 1; i < y.size(); ++i)
            EXPECT_LE(y[i] - y[i - 1], 100 + 1e-9);
    }
}

TEST(ColregRule25, Sailing) {
    Vessel yacht = vessel_of(Kind::sailing, 15);
    EXPECT_EQ(names_of(yacht), under_way);
    yacht.red_over_green = true;
    EXPECT_EQ(names_of(yacht),
              joined({under_way, {"upper all-round red light", "lower all-round green light"}}));
    yacht.tricolour = true;
    EXPECT_THROW(names_of(yacht), VesselError) << "25(c): not with the combined lantern";
    yacht.red_over_green = false;
    EXPECT_EQ(names_of(yacht),
              (Names{"tricolour lantern, port", "tricolour lantern, starboard", "tricolour lantern, stern"}));
    yacht.length_m = 20;
    EXPECT_THROW(names_of(yacht), VesselError);
}

TEST(ColregRule26, Trawling) {
    Vessel trawler = vessel_of(Kind::trawling, 49);
    const Names green_over_white = {"upper all-round green light", "lower all-round white light"};
    EXPECT_EQ(names_of(trawler), joined({under_way, green_over_white}));
    trawler.making_way = false;
    EXPECT_EQ(names_of(trawler), green_over_white);
    trawler.length_m = 50;
    EXPECT_EQ(names_of(trawler), joined({{"masthead light"}, green_over_white}));
    trawler.fishing_signal = FishingSignal::hauling_nets;
    EXPECT_EQ(names_of(trawler), joined({{"masthead light"},
                                         green_over_white,
                                         {"upper signal light, white", "lower signal light, red"}}));
}

TEST(ColregRule26, FishingWithGearBeyond150Metres) {
    Vessel fisher = vessel_of(Kind::fishing, 30);
    const Names red_over_white = {"upper all-round red light", "lower all-round white light"};
    fisher.gear_extent_m = 150;
    EXPECT_EQ(names_of(fisher), joined({under_way, red_over_white}));
    fisher.gear_extent_m = 151;
    fisher.gear_bearing_deg = 90;
    EXPECT_EQ(names_of(fisher),
              joined({under_way, red_over_white, {"all-round white light towards the gear"}}));
    const std::vector<Light> lights = colreg_lights(fisher);
    const Light& gear = lights.back();
    const Light& white = find(lights, "lower all-round white light");
    // Annex I section 4(a).
    const double away_m =
        std::hypot(gear.position_m[0] - white.position_m[0], gear.position_m[1] - white.position_m[1]);
    EXPECT_GE(away_m, 2);
    EXPECT_LE(away_m, 6);
    EXPECT_GT(gear.position_m[0], 2) << "to starboard, where the gear is";
    EXPECT_LE(gear.position_m[2], white.position_m[2]);
    EXPECT_GE(gear.position_m[2], find(lights, "port sidelight").position_m[2]);
}

TEST(ColregRule26, PurseSeinersFlashTwoYellowLightsInTurn) {
    Vessel seiner = vessel_of(Kind::fishing, 30);
    seiner.fishing_signal = FishingSignal::purse_seine;
    const std::vector<Light> lights = colreg_lights(seiner);
    const Light& upper = lights[lights.size() - 2];
    const Light& lower = lights.back();
    LightStore store;
    store.add(upper);
    store.add(lower);
    int lit_alone = 0;
    for (int i = 0; i < 40; ++i) {
        Observer observer;
        observer.time_s = 1000.05 + 0.1 * i;
        observer.exposure_s = 0;
        observer.geographic_horizon = false;
        observer.view_from_scene = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        observer.eye_m = {300, 0, 5};
        Evaluated out;
        evaluate(store, observer, out);
        lit_alone += out.sources.size() == 1 ? 1 : 0;
    }
    EXPECT_EQ(lit_alone, 40) << "one is lit whenever the other is not: Annex II section 3";
}

const Names red_white_red = {"upper all-round red light", "middle all-round white light",
                             "lower all-round red light"};

TEST(ColregRule27, NotUnderCommandShowsSidelightsOnlyWhenMakingWay) {
    Vessel vessel = vessel_of(Kind::not_under_command, 80);
    const Names two_red = {"upper all-round red light", "lower all-round red light"};
    EXPECT_EQ(names_of(vessel), joined({under_way, two_red}));
    vessel.making_way = false;
    EXPECT_EQ(names_of(vessel), two_red);
}

TEST(ColregRule27, RestrictedInHerAbilityToManoeuvre) {
    Vessel vessel = vessel_of(Kind::restricted, 80);
    EXPECT_EQ(names_of(vessel), joined({two_masts, red_white_red}));
    vessel.making_way = false;
    EXPECT_EQ(names_of(vessel), red_white_red);
    vessel.making_way = true;
    vessel.at_anchor = true;
    EXPECT_EQ(names_of(vessel), joined({{"forward anchor light", "after anchor light"}, red_white_red}));
}

TEST(ColregRule27, TheObstructedSideIsRedAndTheClearSideGreen) {
    Vessel dredger = vessel_of(Kind::restricted, 60, 12);
    dredger.making_way = false;
    dredger.obstruction_side = Side::port;
    const std::vector<Light> lights = colreg_lights(dredger);
    ASSERT_EQ(lights.size(), 7U);
    for (std::size_t i = 3; i < 7; ++i) {
        const bool red = i < 5;
        EXPECT_EQ(colour_of(lights[i]), red ? Colour::red : Colour::green);
        EXPECT_LE(red ? lights[i].position_m[0] : -lights[i].position_m[0], -2) << "Annex I section 4(b)";
    }
    EXPECT_LE(lights[3].position_m[2], lights[2].position_m[2]) << "not above the lowest of the three";
    dredger.at_anchor = true;  // 27(d)(iii): no anchor lights
    EXPECT_EQ(colreg_lights(dredger).size(), 7U);
}

TEST(ColregRule27, MineClearanceShowsThreeGreenLightsBesideHerOwn) {
    const Names green = {"all-round green light, foremast head", "all-round green light, port yardarm",
                         "all-round green light, starboard yardarm"};
    EXPECT_EQ(names_of(vessel_of(Kind::mine_clearance, 49)), joined({one_mast, green}));
}

TEST(ColregRule28, ConstrainedByDraughtShowsThreeRedLightsBesideHerOwn) {
    EXPECT_EQ(
        names_of(vessel_of(Kind::constrained_by_draught, 300)),
        joined({two_masts,
                {"upper all-round red light", "middle all-round red light", "lower all-round red light"}}));
}

TEST(ColregRule29, PilotVessels) {
    Vessel pilot = vessel_of(Kind::pilot, 18);
    const Names white_over_red = {"upper all-round white light", "lower all-round red light"};
    EXPECT_EQ(names_of(pilot), joined({under_way, white_over_red}));
    pilot.at_anchor = true;
    EXPECT_EQ(names_of(pilot), joined({{"anchor light"}, white_over_red}));
}

TEST(ColregRule30, AtAnchorAndAground) {
    EXPECT_EQ(names_of(vessel_of(Kind::at_anchor, 49.99)), Names{"anchor light"});
    EXPECT_EQ(names_of(vessel_of(Kind::at_anchor, 50)),
              (Names{"forward anchor light", "after anchor light"}));
    Vessel vessel = vessel_of(Kind::at_anchor, 49.99);
    vessel.two_anchor_lights = true;
    EXPECT_EQ(names_of(vessel), (Names{"forward anchor light", "after anchor light"}));
    EXPECT_EQ(names_of(vessel_of(Kind::aground, 60)),
              (Names{"forward anchor light", "after anchor light", "upper all-round red light",
                     "lower all-round red light"}));
    EXPECT_EQ(names_of(vessel_of(Kind::aground, 11.9)), Names{"anchor light"}) << "30(f)";
}

TEST(ColregRule30, DecksAreLitFrom100MetresOn) {
    EXPECT_TRUE(colreg_notes(vessel_of(Kind::at_anchor, 99.9)).empty());
    EXPECT_EQ(colreg_notes(vessel_of(Kind::at_anchor, 100)).size(), 1U);
    Vessel lit = vessel_of(Kind::at_anchor, 100);
    lit.deck_lights_cd = 500;
    EXPECT_TRUE(colreg_notes(lit).empty());
    const std::vector<Light> lights = colreg_lights(lit);
    EXPECT_EQ(lights.size(), 10U);
    EXPECT_EQ(lights.back().intensity_cd[0], 500);
}

TEST(ColregLights, NameTheirRuleTheirVesselAndStandOnHerBody) {
    Vessel vessel = vessel_of(Kind::power_driven, 60);
    vessel.name = "Skagerrak";
    vessel.body_id = 9;
    vessel.amidships_m = {1, -20, 0.5};
    const std::vector<Light> moved = colreg_lights(vessel);
    vessel.amidships_m = {};
    const std::vector<Light> lights = colreg_lights(vessel);
    EXPECT_EQ(find(lights, "Skagerrak: forward masthead light").source, "COLREG 1972 Rule 23(a)(i)");
    for (std::size_t i = 0; i < lights.size(); ++i) {
        EXPECT_EQ(lights[i].body_id, 9U);
        EXPECT_DOUBLE_EQ(moved[i].position_m[0] - lights[i].position_m[0], 1);
        EXPECT_DOUBLE_EQ(moved[i].position_m[1] - lights[i].position_m[1], -20);
        EXPECT_NEAR(moved[i].position_m[2] - lights[i].position_m[2], 0.5, 1e-12);
    }
}

TEST(ColregLights, EveryKindAndSizeIsLitAndNumbersAreFinite) {
    for (int kind = 0; kind < vessel_kind_count; ++kind) {
        for (const double length_m : {1.0, 5.0, 15.0, 30.0, 70.0, 1000.0}) {
            const std::vector<Light> lights = colreg_lights(vessel_of(static_cast<Kind>(kind), length_m, 1));
            EXPECT_FALSE(lights.empty());
            for (const Light& light : lights) {
                EXPECT_TRUE(std::isfinite(light.position_m[0] + light.position_m[1] + light.position_m[2]));
                EXPECT_GT(light.position_m[2], 0) << light.name;
                EXPECT_NE(light.source.find("Rule"), std::string::npos);
            }
        }
    }
}

std::string field_refused(const Vessel& vessel) {
    try {
        colreg_lights(vessel);
    } catch (const VesselError& error) {
        return error.field();
    }
    return "";
}

TEST(ColregLights, WhatContradictsTheRulesIsRefusedByItsField) {
    Vessel vessel = vessel_of(Kind::power_driven, 30);
    vessel.tricolour = true;
    EXPECT_EQ(field_refused(vessel), "tricolour");
    vessel = vessel_of(Kind::power_driven, 30);
    vessel.length_m = std::nan("");
    EXPECT_EQ(field_refused(vessel), "length_m");
    vessel = vessel_of(Kind::power_driven, 30);
    vessel.breadth_m = -1;
    EXPECT_EQ(field_refused(vessel), "breadth_m");
    vessel = vessel_of(Kind::power_driven, 30);
    vessel.mast_height_m = 5.9;
    EXPECT_EQ(field_refused(vessel), "mast_height_m");
    vessel.mast_height_m = 6;
    EXPECT_EQ(field_refused(vessel), "");
    vessel = vessel_of(Kind::constrained_by_draught, 300);
    vessel.mast_separation_m = 99;
    EXPECT_EQ(field_refused(vessel), "mast_separation_m");
    vessel = vessel_of(Kind::restricted, 30, 6);
    vessel.mast_height_m = 7;  // enough by 2(a), but three lights below need 4 + 3 * 2
    EXPECT_EQ(field_refused(vessel), "mast_height_m");
    vessel = vessel_of(Kind::trawling, 30);
    vessel.fishing_signal = FishingSignal::purse_seine;
    EXPECT_EQ(field_refused(vessel), "fishing_signal");
    vessel = vessel_of(Kind::power_driven, 20);
    vessel.combined_sidelights = true;
    EXPECT_EQ(field_refused(vessel), "combined_sidelights");
    vessel.length_m = 19.9;
    EXPECT_EQ(field_refused(vessel), "");
}

}  // namespace
}  // namespace seaglare::lightdb
