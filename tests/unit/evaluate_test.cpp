// From the database to lux at the eye: laws, reasons for the dark, and extremes that must not poison a frame.
#include "lightdb/evaluate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "glare/colour/navigation_colours.h"
#include "lightdb/daylight.h"
#include "lightdb/geodesy.h"
#include "lightdb/photometry.h"
#include "lightdb/profile.h"
#include "lightdb/vector_math.h"

namespace seaglare::lightdb {
namespace {

constexpr std::size_t white = static_cast<std::size_t>(Colour::white);
constexpr std::size_t red = static_cast<std::size_t>(Colour::red);
constexpr std::size_t green = static_cast<std::size_t>(Colour::green);
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Light lamp(double x, double y, double z, double intensity_cd = 1000) {
    Light light;
    light.position_m = {x, y, z};
    light.intensity_cd[white] = intensity_cd;
    return light;
}

// Looks north: x right, y up, z back.
Observer looking_north(double eye_height_m = 10) {
    Observer observer;
    observer.eye_m = {0, 0, eye_height_m};
    observer.view_from_scene = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1};
    return observer;
}

double luminous_lx(const glare::PointSource& source) {
    return 0.2126 * static_cast<double>(source.illuminance_rgb_lx[0]) +
           0.7152 * static_cast<double>(source.illuminance_rgb_lx[1]) +
           0.0722 * static_cast<double>(source.illuminance_rgb_lx[2]);
}

Evaluated evaluated(const std::vector<Light>& lights, const Observer& observer) {
    LightStore store;
    for (const Light& light : lights)
        store.add(light);
    Evaluated out;
    evaluate(store, observer, out);
    EXPECT_EQ(out.total, lights.size());
    EXPECT_EQ(out.sources.size(), out.light.size());
    EXPECT_EQ(out.sources.size() + out.dark + out.below_horizon + out.too_faint, lights.size());
    return out;
}

double lux_of(const Light& light, const Observer& observer) {
    const Evaluated out = evaluated({light}, observer);
    return out.sources.empty() ? 0 : luminous_lx(out.sources[0]);
}

TEST(Evaluate, IlluminanceFollowsTheInverseSquareAndTheAir) {
    Observer observer = looking_north();
    for (double distance_m = 10; distance_m < 20000; distance_m *= 2) {
        EXPECT_NEAR(lux_of(lamp(0, distance_m, 10), observer) * distance_m * distance_m, 1000, 0.01);
    }
    observer.extinction_per_m = extinction_per_m(2000);
    EXPECT_NEAR(lux_of(lamp(2000, 0, 10), observer), 1000.0 / 4e6 * 0.05, 1e-10);
}

// A light seen at its nominal range in the nominal air gives the threshold it is defined by: 2e-7 lx.
TEST(Evaluate, AtItsNominalRangeALightGivesTheThreshold) {
    Observer observer = looking_north(100);
    observer.extinction_per_m = extinction_per_m(nominal_visibility_nm * metres_per_nautical_mile);
    for (const double range_nm : {2.0, 5.0, 10.0}) {
        const Light light =
            lamp(range_nm * metres_per_nautical_mile, 0, 100, intensity_for_range_cd(range_nm));
        EXPECT_NEAR(lux_of(light, observer) / night_threshold_lx, 1, 1e-5);
    }
}

TEST(Evaluate, ThePositionIsInViewSpaceAndKeepsItsDigitsFarFromTheOrigin) {
    Observer observer = looking_north();
    observer.eye_m = {6e6, -3e6, 10};
    const Evaluated out = evaluated({lamp(6e6 + 3, -3e6 + 100.125, 12.25)}, observer);
    ASSERT_EQ(out.sources.size(), 1U);
    EXPECT_EQ(out.sources[0].position_view_m, (std::array<float, 3>{3, 2.25F, -100.125F}));
    EXPECT_EQ(out.sources[0].radius_m, 0.05F);
}

// In single precision a position 1e7 m away has steps of a metre.
TEST(Evaluate, TenMillionMetresFromTheOriginAMillimetreIsKept) {
    Observer observer = looking_north();
    observer.eye_m = {1e7, -1e7, 10};
    LightStore store;
    for (int i = 0; i < 1000; ++i)
        store.add(lamp(1e7 + 3.001, -1e7 + 100.125 + i, 12.25));
    store.optimise();
    Evaluated out;
    evaluate(store, observer, out);
    ASSERT_EQ(out.sources.size(), 1000U);
    EXPECT_NEAR(out.sources[0].position_view_m[0], 3.001, 1e-6);
    EXPECT_EQ(out.sources[0].position_view_m[2], -100.125F);
}

TEST(Evaluate, ByDayALampHasItsIntensityByDay) {
    Light light = lamp(0, 100, 10, 100);
    Observer observer = looking_north();
    observer.is_day = true;
    EXPECT_NEAR(lux_of(light, observer), 0.01, 1e-8) << "without one it burns as by night";
    light.day_intensity_cd[white] = 5000;
    EXPECT_NEAR(lux_of(light, observer), 0.5, 1e-6);
    observer.is_day = false;
    EXPECT_NEAR(lux_of(light, observer), 0.01, 1e-8);
}

TEST(Evaluate, ColourAndScotopicPartAreThoseOfTheLamp) {
    Light light = lamp(0, 100, 10, 0);
    light.intensity_cd[red] = 400;
    const Evaluated out = evaluated({light}, looking_north());
    ASSERT_EQ(out.sources.size(), 1U);
    const glare::UnitColour colour = glare::navigation_colour(static_cast<int>(red));
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(out.sources[0].illuminance_rgb_lx[i], 0.04F * colour.rgb[i], 1e-6);
    }
    EXPECT_NEAR(out.sources[0].illuminance_scotopic_lx, 0.04F * colour.scotopic_per_photopic, 1e-6);
}

