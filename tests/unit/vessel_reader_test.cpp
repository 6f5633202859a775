// Vessels and buoys of light files: what they become, where errors point.
#include "lightdb/vessel_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "lightdb/buoy_reader.h"
#include "lightdb/colreg.h"
#include "lightdb/evaluate.h"
#include "lightdb/geodesy.h"
#include "lightdb/json/value.h"
#include "lightdb/light_file.h"

namespace seaglare::lightdb {
namespace {

std::vector<Light> read(const std::string& text, std::vector<std::string>* warnings = nullptr) {
    const json::Document document = json::parse(text, "fleet.json");
    std::vector<std::string> own;
    return read_vessel(document.root(), "", warnings != nullptr ? *warnings : own);
}

std::string error_of(const std::string& text) {
    try {
        read(text);
    } catch (const json::Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(VesselReader, OnABodyTheLightsAreThoseOfColreg) {
    Vessel vessel;
    vessel.name = "Tug";
    vessel.kind = VesselKind::towing;
    vessel.length_m = 30;
    vessel.breadth_m = 9;
    vessel.body_id = 4;
    vessel.tow_length_m = 250;
    EXPECT_EQ(
        read(
            R"({"name": "Tug", "kind": "towing", "length_m": 30, "breadth_m": 9, "body": 4, "tow_length_m": 250})"),
        colreg_lights(vessel));
}

TEST(VesselReader, OneThatLiesStillPointsWhereSheHeads) {
    // Heading east: the port sidelight is on the north side and shows north.
    const std::vector<Light> lights = read(
        R"({"name": "A", "kind": "power_driven", "length_m": 40, "breadth_m": 10, "position": [100, 200], "heading_deg": 90})");
    const Light& port = lights[1];
    ASSERT_EQ(port.name, "A: port sidelight");
    EXPECT_EQ(port.body_id, 0U);
    EXPECT_NEAR(port.position_m[0], 105, 1e-9) << "an eighth of her length ahead of amidships";
    EXPECT_NEAR(port.position_m[1], 204.8, 1e-9);
    EXPECT_EQ(port.height_m, port.position_m[2]);
    LightStore store;
    store.add(port);
    Observer observer;
    observer.eye_m = {105, 1204.8, port.position_m[2]};
    EXPECT_GT(intensity_towards_cd(store, port, observer)[1], 4);
    observer.eye_m[1] = -795.2;
    EXPECT_EQ(intensity_towards_cd(store, port, observer)[1], 0);
}

TEST(VesselReader, LatitudeAndLongitudeAreThoseOfAmidships) {
    const GeographicPoint origin = {55.3, 10.95, 0};
    std::vector<Light> lights = read(
        R"({"name": "A", "kind": "power_driven", "length_m": 200, "breadth_m": 30, "lat": 55.3, "lon": 10.95, "heading_deg": 30})");
    std::vector<Light> local = read(
        R"({"name": "A", "kind": "power_driven", "length_m": 200, "breadth_m": 30, "position": [0, 0], "heading_deg": 30})");
    place_lights(lights, origin, Earth::flat);
    ASSERT_EQ(lights.size(), local.size());
    for (std::size_t i = 0; i < lights.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_NEAR(lights[i].position_m[k], local[i].position_m[k], 0.005) << lights[i].name;
    }
}

TEST(VesselReader, ErrorsPointAtWhatIsWrong) {
    EXPECT_EQ(error_of("{\"name\": \"A\", \"kind\": \"power_driven\",\n \"length_m\": 0, \"breadth_m\": 3, "
                       "\"body\": 1}"),
              "fleet.json:2:14: 'length_m' is 0: it must lie between 1 and 1000");
    EXPECT_NE(error_of(R"({"name": "A", "kind": "ferry", "length_m": 30, "breadth_m": 3, "body": 1})")
                  .find("1:23: 'ferry' is no kind of vessel"),
              std::string::npos);
    EXPECT_NE(
        error_of(
            R"({"name": "A", "kind": "sailing", "length_m": 30, "breadth_m": 3, "body": 1, "tricolor": true})")
            .find("'tricolour'"),
        std::string::npos);
    EXPECT_NE(
        error_of(
            R"({"name": "A", "kind": "sailing", "length_m": 30, "breadth_m": 3, "body": 1, "tricolour": true})")
            .find("Rule 25(b)"),
        std::string::npos);
    EXPECT_NE(error_of(R"({"name": "A", "kind": "sailing", "length_m": 30, "breadth_m": 3})").find("'body'"),
              std::string::npos);
    EXPECT_NE(
        error_of(
            R"({"name": "A", "kind": "sailing", "length_m": 30, "breadth_m": 3, "body": 1, "heading_deg": 3})")
            .find("1:"),
        std::string::npos);
}

TEST(VesselReader, AnAnchoredShipOf100MetresIsToldToLightHerDecks) {
    std::vector<std::string> warnings;
    read(R"({"name": "A", "kind": "at_anchor", "length_m": 100, "breadth_m": 16, "body": 1})", &warnings);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].find("Rule 30(c)"), std::string::npos);
}

TEST(VesselReader, WhatIsSavedReadsBackAsTheSameLights) {
    std::string vessels;
    for (const std::string_view kind : vessel_kind_names())
        vessels += std::string(vessels.empty() ? "" : ", ") + R"({"name": ")" + std::string(kind) +
                   R"(", "kind": ")" + std::string(kind) +
                   R"(", "length_m": 60, "breadth_m": 12, "body": 3})";
    vessels +=
        R"(, {"name": "seiner", "kind": "fishing", "fishing_signal": "purse_seine", "length_m": 30, "breadth_m": 8, "position": [5, 6], "heading_deg": 211})";
    const LightFile file = parse_light_file(R"({"vessels": [)" + vessels + "]}", "fleet.json");
    const LightFile again = parse_light_file(format_light_file(file), "saved.json");
    ASSERT_EQ(again.lights.size(), file.lights.size());
    for (std::size_t i = 0; i < file.lights.size(); ++i)
        EXPECT_EQ(again.lights[i], file.lights[i]) << file.lights[i].name;
}

