// "seaglare.vessels/1" and "seaglare.waves/1" as a host has them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "plugin_api/context.h"
#include "tests/abi/loaded_plugin.h"

namespace {

using namespace seaglare::test;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double pi = std::numbers::pi;

seaglare_vessel ship() {
    auto vessel = sized<seaglare_vessel>();
    vessel.kind = SEAGLARE_VESSEL_POWER_DRIVEN;
    vessel.body_id = 7;
    vessel.length_m = 120;
    vessel.breadth_m = 18;
    vessel.name = "Skagerrak";
    return vessel;
}

class Vessels : public ::testing::Test {
  protected:
    std::uint32_t count() const {
        std::uint32_t count = 0;
        EXPECT_EQ(plugin_->list_lights(context_, nullptr, 0, &count), SEAGLARE_OK);
        return count;
    }
    seaglare_result add(const seaglare_vessel& vessel, std::uint32_t* added = nullptr) {
        std::array<seaglare_light_id, 64> ids{};
        std::uint32_t number = 0;
        const seaglare_result result = api_->add_vessel(context_, &vessel, ids.data(), ids.size(), &number);
        if (added != nullptr) *added = number;
        return result;
    }
    // The vessel is refused by these words, and nothing is added.
    void expect_refused(const seaglare_vessel& vessel, const std::string& words) {
        EXPECT_EQ(add(vessel), SEAGLARE_ERROR_INVALID_ARGUMENT) << words;
        EXPECT_NE(plugin_.last_error(context_).find(words), std::string::npos)
            << plugin_.last_error(context_) << " lacks " << words;
        EXPECT_EQ(count(), 0U);
    }

