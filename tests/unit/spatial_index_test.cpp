// What the spatial index leaves out would not have been seen: with and without it the sources are the same to the last
// bit, whatever the lights, the eye, and what was done to the lights before.
#include "lightdb/spatial_index.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "lightdb/evaluate.h"
#include "lightdb/light_store.h"
#include "lightdb/photometry.h"

namespace seaglare::lightdb {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

class Dice {
  public:
    explicit Dice(std::uint32_t seed) : engine_(seed) {}
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    double power_of_ten(double low, double high) { return std::pow(10, between(low, high)); }
    std::size_t below(std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(engine_);
    }
    bool one_in(std::size_t count) { return below(count) == 0; }

  private:
    std::mt19937 engine_;
};

struct Region {
    Vec3 centre_m{};
    double size_m = 0;
};

const std::vector<Region> regions = {{{0, 0, 0}, 1e5},    {{1e7, -1e7, 0}, 3e4}, {{-1e7, 3, 50}, 10},
                                     {{5e3, 0, 20}, 0},   {{0, 0, 0}, 1e7},      {{0, 0, 0}, 1e300},
                                     {{100, 200, 0}, 2e3}};

Vec3 somewhere(Dice& dice, const Region& region) {
    return {region.centre_m[0] + region.size_m * dice.between(-1, 1),
            region.centre_m[1] + region.size_m * dice.between(-1, 1),
            region.centre_m[2] + (region.size_m > 0 ? dice.between(-5, 5) + dice.power_of_ten(-1, 2.5) : 0)};
}

Light any_light(Dice& dice, const Region& region) {
    Light light;
    light.position_m = somewhere(dice, region);
    light.intensity_cd[dice.below(colour_count)] = dice.power_of_ten(-3, 8);
    if (dice.one_in(5)) light.intensity_cd[dice.below(colour_count)] = dice.power_of_ten(-3, 8);
    if (dice.one_in(9)) light.day_intensity_cd[dice.below(colour_count)] = dice.power_of_ten(-1, 7);
    if (dice.one_in(4)) {
        light.rhythm.phases = {{1, true, Colour::white, dice.between(0, 2)}, {dice.between(0, 4), false}};
        light.rhythm.period_s = light.rhythm.phases[0].duration_s + light.rhythm.phases[1].duration_s;
    }
    if (dice.one_in(6)) {
        light.sectors = {{Colour::white, dice.between(0, 360), dice.between(0, 360), dice.between(0, 1.5), 3},
                         {Colour::red, dice.between(0, 360), dice.between(0, 360)}};
    }
    if (dice.one_in(6)) light.vertical = {{-20, 0, 20}, {0.1, dice.between(0, 3), 0.1}};
    if (dice.one_in(8)) light.horizontal = {{0, 180}, {dice.between(0, 3), 0.5}};
    if (dice.one_in(8)) light.rotation = {dice.between(5, 20), {{0, 5, 355}, {dice.between(0, 9), 0, 0}}};
    if (dice.one_in(8)) light.day_off = true;
    if (dice.one_in(8)) light.on = false;
    if (dice.one_in(8)) light.visibility = static_cast<float>(dice.between(-0.5, 2));
    if (dice.one_in(8)) light.radius_m = dice.power_of_ten(-4, 4);
    if (dice.one_in(6)) {
        light.body_id = static_cast<std::uint32_t>(1 + dice.below(20));
        light.position_m = {dice.between(-20, 20), dice.between(-200, 200), dice.between(0, 40)};
    }
    if (dice.one_in(8)) light.orientation = {0.1, 0, dice.between(-1, 1), 1};
    const double strange[] = {nan, infinity, -infinity, 0, -1};
    if (dice.one_in(60)) light.position_m[dice.below(3)] = strange[dice.below(5)];
    if (dice.one_in(60)) light.intensity_cd[0] = strange[dice.below(5)];
    if (dice.one_in(60)) light.radius_m = strange[dice.below(5)];
    if (dice.one_in(60)) light.vertical = {{0}, {strange[dice.below(5)]}};
    return light;
}

Observer any_observer(Dice& dice, const Region& region) {
    Observer observer;
    observer.eye_m = somewhere(dice, region);
    if (dice.one_in(6)) observer.eye_m[2] = dice.power_of_ten(0, 5);
    if (dice.one_in(40)) observer.eye_m[dice.below(3)] = nan;
    // Reversed as a left-handed host has it.
    observer.view_from_scene = {1, 0, 0, 0, 0, 0, dice.one_in(2) ? 1.0 : -1.0, 0, 0, 1, 0, 0, 0, 0, 0, 1};
    observer.time_s = dice.between(0, 1e7);
    observer.exposure_s = dice.one_in(3) ? 0 : 1.0 / 60;
    observer.extinction_per_m = dice.one_in(2) ? 0 : dice.power_of_ten(-6, -1);
    if (dice.one_in(20)) observer.extinction_per_m = dice.one_in(2) ? infinity : nan;
    observer.geographic_horizon = !dice.one_in(4);
    observer.round_earth = dice.one_in(3);
    observer.water_level_m = dice.one_in(3) ? dice.between(-50, 50) : 0;
    observer.is_day = dice.one_in(3);
    observer.least_illuminance_lx = dice.one_in(4) ? 0 : dice.power_of_ten(-14, 0);
    if (dice.one_in(40)) observer.least_illuminance_lx = nan;
    return observer;
}

// True where the index left something out.
bool expect_same(const LightStore& store, const Observer& observer) {
    Evaluated with;
    Evaluated without;
    evaluate(store, observer, with, Culling::by_index);
    evaluate(store, observer, without, Culling::one_by_one);
    EXPECT_EQ(with.light, without.light);
    EXPECT_EQ(with.sources.size(), without.sources.size());
    for (std::size_t i = 0; i < std::min(with.sources.size(), without.sources.size()); ++i) {
        EXPECT_EQ(with.sources[i].position_view_m, without.sources[i].position_view_m);
        EXPECT_EQ(with.sources[i].illuminance_rgb_lx, without.sources[i].illuminance_rgb_lx);
        EXPECT_EQ(with.sources[i].illuminance_scotopic_lx, without.sources[i].illuminance_scotopic_lx);
        EXPECT_EQ(with.sources[i].radius_m, without.sources[i].radius_m);
        EXPECT_EQ(with.sources[i].lamp, without.sources[i].lamp);
    }
    for (const Evaluated* out : {&with, &without}) {
        EXPECT_EQ(out->total, store.size());
        EXPECT_EQ(out->sources.size() + out->dark + out->below_horizon + out->too_faint, store.size());
    }
    // A group is left out where each of its lights would be, for one reason or the other.
    if (!observer.is_day && observer.least_illuminance_lx > 0) {
        EXPECT_EQ(with.dark, without.dark);
    }

    LightMarks marks;
    marks.resize(store.slot_count());
    CullingEye eye;
    eye.eye_m = observer.eye_m;
    eye.least_lx = observer.least_illuminance_lx;
    eye.height_m = observer.eye_m[2];
    LeftOutCounts counts;
    store.index().collect(eye, marks, counts);
    return counts.below_horizon + counts.too_faint > 0;
}

void pose_bodies(Dice& dice, const Region& region, LightStore& store) {
    for (std::uint32_t body = 1; body < 15; ++body) {
        store.set_body_pose(body, {somewhere(dice, region),
                                   {dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1), 1}});
    }
}

