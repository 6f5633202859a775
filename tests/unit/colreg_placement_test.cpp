// Where vessels carry their lights: every distance that COLREG 1972 Annex I sections 2 and 3 asks for, over sizes.
#include "lightdb/colreg_placement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lightdb/colreg.h"
#include "tests/unit/vessels.h"

namespace seaglare::lightdb {
namespace {

using Kind = VesselKind;
using test::find;
using test::vessel_of;

class EverySize : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(ColregPlacement, EverySize,
                         testing::Values(6, 11.9, 12, 19.9, 20, 35, 49.9, 50, 99.9, 100, 180, 200, 260, 400));

double above_hull_m(const Vessel& vessel, const Light& light) {
    return light.position_m[2] - hull_height_m(vessel);
}

TEST_P(EverySize, MastheadLightsStandAsAnnexIHasIt) {
    const double length_m = GetParam();
    for (const double breadth_m : {2.0, 6.0, 9.0, 12.0, 32.0}) {
        const Vessel vessel = vessel_of(Kind::power_driven, length_m, breadth_m);
        const std::vector<Light> lights = colreg_lights(vessel);
        const double forward_m = above_hull_m(vessel, lights[0]);
        if (length_m >= 20) {
            EXPECT_GE(forward_m, std::min(std::max(6.0, breadth_m), 12.0) - 1e-9) << "2(a)(i)";
        } else if (length_m >= 12) {
            EXPECT_GE(forward_m, 2.5) << "2(c)";
        }
        const Light& side = find(lights, "port sidelight");
        const double side_m = above_hull_m(vessel, side);
        EXPECT_GT(side_m, 0);
        if (length_m >= 20) {
            EXPECT_LE(side_m, 0.75 * forward_m) << "2(g)";
            EXPECT_LE(side.position_m[1], lights[0].position_m[1]) << "3(b)";
        } else {
            EXPECT_GE(forward_m, side_m + 1) << "2(d), (h)";
        }
        EXPECT_GT(std::abs(side.position_m[0]), 0.4 * breadth_m) << "3(b): near the side";
        EXPECT_LT(side.position_m[0], 0);
        EXPECT_DOUBLE_EQ(find(lights, "sternlight").position_m[1], -length_m / 2);
        if (length_m < 50) {
            if (length_m >= 20) {
                EXPECT_GT(lights[0].position_m[1], 0) << "3(d): forward of amidships";
            }
            continue;
        }
        const Light& forward = find(lights, "forward masthead light");
        const Light& after = find(lights, "after masthead light");
        EXPECT_GE(after.position_m[2] - forward.position_m[2], 4.5 - 1e-12) << "2(a)(ii)";
        const double apart_m = forward.position_m[1] - after.position_m[1];
        EXPECT_NEAR(apart_m, std::min(length_m / 2, 100.0), 1e-9) << "3(a)";
        EXPECT_LE(length_m / 2 - forward.position_m[1], length_m / 4) << "3(a)";
        // 2(b): from the water 1000 m before the stem the after light is seen above the forward one.
        const double from_m = 1000 + length_m / 2;
        EXPECT_GT(after.position_m[2] / (from_m - after.position_m[1]),
                  forward.position_m[2] / (from_m - forward.position_m[1]) + 0.00029);
    }
}

// Lights of a vertical line, by their names, from the highest down.
std::vector<Light> line_of(const std::vector<Light>& lights) {
    std::vector<Light> line;
    for (const Light& light : lights) {
        for (const char* which : {"upper ", "middle ", "lower "})
            if (light.name.rfind(which, 0) == 0 && light.name.find("signal") == std::string::npos &&
                light.name.find("side") == std::string::npos)
                line.push_back(light);
    }
    return line;
}

TEST_P(EverySize, VerticalLinesAreSpacedAndBelowTheMastheadLights) {
    const double length_m = GetParam();
    const double spacing_m = length_m >= 20 ? 2 : 1;
    const double lowest_m = length_m >= 20 ? 4 : 2;
    for (const Kind kind : {Kind::restricted, Kind::constrained_by_draught, Kind::not_under_command,
                            Kind::pilot, Kind::trawling, Kind::fishing}) {
        Vessel vessel = vessel_of(kind, length_m);
        if (kind == Kind::restricted) vessel.obstruction_side = Side::starboard;
        const std::vector<Light> lights = colreg_lights(vessel);
        const std::vector<Light> line = line_of(lights);
        ASSERT_GE(line.size(), 2U);
        for (std::size_t i = 1; i < line.size(); ++i) {
            EXPECT_NEAR(line[i - 1].position_m[2] - line[i].position_m[2], spacing_m, 1e-9) << "2(i)";
            EXPECT_EQ(line[i - 1].position_m[0], line[i].position_m[0]);
            EXPECT_EQ(line[i - 1].position_m[1], line[i].position_m[1]);
        }
        EXPECT_GE(above_hull_m(vessel, line.back()), lowest_m - 1e-9) << "2(i)";
        for (const Light& masthead : lights) {
            if (masthead.name.find("masthead light") == std::string::npos) continue;
            for (const Light& other : lights) {
                if (other.name.find("masthead light") == std::string::npos) {
                    EXPECT_GT(masthead.position_m[2], other.position_m[2]) << "2(f)(i): " << other.name;
                }
            }
        }
        if (kind == Kind::fishing || kind == Kind::trawling) {
            EXPECT_GE(line.back().position_m[2] - find(lights, "port sidelight").position_m[2],
                      2 * spacing_m - 1e-9)
                << "2(j)";
        }
    }
}

TEST_P(EverySize, TowingMastheadLightsAreALineAboveTheForwardMastheadLight) {
    Vessel tug = vessel_of(Kind::towing, GetParam());
    tug.tow_length_m = 300;
    const std::vector<Light> lights = colreg_lights(tug);
    std::vector<Light> line = line_of(lights);
    ASSERT_EQ(line.size(), 3U);
    const double spacing_m = GetParam() >= 20 ? 2 : 1;
    EXPECT_NEAR(line[0].position_m[2] - line[1].position_m[2], spacing_m, 1e-9);
    EXPECT_NEAR(line[1].position_m[2] - line[2].position_m[2], spacing_m, 1e-9);
    EXPECT_NEAR(find(lights, "towing light").position_m[2] - find(lights, "sternlight").position_m[2],
                spacing_m, 1e-9)
        << "24(a)(iv): above the sternlight";
    if (GetParam() >= 50) {
        EXPECT_GE(line[2].position_m[2] - find(lights, "forward masthead light").position_m[2], 4.5 - 1e-9)
            << "2(e)";
    }
}

TEST_P(EverySize, TheForwardAnchorLightIsTheHigher) {
    Vessel vessel = vessel_of(Kind::at_anchor, GetParam());
    vessel.two_anchor_lights = true;
    const std::vector<Light> lights = colreg_lights(vessel);
    EXPECT_GE(lights[0].position_m[2] - lights[1].position_m[2], 4.5 - 1e-9) << "Annex I section 2(k)";
    if (GetParam() >= 50) {
        EXPECT_GE(above_hull_m(vessel, lights[0]), 6) << "2(k)";
    }
    EXPECT_GT(lights[0].position_m[1], 0);
    EXPECT_LT(lights[1].position_m[1], -0.4 * GetParam());
}

}  // namespace
}  // namespace seaglare::lightdb