    LoadedPlugin plugin_;
    QuickContext context_{plugin_};
    const seaglare_vessels_api* api_ = plugin_.extension<seaglare_vessels_api>("seaglare.vessels/1");
};

TEST_F(Vessels, AllOfHerLightsAreAddedOrNone) {
    ASSERT_NE(api_, nullptr);
    EXPECT_EQ(api_->struct_size, sizeof(seaglare_vessels_api));
    const seaglare_vessel vessel = ship();
    std::uint32_t needed = 0;
    EXPECT_EQ(api_->add_vessel(context_, &vessel, nullptr, 0, &needed), SEAGLARE_OK);
    EXPECT_EQ(needed, 5U) << "two masthead lights, two sidelights, a sternlight";
    EXPECT_EQ(count(), 0U);
    std::array<seaglare_light_id, 8> ids{};
    EXPECT_EQ(api_->add_vessel(context_, &vessel, ids.data(), 4, &needed), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(needed, 5U);
    EXPECT_EQ(count(), 0U);
    EXPECT_EQ(ids[0], 0U);
    EXPECT_EQ(api_->add_vessel(context_, &vessel, ids.data(), 8, &needed), SEAGLARE_OK);
    EXPECT_EQ(count(), 5U);
    EXPECT_NE(ids[4], 0U);
    EXPECT_EQ(ids[5], 0U);
}

TEST_F(Vessels, AreRemovedByTheirIdsAllOrNone) {
    std::array<seaglare_light_id, 5> ids{};
    std::uint32_t number = 0;
    const seaglare_vessel vessel = ship();
    ASSERT_EQ(api_->add_vessel(context_, &vessel, ids.data(), ids.size(), &number), SEAGLARE_OK);
    auto wrong = ids;
    wrong[3] += std::uint64_t{1} << 32;
    EXPECT_EQ(api_->remove_vessel(context_, wrong.data(), 5), SEAGLARE_ERROR_STALE_ID);
    EXPECT_NE(plugin_.last_error(context_).find("ids[3]"), std::string::npos);
    wrong[3] = 0;
    EXPECT_EQ(api_->remove_vessel(context_, wrong.data(), 5), SEAGLARE_ERROR_STALE_ID);
    EXPECT_EQ(count(), 5U);
    EXPECT_EQ(api_->remove_vessel(context_, ids.data(), 5), SEAGLARE_OK);
    EXPECT_EQ(count(), 0U);
    EXPECT_EQ(api_->remove_vessel(context_, ids.data(), 5), SEAGLARE_ERROR_STALE_ID);
    EXPECT_EQ(api_->remove_vessel(context_, nullptr, 0), SEAGLARE_OK);
}

TEST_F(Vessels, EveryKindHasLights) {
    for (std::int32_t kind = 0; kind <= SEAGLARE_VESSEL_AGROUND; ++kind) {
        seaglare_vessel vessel = ship();
        vessel.kind = kind;
        vessel.name = nullptr;
        std::uint32_t added = 0;
        EXPECT_EQ(add(vessel, &added), SEAGLARE_OK) << kind << ": " << plugin_.last_error(context_);
        EXPECT_GT(added, 0U);
    }
}

TEST_F(Vessels, AreRefusedByTheFieldThatIsWrong) {
    seaglare_vessel vessel = ship();
    vessel.kind = 18;
    expect_refused(vessel, "vessel.kind");
    vessel = ship();
    vessel.body_id = 0;
    expect_refused(vessel, "vessel.body_id");
    vessel = ship();
    vessel.flags = 1U << 11;
    expect_refused(vessel, "vessel.flags");
    for (double seaglare_vessel::*field :
         {&seaglare_vessel::length_m, &seaglare_vessel::breadth_m, &seaglare_vessel::tow_length_m,
          &seaglare_vessel::gear_extent_m, &seaglare_vessel::gear_bearing_deg,
          &seaglare_vessel::deck_lights_cd, &seaglare_vessel::deck_height_m, &seaglare_vessel::mast_height_m,
          &seaglare_vessel::mast_separation_m, &seaglare_vessel::intensity_factor,
          &seaglare_vessel::radius_m}) {
        vessel = ship();
        vessel.*field = nan;
        expect_refused(vessel, "not a number");
    }
    vessel = ship();
    vessel.amidships_m[2] = nan;
    expect_refused(vessel, "vessel.amidships_m[2]");
    vessel = ship();
    vessel.length_m = 0;
    expect_refused(vessel, "'length_m'");
    vessel = ship();
    vessel.flags = SEAGLARE_VESSEL_TRICOLOUR;
    expect_refused(vessel, "Rule 25(b)");
    vessel = ship();
    vessel.obstruction_side = 3;
    expect_refused(vessel, "vessel.obstruction_side");
    std::uint32_t number = 0;
    vessel = ship();
    vessel.struct_size = sizeof vessel + 4;
    EXPECT_EQ(api_->add_vessel(context_, &vessel, nullptr, 0, &number), SEAGLARE_ERROR_STRUCT_SIZE);
    EXPECT_EQ(api_->add_vessel(context_, nullptr, nullptr, 0, &number), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(api_->add_vessel(nullptr, &vessel, nullptr, 0, &number), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(api_->add_vessel(context_, &vessel, nullptr, 0, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
}

seaglare_wave swell(double amplitude_m, double wavelength_m, double direction_deg, double phase_rad = 0) {
    auto wave = sized<seaglare_wave>();
    wave.amplitude_m = amplitude_m;
    wave.wavelength_m = wavelength_m;
    wave.direction_deg = direction_deg;
    wave.phase_rad = phase_rad;
    return wave;
}

seaglare_buoy moored(double x, double y, double z = 0) {
    auto buoy = sized<seaglare_buoy>();
    buoy.body_id = 12;
    buoy.position_m[0] = x;
    buoy.position_m[1] = y;
    buoy.position_m[2] = z;
    return buoy;
}

struct Pose {
    double position_m[3] = {};
    double orientation[4] = {};
};

class Waves : public ::testing::Test {
  protected:
    Pose pose(double time_s, seaglare_context* context = nullptr) const {
        Pose result;
        seaglare_context* const of = context != nullptr ? context : static_cast<seaglare_context*>(context_);
        EXPECT_EQ(api_->get_buoy_pose(of, 12, time_s, result.position_m, result.orientation), SEAGLARE_OK)
            << plugin_.last_error(of);
        return result;
    }
    void expect_refused(seaglare_result result, const std::string& words) const {
        EXPECT_EQ(result, SEAGLARE_ERROR_INVALID_ARGUMENT) << words;
        EXPECT_NE(plugin_.last_error(context_).find(words), std::string::npos)
            << plugin_.last_error(context_) << " lacks " << words;
    }

    LoadedPlugin plugin_;
    QuickContext context_{plugin_};
    const seaglare_waves_api* api_ = plugin_.extension<seaglare_waves_api>("seaglare.waves/1");
};

TEST_F(Waves, ABuoyRidesThemInTheHostsWorld) {
    ASSERT_NE(api_, nullptr);
    // East-North-Up, of a swell so long that the buoy follows it: 2 m of heave.
    const seaglare_buoy buoy = moored(100, 50, 0.5);
    const seaglare_wave wave = swell(2, 2000, 90, -2 * pi * 100 / 2000);
    ASSERT_EQ(api_->set_buoy(context_, &buoy), SEAGLARE_OK);
    EXPECT_EQ(pose(3).position_m[2], 0.5) << "still water";
    ASSERT_EQ(api_->set_waves(context_, &wave, 1, 0), SEAGLARE_OK);
    const Pose crest = pose(0);
    EXPECT_EQ(crest.position_m[0], 100);
    EXPECT_EQ(crest.position_m[1], 50);
    EXPECT_NEAR(crest.position_m[2], 2.5, 0.02);
    EXPECT_EQ(api_->set_waves(context_, nullptr, 0, 0), SEAGLARE_OK);
    EXPECT_EQ(pose(0).position_m[2], 0.5);
}

TEST_F(Waves, ABuoyHasThePoseThatSetBodyPoseWouldTakeInEveryWorld) {
    // A buoy that stands on the slope of a swell running north, seen at the place where it rises most to the north: its
    // mast leans south by the slope's angle, in the axes of each world.
    const double slope = 2 * pi * 1.0 / 100;
    struct Row {
        std::int32_t axes;
        std::array<double, 3> up, south;
    };
    for (const Row& row : {Row{SEAGLARE_AXES_EAST_NORTH_UP, {0, 0, 1}, {0, -1, 0}},
                           Row{SEAGLARE_AXES_EAST_UP_SOUTH, {0, 1, 0}, {0, 0, 1}},
                           Row{SEAGLARE_AXES_EAST_UP_NORTH, {0, 1, 0}, {0, 0, -1}},
                           Row{SEAGLARE_AXES_NORTH_EAST_DOWN, {0, 0, -1}, {-1, 0, 0}}}) {
        auto info = sized<seaglare_create_info>();
        info.flags = SEAGLARE_CREATE_NO_OPENCL;
        info.axes = row.axes;
        const TemporaryFile quality("small.json", small_quality);
        info.config_path = quality.path();
        seaglare_context* context = nullptr;
        ASSERT_GE(plugin_->create(&info, &context), 0);
        seaglare_buoy buoy = moored(0, 0);
        buoy.roll_period_s = buoy.heave_period_s = 0.1;
        buoy.roll_damping = buoy.heave_damping = 1;
        const seaglare_wave wave = swell(1, 100, 0, -pi / 2);
        ASSERT_EQ(api_->set_buoy(context, &buoy), SEAGLARE_OK);
        ASSERT_EQ(api_->set_waves(context, &wave, 1, 0), SEAGLARE_OK);
        const Pose is = pose(0, context);
        // The body's own up, turned by the quaternion.
        const double* q = is.orientation;
        const auto& u = row.up;
        std::array<double, 3> t{}, mast{};
        for (std::size_t i = 0; i < 3; ++i)
            t[i] = q[(i + 1) % 3] * u[(i + 2) % 3] - q[(i + 2) % 3] * u[(i + 1) % 3] + q[3] * u[i];
        for (std::size_t i = 0; i < 3; ++i)
            mast[i] = u[i] + 2 * (q[(i + 1) % 3] * t[(i + 2) % 3] - q[(i + 2) % 3] * t[(i + 1) % 3]);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(mast[i], (u[i] + slope * row.south[i]) / std::hypot(1, slope), 0.003)
                << row.axes << " " << i;
        EXPECT_EQ(plugin_->destroy(context), SEAGLARE_OK);
    }
}

TEST_F(Waves, TwoContextsAgreeOnABuoyAfterManyDays) {
    const QuickContext other(plugin_);
    const seaglare_buoy buoy = moored(-300, 80);
    const std::array<seaglare_wave, 2> sea = {swell(0.7, 45, 70, 1), swell(0.2, 9, 100, 2)};
    ASSERT_EQ(api_->set_waves(context_, sea.data(), 2, 0), SEAGLARE_OK);
    ASSERT_EQ(api_->set_buoy(context_, &buoy), SEAGLARE_OK);
    ASSERT_EQ(api_->set_buoy(other, &buoy), SEAGLARE_OK);
    ASSERT_EQ(api_->set_waves(other, sea.data(), 2, sizeof(seaglare_wave)), SEAGLARE_OK);
    for (double t = 0; t < 50; ++t)
        pose(t);  // one of them has a past
    const Pose one = pose(1e7);
    const Pose two = pose(1e7, other);
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(one.position_m[i], two.position_m[i]);
    for (int i = 0; i < 4; ++i)
        EXPECT_EQ(one.orientation[i], two.orientation[i]);
    EXPECT_NE(one.orientation[0], 0);
}

TEST_F(Waves, AHostThatMovesTheBodyItselfHasTheLastWord) {
    const seaglare_buoy buoy = moored(1, 2);
    ASSERT_EQ(api_->set_buoy(context_, &buoy), SEAGLARE_OK);
    const double position_m[3] = {0, 0, 0}, upright[4] = {0, 0, 0, 1};
    ASSERT_EQ(plugin_->set_body_pose(context_, 12, position_m, upright), SEAGLARE_OK);
    Pose out;
    EXPECT_EQ(api_->get_buoy_pose(context_, 12, 0, out.position_m, out.orientation), SEAGLARE_ERROR_STALE_ID);
    EXPECT_EQ(api_->remove_buoy(context_, 12), SEAGLARE_ERROR_STALE_ID);
    ASSERT_EQ(api_->set_buoy(context_, &buoy), SEAGLARE_OK);
    EXPECT_EQ(api_->remove_buoy(context_, 12), SEAGLARE_OK);
    ASSERT_EQ(api_->set_buoy(context_, &buoy), SEAGLARE_OK);
    ASSERT_EQ(plugin_->clear_lights(context_), SEAGLARE_OK);
    EXPECT_EQ(api_->remove_buoy(context_, 12), SEAGLARE_ERROR_STALE_ID);
}

TEST_F(Waves, AreRefusedByEntryAndFieldAndTheOldSeaStays) {
    const seaglare_buoy buoy = moored(0, 0);
    std::array<seaglare_wave, 2> sea = {swell(1, 300, 0), swell(1, 200, 0)};
    ASSERT_EQ(api_->set_buoy(context_, &buoy), SEAGLARE_OK);
    ASSERT_EQ(api_->set_waves(context_, sea.data(), 2, 0), SEAGLARE_OK);
    const double before_m = pose(5).position_m[2];
    for (double seaglare_wave::*field :
         {&seaglare_wave::amplitude_m, &seaglare_wave::direction_deg, &seaglare_wave::wavelength_m,
          &seaglare_wave::angular_frequency_rad_s, &seaglare_wave::phase_rad, &seaglare_wave::depth_m}) {
        std::array<seaglare_wave, 2> bad = sea;
        bad[1].*field = nan;
        expect_refused(api_->set_waves(context_, bad.data(), 2, 0), "waves[1]");
        bad[1].*field = -1e9;
        expect_refused(api_->set_waves(context_, bad.data(), 2, 0), "waves[1]");
    }
    std::array<seaglare_wave, 2> bad = sea;
    bad[0].wavelength_m = 0;
    expect_refused(api_->set_waves(context_, bad.data(), 2, 0),
                   "either wavelength_m or angular_frequency_rad_s");
    bad[0].flags = 1;
    expect_refused(api_->set_waves(context_, bad.data(), 2, 0), "waves[0]: flags");
    expect_refused(api_->set_waves(context_, nullptr, 2, 0), "waves is NULL");
    expect_refused(api_->set_waves(context_, sea.data(), 4097, 0), "count is 4097");
    expect_refused(api_->set_waves(context_, sea.data(), 2, 16), "stride is 16");
    EXPECT_EQ(pose(5).position_m[2], before_m);
}

TEST_F(Waves, BuoysAreRefusedByTheFieldThatIsWrong) {
    const auto refused = [&](const seaglare_buoy& buoy, const std::string& words) {
        expect_refused(api_->set_buoy(context_, &buoy), words);
        EXPECT_EQ(api_->remove_buoy(context_, 12), SEAGLARE_ERROR_STALE_ID);
    };
    seaglare_buoy buoy = moored(0, 0);
    buoy.body_id = 0;
    refused(buoy, "buoy.body_id");
    buoy = moored(0, nan);
    refused(buoy, "buoy.position_m[1]");
    struct Row {
        double seaglare_buoy::*field;
        const char* name;
    };
    for (const Row& row : {Row{&seaglare_buoy::focal_height_m, "buoy.focal_height_m"},
                           Row{&seaglare_buoy::heave_period_s, "buoy.heave_period_s"},
                           Row{&seaglare_buoy::heave_damping, "buoy.heave_damping"},
                           Row{&seaglare_buoy::roll_period_s, "buoy.roll_period_s"},
                           Row{&seaglare_buoy::roll_damping, "buoy.roll_damping"},
                           Row{&seaglare_buoy::max_tilt_deg, "buoy.max_tilt_deg"}}) {
        for (const double value : {nan, -1.0, 1e9}) {
            buoy = moored(0, 0);
            buoy.*row.field = value;
            refused(buoy, row.name);
        }
    }
    Pose out;
    buoy = moored(0, 0);
    ASSERT_EQ(api_->set_buoy(context_, &buoy), SEAGLARE_OK);
    expect_refused(api_->get_buoy_pose(context_, 12, nan, out.position_m, out.orientation), "time_s");
    expect_refused(api_->get_buoy_pose(context_, 12, 0, nullptr, out.orientation), "position_m is NULL");
}

// Inside: the lights of a buoy stand where its pose at the frame's time has them.
TEST(BuoyInAFrame, ItsLightMovesWithTheFramesTimeAndNothingElse) {
    const TemporaryFile quality("small.json", small_quality);
    auto info = sized<seaglare_create_info>();
    info.flags = SEAGLARE_CREATE_NO_OPENCL;
    info.config_path = quality.path();
    seaglare::plugin::Context context(info);
    auto light = sized<seaglare_light>();
    light.body_id = 12;
    light.position_m[2] = 4;
    light.intensity_cd = 100;
    context.add_light(light);
    seaglare::lightdb::Buoy buoy;
    buoy.body_id = 12;
    buoy.position_m = {0, 500, 0};
    context.set_buoy(buoy);
    context.set_waves(
        {seaglare::lightdb::wave_of_length(1, 90, 30, 0.4, std::numeric_limits<double>::infinity())});
    const auto height_m = [&](double time_s) {
        seaglare_frame frame = looking_north(64, 36);
        frame.time_s = time_s;
        seaglare::lightdb::Evaluated out;
        seaglare::glare::Frame picture;
        picture.viewport_px = {0, 0, 64, 36};
        picture.clip_from_view = std::to_array(frame.clip_from_view);
        context.evaluate(frame, picture, 0, out);
        EXPECT_EQ(out.sources.size(), 1U);
        std::vector<seaglare_visibility_query> queries;
        context.visibility_queries(out.light, queries);
        return queries.empty() ? nan : queries.front().position_m[2];
    };
    const double first_m = height_m(2.5);
    const seaglare::lightdb::BodyPose pose = context.buoy_pose(12, 2.5);
    EXPECT_NEAR(first_m,
                pose.position_m[2] + 4 * (1 - 2 * (pose.orientation[0] * pose.orientation[0] +
                                                   pose.orientation[1] * pose.orientation[1])),
                1e-9);
    EXPECT_GT(std::abs(height_m(4) - first_m), 0.01);
    EXPECT_EQ(height_m(2.5), first_m);
}

}  // namespace