void expect_nothing_seen(const LightStore& store) {
    Evaluated out;
    evaluate(store, {}, out);
    EXPECT_EQ(out.sources.size() + out.below_horizon + out.too_faint + out.dark, 0U);
}

TEST(SpatialIndex, LeavesOutNothingThatWouldBeSeen) {
    int left_out = 0;
    for (std::uint32_t seed = 0; seed < 140; ++seed) {
        SCOPED_TRACE(seed);
        Dice dice(seed);
        const Region& region = regions[seed % regions.size()];
        const std::size_t counts[] = {0, 1, 8, 9, 600, 5000};
        LightStore store;
        for (std::size_t i = counts[seed / regions.size() % 6]; i > 0; --i)
            store.add(any_light(dice, region));
        pose_bodies(dice, region, store);
        if (dice.one_in(2)) store.optimise();
        for (int i = 0; i < 12; ++i)
            left_out += expect_same(store, any_observer(dice, region)) ? 1 : 0;
    }
    EXPECT_GT(left_out, 100) << "it must have had something to do";
}

void change_something(Dice& dice, const Region& region, LightStore& store, std::vector<LightId>& ids) {
    const std::size_t at = dice.below(ids.size());
    const LightId id = ids[at];
    switch (dice.below(9)) {
        case 0:
            EXPECT_TRUE(store.set_position(id, somewhere(dice, region)));
            break;
        case 1:
            EXPECT_TRUE(store.set_intensity(id, dice.one_in(4) ? 0 : dice.power_of_ten(-3, 8)));
            break;
        case 2:
        case 3:
            EXPECT_TRUE(store.set_on(id, dice.one_in(2)));
            break;
        case 4:
            EXPECT_TRUE(store.set_visibility(id, static_cast<float>(dice.between(-1, 1.5))));
            break;
        case 5:
            EXPECT_TRUE(store.set_orientation(id, {dice.between(-1, 1), 0, 0, 1}));
            break;
        case 6:
            EXPECT_TRUE(store.replace(id, any_light(dice, region)));
            break;
        case 7:
            EXPECT_TRUE(store.remove(id));
            EXPECT_FALSE(store.set_on(id, true));
            ids[at] = store.add(any_light(dice, region));
            break;
        default:
            EXPECT_TRUE(store.set_position(id, {nan, 0, 0}));
            break;
    }
}