// Inside a lamp of radius r the illuminance is that of its surface, finite at its centre, too.
TEST(Evaluate, TheEyeMayBeInsideALamp) {
    Light light = lamp(0, 0, 10, 50);
    light.radius_m = 0.5;
    EXPECT_NEAR(lux_of(light, looking_north()), 200, 1e-3);
    light.position_m = {0, 0.2, 10};
    EXPECT_NEAR(lux_of(light, looking_north()), 200, 1e-3);
}

TEST(Evaluate, EveryReasonForTheDarkIsCounted) {
    Observer observer = looking_north();
    Light off = lamp(0, 100, 10);
    off.on = false;
    Light hidden = lamp(0, 100, 10);
    hidden.visibility = 0;
    Light none = lamp(0, 100, 10, 0);
    Light eclipsed = lamp(0, 100, 10);
    eclipsed.rhythm.phases = {{5, false}};
    eclipsed.rhythm.period_s = 5;
    Light turned_away = lamp(0, 100, 10);
    turned_away.sectors = {{Colour::white, 90, 270}};  // and the light bears 000
    Light narrow = lamp(0, 100, 10);
    narrow.vertical = {{-1, 0, 1}, {0, 1, 0}};
    narrow.position_m[2] = 60;
    Light far = lamp(0, 60000, 10);
    EXPECT_EQ(evaluated({off, hidden, none, eclipsed, turned_away, narrow}, observer).dark, 6U);
    EXPECT_EQ(evaluated({far}, observer).below_horizon, 1U);
    observer.geographic_horizon = false;
    EXPECT_EQ(evaluated({far}, observer).sources.size(), 1U);
    observer.extinction_per_m = 970 / 60e3;
    EXPECT_EQ(evaluated({far}, observer).dark, 1U);  // underflown
    EXPECT_EQ(evaluated({}, observer).total, 0U);
}

TEST(Evaluate, APhotometerSwitchesByDay) {
    Light light = lamp(0, 100, 10);
    light.day_off = true;
    Observer observer = looking_north();
    observer.is_day = is_day(day_above_cd_m2, false);
    EXPECT_GT(lux_of(light, observer), 0);
    observer.is_day = is_day(1.001 * day_above_cd_m2, false);
    EXPECT_EQ(lux_of(light, observer), 0);
    light.day_off = false;
    EXPECT_GT(lux_of(light, observer), 0);
}

TEST(Evaluate, MovingAcrossASectorLimitChangesTheColour) {
    Light light = lamp(0, 0, 10, 300);
    light.intensity_cd[green] = 300;
    light.sectors = {{Colour::green, 340, 0}, {Colour::white, 0, 20}};
    Observer observer = looking_north();
    observer.eye_m = {1, -1000, 10};  // the light bears a little west of north
    Evaluated out = evaluated({light}, observer);
    ASSERT_EQ(out.sources.size(), 1U);
    const glare::UnitColour colour = glare::navigation_colour(static_cast<int>(green));
    EXPECT_NEAR(out.sources[0].illuminance_rgb_lx[0], 3e-4F * colour.rgb[0], 1e-9);
    observer.eye_m = {-1, -1000, 10};
    out = evaluated({light}, observer);
    EXPECT_NEAR(out.sources[0].illuminance_rgb_lx[0], 3e-4, 1e-9);
    // The light's true north lies 0.2 degrees west of the scene's: the limit turns with it.
    light.true_north_deg = -0.2;
    observer.eye_m = {1, -1000, 10};
    EXPECT_NEAR(evaluated({light}, observer).sources[0].illuminance_rgb_lx[0], 3e-4, 1e-9);
}

