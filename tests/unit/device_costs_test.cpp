// What a probe of a few pictures says about a device, and what frames teach.
#include "glare/plan/device_costs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace seaglare::glare {
namespace {

// The times of a device on which everything costs what it usually does, but for some factors.
struct Device {
    double draw = 1, skirt = 1, composite = 1, gather = 1, gathered_light = 1;

    ProbeTimes times() const {
        const DeviceCosts usual;
        constexpr double ms = 1e-6;
        ProbeTimes t;
        t.picture_px = 8192;
        t.draws = 4;
        t.lights = 16;
        const double skirt_ms = skirt * usual.of(Work::gl_skirt_px) * t.picture_px * ms;
        const double composite_ms = composite * usual.of(Work::composite_px) * t.picture_px * ms;
        const double light_ms =
            gathered_light * ms * (usual.of(Work::cl_light) + usual.of(Work::cl_light_px) * t.picture_px);
        t.core = draw * usual.of(Work::gl_draw) * t.draws * ms;
        t.skirt = t.core + skirt_ms + composite_ms;
        t.many_skirts = t.core + t.lights * skirt_ms + composite_ms;
        t.gather = t.core + composite_ms + light_ms +
                   gather * ms * (usual.of(Work::cl_pass) + usual.of(Work::cl_screen_px) * t.picture_px);
        t.many_gathered = t.gather + (t.lights - 1) * light_ms;
        return t;
    }
};

TEST(MeasuredCosts, AreTheUsualOnesOnTheUsualDevice) {
    const DeviceCosts usual;
    const DeviceCosts costs = measured_costs(Device{}.times());
    for (std::size_t i = 0; i < work_kinds; ++i)
        EXPECT_NEAR(costs.ns[i], usual.ns[i], 1e-6 * usual.ns[i]) << name_of(static_cast<Work>(i));
    EXPECT_FALSE(costs.pinned);
}

TEST(MeasuredCosts, FollowEachKindOfWorkAlone) {
    const DeviceCosts usual;
    const auto factor = [&](const Device& device, Work work) {
        return measured_costs(device.times()).of(work) / usual.of(work);
    };
    EXPECT_NEAR(factor({.draw = 0.2}, Work::gl_draw), 0.2, 1e-9);
    EXPECT_NEAR(factor({.draw = 0.2}, Work::gl_skirt_px), 1, 1e-9);
    for (const Work work : {Work::gl_skirt_px, Work::gl_core_px, Work::gl_tail_cell})
        EXPECT_NEAR(factor({.skirt = 0.02}, work), 0.02, 1e-9) << "a GPU";
    EXPECT_NEAR(factor({.composite = 3}, Work::composite_px), 3, 1e-9);
    for (const Work work : {Work::cl_pass, Work::cl_screen_px})
        EXPECT_NEAR(factor({.gather = 5}, work), 5, 1e-6);
    for (const Work work : {Work::cl_light, Work::cl_light_px})
        EXPECT_NEAR(factor({.gathered_light = 0.1}, work), 0.1, 1e-9);
}

TEST(MeasuredCosts, WhatWasNotMeasuredOrMakesNoSenseIsAsUsual) {
    const DeviceCosts usual;
    EXPECT_EQ(measured_costs({}), usual);
    ProbeTimes no_gather = Device{.skirt = 2}.times();
    no_gather.gather = no_gather.many_gathered = 0;
    EXPECT_EQ(measured_costs(no_gather).of(Work::cl_light_px), usual.of(Work::cl_light_px));
    EXPECT_NEAR(measured_costs(no_gather).of(Work::gl_skirt_px), 2 * usual.of(Work::gl_skirt_px), 1e-6);
    // More lights took less time: something else ran beside the first.
    ProbeTimes disturbed = Device{}.times();
    disturbed.many_skirts = disturbed.skirt / 2;
    EXPECT_EQ(measured_costs(disturbed).of(Work::gl_skirt_px), usual.of(Work::gl_skirt_px));
    disturbed.many_skirts = std::numeric_limits<double>::infinity();
    EXPECT_EQ(measured_costs(disturbed).of(Work::gl_skirt_px), usual.of(Work::gl_skirt_px));
    EXPECT_NEAR(measured_costs(Device{.skirt = 1e6}.times()).of(Work::gl_skirt_px),
                100 * usual.of(Work::gl_skirt_px), 1e-6);
}

TEST(Learning, EveryKindHasANameOfItsOwn) {
    for (std::size_t i = 0; i < work_kinds; ++i) {
        EXPECT_FALSE(name_of(static_cast<Work>(i)).empty());
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_NE(name_of(static_cast<Work>(i)), name_of(static_cast<Work>(j)));
    }
}

}  // namespace
}  // namespace seaglare::glare