TEST(SpatialIndex, HoldsThroughAnyChanges) {
    for (std::uint32_t seed = 0; seed < 14; ++seed) {
        SCOPED_TRACE(seed);
        Dice dice(1000 + seed);
        const Region& region = regions[seed % regions.size()];
        LightStore store;
        std::vector<LightId> ids;
        for (int i = 0; i < 3000; ++i)
            ids.push_back(store.add(any_light(dice, region)));
        store.optimise();
        std::size_t most_blocks = 0;
        for (int round = 0; round < 60; ++round) {
            for (std::size_t i = round % 20 == 0 ? 3000 : 40; i > 0; --i)
                change_something(dice, region, store, ids);
            pose_bodies(dice, region, store);
            for (std::size_t i = dice.below(50); i > 0; --i)
                store.settle();
            most_blocks = std::max(most_blocks, store.index().block_count());
            expect_same(store, any_observer(dice, region));
            ASSERT_EQ(store.ids().size(), ids.size());
        }
        EXPECT_GT(most_blocks, 0U);
    }
}

// Right at the horizon, where a group's height decides.
TEST(SpatialIndex, LeavesOutNothingAtTheVeryHorizon) {
    for (std::uint32_t seed = 0; seed < 30; ++seed) {
        SCOPED_TRACE(seed);
        Dice dice(500 + seed);
        LightStore store;
        for (int i = 0; i < 300; ++i) {
            Light light;
            const double height_m = dice.power_of_ten(0, 2.5);
            const double range_m = geographical_range_nm(height_m, 15) * metres_per_nautical_mile;
            const double turn = dice.between(0, 2 * std::numbers::pi);
            const double distance_m = range_m * dice.between(0.999, 1.002);
            light.position_m = {distance_m * std::cos(turn), distance_m * std::sin(turn), height_m};
            light.intensity_cd[0] = 1e6;
            // A group has no room for slack where all of it stands at one place.
            for (int of_group = 0; of_group < 16; ++of_group)
                store.add(light);
        }
        store.optimise();
        Observer observer;
        observer.eye_m = {0, 0, 15};
        observer.least_illuminance_lx = 1e-12;
        expect_same(store, observer);
    }
}