TEST(Evaluate, AShipsSidelightsTurnWithTheShip) {
    LightStore store;
    Light port;  // COLREG: 112.5 degrees from ahead to port, cut off 2 degrees across ahead
    port.body_id = 5;
    port.position_m = {-4, 10, 6};
    port.intensity_cd[red] = 52;
    port.sectors = {{Colour::red, 247.5, 2}};
    port.sector_reference = SectorReference::outward_from_ahead;
    Light starboard = port;
    starboard.position_m = {4, 10, 6};
    starboard.intensity_cd = {};
    starboard.intensity_cd[green] = 52;
    starboard.sectors = {{Colour::green, -2, 112.5}};
    const LightId port_id = store.add(port);
    store.add(starboard);
    const auto seen_from = [&](double x, double y) {
        Observer observer = looking_north();
        observer.eye_m = {x, y, 6};
        Evaluated out;
        evaluate(store, observer, out);
        std::string colours;
        for (const LightIndex light : out.light)
            colours += store.id_of(light) == port_id ? 'R' : 'G';
        return colours;
    };
    store.set_body_pose(5, {{100, 200, 0}, {0, 0, 0, 1}});  // heads north
    EXPECT_EQ(seen_from(100, 3000), "RG");                  // right ahead both are seen
    EXPECT_EQ(seen_from(-2000, 300), "R");
    EXPECT_EQ(seen_from(2000, 300), "G");
    EXPECT_EQ(seen_from(100, -3000), "");
    const double half = std::sqrt(0.5);
    store.set_body_pose(5, {{100, 200, 0}, {0, 0, -half, half}});  // turned 90 degrees clockwise: heads east
    EXPECT_EQ(seen_from(300, 3000), "R");
    EXPECT_EQ(seen_from(300, -3000), "G");
    const Vec3 p = scene_position_m(store, *store.find(port_id));
    EXPECT_NEAR(p[0], 110, 1e-9);
    EXPECT_NEAR(p[1], 204, 1e-9);
    EXPECT_NEAR(p[2], 6, 1e-9);
}

TEST(Evaluate, TheVerticalProfileTiltsWithTheLight) {
    Light light = lamp(0, 1000, 10);
    light.vertical = *named_vertical_profile("sabik_vp");
    const Observer observer = looking_north();
    EXPECT_NEAR(lux_of(light, observer), 1e-3, 1e-9);
    light.position_m[2] =
        10 + 1000 * std::tan(5 * 3.14159265358979 / 180);  // the eye stands 5 degrees below it
    const double distance_m = std::hypot(1000, light.position_m[2] - 10);
    EXPECT_NEAR(lux_of(light, observer) * distance_m * distance_m, 500, 0.1);
    // Tilted 5 degrees towards the eye (about the x axis), the beam meets it.
    const double quarter = 2.5 * 3.14159265358979 / 180;
    light.orientation = {std::sin(quarter), 0, 0, std::cos(quarter)};
    EXPECT_NEAR(lux_of(light, observer) * distance_m * distance_m, 1000, 0.1);
}

TEST(Evaluate, SectorsByTrueBearingDoNotTurnWithTheirBuoy) {
    Light light = lamp(0, 0, 5);
    light.body_id = 9;
    light.sectors = {{Colour::white, 350, 10}};
    LightStore store;
    store.add(light);
    Observer observer = looking_north();
    observer.eye_m = {0, -500, 5};
    Evaluated out;
    for (const double heading : {0.0, 1.0, 2.0}) {
        store.set_body_pose(9, {{0, 0, 0}, {0, 0, std::sin(heading), std::cos(heading)}});
        evaluate(store, observer, out);
        EXPECT_EQ(out.sources.size(), 1U);
    }
}