TEST(BuoyReader, ALightOfABuoyStandsOnItsBody) {
    const LightFile file =
        parse_light_file(R"({"buoys": [{"name": "B", "position": [10, 20], "roll_period_s": 3.5,
        "lights": [{"name": "B", "position": [0, 0, 3.2], "character": "Fl R 3s", "intensity_cd": 40}]}]})",
                         "buoys.json");
    ASSERT_EQ(file.buoys.size(), 1U);
    ASSERT_EQ(file.lights.size(), 1U);
    const Buoy& buoy = file.buoys.front();
    EXPECT_GE(buoy.body_id, first_made_up_body);
    EXPECT_EQ(file.lights.front().body_id, buoy.body_id);
    EXPECT_EQ(buoy.focal_height_m, 3.2);
    EXPECT_EQ(buoy.roll.period_s, 3.5);
    EXPECT_EQ(buoy.heave.period_s, 0);
    const LightFile again = parse_light_file(format_light_file(file), "saved.json");
    ASSERT_EQ(again.buoys.size(), 1U);
    EXPECT_EQ(again.buoys.front(), buoy);
    EXPECT_EQ(again.lights, file.lights);
}

TEST(BuoyReader, ErrorsPointAtWhatIsWrong) {
    const auto error = [](const std::string& buoy) -> std::string {
        try {
            parse_light_file(R"({"buoys": [)" + buoy + "]}", "b.json");
        } catch (const json::Error& wrong) {
            return wrong.what();
        }
        return "no error";
    };
    EXPECT_NE(error(R"({"name": "B"})").find("give the mooring"), std::string::npos);
    EXPECT_NE(error(R"({"name": "B", "position": [1, 2], "roll_period": 3})").find("'roll_period_s'"),
              std::string::npos);
    EXPECT_NE(error(R"({"name": "B", "position": [1, 2], "heave_damping": 0})").find("heave_damping"),
              std::string::npos);
    EXPECT_NE(
        error(
            R"({"name": "B", "position": [1, 2], "lights": [{"name": "L", "body": 3, "position": [0, 0, 4], "intensity_cd": 1}]})")
            .find("no body but the buoy"),
        std::string::npos);
}

}  // namespace
}  // namespace seaglare::lightdb
