// Ids that go stale, bodies that move, keys that do not depend on the order of loading.
#include "lightdb/light_store.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace seaglare::lightdb {
namespace {

Light named(const std::string& name) {
    Light light;
    light.name = name;
    return light;
}

TEST(LightStore, AnIdFindsItsLightUntilItIsRemoved) {
    LightStore store;
    const LightId a = store.add(named("a"));
    const LightId b = store.add(named("b"));
    EXPECT_NE(a, 0U);
    EXPECT_EQ(store.find(a)->name, "a");
    EXPECT_TRUE(store.remove(a));
    EXPECT_FALSE(store.find(a));
    EXPECT_FALSE(store.remove(a));
    EXPECT_EQ(store.find(b)->name, "b");
    const LightId c = store.add(named("c"));  // in the slot of a
    EXPECT_NE(c, a);
    EXPECT_FALSE(store.find(a));
    EXPECT_EQ(store.find(c)->name, "c");
    EXPECT_EQ(store.size(), 2U);
}

TEST(LightStore, IdsThatNeverWereAreStale) {
    LightStore store;
    store.add(named("a"));
    for (const LightId id : {LightId{0}, LightId{1}, LightId{1} << 32, (LightId{1} << 32) | 2, ~LightId{0}}) {
        EXPECT_FALSE(store.find(id)) << id;
        EXPECT_FALSE(store.remove(id));
    }
    EXPECT_EQ(store.id_of(7), 0U);
}

TEST(LightStore, ClearMakesAllIdsStale) {
    LightStore store;
    const LightId a = store.add(named("a"));
    store.set_body_pose(3, {});
    store.clear();
    EXPECT_EQ(store.size(), 0U);
    EXPECT_TRUE(store.ids().empty());
    EXPECT_EQ(store.body_pose(3), nullptr);
    const LightId b = store.add(named("b"));
    EXPECT_NE(a, b);
    EXPECT_FALSE(store.find(a));
}

TEST(LightStore, IdsComeInLoadOrderThroughManyChanges) {
    LightStore store;
    std::vector<LightId> expected;
    for (int i = 0; i < 1000; ++i)
        expected.push_back(store.add(named(std::to_string(i))));
    for (int round = 0; round < 5; ++round) {
        std::vector<LightId> kept;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            if (i % 3 == 0) {
                EXPECT_TRUE(store.remove(expected[i]));
            } else {
                kept.push_back(expected[i]);
            }
        }
        for (int i = 0; i < 100; ++i)
            kept.push_back(store.add(named("new")));
        expected = kept;
        ASSERT_EQ(store.ids(), expected);
        ASSERT_EQ(store.size(), expected.size());
    }
    const std::set<LightId> unique(expected.begin(), expected.end());
    EXPECT_EQ(unique.size(), expected.size());
    for (LightIndex slot = 0; slot < store.slot_count(); ++slot) {
        EXPECT_EQ(unique.count(store.id_of(slot)), store.arrays().is(slot, light_flag::live) ? 1U : 0U);
    }
}

TEST(LightStore, QuaternionsAreNormalisedOnEntry) {
    LightStore store;
    Light light = named("a");
    light.orientation = {0, 0, 3, 4};
    EXPECT_EQ(store.find(store.add(light))->orientation, (std::array<double, 4>{0, 0, 0.6, 0.8}));
    for (const double bad : {0.0, std::nan("")}) {
        light.orientation = {0, 0, 0, bad};
        EXPECT_EQ(store.find(store.add(light))->orientation, (std::array<double, 4>{0, 0, 0, 1}));
    }
    store.set_body_pose(1, {{}, {0, 0, 0, 9}});
    EXPECT_EQ(store.body_pose(1)->orientation, (std::array<double, 4>{0, 0, 0, 1}));
    EXPECT_EQ(store.body_pose(2), nullptr);
}

TEST(LightStore, ALightComesBackAsItWasGiven) {
    Light light = named("Østerrenden N\n");
    light.source = "a list, 12";
    light.position_m = {1e7 + 0.125, -3, 4};
    light.geographic = true;
    light.latitude_deg = 55.5;
    light.longitude_deg = 11;
    light.height_m = 31;
    light.radius_m = 0.3;
    light.intensity_cd[1] = 77;
    light.day_intensity_cd[1] = 900;
    light.character = "Fl R 5s";
    light.rhythm.phases = {{1, true, Colour::red}, {4, false}};
    light.rhythm.period_s = 5;
    light.true_north_deg = 0.29;
    light.body_id = 4;
    light.day_off = true;
    light.on = false;
    light.visibility = 0.25F;
    light.stable_key = 42;
    LightStore store;
    const LightId id = store.add(light);
    EXPECT_EQ(*store.find(id), light);
    Light other = light;
    other.name = "other";
    other.intensity_cd[1] = 78;
    EXPECT_TRUE(store.replace(id, other));
    EXPECT_EQ(*store.find(id), other);
    EXPECT_EQ(store.ids(), std::vector<LightId>{id});
    EXPECT_TRUE(store.remove(id));
    EXPECT_FALSE(store.replace(id, light));
}