TEST(Evaluate, ALightIsBlackenedByTheHorizonWhereTheFormulaSays) {
    const Observer observer = looking_north(9);
    const double range_m = geographical_range_nm(25, 9) * metres_per_nautical_mile;
    EXPECT_GT(lux_of(lamp(0, 0.999 * range_m, 25, 1e6), observer), 0);
    EXPECT_EQ(lux_of(lamp(0, 1.001 * range_m, 25, 1e6), observer), 0);
    // On a round earth the same light stands lower in the scene, and its height above the water is the same.
    Observer round = observer;
    round.round_earth = true;
    const auto sunk = [](double y) { return 25 - y * y / (2 * earth_radius_m); };
    EXPECT_GT(lux_of(lamp(0, 0.999 * range_m, sunk(0.999 * range_m), 1e6), round), 0);
    EXPECT_EQ(lux_of(lamp(0, 1.001 * range_m, sunk(1.001 * range_m), 1e6), round), 0);
    // An eye under water counts as at its surface.
    EXPECT_GT(lux_of(lamp(0, 1000, 4), looking_north(-3)), 0);
    // Heights count from the water, wherever the scene has its zero.
    Observer raised = looking_north(109);
    raised.water_level_m = 100;
    EXPECT_GT(lux_of(lamp(0, 0.999 * range_m, 125, 1e6), raised), 0);
    EXPECT_EQ(lux_of(lamp(0, 1.001 * range_m, 125, 1e6), raised), 0);
}

TEST(Evaluate, RhythmsKeepTheirMeanAndTheirColours) {
    Light light = lamp(0, 100, 10, 100);
    light.intensity_cd[red] = 100;
    light.rhythm.phases = {{0.3, true, Colour::white}, {0.4, true, Colour::red}, {0.3, false}};
    light.rhythm.period_s = 1;
    LightStore store;
    store.add(light);
    Observer observer = looking_north();
    observer.exposure_s = 0.01;
    Evaluated out;
    double red_lx = 0;
    double sum_lx = 0;
    for (int i = 0; i < 100; ++i) {
        observer.time_s = 50 + (i + 1) * 0.01;
        evaluate(store, observer, out);
        if (out.sources.empty()) continue;
        sum_lx += luminous_lx(out.sources[0]) / 100;
        // Red alone leaves the blue primary at or below nothing.
        if (out.sources[0].illuminance_rgb_lx[2] < 1e-3F) red_lx += luminous_lx(out.sources[0]) / 100;
    }
    EXPECT_NEAR(sum_lx, 0.01 * 0.7, 1e-6);
    EXPECT_NEAR(red_lx, 0.01 * 0.4, 0.01 * 0.011);
}

TEST(Evaluate, ASectoredLightShowsTheSectorsColourInItsRhythm) {
    Light light = lamp(0, 100, 10, 100);
    light.intensity_cd[red] = 60;
    light.sectors = {{Colour::red, 350, 10}};
    light.rhythm.phases = {{1, true, Colour::white}, {1, true, Colour::white, 0.5}};
    light.rhythm.period_s = 2;
    Observer observer = looking_north();
    LightStore store;
    const LightId id = store.add(light);
    bool full = false;
    bool half = false;
    for (double t_s = 0; t_s < 2; t_s += 0.1) {
        observer.time_s = t_s;
        const auto intensity_cd = intensity_towards_cd(store, *store.find(id), observer);
        EXPECT_EQ(intensity_cd[white], 0);
        full = full || std::abs(intensity_cd[red] - 60) < 1e-9;
        half = half || std::abs(intensity_cd[red] - 30) < 1e-9;
    }
    EXPECT_TRUE(full && half);
}

TEST(Evaluate, AFixedLightWithoutPhasesShowsTheColourItHas) {
    Light light = lamp(0, 100, 10, 0);
    light.intensity_cd[green] = 70;
    LightStore store;
    const LightId id = store.add(light);
    EXPECT_EQ(intensity_towards_cd(store, *store.find(id), looking_north())[green], 70);
}

TEST(Evaluate, TheSeedShiftsTheRhythmAndTheOrderOfLoadingDoesNot) {
    Light light = lamp(0, 100, 10, 100);
    light.name = "a";
    light.rhythm.phases = {{5, true}, {5, false}};
    light.rhythm.period_s = 10;
    Light other = light;
    other.name = "b";
    const auto pattern = [&](const std::vector<Light>& lights, const std::string& name, std::uint64_t seed) {
        LightStore store;
        for (const Light& l : lights)
            store.add(l);
        Observer observer = looking_north();
        observer.seed = seed;
        std::string result;
        for (double t_s = 0; t_s < 10; t_s += 0.25) {
            observer.time_s = t_s;
            Evaluated out;
            evaluate(store, observer, out);
            bool lit = false;
            for (const LightIndex i : out.light)
                lit = lit || store.name(i) == name;
            result += lit ? '1' : '0';
        }
        return result;
    };
    EXPECT_EQ(pattern({light, other}, "a", 1), pattern({other, light}, "a", 1));
    EXPECT_EQ(pattern({light, other}, "b", 1), pattern({other, light}, "b", 1));
    EXPECT_NE(pattern({light, other}, "a", 1), pattern({light, other}, "a", 2));
    EXPECT_NE(pattern({light, other}, "a", 1), pattern({light, other}, "b", 1));
}