// A ring of lights around an eye 12 m up, each 10 m high and bright enough.
TEST(SpatialIndex, CountsWhatItLeavesOutByItsReason) {
    LightStore store;
    const auto ring = [&](int count, double distance_m, double intensity_cd) {
        for (int i = 0; i < count; ++i) {
            const double turn = 2 * std::numbers::pi * i / count;
            Light light;
            light.position_m = {distance_m * std::cos(turn), distance_m * std::sin(turn), 10};
            light.intensity_cd[0] = intensity_cd;
            store.add(light);
        }
    };
    ring(1000, 5e3, 1e4);
    ring(2000, 1e5, 1e6);
    ring(3000, 6e3, 1e-3);
    Light off;
    off.on = false;
    for (int i = 0; i < 500; ++i)
        store.add(off);
    store.optimise();
    Observer observer;
    observer.eye_m = {0, 0, 12};
    observer.least_illuminance_lx = 1e-9;
    Evaluated out;
    evaluate(store, observer, out);
    EXPECT_EQ(out.total, 6500U);
    EXPECT_EQ(out.sources.size(), 1000U);
    EXPECT_EQ(out.below_horizon, 2000U);
    EXPECT_EQ(out.too_faint, 3000U);
    EXPECT_EQ(out.dark, 500U);
    observer.geographic_horizon = false;
    evaluate(store, observer, out);
    EXPECT_EQ(out.sources.size(), 3000U);
    observer.least_illuminance_lx = 0;
    evaluate(store, observer, out);
    EXPECT_EQ(out.sources.size(), 6000U);
    EXPECT_EQ(out.too_faint, 0U);
}

// Whole blocks of lights with a photometer are left out by day.
TEST(SpatialIndex, LightsWithAPhotometerAreDarkByDay) {
    LightStore store;
    for (int i = 0; i < 4000; ++i) {
        const int row = i / 63;
        Light light;
        light.position_m = {i % 63 * 10.0, row * 10.0, 5};
        light.intensity_cd[0] = 100;
        light.day_off = i % 4 != 0;
        store.add(light);
    }
    store.optimise();
    Observer observer;
    observer.eye_m = {0, 0, 12};
    Evaluated out;
    evaluate(store, observer, out);
    EXPECT_EQ(out.sources.size(), 4000U);
    observer.is_day = true;
    evaluate(store, observer, out);
    EXPECT_EQ(out.sources.size(), 1000U);
    EXPECT_EQ(out.dark, 3000U);
    expect_same(store, observer);
}

// A move makes a light loose; it settles again once it has kept still, a bounded number at a time.
TEST(SpatialIndex, MovedLightsSettleWithoutEverBeingRebuiltAsAWhole) {
    LightStore store;
    std::vector<LightId> ids;
    for (int i = 0; i < 20000; ++i) {
        const int row = i / 200;
        Light light;
        light.position_m = {i % 200 * 100.0, row * 100.0, 5};
        light.intensity_cd[0] = 100;
        ids.push_back(store.add(light));
    }
    store.optimise();
    EXPECT_EQ(store.index().loose_count(), 0U);
    for (const LightId id : ids)
        store.set_position(id, {1, 2, 3});
    EXPECT_EQ(store.index().loose_count(), 20000U);
    EXPECT_EQ(store.index().block_count(), 0U);
    std::size_t before = 20000;
    for (int frame = 0; frame < 200; ++frame) {
        store.settle();
        const std::size_t now = store.index().loose_count();
        ASSERT_LE(before - now, LightBlock::capacity);
        before = now;
    }
    EXPECT_LT(before, SpatialIndex::smallest_block);
    // One that moves in every frame stays loose, and the same place is no move.
    for (int frame = 0; frame < 100; ++frame) {
        store.set_position(ids[0], {frame * 1.0, 0, 0});
        store.set_position(ids[1], {1, 2, 3});
        store.settle();
    }
    EXPECT_LE(store.index().loose_count(), before + 1);
    EXPECT_EQ(store.find(ids[0])->position_m, (Vec3{99, 0, 0}));
}

// Loaded at once or added one by one: the same picture, and what the index leaves out would not be in it.
TEST(SpatialIndex, ABatchIsIndexedLikeLightsThatWereAdded) {
    for (std::uint32_t seed = 0; seed < 14; ++seed) {
        SCOPED_TRACE(seed);
        Dice dice(300 + seed);
        const Region& region = regions[seed % regions.size()];
        LightStore store;
        std::vector<Light> lights;
        for (int i = 0; i < 6000; ++i)
            lights.push_back(any_light(dice, region));
        pose_bodies(dice, region, store);
        LightBatch batch(lights);
        while (store.take_in(batch, 500))
            expect_nothing_seen(store);
        store.show(batch);
        for (int i = 0; i < 6; ++i)
            expect_same(store, any_observer(dice, region));
    }
}

