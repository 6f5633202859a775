// What a light sends in a direction: sectors, tables, solids and turning beams, on the ground and on a ship that rolls.
#include "lightdb/emission.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <numbers>

#include "lightdb/evaluate.h"
#include "lightdb/light_store.h"
#include "lightdb/photometry_file.h"
#include "lightdb/profile.h"
#include "lightdb/rotation.h"

namespace {

int allocation_count = 0;

}  // namespace

[[gnu::noinline]] void* operator new(std::size_t size) {
    ++allocation_count;
    void* const memory = std::malloc(size != 0 ? size : 1);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

// std::stable_sort asks for its room this way and gives it back by the plain delete.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
    ++allocation_count;
    return std::malloc(size != 0 ? size : 1);
}

[[gnu::noinline]] void operator delete(void* memory) noexcept {
    std::free(memory);
}

[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept {
    std::free(memory);
}

namespace seaglare::lightdb {
namespace {

constexpr std::size_t white = static_cast<std::size_t>(Colour::white);
constexpr std::size_t red = static_cast<std::size_t>(Colour::red);
constexpr std::size_t green = static_cast<std::size_t>(Colour::green);
constexpr double rad_per_deg = std::numbers::pi / 180;
constexpr std::uint32_t ship = 7;

Light light_of(Colour colour, double intensity_cd) {
    Light light;
    light.name = "light";
    light.position_m = {0, 0, 20};
    light.intensity_cd[static_cast<std::size_t>(colour)] = intensity_cd;
    return light;
}

// From an eye 1000 m away on a bearing (clockwise from the scene's north) and elevation, as the light sees it.
Intensities towards(const LightStore& store, const Light& light, double bearing_deg, double elevation_deg = 0,
                    double time_s = 0, double exposure_s = 0) {
    const double b = bearing_deg * rad_per_deg;
    const double e = elevation_deg * rad_per_deg;
    const Vec3 way_m = {1000 * std::cos(e) * std::sin(b), 1000 * std::cos(e) * std::cos(b),
                        1000 * std::sin(e)};
    Observer observer;
    observer.eye_m = scene_position_m(store, light) + way_m;
    observer.time_s = time_s;
    observer.exposure_s = exposure_s;
    return intensity_towards_cd(store, light, observer);
}

Intensities towards(const Light& light, double bearing_deg, double elevation_deg = 0) {
    return towards(LightStore(), light, bearing_deg, elevation_deg);
}

// A ship heading north, rolled to starboard and pitched bow up.
LightStore sea_with_ship(double roll_deg, double pitch_deg = 0, double heading_deg = 0) {
    const auto about = [](const Vec3& axis, double deg) {
        const double half = deg * rad_per_deg / 2;
        return Quaternion{axis[0] * std::sin(half), axis[1] * std::sin(half), axis[2] * std::sin(half),
                          std::cos(half)};
    };
    const auto times = [](const Quaternion& a, const Quaternion& b) {
        const Vec3 v = {a[0], a[1], a[2]};
        const Vec3 w = {b[0], b[1], b[2]};
        const Vec3 c = cross(v, w);
        return Quaternion{a[3] * w[0] + b[3] * v[0] + c[0], a[3] * w[1] + b[3] * v[1] + c[1],
                          a[3] * w[2] + b[3] * v[2] + c[2], a[3] * b[3] - dot(v, w)};
    };
    LightStore store;
    store.set_body_pose(ship, {{300, -200, 0},
                               times(about({0, 0, 1}, -heading_deg),
                                     times(about({1, 0, 0}, pitch_deg), about({0, 1, 0}, roll_deg)))});
    return store;
}

// COLREG 1972 Annex I: 225 degrees of arc, section 10(a) vertically.
Light masthead_light() {
    Light light = light_of(Colour::white, 94);
    light.body_id = ship;
    light.sector_reference = SectorReference::outward_from_ahead;
    light.sectors = {{Colour::white, 247.5, 112.5}};
    light.vertical = *named_vertical_profile("colreg_power");
    return light;
}

// Rolled by 10 degrees the eye abeam to starboard stands 10 degrees above the lantern's own plane, where the profile has
// kept 60 %; at 6 degrees 1 - 0.4 (6 - 5) / 2.5 = 84 %. Ahead the roll changes nothing.
TEST(Emission, AMastheadLightDimsAbeamAsTheShipRollsAndNotAhead) {
    const Light light = masthead_light();
    EXPECT_NEAR(towards(sea_with_ship(0), light, 90)[white], 94, 1e-9);
    EXPECT_NEAR(towards(sea_with_ship(10), light, 90)[white], 94 * 0.6, 1e-9);
    EXPECT_NEAR(towards(sea_with_ship(10), light, 270)[white], 94 * 0.6, 1e-9);
    EXPECT_NEAR(towards(sea_with_ship(10), light, 0)[white], 94, 1e-9);
    EXPECT_NEAR(towards(sea_with_ship(6), light, 90)[white], 94 * 0.84, 1e-9);
    // On the bow, 45 degrees to starboard: asin(sin 10 sin 45) = 7.05302 degrees above the plane.
    EXPECT_NEAR(towards(sea_with_ship(10), light, 45)[white], 94 * (1 - 0.4 * 2.05302 / 2.5), 1e-4);
    // Pitched, it is the other way round.
    EXPECT_NEAR(towards(sea_with_ship(0, 6), light, 0)[white], 94 * 0.84, 1e-9);
    EXPECT_NEAR(towards(sea_with_ship(0, 6), light, 90)[white], 94, 1e-9);
    EXPECT_EQ(towards(sea_with_ship(10), light, 180)[white], 0);  // abaft the arc
}

TEST(Emission, SidelightsTurnWithTheShip) {
    Light light = light_of(Colour::green, 12);
    light.body_id = ship;
    light.sector_reference = SectorReference::outward_from_ahead;
    light.sectors = {{Colour::green, 0, 112.5}};
    const LightStore eastward = sea_with_ship(0, 0, 90);
    EXPECT_EQ(towards(eastward, light, 91)[green], 12);
    EXPECT_EQ(towards(eastward, light, 180)[green], 12);
    EXPECT_EQ(towards(eastward, light, 202)[green], 12);
    EXPECT_EQ(towards(eastward, light, 203)[green], 0);
    EXPECT_EQ(towards(eastward, light, 89)[green], 0);
}

// A lantern whose vertical limit tilts with the ship: obscured above 8 degrees of its own plane.
TEST(Emission, VerticalSectorsRollWithTheShip) {
    Light light = light_of(Colour::white, 10);
    light.body_id = ship;
    light.sector_reference = SectorReference::outward_from_ahead;
    light.sectors = {{Colour::white, 0, 360}};
    light.sectors[0].to_elevation_deg = 8;
    EXPECT_EQ(towards(sea_with_ship(7), light, 90)[white], 10);
    EXPECT_EQ(towards(sea_with_ship(9), light, 90)[white], 0);
    EXPECT_EQ(towards(sea_with_ship(9), light, 270)[white], 10);
    EXPECT_EQ(towards(sea_with_ship(0), light, 123, 7.9)[white], 10);
    EXPECT_EQ(towards(sea_with_ship(0), light, 123, 8.1)[white], 0);
}

// The navigator south of the light reads 000 degrees, and true north of the light need not be the scene's.
TEST(Emission, SectorsFromSeawardAreTheNavigatorsTrueBearings) {
    Light light = light_of(Colour::red, 9);
    light.intensity_cd[white] = 30;
    light.sectors = {{Colour::red, 350, 10}, {Colour::white, 10, 100}};
    EXPECT_EQ(towards(light, 180)[red], 9);
    EXPECT_EQ(towards(light, 189.9)[red], 9);
    EXPECT_EQ(towards(light, 190.1)[white], 30);
    EXPECT_EQ(towards(light, 0)[red] + towards(light, 0)[white], 0);
    light.true_north_deg = 0.29;  // so a bearing of the scene of 10.1 is 9.81 true
    EXPECT_EQ(towards(light, 190.1)[red], 9);
    EXPECT_EQ(towards(light, 190.4)[white], 30);
    // A lantern turned on its pedestal changes no charted sector.
    light.orientation = {0, 0, 1, 0};
    EXPECT_EQ(towards(light, 190.4)[white], 30);
}

TEST(Emission, AHorizontalTableTurnsWithTheLanternAndRunsOnThroughAhead) {
    Light light = light_of(Colour::white, 100);
    light.horizontal = {{90, 270}, {1, 0}};
    EXPECT_NEAR(towards(light, 90)[white], 100, 1e-9);
    EXPECT_NEAR(towards(light, 0)[white], 50, 1e-9);  // through 000 from 0 at 270 to 1 at 90
    EXPECT_NEAR(towards(light, 315)[white], 25, 1e-9);
    EXPECT_NEAR(towards(light, 225)[white], 25, 1e-9);
    const double quarter = std::sqrt(0.5);
    light.orientation = {0, 0, -quarter, quarter};  // its ahead to the east
    EXPECT_NEAR(towards(light, 180)[white], 100, 1e-9);
    EXPECT_NEAR(towards(light, 90)[white], 50, 1e-9);
}

TEST(Emission, AVerticalTableKeepsItsEnds) {
    Light light = light_of(Colour::white, 100);
    light.vertical = *named_vertical_profile("sabik_vp");
    EXPECT_NEAR(towards(light, 10, 5)[white], 50, 1e-6);
    EXPECT_NEAR(towards(light, 10, 60)[white], 10, 1e-9);
    EXPECT_NEAR(towards(light, 10, -90)[white], 10, 1e-9);
}

std::shared_ptr<const PhotometricSolid> solid_of(int type, const std::string& rest) {
    return parse_ies(
               "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 3 " + std::to_string(type) + " 2 0 0 0\n1 1 0\n" + rest,
               "a.ies")
        .solid;
}

TEST(Emission, ASolidShapesWhatTheLightsOwnIntensityScales) {
    Light light = light_of(Colour::green, 500);
    light.photometry = solid_of(1, "0 90 180\n0 90 180\n0 80 0\n0 40 0\n0 20 0\n");
    EXPECT_NEAR(towards(light, 0)[green], 500, 1e-9);  // the peak in the horizontal plane
    EXPECT_NEAR(towards(light, 90)[green], 250, 1e-9);
    EXPECT_NEAR(towards(light, 180)[green], 125, 1e-9);
    EXPECT_NEAR(towards(light, 0, 45)[green], 250, 1e-6);
    // With the file's own peak as the intensity the file's candela hold.
    light.intensity_cd[green] = light.photometry->reference_cd;
    EXPECT_NEAR(towards(light, 135)[green], 30, 1e-9);
    EXPECT_NEAR(towards(light, 135, -45)[green], 15, 1e-6);
}

TEST(Emission, ASolidRollsWithTheShipInBothKindsOfGrid) {
    for (const int type : {2, 3}) {
        Light light = light_of(Colour::white, 100);
        light.body_id = ship;
        light.photometry = solid_of(type, "-20 0 20\n-90 0 90\n0 50 0\n0 100 0\n0 50 0\n");
        EXPECT_NEAR(towards(sea_with_ship(0), light, 0)[white], 100, 1e-6) << type;
        EXPECT_NEAR(towards(sea_with_ship(0, 5), light, 0)[white], 75, 1e-6)
            << type;  // bow up: the eye 5 below the beam
        EXPECT_NEAR(towards(sea_with_ship(15), light, 0)[white], 100, 1e-6)
            << type;  // rolled about the beam's axis
        EXPECT_NEAR(towards(sea_with_ship(0, 0, 45), light, 0)[white], 75, 1e-6)
            << type;  // 45 to port of the beam
        EXPECT_EQ(towards(sea_with_ship(0), light, 180)[white], 0) << type;
    }
}

TEST(Emission, TablesSolidsAndSectorsMultiply) {
    Light light = light_of(Colour::white, 100);
    light.sectors = {{Colour::white, 0, 360, 0.5}};
    light.vertical = {{-90, 90}, {0.5, 0.5}};
    light.horizontal = {{0}, {0.5}};
    light.photometry = solid_of(1, "0 90 180\n0 90 180\n0 80 0\n0 40 0\n0 80 0\n");
    light.rotation = {0, {{0}, {0.5}}};
    EXPECT_NEAR(towards(light, 90)[white], 100 * 0.5 * 0.5 * 0.5 * 0.5 * 0.5, 1e-9);
}

// A beam of 4 degrees' foot, a triangle: 2 degrees of full light in a turn of 10 s.
Light turning_light() {
    Light light = light_of(Colour::white, 1000);
    light.rotation = {10, {{-2, 0, 2}, {0, 1, 0}}};
    light.stable_key = 4711;
    return light;
}

TEST(Emission, ATurningBeamLosesNoLightBetweenFrames) {
    const Light light = turning_light();
    const LightStore store;
    double sum = 0;
    constexpr int frames = 300;
    for (int i = 0; i < frames; ++i)
        sum += towards(store, light, 77, 0, (i + 1) / 30.0, 1 / 30.0)[white];
    EXPECT_NEAR(sum / frames, 1000 * 2 / 360.0, 1e-6);
}

TEST(Emission, ATurningBeamKeepsThePhaseOfItsKeyOrItsGroup) {
    Light light = turning_light();
    const LightStore store;
    const auto passes = [&](const Light& of) {  // when the beam is brightest towards north
        double best_s = 0;
        double brightest = 0;
        for (double t = 0; t < 10; t += 0.005) {
            const double here = towards(store, of, 0, 0, t)[white];
            if (here > brightest) {
                brightest = here;
                best_s = t;
            }
        }
        EXPECT_GT(brightest, 850);
        return best_s;
    };
    const double expected_s = std::fmod(10 - std::fmod(phase_offset_s(light.rhythm, 4711, 0), 10), 10);
    EXPECT_NEAR(passes(light), expected_s, 0.01);
    Light other = light;
    other.stable_key = 4712;
    EXPECT_GT(std::abs(passes(other) - passes(light)), 0.05);
    light.rhythm.sync_group = other.rhythm.sync_group = "range";
    EXPECT_EQ(passes(other), passes(light));
    // It turns with the lantern's ahead: a quarter of a turn further to the east is a quarter of a period later.
    const double at_east = towards(store, light, 90, 0, passes(light) + 2.5)[white];
    EXPECT_GT(at_east, 850);
}

TEST(Emission, ALeadingBearingChangesNothingOfWhatIsSeen) {
    Light light = light_of(Colour::white, 100);
    light.leading_bearing_deg = 90;
    for (const double bearing_deg : {0.0, 90.0, 270.0})
        EXPECT_EQ(towards(light, bearing_deg)[white], 100);
    EXPECT_FALSE(has_direction(light));
}

TEST(Emission, EveryKindOfDirectionIsKnownAsOne) {
    EXPECT_FALSE(has_direction(Light{}));
    Light light;
    light.sectors = {{Colour::white, 0, 90}};
    EXPECT_TRUE(has_direction(light));
    light = {};
    light.vertical = {{0}, {1}};
    EXPECT_TRUE(has_direction(light));
    light = {};
    light.horizontal = {{0}, {1}};
    EXPECT_TRUE(has_direction(light));
    light = {};
    light.photometry = solid_of(1, "0 90 180\n0 90 180\n1 1 1\n1 1 1\n1 1 1\n");
    EXPECT_TRUE(has_direction(light));
    light = {};
    light.rotation = {10, {{0, 180}, {1, 0}}};
    EXPECT_TRUE(has_direction(light));
}

TEST(Emission, NothingIsAllocatedAndNothingIsNotFinite) {
    Light light = masthead_light();
    light.sectors[0].transition_deg = 3;
    light.sectors.push_back({Colour::red, 100, 120, 1, 10, -5, 5});
    light.intensity_cd[red] = 5;
    light.horizontal = {{0, 120, 240}, {1, 0.5, 1}};
    light.rotation = {-7, {{0, 90, 180, 270}, {1, 0.2, 0, 0.2}}};
    light.photometry = solid_of(2, "-90 0 90\n-90 0 90\n1 1 1\n1 1 1\n1 1 1\n");
    const LitFractions lit = lit_during(light, {});
    const double infinite = std::numeric_limits<double>::infinity();
    const double nan = std::nan("");
    const Vec3 ways[] = {{0, 0, 0},      {0, 0, 5},     {1, 1, 0},   {-1, 1, 0.1},
                         {1e-300, 0, 0}, {1e300, 1, 1}, {nan, 1, 1}, {infinite, 0, 0}};
    const int before = allocation_count;
    double sum = 0;
    for (const Vec3& way : ways) {
        for (const double elevation_deg : {-90.0, -4.9, 0.0, 5.0, nan}) {
            for (const double time_s : {0.0, 1e7, nan, infinite}) {
                for (const double candela :
                     emitted_cd(light, lit, {time_s, 0.02, 3}, {way, way, elevation_deg}))
                    sum += candela;
            }
        }
    }
    EXPECT_EQ(allocation_count, before);
    EXPECT_TRUE(std::isfinite(sum));
}

}  // namespace
}  // namespace seaglare::lightdb