TEST(LightStore, AnIntensityThatWasSetToNothingCanBeSetAgain) {
    Light light = named("a");
    light.intensity_cd[2] = 50;
    LightStore store;
    const LightId id = store.add(light);
    const LightId same = store.add(light);
    EXPECT_TRUE(store.set_intensity(id, 0));
    EXPECT_EQ(store.asleep(), 1U);
    EXPECT_TRUE(store.set_intensity(id, 70));
    EXPECT_EQ(store.asleep(), 0U);
    EXPECT_EQ(store.find(id)->intensity_cd[2], 70);
    EXPECT_EQ(store.find(same)->intensity_cd[2], 50) << "though they were of one kind";
    EXPECT_EQ(store.find(id)->intensity_cd[0], 0);
}

TEST(LightStore, ALightOfAKindCostsLittleBesideItsTexts) {
    LightStore store;
    Light light;
    light.intensity_cd[0] = 5;
    light.sectors.resize(20);
    for (int i = 0; i < 20000; ++i) {
        light.position_m[0] = i;
        light.stable_key = static_cast<std::uint64_t>(i) + 1;
        store.add(light);
    }
    store.optimise();
    EXPECT_EQ(store.kind_count(), 1U);
    EXPECT_LT(store.memory_bytes() / 20000, 320U) << "capacity of vectors that have just doubled included";
}

TEST(LightStore, LightsThatDifferInTheirIntensityAreOfOneKind) {
    LightStore store;
    std::vector<LightId> ids;
    Light light;
    light.character = "Fl 5s";
    for (int i = 1; i <= 1000; ++i) {
        light.intensity_cd[1] = i / 3.0;
        ids.push_back(store.add(light));
    }
    EXPECT_EQ(store.kind_count(), 1U);
    for (int i = 1; i <= 1000; ++i)
        EXPECT_EQ(store.find(ids[static_cast<std::size_t>(i - 1)])->intensity_cd[1], i / 3.0);
    // Several colours, whose quotient need not give them back: to the last bit all the same.
    for (int i = 1; i <= 1000; ++i) {
        light.intensity_cd = {i / 7.0, i / 11.0, 1.0 / i};
        EXPECT_EQ(store.find(store.add(light))->intensity_cd, light.intensity_cd);
    }
}

std::vector<Light> scattered(int count) {
    std::vector<Light> lights;
    for (int i = 0; i < count; ++i) {
        Light light = named(std::to_string(i));
        light.position_m = {i * 7919 % 10007 * 10.0, i * 104729 % 10009 * 10.0, 10};
        light.intensity_cd[i % 3] = 100 + i;
        light.day_off = i % 5 == 0;
        light.on = i % 7 != 0;
        if (i % 11 == 0) light.body_id = 3;
        lights.push_back(light);
    }
    return lights;
}

// Piece by piece or one by one: the same lights, in the same order; and nothing is to be seen before it is all there.
TEST(LightStore, ABatchIsShownAllAtOnce) {
    for (const int count : {0, 1, 400, 20000}) {
        const std::vector<Light> lights = scattered(count);
        LightStore store;
        const LightId before = store.add(named("before"));
        LightBatch batch(lights);
        while (store.take_in(batch, 77)) {
            ASSERT_EQ(store.size(), 1U);
            ASSERT_EQ(store.ids(), std::vector<LightId>{before});
        }
        EXPECT_EQ(store.index().block_count() > 0, count > 2000);
        const LightId meanwhile = store.add(named("meanwhile"));
        const std::vector<LightId> ids(batch.ids().begin(), batch.ids().end());
        store.show(batch);
        ASSERT_EQ(store.size(), static_cast<std::size_t>(count) + 2);
        std::vector<LightId> expected = {before, meanwhile};
        expected.insert(expected.end(), ids.begin(), ids.end());
        EXPECT_EQ(store.ids(), expected);
        for (std::size_t i = 0; i < lights.size(); ++i) {
            Light light = *store.find(ids[i]);
            light.stable_key = 0;
            ASSERT_EQ(light, lights[i]);
        }
        for (const LightId id : ids)
            EXPECT_TRUE(store.remove(id));
        EXPECT_EQ(store.ids(), (std::vector<LightId>{before, meanwhile}));
    }
}

TEST(LightStore, ABatchThatIsDroppedLeavesNothing) {
    LightStore store;
    const LightId before = store.add(named("before"));
    LightBatch batch(scattered(10000));
    store.take_in(batch, 6000);
    store.drop(batch);
    EXPECT_EQ(store.ids(), std::vector<LightId>{before});
    EXPECT_EQ(store.size(), 1U);
    EXPECT_EQ(store.asleep(), 1U) << "it has no intensity";
    EXPECT_EQ(store.kind_count(), 1U);
}

TEST(LightStore, StableKeysComeFromTheLightAlone) {
    Light light = named("a");
    light.geographic = true;
    light.latitude_deg = 55;
    const std::uint64_t key = stable_key_of(light);
    LightStore one;
    LightStore other;
    other.add(named("first"));
    EXPECT_EQ(one.find(one.add(light))->stable_key, key);
    EXPECT_EQ(other.find(other.add(light))->stable_key, key);
    light.position_m = {1, 2, 3};  // where a scene puts it does not matter
    light.intensity_cd[0] = 7;
    EXPECT_EQ(stable_key_of(light), key);
    light.latitude_deg = 55.0001;
    EXPECT_NE(stable_key_of(light), key);
    light = named("a");
    light.character = "b";
    Light swapped = named("");
    swapped.character = "ab";
    EXPECT_NE(stable_key_of(light), stable_key_of(swapped));
    light.stable_key = 99;
    EXPECT_EQ(one.find(one.add(light))->stable_key, 99U);
}

}  // namespace
}  // namespace seaglare::lightdb
