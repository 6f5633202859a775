// Waves by linear theory, and buoys as the damped oscillators that they drive.
#include "lightdb/buoy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "lightdb/evaluate.h"
#include "lightdb/profile.h"

namespace seaglare::lightdb {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

Buoy moored(double east_m = 0, double north_m = 0) {
    Buoy buoy;
    buoy.body_id = 5;
    buoy.position_m = {east_m, north_m, 0};
    return buoy;
}

// The body's z axis in the scene.
Vec3 mast_of(const BodyPose& pose) {
    return rotate(pose.orientation, {0, 0, 1});
}

// ---- waves ----

TEST(Waves, DispersionOfDeepWater) {
    // A period of 10 s is 156.1 m long: g T^2 / 2 pi.
    const WaveComponent wave = wave_of_frequency(1, 0, 2 * pi / 10, 0, infinity);
    EXPECT_NEAR(2 * pi / wave.wavenumber_rad_m, gravity_m_s2 * 100 / (2 * pi), 1e-9);
    EXPECT_NEAR(2 * pi / wave.wavenumber_rad_m, 156.08, 0.01);
}

TEST(Waves, DispersionOfShallowWaterIsTheSpeedOfLongWaves) {
    const WaveComponent wave = wave_of_length(0.1, 0, 10000, 0, 2);
    EXPECT_NEAR(wave.angular_frequency_rad_s / wave.wavenumber_rad_m, std::sqrt(gravity_m_s2 * 2), 1e-5);
}

TEST(Waves, FrequencyAndLengthAreInverses) {
    for (const double depth_m : {0.5, 3.0, 20.0, 400.0, infinity}) {
        for (const double k : {1e-3, 0.02, 0.3, 4.0, 60.0})
            EXPECT_NEAR(wavenumber_of(angular_frequency_of(k, depth_m), depth_m) / k, 1, 1e-12)
                << k << " in " << depth_m << " m";
    }
}

TEST(Waves, AreCutWhereTheyBreak) {
    // Michell 1893: height 0.142 of the length in deep water.
    EXPECT_NEAR(wave_of_length(100, 0, 10, 0, infinity).amplitude_m, 0.71, 1e-12);
    EXPECT_EQ(wave_of_length(0.7, 0, 10, 0, infinity).amplitude_m, 0.7);
}

TEST(Waves, RunTowardsTheirDirection) {
    // Towards the east: a quarter period later the crest is a quarter of the length further east.
    const WaveComponent wave = wave_of_length(0.5, 90, 20, 0, infinity);
    const std::vector<WaveComponent> sea = {wave};
    const double quarter_s = pi / 2 / wave.angular_frequency_rad_s;
    EXPECT_NEAR(sea_surface(sea, 0, 7, 0).elevation_m, 0.5, 1e-12);
    EXPECT_NEAR(sea_surface(sea, 5, 7, quarter_s).elevation_m, 0.5, 1e-9);
    // Behind the crest the water falls towards the west: it rises to the east.
    EXPECT_GT(sea_surface(sea, -2, 0, 0).slope_east, 0);
    EXPECT_NEAR(sea_surface(sea, -2, 0, 0).slope_north, 0, 1e-12);
}

TEST(Waves, SlopeIsTheDerivativeOfTheElevation) {
    const std::vector<WaveComponent> sea = {wave_of_length(0.8, 30, 25, 0.7, infinity),
                                            wave_of_length(0.2, 250, 6, 2.1, 4)};
    const double h = 1e-5;
    const SeaSurface at = sea_surface(sea, 3, -8, 12.5);
    EXPECT_NEAR(
        at.slope_east,
        (sea_surface(sea, 3 + h, -8, 12.5).elevation_m - sea_surface(sea, 3 - h, -8, 12.5).elevation_m) /
            (2 * h),
        1e-8);
    EXPECT_NEAR(
        at.slope_north,
        (sea_surface(sea, 3, -8 + h, 12.5).elevation_m - sea_surface(sea, 3, -8 - h, 12.5).elevation_m) /
            (2 * h),
        1e-8);
}

// ---- the oscillator ----

// x'' + 2 z w0 x' + w0^2 x = w0^2 cos(w t) has the amplitude 1 / sqrt((1 - r^2)^2 + (2 z r)^2) and lags by
// atan2(2 z r, 1 - r^2), r = w / w0.
TEST(Oscillator, AmplitudeAndLagBelowAtAndAboveResonance) {
    const Oscillator oscillator = {4, 0.1};
    const double w0 = 2 * pi / 4;
    EXPECT_NEAR(std::abs(response(oscillator, 1e-9)), 1, 1e-12);
    EXPECT_NEAR(std::abs(response(oscillator, 0.5 * w0)), 1 / std::hypot(0.75, 0.1), 1e-12);
    EXPECT_NEAR(std::arg(response(oscillator, 0.5 * w0)), std::atan2(0.1, 0.75), 1e-12);
    EXPECT_NEAR(std::abs(response(oscillator, w0)), 5, 1e-12) << "1 / 2 z";
    EXPECT_NEAR(std::arg(response(oscillator, w0)), pi / 2, 1e-12);
    EXPECT_NEAR(std::abs(response(oscillator, 3 * w0)), 1 / std::hypot(8, 0.6), 1e-12);
    EXPECT_NEAR(std::arg(response(oscillator, 3 * w0)), std::atan2(0.6, -8), 1e-12);
}

TEST(BuoyPose, HeaveIsTheClosedFormOfTheDrivenOscillator) {
    Buoy buoy = moored();
    buoy.heave = {3, 0.2};
    for (const double ratio : {0.3, 1.0, 2.5}) {
        const double w = ratio * 2 * pi / 3;
        const std::vector<WaveComponent> sea = {wave_of_frequency(0.1, 40, w, 0.3, infinity)};
        const double gain = 1 / std::hypot(1 - ratio * ratio, 0.4 * ratio);
        const double lag = std::atan2(0.4 * ratio, 1 - ratio * ratio);
        for (double t = 0; t < 10; t += 0.37)
            EXPECT_NEAR(buoy_pose(buoy, sea, t).position_m[2], 0.1 * gain * std::cos(w * t - 0.3 - lag),
                        1e-12);
    }
}

// The equation itself, by differences, for a sea of several components.
TEST(BuoyPose, ObeysTheEquationOfMotion) {
    Buoy buoy = moored(17, -4);
    buoy.heave = {2.5, 0.25};
    const std::vector<WaveComponent> sea = {wave_of_length(0.6, 80, 40, 0.7, infinity),
                                            wave_of_length(0.3, 100, 14, 1.9, infinity),
                                            wave_of_length(0.1, 20, 5, 4.4, infinity)};
    const double h = 1e-3, w0 = 2 * pi / 2.5;
    for (const double t : {0.0, 3.3, 100.1}) {
        const auto z = [&](double at_s) { return buoy_pose(buoy, sea, at_s).position_m[2]; };
        const double velocity = (z(t + h) - z(t - h)) / (2 * h);
        const double acceleration = (z(t + h) - 2 * z(t) + z(t - h)) / (h * h);
        EXPECT_NEAR(acceleration + 2 * 0.25 * w0 * velocity + w0 * w0 * z(t),
                    w0 * w0 * sea_surface(sea, 17, -4, t).elevation_m, 1e-4);
    }
}

TEST(BuoyPose, AQuickBuoyStandsOnTheSlopeOfALongSwell) {
    Buoy buoy = moored(30, 12);
    buoy.roll = {0.1, 1};
    buoy.heave = {0.1, 1};
    const std::vector<WaveComponent> sea = {wave_of_length(2, 60, 100, 1, infinity)};
    for (double t = 0; t < 8; t += 0.5) {
        const SeaSurface surface = sea_surface(sea, 30, 12, t);
        const Vec3 mast = mast_of(buoy_pose(buoy, sea, t));
        const double size = std::sqrt(1 + surface.slope_east * surface.slope_east +
                                      surface.slope_north * surface.slope_north);
        EXPECT_NEAR(mast[0], -surface.slope_east / size, 0.004);
        EXPECT_NEAR(mast[1], -surface.slope_north / size, 0.004);
        EXPECT_NEAR(buoy_pose(buoy, sea, t).position_m[2], surface.elevation_m, 0.06);
    }
}

TEST(BuoyPose, TiltIsTheClosedFormAndLiesInTheDirectionOfTheWave) {
    Buoy buoy = moored();
    buoy.roll = {4, 0.1};
    const double w = 2 * pi / 4;  // at resonance: five times the slope, a quarter period late
    const WaveComponent wave = wave_of_frequency(0.1, 90, w, 0, infinity);
    const std::vector<WaveComponent> sea = {wave};
    const double slope = 0.1 * wave.wavenumber_rad_m;
    double steepest = 0;
    for (double t = 0; t < 4; t += 0.01) {
        const Vec3 mast = mast_of(buoy_pose(buoy, sea, t));
        // The slope at the mooring is slope * sin(w t); the answer lags by pi / 2.
        EXPECT_NEAR(-mast[0] / mast[2], 5 * slope * std::sin(w * t - pi / 2), 1e-12);
        EXPECT_NEAR(mast[1], 0, 1e-15);
        steepest = std::max(steepest, std::abs(mast[0] / mast[2]));
    }
    EXPECT_NEAR(steepest, 5 * slope, 1e-4);
}

TEST(BuoyPose, NeverLeansFurtherThanItsLimit) {
    Buoy buoy = moored();
    buoy.roll = {2 * pi / std::sqrt(gravity_m_s2 * 2 * pi / 8), 0.01};
    buoy.max_tilt_deg = 35;
    const std::vector<WaveComponent> sea = {wave_of_length(50, 0, 8, 0, infinity)};
    double lowest = 1;
    for (double t = 0; t < 10; t += 0.05)
        lowest = std::min(lowest, mast_of(buoy_pose(buoy, sea, t))[2]);
    EXPECT_NEAR(lowest, std::cos(35 * pi / 180), 1e-12);
}

TEST(BuoyPose, StandsUprightInStillWater) {
    const Buoy buoy = moored(3, 4);
    for (const auto& sea :
         {std::vector<WaveComponent>{}, std::vector<WaveComponent>{wave_of_length(0, 10, 20, 1, infinity)}}) {
        const BodyPose pose = buoy_pose(buoy, sea, 1234.5);
        EXPECT_EQ(pose.position_m, (Vec3{3, 4, 0}));
        EXPECT_EQ(pose.orientation, (Quaternion{0, 0, 0, 1}));
    }
}

TEST(BuoyPose, ATimeThatIsNoneGivesAPoseAllTheSame) {
    const std::vector<WaveComponent> sea = {wave_of_length(1, 10, 20, 1, infinity)};
    const BodyPose pose = buoy_pose(moored(), sea, std::nan(""));
    EXPECT_TRUE(std::isfinite(pose.position_m[2] + pose.orientation[0]));
}

TEST(BuoyPose, IsOfItsNearestMicrosecondAfterManyDays) {
    // At t = 1e7 s the phase of each wave still tells a microsecond: neighbours differ by what the speed allows.
    Buoy buoy = moored();
    const std::vector<WaveComponent> sea = {wave_of_frequency(1, 10, 1, 0, infinity)};
    const double now = buoy_pose(buoy, sea, 1e7).position_m[2];
    const double turns = std::remainder(1e7, 2 * pi);
    EXPECT_NEAR(now, buoy_pose(buoy, sea, turns).position_m[2], 1e-6);
}

TEST(BuoyDefaults, FollowTheFocalHeight) {
    Buoy buoy = moored();
    buoy.focal_height_m = 4;
    EXPECT_NEAR(roll_of(buoy).period_s, 4.013, 0.001);
    EXPECT_NEAR(heave_of(buoy).period_s, 2.837, 0.001);
    buoy.roll.period_s = 3;
    EXPECT_EQ(roll_of(buoy).period_s, 3);
    EXPECT_EQ(roll_of(buoy).damping, 0.1);
}

// ---- fields of buoys ----

TEST(BuoyField, PosesEqualThoseOfThePureFunction) {
    const std::vector<WaveComponent> sea = {wave_of_length(0.6, 80, 40, 0.7, infinity),
                                            wave_of_length(0.3, 200, 14, 1.9, 8)};
    BuoyField field;
    field.set_waves(sea);
    for (std::uint32_t i = 1; i < 20; ++i) {
        Buoy buoy = moored(13.0 * i, -7.0 * i);
        buoy.body_id = 100 - i;
        field.add(buoy);
    }
    EXPECT_EQ(field.size(), 19U);
    LightStore store;
    for (const double t : {0.0, 77.7, 1e7}) {
        field.pose(t, store);
        for (std::uint32_t i = 1; i < 20; ++i) {
            const BodyPose is = *store.body_pose(100 - i);
            const BodyPose should = buoy_pose(*field.find(100 - i), sea, t);
            for (std::size_t k = 0; k < 3; ++k)
                EXPECT_NEAR(is.position_m[k], should.position_m[k], 1e-12);
            for (std::size_t k = 0; k < 4; ++k)
                EXPECT_NEAR(is.orientation[k], should.orientation[k], 1e-12);
        }
    }
}

TEST(BuoyField, DependsOnNeitherTheOrderNorTheHistory) {
    const std::vector<WaveComponent> sea = {wave_of_length(0.6, 80, 40, 0.7, infinity)};
    BuoyField one, other;
    Buoy a = moored(1, 2), b = moored(30, 40);
    b.body_id = 6;
    one.add(a);
    one.add(b);
    one.set_waves(sea);
    other.set_waves({wave_of_length(2, 10, 90, 0, infinity)});
    other.add(b);
    other.add(moored(900, 900));
    other.add(a);  // replaces the one before
    other.set_waves(sea);
    LightStore first, second;
    for (double t = 0; t < 100; ++t)
        other.pose(t, second);
    one.pose(1e7, first);
    other.pose(1e7, second);
    for (const std::uint32_t body : {5U, 6U}) {
        EXPECT_EQ(first.body_pose(body)->position_m, second.body_pose(body)->position_m);
        EXPECT_EQ(first.body_pose(body)->orientation, second.body_pose(body)->orientation);
    }
}

TEST(BuoyField, StillWaterSetsThePoseOnceAndNewWavesSetItAgain) {
    BuoyField field;
    field.add(moored(3, 4));
    LightStore store;
    field.pose(1, store);
    ASSERT_NE(store.body_pose(5), nullptr);
    EXPECT_EQ(store.body_pose(5)->position_m, (Vec3{3, 4, 0}));
    field.set_waves({wave_of_length(1, 90, 30, 0, infinity)});
    field.pose(1, store);
    EXPECT_NE(store.body_pose(5)->position_m[2], 0);
    field.set_waves({});
    field.pose(2, store);
    EXPECT_EQ(store.body_pose(5)->position_m, (Vec3{3, 4, 0}));
    EXPECT_TRUE(field.remove(5));
    EXPECT_FALSE(field.remove(5));
}

// ---- on a round Earth ----

TEST(BuoyOnARoundEarth, StandsUprightWhereItIs) {
    const GeographicPoint origin = {55, 11, 0};
    Buoy buoy;
    buoy.geographic = true;
    buoy.latitude_deg = 56;  // 111.4 km north: leans a degree away from the origin
    buoy.longitude_deg = 11;
    place_buoy(buoy, origin, Earth::round);
    const Vec3 mast = rotate(buoy.upright, {0, 0, 1});
    EXPECT_NEAR(std::atan2(mast[1], mast[2]) * 180 / pi, 1, 1e-9);
    EXPECT_NEAR(mast[0], 0, 1e-12);
    place_buoy(buoy, origin, Earth::flat);
    EXPECT_EQ(buoy.upright, (Quaternion{0, 0, 0, 1}));
    EXPECT_EQ(buoy.position_m[2], 0);
}

// ---- what it does to the light ----

// A lantern of 100 cd with the vertical profile of a Sabik VP (half at 5 degrees, a tenth at 10), 4 m up the mast of a
// buoy that leans 5 degrees towards the eye at the crest's side: worked by hand.
TEST(BuoyLight, ALeaningLanternShowsItsProfileTilted) {
    LightStore store;
    Light lamp;
    lamp.body_id = 5;
    lamp.position_m = {0, 0, 4};
    lamp.intensity_cd[0] = 100;
    lamp.vertical = *named_vertical_profile("sabik_vp");
    store.add(lamp);
    Buoy buoy = moored();
    buoy.roll = {4, 0.5};  // at resonance the gain is 1, the lag a quarter period
    buoy.heave = {4, 0.5};
    const double w = 2 * pi / 4;
    WaveComponent wave = wave_of_frequency(0.1, 90, w, 0, infinity);
    wave.amplitude_m = std::tan(5 * pi / 180) / wave.wavenumber_rad_m;  // slopes of 5 degrees
    BuoyField field;
    field.add(buoy);
    field.set_waves({wave});

    Observer observer;
    observer.geographic_horizon = false;
    observer.view_from_scene = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const auto candela = [&](double time_s) {
        field.pose(time_s, store);
        observer.time_s = time_s;
        const Light light = *store.find(store.ids().front());
        const auto at = scene_position_m(store, light);
        observer.eye_m = {at[0] + 1000, at[1], at[2]};  // to the east, level with the lamp
        return intensity_towards_cd(store, light, observer)[0];
    };
    // Slope at the mooring: tan 5 deg * sin(w t); its answer: tan 5 deg * sin(w t - pi / 2). So at t = 0 it is -tan 5 deg:
    // the surface falls to the east, the mast leans east by 5 degrees, and an eye to the east is 5 degrees above the
    // lamp's own horizon: half.
    EXPECT_NEAR(candela(0), 50, 1e-6);
    EXPECT_NEAR(candela(1), 100, 1e-6);  // upright
    EXPECT_NEAR(candela(2), 50, 1e-6);   // leans west
    EXPECT_NEAR(candela(3), 100, 1e-6);
    // At t = 0.5 s it leans atan(tan 5 deg / sqrt 2) = 3.5399 degrees: 1 - 0.5 * 3.5399 / 5.
    EXPECT_NEAR(candela(0.5), 64.60, 0.01);
    // The lamp itself moves 4 m * sin 5 deg to the east at t = 0.
    field.pose(0, store);
    const auto at = scene_position_m(store, *store.find(store.ids().front()));
    EXPECT_NEAR(at[0], 4 * std::sin(5 * pi / 180), 1e-9);
    EXPECT_NEAR(at[2], 4 * std::cos(5 * pi / 180), 1e-9) << "at t = 0 the heave, a quarter period late, is 0";
}

}  // namespace
}  // namespace seaglare::lightdb
