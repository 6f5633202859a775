// How strong the lights of vessels are and from where they are seen: COLREG 1972 Rules 21 and 22, Annex I sections 8 to 10.
#include "lightdb/colreg_lamps.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "lightdb/colreg.h"
#include "lightdb/evaluate.h"
#include "lightdb/light_store.h"
#include "tests/unit/vessels.h"

namespace seaglare::lightdb {
namespace {

using Kind = VesselKind;
using test::colour_of;
using test::find;
using test::vessel_of;

// Share of its full intensity that a light shows on a bearing from ahead of its body, at its own height, through the
// whole of evaluate(): the body lies somewhere, on some heading.
double seen(const Light& light, double bearing_deg, double elevation_deg = 0) {
    constexpr double distance_m = 500, heading_deg = 77;
    constexpr double rad = std::numbers::pi / 180;
    LightStore store;
    Light placed = light;
    placed.body_id = 3;
    store.add(placed);
    const double half = -heading_deg * rad / 2;
    store.set_body_pose(3, {{1200, -340, 2}, {0, 0, std::sin(half), std::cos(half)}});
    const std::array<double, 3> lamp = scene_position_m(store, placed);
    Observer observer;
    observer.geographic_horizon = false;
    observer.view_from_scene = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const double bearing = (heading_deg + bearing_deg) * rad;
    const double flat_m = distance_m * std::cos(elevation_deg * rad);
    observer.eye_m = {lamp[0] + flat_m * std::sin(bearing), lamp[1] + flat_m * std::cos(bearing),
                      lamp[2] + distance_m * std::sin(elevation_deg * rad)};
    Evaluated out;
    evaluate(store, observer, out);
    if (out.sources.empty()) return 0;
    EXPECT_EQ(out.sources.front().lamp, static_cast<std::uint32_t>(colour_of(light))) << light.name;
    const auto& rgb = out.sources.front().illuminance_rgb_lx;
    const double lux = 0.2126390 * static_cast<double>(rgb[0]) + 0.7151687 * static_cast<double>(rgb[1]) +
                       0.0721923 * static_cast<double>(rgb[2]);
    return lux * distance_m * distance_m / light.intensity_cd[static_cast<std::size_t>(colour_of(light))];
}

// ---- Rule 22, Annex I section 8 ----

TEST(ColregRanges, AreThoseOfRule22OnBothSidesOfEachLength) {
    struct Row {
        double length_m, masthead, side, stern, all_round;
    };
    for (const Row& row :
         {Row{11.99, 2, 1, 2, 2}, Row{12, 3, 2, 2, 2}, Row{19.99, 3, 2, 2, 2}, Row{20, 5, 2, 2, 2},
          Row{49.99, 5, 2, 2, 2}, Row{50, 6, 3, 3, 3}, Row{400, 6, 3, 3, 3}}) {
        const ColregRanges ranges = colreg_ranges(row.length_m);
        EXPECT_EQ(ranges.masthead_nm, row.masthead) << row.length_m;
        EXPECT_EQ(ranges.sidelight_nm, row.side) << row.length_m;
        EXPECT_EQ(ranges.sternlight_nm, row.stern) << row.length_m;
        EXPECT_EQ(ranges.all_round_nm, row.all_round) << row.length_m;
    }
}

// Annex I section 8(b) prints 0.9, 4.3, 12, 27, 52, 94 cd for 1 to 6 miles.
TEST(ColregIntensity, IsTheTableOfAnnexI) {
    const auto intensity = [](double length_m, const char* name) {
        const std::vector<Light> lights = colreg_lights(vessel_of(Kind::power_driven, length_m));
        const Light& light = find(lights, name);
        return light.intensity_cd[static_cast<std::size_t>(colour_of(light))];
    };
    EXPECT_NEAR(intensity(50, "forward masthead light"), 94, 0.5);
    EXPECT_NEAR(intensity(49, "masthead light"), 52, 0.5);
    EXPECT_NEAR(intensity(50, "port sidelight"), 12, 0.5);
    EXPECT_NEAR(intensity(49, "sternlight"), 4.3, 0.05);
    EXPECT_NEAR(intensity(15, "masthead light"), 12, 0.5);
    EXPECT_NEAR(intensity(11, "starboard sidelight"), 0.86, 0.005);
}

TEST(ColregIntensity, OfBetterLampsIsAMultipleOfTheLeast) {
    Vessel vessel = vessel_of(Kind::power_driven, 80);
    const double least = colreg_lights(vessel).front().intensity_cd[0];
    vessel.intensity_factor = 2.5;
    EXPECT_DOUBLE_EQ(colreg_lights(vessel).front().intensity_cd[0], 2.5 * least);
}

// ---- Rule 21, Annex I sections 9 and 10: worked by hand ----

TEST(ColregArcs, OfAPowerDrivenShipFromEveryDirection) {
    const std::vector<Light> lights = colreg_lights(vessel_of(Kind::power_driven, 120, 18));
    struct Row {
        double bearing_deg, masthead, port, starboard, stern;
    };
    // Full to 5 degrees inside a limit, half at the limit, nothing 5 degrees outside; a sidelight is full right ahead, half
    // 1 degree across the bow and dark at 2.
    constexpr std::array<Row, 21> table = {{{0, 1, 1, 1, 0},
                                            {0.5, 1, 0.75, 1, 0},
                                            {1, 1, 0.5, 1, 0},
                                            {2, 1, 0, 1, 0},
                                            {3, 1, 0, 1, 0},
                                            {45, 1, 0, 1, 0},
                                            {90, 1, 0, 1, 0},
                                            {107.5, 1, 0, 1, 0},
                                            {110, 0.75, 0, 0.75, 0.25},
                                            {112.5, 0.5, 0, 0.5, 0.5},
                                            {115, 0.25, 0, 0.25, 0.75},
                                            {117.5, 0, 0, 0, 1},
                                            {180, 0, 0, 0, 1},
                                            {242.5, 0, 0, 0, 1},
                                            {247.5, 0.5, 0.5, 0, 0.5},
                                            {252.5, 1, 1, 0, 0},
                                            {270, 1, 1, 0, 0},
                                            {315, 1, 1, 0, 0},
                                            {357, 1, 1, 0, 0},
                                            {359, 1, 1, 0.5, 0},
                                            {359.5, 1, 1, 0.75, 0}}};
    for (const Row& row : table) {
        EXPECT_NEAR(seen(find(lights, "forward masthead light"), row.bearing_deg), row.masthead, 1e-5)
            << row.bearing_deg;
        EXPECT_NEAR(seen(find(lights, "after masthead light"), row.bearing_deg), row.masthead, 1e-5);
        EXPECT_NEAR(seen(find(lights, "port sidelight"), row.bearing_deg), row.port, 1e-5) << row.bearing_deg;
        EXPECT_NEAR(seen(find(lights, "starboard sidelight"), row.bearing_deg), row.starboard, 1e-5)
            << row.bearing_deg;
        EXPECT_NEAR(seen(find(lights, "sternlight"), row.bearing_deg), row.stern, 1e-5) << row.bearing_deg;
    }
}

TEST(ColregArcs, AllRoundLightsAreSeenAllRoundAndTowingLightsFromAstern) {
    const std::vector<Light> nuc = colreg_lights(vessel_of(Kind::not_under_command, 60));
    const std::vector<Light> tug = colreg_lights(vessel_of(Kind::towing, 30));
    for (double bearing_deg = 0; bearing_deg < 360; bearing_deg += 7.5) {
        EXPECT_NEAR(seen(find(nuc, "upper all-round red light"), bearing_deg), 1, 1e-5);
        const bool astern = bearing_deg > 117 && bearing_deg < 243;
        const bool edge = bearing_deg == 112.5 || bearing_deg == 247.5;
        EXPECT_NEAR(seen(find(tug, "towing light"), bearing_deg),
                    astern ? 1
                    : edge ? 0.5
                           : 0,
                    1e-5)
            << bearing_deg;
    }
}

TEST(ColregArcs, VerticalSectorsAreWiderForVesselsUnderSail) {
    const std::vector<Light> power = colreg_lights(vessel_of(Kind::power_driven, 30));
    const std::vector<Light> sail = colreg_lights(vessel_of(Kind::sailing, 30));
    const Light& side = find(power, "port sidelight");
    const Light& sail_side = find(sail, "port sidelight");
    for (const double sign : {-1.0, 1.0}) {
        EXPECT_NEAR(seen(side, 315, sign * 5), 1, 1e-5);       // section 10(a)(i)
        EXPECT_GE(seen(side, 315, sign * 7.5), 0.6 - 1e-5);    // section 10(a)(ii)
        EXPECT_NEAR(seen(sail_side, 315, sign * 5), 1, 1e-5);  // section 10(b)(i)
        EXPECT_GE(seen(sail_side, 315, sign * 25), 0.5 - 1e-5);
        EXPECT_GT(seen(sail_side, 315, sign * 7.5), 0.93);
    }
}

TEST(ColregArcs, ATricolourLanternShowsOneColourAtATimeButAhead) {
    Vessel yacht = vessel_of(Kind::sailing, 15);
    yacht.tricolour = true;
    const std::vector<Light> lights = colreg_lights(yacht);
    const auto shown = [&](double bearing_deg) {
        std::array<double, 3> result{};
        for (std::size_t i = 0; i < 3; ++i)
            result[i] = seen(lights[i], bearing_deg);
        return result;
    };
    const auto expect = [&](double bearing_deg, double red, double green, double white) {
        const auto is = shown(bearing_deg);
        EXPECT_NEAR(is[0], red, 1e-5) << bearing_deg;
        EXPECT_NEAR(is[1], green, 1e-5) << bearing_deg;
        EXPECT_NEAR(is[2], white, 1e-5) << bearing_deg;
    };
    expect(0, 1, 1, 0);
    expect(60, 0, 1, 0);
    expect(180, 0, 0, 1);
    expect(300, 1, 0, 0);
}

}  // namespace
}  // namespace seaglare::lightdb
