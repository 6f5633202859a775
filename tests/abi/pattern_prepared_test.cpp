// What is prepared with a pattern for those who draw: by its maker, for what views do and no more, and untouched while they
// read it.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include "glare/device/cl_shared.h"
#include "plugin_api/pattern_store.h"

namespace {

using namespace seaglare;
using plugin::PatternDemand;
using plugin::PatternLease;
using plugin::PatternStore;
using plugin::PreparedLease;

constexpr double interval_s = 1.0 / 60;

glare::PatternSettings small_settings() {
    glare::PatternSettings settings;
    settings.transform_size = 256;
    settings.wavelengths = 4;
    settings.max_radius_nodes = 24;
    settings.layer_radii_px = {0, 2};
    return settings;
}

class Prepared : public ::testing::Test {
  protected:
    void SetUp() override {
        store_ = std::make_unique<PatternStore>(eye_, small_settings(), 5, true);
        if (store_->degraded()) GTEST_SKIP() << store_->facts()->reason;
        context_ = glare::ClShared::acquire();
    }
    PatternDemand at(double time_s, glare::PatternUse use, double pitch = 1.0 / 869) const {
        PatternDemand demand;
        demand.interval_s = interval_s;
        demand.moment.adaptation_cd_m2 = 0.001;
        demand.moment.request.pitch = pitch;
        demand.moment.request = glare::request_at(eye_, 5, demand.moment, time_s);
        demand.use = std::move(use);
        return demand;
    }
    // The first pattern of a later instant than any before; a frame at a time, while the maker's thread makes it.
    PatternLease next(const glare::PatternUse& use, double pitch = 1.0 / 869) {
        for (int tries = 0; tries < 5000; ++tries) {
            time_s_ += interval_s;
            PatternLease lease = store_->take(at(time_s_, use, pitch));
            if (!lease.reused()) return lease;
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
        ADD_FAILURE() << "no pattern comes";
        return store_->take(at(time_s_, use, pitch));
    }
    static std::vector<glare::Half> read(const glare::ClBuffer& buffer) {
        const glare::ClDevice device;
        std::vector<glare::Half> halves(buffer.bytes() / sizeof(glare::Half));
        glare::check_cl(clEnqueueReadBuffer(device.queue(), buffer.get(), CL_TRUE, 0, buffer.bytes(),
                                            halves.data(), 0, nullptr, nullptr),
                        "clEnqueueReadBuffer");
        return halves;
    }

    glare::EyeModel eye_ = glare::young_eye();
    std::unique_ptr<PatternStore> store_;
    std::shared_ptr<glare::ClShared> context_;
    double time_s_ = 1;
};

TEST_F(Prepared, AGatherFindsTheCopiesOfEveryPatternButTheFirst) {
    const glare::PatternUse gathers = {.draws = false, .gather = context_};
    store_->warm_up(at(0, {}).moment);
    next(gathers);  // attaching did not know what views would do
    next(gathers);
    for (int i = 0; i < 10; ++i) {
        const PatternLease lease = next(gathers);
        const PreparedLease prepared = lease.prepared();
        const glare::GatherPattern* const copies = prepared.get()->copies_of(lease.pattern(), *context_);
        ASSERT_NE(copies, nullptr) << "pattern " << i;
        // As who draws would make them.
        const glare::ClDevice device;
        glare::GatherPattern own;
        glare::GatherPatternWriter(device).write(lease.pattern(), own);
        EXPECT_EQ(read(copies->skirt), read(own.skirt));
        EXPECT_EQ(read(copies->departures), read(own.departures));
        EXPECT_EQ(read(copies->tables), read(own.tables));
        EXPECT_EQ(copies->skirt_scale, own.skirt_scale);
        EXPECT_EQ(copies->departures_scale, own.departures_scale);
        EXPECT_EQ(prepared.get()->texels_of(lease.pattern()), nullptr) << "nobody draws";
    }
}

TEST_F(Prepared, WhoDrawsRectanglesGetsTexelsAndNothingOnTheDevice) {
    const glare::PatternUse draws = {.draws = true, .gather = nullptr};
    store_->warm_up(at(0, {}).moment);
    next(draws);
    next(draws);
    const PatternLease lease = next(draws);
    const PreparedLease prepared = lease.prepared();
    const glare::PatternTexels* const texels = prepared.get()->texels_of(lease.pattern());
    ASSERT_NE(texels, nullptr);
    glare::PatternTexels own;
    glare::make_texels(lease.pattern(), own);
    EXPECT_EQ(texels->halves, own.halves);
    EXPECT_EQ(texels->scale, own.scale);
    EXPECT_EQ(store_->device_memory().accumulation, 0);
}

TEST_F(Prepared, WhoDrawsOnGridsGetsTheProfileAndTheDeparturesToo) {
    const glare::PatternUse draws = {.draws = true, .grids = true, .gather = nullptr};
    store_->warm_up(at(0, {}).moment);
    next(draws);
    next(draws);
    const PatternLease lease = next(draws);
    const PreparedLease prepared = lease.prepared();
    const glare::GridTexels* const texels = prepared.get()->grid_texels_of(lease.pattern());
    ASSERT_NE(texels, nullptr);
    glare::GridTexels own;
    glare::GridTexelMaker().make(lease.pattern(), own);
    EXPECT_EQ(texels->departures, own.departures);
    EXPECT_EQ(texels->departures_scale, own.departures_scale);
    EXPECT_TRUE(std::ranges::equal(texels->profile.tables(), own.profile.tables()));
}

TEST_F(Prepared, WhoWaitsHasThemWithItsOwnPatternAndTwoPatternsTakeTurns) {
    double bytes = 0;
    for (int i = 0; i < 6; ++i) {
        PatternDemand demand = at(1 + i, {.draws = true, .gather = context_});
        demand.wait = true;
        const PatternLease lease = store_->take(demand);
        const PreparedLease prepared = lease.prepared();
        EXPECT_NE(prepared.get()->copies_of(lease.pattern(), *context_), nullptr);
        EXPECT_NE(prepared.get()->texels_of(lease.pattern()), nullptr);
        if (i == 1) bytes = store_->device_memory().accumulation;
    }
    EXPECT_GT(bytes, 0);
    EXPECT_EQ(store_->device_memory().accumulation, bytes);
}

TEST_F(Prepared, StaysAsItIsWhileItIsReadThoughItsPatternIsWrittenOver) {
    const glare::PatternUse gathers = {.draws = true, .gather = context_};
    store_->warm_up(at(0, {}).moment);
    next(gathers);
    next(gathers);
    PreparedLease kept;
    {
        const PatternLease lease = next(gathers);
        kept = lease.prepared();
    }
    ASSERT_EQ(kept.get()->copies.size(), 1U);
    const std::uint64_t generation = kept.get()->texels.generation;
    const std::vector<glare::Half> texels = kept.get()->texels.halves;
    const std::vector<glare::Half> skirt = read(kept.get()->copies[0]->pattern.skirt);
    for (int i = 0; i < 6; ++i)
        next(gathers);
    store_.reset();  // it outlives the store, too
    EXPECT_EQ(kept.get()->texels.generation, generation);
    EXPECT_EQ(kept.get()->texels.halves, texels);
    EXPECT_EQ(read(kept.get()->copies[0]->pattern.skirt), skirt);
}

TEST_F(Prepared, IsNotMadeAnyMoreWhenNobodyHasUsedItForAWhile) {
    store_->warm_up(at(0, {}).moment);
    next({.draws = false, .gather = context_});
    next({.draws = false, .gather = context_});
    next({.draws = false, .gather = context_});
    EXPECT_GT(store_->device_memory().accumulation, 0);
    for (std::uint64_t i = 0; i < 2 * plugin::use_lingers; ++i)
        next({.draws = true, .gather = nullptr});
    EXPECT_EQ(store_->device_memory().accumulation, 0);
}

// A window that changes its size asks for a pitch that it will not ask for again.
TEST_F(Prepared, OfAPitchThatNobodyAsksForIsReleased) {
    const glare::PatternUse gathers = {.draws = false, .gather = context_};
    store_->warm_up(at(0, {}).moment);
    for (int i = 0; i < 3; ++i)
        next(gathers);
    const double of_one = store_->device_memory().accumulation;
    ASSERT_GT(of_one, 0);
    for (int i = 0; i < 299; ++i)
        next(gathers, 1.0 / 800);
    // The new pitch has its copies, and the old one's are gone. Whether both were there at a time is for the machine to say.
    const PatternLease lease = next(gathers, 1.0 / 800);
    const PreparedLease prepared = lease.prepared();
    EXPECT_NE(prepared.get()->copies_of(lease.pattern(), *context_), nullptr);
    EXPECT_LT(store_->device_memory().accumulation, 1.3 * of_one);
}

TEST_F(Prepared, ViewsOnFiveThreadsReadWhatIsPreparedWhileMoreIsMade) {
    store_->warm_up(at(0, {}).moment);
    std::vector<std::thread> threads;
    for (int t = 0; t < 5; ++t) {
        threads.emplace_back([this, t] {
            PreparedLease last;
            for (int i = 0; i < 60; ++i) {
                PatternDemand demand = at(1 + i * interval_s, {.draws = t % 2 == 0, .gather = context_});
                demand.viewer = &last;
                last.reset();
                const PatternLease lease = store_->take(demand);
                last = lease.prepared();
                if (const glare::GatherPattern* const copies =
                        last.get()->copies_of(lease.pattern(), *context_)) {
                    EXPECT_FALSE(copies->profile.tables().empty());
                    EXPECT_TRUE(std::isfinite(copies->profile.tables()[0]));
                }
                if (const glare::PatternTexels* const texels = last.get()->texels_of(lease.pattern())) {
                    EXPECT_EQ(texels->halves.size(), lease.pattern().skirt.size());
                }
                std::this_thread::sleep_for(std::chrono::microseconds(300));
            }
        });
    }
    for (std::thread& thread : threads)
        thread.join();
}

}  // namespace
