// A file that is read again: each light is known again, whatever happens around it.
#include "lightdb/light_reload.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>

#include "tests/unit/random_light.h"

namespace seaglare::lightdb {
namespace {

constexpr std::size_t none = Reload::none;

Light named(const std::string& name, double east_m, double intensity_cd = 10) {
    Light light;
    light.name = name;
    light.position_m = {east_m, 0, 5};
    light.intensity_cd[0] = intensity_cd;
    return light;
}

Reload reloaded(const std::vector<Light>& before, const std::vector<Light>& after) {
    return match_reload(remembered(before), remembered(after));
}

TEST(LightReload, EqualLightsAreUnchangedInAnyOrder) {
    RandomLights random(1);
    std::vector<Light> before;
    for (int i = 0; i < 200; ++i)
        before.push_back(random.next());
    std::vector<Light> after = before;
    std::shuffle(after.begin(), after.end(), std::mt19937(3));
    const Reload reload = reloaded(before, after);
    EXPECT_TRUE(reload.vanished.empty());
    for (std::size_t i = 0; i < after.size(); ++i) {
        ASSERT_NE(reload.fates[i].before, none);
        EXPECT_FALSE(reload.fates[i].changed);
        EXPECT_TRUE(before[reload.fates[i].before] == after[i]);
    }
}

TEST(LightReload, AChangedLightIsKnownByNameAndPlace) {
    const Reload reload = reloaded({named("a", 1), named("b", 2)}, {named("b", 2, 99), named("a", 1)});
    EXPECT_EQ(reload.fates[0].before, 1U);
    EXPECT_TRUE(reload.fates[0].changed);
    EXPECT_EQ(reload.fates[1].before, 0U);
    EXPECT_FALSE(reload.fates[1].changed);
    const Reload namesakes = reloaded({named("a", 1), named("a", 2)}, {named("a", 2, 99), named("a", 1, 98)});
    EXPECT_EQ(namesakes.fates[0].before, 1U);
    EXPECT_EQ(namesakes.fates[1].before, 0U);
}

TEST(LightReload, AMovedLightIsKnownByANameThatIsItsAlone) {
    const Reload moved = reloaded({named("a", 1), named("b", 2)}, {named("a", 1), named("b", 700)});
    EXPECT_EQ(moved.fates[1].before, 1U);
    EXPECT_TRUE(moved.fates[1].changed);
    const Reload unclear = reloaded({named("a", 1), named("a", 2)}, {named("a", 3), named("a", 4)});
    EXPECT_EQ(unclear.fates[0].before, none);
    EXPECT_EQ(unclear.fates[1].before, none);
    EXPECT_EQ(unclear.vanished, (std::vector<std::size_t>{0, 1}));
    const Reload nameless = reloaded({named("", 1)}, {named("", 2)});
    EXPECT_EQ(nameless.fates[0].before, none);
}

TEST(LightReload, LightsThatAreAlikePairOnceEach) {
    const Light twin = named("twin", 1);
    const Reload fewer = reloaded({twin, twin, twin}, {twin, twin});
    EXPECT_EQ(fewer.fates[0].before, 0U);
    EXPECT_EQ(fewer.fates[1].before, 1U);
    EXPECT_EQ(fewer.vanished, std::vector<std::size_t>{2});
    const Reload more = reloaded({twin}, {named("new", 4), twin, twin});
    EXPECT_EQ(more.fates[0].before, none);
    EXPECT_EQ(more.fates[1].before, 0U);
    EXPECT_EQ(more.fates[2].before, none);
    // One of two twins changes: the other keeps its own.
    const Reload one = reloaded({twin, twin}, {named("twin", 1, 99), twin});
    EXPECT_EQ(one.fates[0].before, 1U);
    EXPECT_TRUE(one.fates[0].changed);
    EXPECT_EQ(one.fates[1].before, 0U);
    EXPECT_FALSE(one.fates[1].changed);
}

TEST(LightReload, NothingBecomesEverythingAndBack) {
    EXPECT_EQ(reloaded({}, {named("a", 1)}).fates[0].before, none);
    EXPECT_EQ(reloaded({named("a", 1)}, {}).vanished, std::vector<std::size_t>{0});
    EXPECT_TRUE(reloaded({}, {}).fates.empty());
}

TEST(LightReload, WhatTheHostSetsIsNoChangeAndAllElseIs) {
    const Light light = named("a", 1);
    const auto changed_by = [&](const auto& change) {
        Light other = light;
        change(other);
        return remembered(std::vector{light})[0].data != remembered(std::vector{other})[0].data;
    };
    EXPECT_FALSE(changed_by([](Light& l) { l.on = false; }));
    EXPECT_FALSE(changed_by([](Light& l) { l.visibility = 0.5F; }));
    EXPECT_TRUE(changed_by([](Light& l) { l.height_m = 6; }));
    EXPECT_TRUE(changed_by([](Light& l) { l.rhythm.fall_s = 1; }));
    EXPECT_TRUE(changed_by([](Light& l) { l.sectors.push_back({Colour::red, 1, 2}); }));
    EXPECT_TRUE(changed_by([](Light& l) { l.day_intensity_cd[2] = 1; }));
    EXPECT_TRUE(changed_by([](Light& l) { l.rotation.beam = {{0}, {1}}; }));
    EXPECT_TRUE(changed_by([](Light& l) { l.leading_bearing_deg = 0; }));
    EXPECT_TRUE(changed_by([](Light& l) { l.vertical = {{0}, {0.5}}; }));
    EXPECT_TRUE(changed_by([](Light& l) { l.source = "x"; }));
    PhotometricSolid solid;
    solid.azimuth_deg = {0};
    solid.latitude_deg = {0, 1};
    solid.candela = {1, 2};
    solid.reference_cd = 2;
    Light measured = light;
    measured.photometry = SharedSolid(std::make_shared<const PhotometricSolid>(solid));
    solid.candela[0] = 3;
    Light other = light;
    other.photometry = SharedSolid(std::make_shared<const PhotometricSolid>(solid));
    EXPECT_NE(remembered(std::vector{measured})[0].data, remembered(std::vector{other})[0].data);
}

}  // namespace
}  // namespace seaglare::lightdb