// Bodies that come, go and wander; most are out of reach and none may be missed.
TEST(SpatialIndex, FollowsBodiesThatMove) {
    Dice dice(77);
    const Region sea{{0, 0, 0}, 3e5};
    LightStore store;
    std::vector<LightId> ids;
    std::vector<Vec3> at_m(500);
    for (std::uint32_t body = 1; body < at_m.size(); ++body) {
        for (int i = 0; i < 4; ++i) {
            Light light;
            light.body_id = body;
            light.position_m = {dice.between(-10, 10), dice.between(-60, 60), dice.between(2, 30)};
            light.intensity_cd[0] = 100;
            light.day_off = body % 3 == 0;
            ids.push_back(store.add(light));
        }
        at_m[body] = somewhere(dice, sea);
        at_m[body][2] = 0;
    }
    int left_out = 0;
    for (int round = 0; round < 60; ++round) {
        for (std::uint32_t body = 1; body < at_m.size(); ++body) {
            if (dice.one_in(3)) continue;
            const double step_m = dice.one_in(50) ? 1e5 : 60;
            at_m[body] = at_m[body] + Vec3{dice.between(-step_m, step_m), dice.between(-step_m, step_m), 0};
            store.set_body_pose(body, {{at_m[body][0], at_m[body][1], dice.between(-2, 2)},
                                       {dice.between(-0.2, 0.2), 0, dice.between(-1, 1), 1}});
        }
        for (int i = 0; i < 20; ++i)
            store.set_on(ids[dice.below(ids.size())], dice.one_in(2));
        Observer observer;
        observer.eye_m = {at_m[5][0] + 3e3, at_m[5][1], 20};
        observer.is_day = round % 4 == 0;
        observer.round_earth = round % 5 == 0;
        observer.least_illuminance_lx = 1e-9;
        left_out += expect_same(store, observer) ? 1 : 0;
    }
    EXPECT_EQ(left_out, 60);
    EXPECT_LE(store.index().bodies().bounded_count(), 499U);
    EXPECT_GT(store.index().bodies().bounded_count(), 450U);
}

// Lights that sleep for long leave their blocks to those that burn.
TEST(SpatialIndex, BlocksInWhichMostLightsSleepAreGivenUp) {
    Dice dice(9);
    LightStore store;
    std::vector<LightId> ids;
    for (int i = 0; i < 40000; ++i) {
        Light light;
        light.position_m = somewhere(dice, regions[0]);
        light.intensity_cd[0] = 100;
        ids.push_back(store.add(light));
    }
    store.optimise();
    const std::size_t blocks = store.index().block_count();
    EXPECT_GE(blocks, 10U);
    for (std::size_t i = 0; i < ids.size(); ++i)
        store.set_on(ids[i], i % 20 == 0);
    for (std::uint32_t i = 0; i < SpatialIndex::frames_to_forget - 1; ++i)
        store.settle();
    EXPECT_EQ(store.index().block_count(), blocks) << "they may come back";
    for (int i = 0; i < 400; ++i)
        store.settle();
    EXPECT_LE(store.index().block_count(), 3U);
    EXPECT_LT(store.index().loose_count(), SpatialIndex::smallest_block);
    Observer observer;
    observer.eye_m = {0, 0, 20};
    observer.least_illuminance_lx = 1e-9;
    expect_same(store, observer);
    for (const LightId id : ids)
        store.set_on(id, true);
    EXPECT_EQ(store.asleep(), 0U);
    expect_same(store, observer);
}

TEST(SpatialIndex, ATreeIsTheSameForTheSameLights) {
    Dice dice(3);
    LightStore one;
    for (int i = 0; i < 5000; ++i)
        one.add(any_light(dice, regions[0]));
    LightStore other = one;  // and copies stand on their own
    one.optimise();
    other.optimise();
    Observer observer;
    observer.eye_m = {0, 0, 20};
    observer.least_illuminance_lx = 1e-7;
    Evaluated a;
    Evaluated b;
    evaluate(one, observer, a);
    one.clear();
    evaluate(other, observer, b);
    EXPECT_EQ(a.light, b.light);
    EXPECT_EQ(a.below_horizon, b.below_horizon);
    EXPECT_EQ(a.too_faint, b.too_faint);
    EXPECT_GT(a.too_faint, 0U);
}

}  // namespace
}  // namespace seaglare::lightdb