TEST(Evaluate, NothingThatIsNotFiniteReachesTheRenderer) {
    std::vector<Light> lights;
    for (const double bad : {nan, infinity, -infinity, 1e300, -1e300, 1e7, 0.0}) {
        lights.push_back(lamp(bad, 100, 10));
        lights.push_back(lamp(0, bad, 10));
        lights.push_back(lamp(0, 100, bad));
        lights.push_back(lamp(0, 100, 10, bad));
        lights.push_back(lamp(0, 100, 10));
        lights.back().radius_m = bad;
        lights.push_back(lamp(0, 100, 10));
        lights.back().visibility = static_cast<float>(std::clamp(bad, -1e30, 1e30));
        lights.push_back(lamp(0, 100, 10));
        lights.back().true_north_deg = bad;
        lights.back().sectors = {{Colour::white, 0, bad, bad, bad}, {Colour::white, bad, 20, 1, 2}};
        lights.push_back(lamp(0, 100, 10));
        lights.back().vertical = {{-bad, bad}, {bad, 1}};
        lights.push_back(lamp(0, 100, 10));
        lights.back().rhythm.phases = {{bad, true, Colour::white, bad}, {1, false}};
        lights.back().rhythm.period_s = bad;
        lights.push_back(lamp(0, 1, 10, 1e8));
    }
    for (const double bad : {nan, infinity, 0.0, 1e7, -5.0}) {
        for (int field = 0; field < 5; ++field) {
            Observer observer = looking_north();
            if (field == 0) observer.time_s = bad;
            if (field == 1) observer.exposure_s = bad;
            if (field == 2) observer.extinction_per_m = bad;
            if (field == 3) observer.eye_m = {bad, bad, bad};
            if (field == 4) observer.least_illuminance_lx = bad;
            for (const glare::PointSource& source : evaluated(lights, observer).sources) {
                for (const float value : source.position_view_m)
                    ASSERT_TRUE(std::isfinite(value));
                for (const float value : source.illuminance_rgb_lx)
                    ASSERT_TRUE(std::isfinite(value));
                ASSERT_TRUE(std::isfinite(source.radius_m));
                ASSERT_TRUE(std::isfinite(source.illuminance_scotopic_lx));
            }
        }
    }
}

TEST(Evaluate, TheFaintestLightThatCountsSurvivesTheNarrowing) {
    Observer observer = looking_north(300);
    const double lux = lux_of(lamp(0, 60e3, 300, 0.01), observer);
    EXPECT_NEAR(lux / 2.78e-12, 1, 0.01);
}

// Each below what counts alone, but not all together.
TEST(Evaluate, ACrowdOfFaintLightsIsNotLeftOut) {
    for (const Culling culling : {Culling::by_index, Culling::one_by_one}) {
        LightStore store;
        for (int i = 0; i < 5000; ++i) {
            Light light;
            light.position_m = {i * 0.01, 5000, 10};
            light.intensity_cd[0] = 1;
            store.add(light);
        }
        store.optimise();
        Observer observer;
        observer.eye_m = {0, 0, 10};
        observer.least_illuminance_lx = 1e-7;  // each gives 4e-8 lx
        Evaluated out;
        evaluate(store, observer, out, culling);
        EXPECT_EQ(out.too_faint, 5000U);
        EXPECT_GE(out.too_faint_lx, 2e-4 * 0.999);
        EXPECT_LE(out.too_faint_lx, 2e-4 * 1.001);
        observer.most_left_out_lx = 16e-7;
        evaluate(store, observer, out, culling);
        EXPECT_EQ(out.sources.size(), 5000U);
        observer.most_left_out_lx = 3e-4;
        evaluate(store, observer, out, culling);
        EXPECT_EQ(out.sources.size(), 0U);
    }
}

TEST(Evaluate, ASteadyFrameKeepsItsMemory) {
    LightStore store;
    for (int i = 0; i < 100; ++i)
        store.add(lamp(i, 100, 10));
    Evaluated out;
    evaluate(store, looking_north(), out);
    const auto* const sources = out.sources.data();
    const auto* const lights = out.light.data();
    for (int i = 0; i < 10; ++i)
        evaluate(store, looking_north(), out);
    EXPECT_EQ(out.sources.data(), sources);
    EXPECT_EQ(out.light.data(), lights);
    EXPECT_EQ(out.sources.size(), 100U);
}

}  // namespace
}  // namespace seaglare::lightdb
