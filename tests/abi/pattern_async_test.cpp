// The pattern beside the frames: who draws takes what is finished. Whatever happens to the eye, each pattern that is shown
// keeps the light's energy, the picture goes over without a jump, and at last it is the one that waiting would have given.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <numeric>
#include <thread>

#include "glare/device/cl_turns.h"
#include "glare/psf/pattern_grid.h"
#include "plugin_api/pattern_store.h"

namespace {

using namespace seaglare;
using plugin::PatternDemand;
using plugin::PatternLease;
using plugin::PatternStore;

constexpr double pitch = 1.0 / 869;
constexpr double interval_s = 1.0 / 60;
constexpr std::uint8_t lamp_white = 0;  // as SEAGLARE_COLOUR_*
constexpr std::uint8_t lamp_red = 1;

glare::PatternSettings settings_of(glare::MotionMode mode) {
    glare::PatternSettings settings;
    settings.transform_size = 256;
    settings.wavelengths = 4;
    settings.max_radius_nodes = 24;
    settings.layer_radii_px = {0, 2};
    settings.motion.mode = mode;
    settings.motion.frames = 4;
    settings.motion.loop_s = 2;
    return settings;
}

// Core and skirt of the green channel, and a tail that is the same for all of one eye but in proportion.
double energy_of(const glare::Pattern& p, std::size_t slot = 0, std::size_t layer = 0) {
    const auto side = 2 * static_cast<std::size_t>(p.radius_nodes) + 1;
    const float* const first =
        p.skirt.data() + (slot * p.layer_radius_nodes.size() + layer) * side * side * 4;
    double sum = 0;
    for (std::size_t i = 0; i < side * side; ++i)
        sum += static_cast<double>(first[4 * i + 1]);
    return static_cast<double>(p.core_energy[slot][1]) + sum * p.pitch * p.pitch;
}

double distance(const glare::Pattern& a, const glare::Pattern& b) {
    double sum = 0;
    for (std::size_t i = 0; i < std::min(a.skirt.size(), b.skirt.size()); ++i)
        sum += std::abs(static_cast<double>(a.skirt[i]) - static_cast<double>(b.skirt[i]));
    return sum;
}

struct Way {
    const char* name;
    bool opencl;
    glare::MotionMode mode;
};

class AsyncStore : public ::testing::TestWithParam<Way> {
  protected:
    AsyncStore() {
        eye_.gratings.count = 0;  // nothing absorbs: the energy is 1 at every pupil
        store_ = std::make_unique<PatternStore>(eye_, settings_of(GetParam().mode), 5, GetParam().opencl);
    }
    void SetUp() override {
        if (GetParam().opencl && store_->degraded()) GTEST_SKIP() << store_->facts()->reason;
    }
    PatternDemand at(double time_s, double adaptation_cd_m2, std::uint32_t lamps = 1) const {
        PatternDemand demand;
        demand.interval_s = interval_s;
        demand.moment.adaptation_cd_m2 = adaptation_cd_m2;
        demand.moment.request.pitch = pitch;
        demand.moment.request.lamps = lamps;
        demand.moment.request = glare::request_at(eye_, 5, demand.moment, time_s);
        return demand;
    }
    // Frames at one time until nothing is left to be made.
    glare::Pattern settled(double time_s, double adaptation_cd_m2, std::uint32_t lamps = 1) {
        int reused = 0;
        for (int i = 0; i < 5000; ++i) {
            const std::uint64_t made = store_->patterns_made();
            {
                const PatternLease lease = store_->take(at(time_s, adaptation_cd_m2, lamps));
                reused = lease.reused() ? reused + 1 : 0;
                if (reused > 20) return lease.pattern();
            }
            for (int tries = 0; tries < 100 && store_->patterns_made() == made; ++tries)
                std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
        ADD_FAILURE() << "the pattern never settles";
        return {};
    }

    glare::EyeModel eye_ = glare::young_eye();
    std::unique_ptr<PatternStore> store_;
};

TEST_P(AsyncStore, TheFirstFrameShowsWhatAttachingMade) {
    auto moment = at(0, 0.001).moment;
    moment.request.pitch = 1.0 / 1303.7;
    store_->warm_up(moment);
    const std::uint64_t made = store_->patterns_made();
    EXPECT_EQ(made, 1U);
    const PatternLease lease = store_->take(at(0, 0.001));
    // Of the pitch that is there: angles are right, and so is the energy.
    EXPECT_EQ(lease.pattern().pitch, 1.0 / 1303.7);
    EXPECT_GT(energy_of(lease.pattern()), 0.5);
}

TEST_P(AsyncStore, KeepsEnergyAndDoesNotJumpWhenTheEyeDoes) {
    store_->warm_up(at(0, 0.001).moment);
    const glare::Pattern dark = settled(1, 0.001);
    const double energy = energy_of(dark);
    glare::Pattern last = dark;
    std::vector<double> steps;
    double time_s = 1;
    const std::uint64_t begin = store_->patterns_made();
    int begin_still = 0;
    // From starlight to a lit bridge in one frame.
    for (int frame = 0; frame < 2000; ++frame) {
        time_s += interval_s;
        const std::uint64_t made = store_->patterns_made();
        {
            const PatternLease lease = store_->take(at(time_s, 100));
            const glare::Pattern& shown = lease.pattern();
            // The tail, which is the eye's, is not in it: it moves with the pupil by less than this.
            EXPECT_NEAR(energy_of(shown), energy, 0.002) << "frame " << frame;
            steps.push_back(distance(shown, last));
            last = shown;
        }
        for (int tries = 0; tries < 100 && store_->patterns_made() == made; ++tries)
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        // As many as the blend takes, and some; a machine that stands still makes none.
        if (store_->patterns_made() > begin + 25 || frame > begin_still + 40) break;
        if (store_->patterns_made() != made) begin_still = frame;
    }
    auto exact = at(time_s, 100);
    exact.wait = true;
    const double whole = distance(store_->take(exact).pattern(), dark);
    EXPECT_LT(distance(last, dark), 1.2 * whole);
    EXPECT_GT(distance(last, dark), 0.8 * whole);
    // smooth(t) rises by at most 1.5 dt / blend in a frame, and dt is at most two intervals.
    const double steepest = 1.5 * 2 * interval_s / plugin::pattern_blend_s;
    for (const double step : steps)
        EXPECT_LT(step, (steepest + 0.15) * whole);
}

// The same after a hitch, and when the clock is set back: the frame before and the one after are seen.
TEST_P(AsyncStore, DoesNotJumpWhenTheEyeDoesDuringAHitch) {
    for (const double hitch_s : {0.3, 10.0, -5.0}) {
        store_ = std::make_unique<PatternStore>(eye_, settings_of(GetParam().mode), 5, GetParam().opencl);
        store_->warm_up(at(0, 0.001).moment);
        const glare::Pattern dark = settled(20, 0.001);
        glare::Pattern last = dark;
        double largest = 0;
        double time_s = 20 + hitch_s;
        for (int frame = 0; frame < 30; ++frame) {
            const std::uint64_t made = store_->patterns_made();
            {
                const PatternLease lease = store_->take(at(time_s, 100));
                largest = std::max(largest, distance(lease.pattern(), last));
                last = lease.pattern();
            }
            for (int tries = 0; tries < 100 && store_->patterns_made() == made; ++tries)
                std::this_thread::sleep_for(std::chrono::microseconds(200));
            time_s += interval_s;
        }
        auto exact = at(time_s, 100);
        exact.wait = true;
        const double whole = distance(store_->take(exact).pattern(), dark);
        EXPECT_LT(largest, (1.5 * 2 * interval_s / plugin::pattern_blend_s + 0.15) * whole) << hitch_s;
    }
}

// Two of three lamps have patterns of their own, lowest first. The lowest comes and goes: none of the others' light jumps.
TEST_P(AsyncStore, MoreLampsThanPatternsGoOverWithoutAJump) {
    auto settings = settings_of(GetParam().mode);
    settings.max_lamps_in_view = 2;
    store_ = std::make_unique<PatternStore>(eye_, settings, 5, GetParam().opencl);
    constexpr std::uint32_t two = 1U << 1U | 1U << 2U;  // red and green
    constexpr std::uint32_t three = two | 1U;
    store_->warm_up(at(0, 0.001, two).moment);
    const auto drawn = [](const glare::Pattern& p, std::size_t lamp) {
        const std::size_t floats = p.skirt.size() / p.lamps.size();
        const auto first = p.skirt.begin() + static_cast<std::ptrdiff_t>(p.slot_of_lamp[lamp] * floats);
        return std::vector<float>(first, first + static_cast<std::ptrdiff_t>(floats));
    };
    const auto apart = [](const std::vector<float>& a, const std::vector<float>& b) {
        double sum = 0;
        for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
            sum += std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
        return sum;
    };
    constexpr std::size_t green = 2;
    const std::vector<float> own = drawn(settled(1, 0.001, two), green);
    double time_s = 1;
    for (const std::uint32_t lamps : {three, two}) {
        std::vector<float> last;
        double largest = 0;
        // A lamp that went out of view keeps its pattern for a while.
        if (lamps == two) time_s += plugin::lamp_linger_s + 1;
        for (int frame = 0; frame < 30; ++frame) {
            const std::uint64_t made = store_->patterns_made();
            {
                const PatternLease lease = store_->take(at(time_s, 0.001, lamps));
                const std::vector<float> now = drawn(lease.pattern(), green);
                if (!last.empty()) largest = std::max(largest, apart(now, last));
                last = now;
            }
            for (int tries = 0; tries < 100 && store_->patterns_made() == made; ++tries)
                std::this_thread::sleep_for(std::chrono::microseconds(200));
            time_s += interval_s;
        }
        const double whole = apart(last, own);
        if (lamps == three) {
            EXPECT_GT(whole, 0) << "green has lost its pattern to white";
        }
        const auto exact = drawn(settled(time_s, 0.001, three), green);
        const double change = apart(exact, own);
        EXPECT_LT(largest, (1.5 * 2 * interval_s / plugin::pattern_blend_s + 0.15) * change) << lamps;
    }
}

TEST_P(AsyncStore, SettlesOnThePatternThatWaitingGives) {
    store_->warm_up(at(0, 0.001).moment);
    static_cast<void>(settled(1, 0.001));
    // While the host pauses, the pattern is that of the frame that would come next.
    const glare::Pattern shown = settled(1, 10);
    PatternStore other(eye_, settings_of(GetParam().mode), 5, GetParam().opencl);
    auto exact = at(1, 10);
    exact.wait = true;
    const PatternLease lease = other.take(exact);
    const double scale = distance(lease.pattern(), settled(1, 0.001));
    EXPECT_LT(distance(lease.pattern(), shown), 0.25 * scale);
}

TEST_P(AsyncStore, ALampThatComesIntoViewIsDrawnLikeItsNearestAndThenLikeItself) {
    constexpr std::uint32_t white = 1U << lamp_white;
    constexpr std::uint32_t red = 1U << lamp_red;
    store_->warm_up(at(0, 0.001).moment);
    static_cast<void>(settled(0, 0.001, white));
    {
        const PatternLease lease = store_->take(at(0, 0.001, white | red));
        ASSERT_LT(lease.pattern().slot_of_lamp[lamp_red], lease.pattern().lamps.size());
    }
    const glare::Pattern own = settled(0, 0.001, white | red);
    EXPECT_EQ(own.lamps[own.slot_of_lamp[lamp_red]], lamp_red);
    // It flashes: while it is dark its pattern stays.
    const glare::Pattern still = settled(0, 0.001, white);
    EXPECT_EQ(still.lamps[still.slot_of_lamp[lamp_red]], lamp_red);
}

// Two views of one instant show one pattern, however the thread beside them is faring.
TEST_P(AsyncStore, ViewsOfOneInstantAgree) {
    store_->warm_up(at(0, 0.001).moment);
    for (int frame = 1; frame < 60; ++frame) {
        auto demand = at(frame * interval_s, 0.001);
        const int left_view = 0;
        const int right_view = 0;
        demand.viewer = &left_view;
        const std::uint64_t left = store_->take(demand).pattern().generation;
        demand.viewer = &right_view;
        std::this_thread::sleep_for(std::chrono::milliseconds(frame % 4));
        EXPECT_EQ(store_->take(demand).pattern().generation, left);
    }
}

// Determinism: what was shown before, and who asked first, does not matter.
TEST_P(AsyncStore, WaitingGivesAPureFunctionOfTheMoment) {
    PatternStore other(eye_, settings_of(GetParam().mode), 5, GetParam().opencl);
    store_->warm_up(at(0, 1).moment);
    for (int frame = 0; frame < 10; ++frame)
        static_cast<void>(store_->take(at(frame * interval_s, 1)));
    for (const double time_s : {3.21, 0.4, 3.21, 1e6}) {
        for (const double adaptation : {0.001, 3.0}) {
            auto demand = at(time_s, adaptation);
            demand.wait = true;
            const PatternLease here = store_->take(demand);
            const PatternLease there = other.take(demand);
            EXPECT_EQ(here.pattern().skirt, there.pattern().skirt) << time_s << ' ' << adaptation;
            EXPECT_EQ(here.pattern().core_energy, there.pattern().core_energy);
        }
    }
}

// Five channels with pitches of their own, each on its thread, while the configuration's spectra change.
TEST_P(AsyncStore, FiveViewsOnFiveThreadsAreServed) {
    store_->warm_up(at(0, 0.001).moment);
    // A pattern of another pitch may stand in, whose skirt ends a little elsewhere.
    double least = 1;
    double most = 0;
    for (int view = 0; view < 5; ++view) {
        auto demand = at(0, 0.001);
        demand.moment.request.pitch = pitch * (1 + 0.1 * view);
        demand.wait = true;
        const double energy = energy_of(store_->take(demand).pattern());
        least = std::min(least, energy - 0.003);
        most = std::max(most, energy + 0.003);
    }
    std::atomic<int> bad{0};
    std::vector<std::thread> views;
    for (int view = 0; view < 5; ++view) {
        views.emplace_back([&, view] {
            for (int frame = 0; frame < 40; ++frame) {
                auto demand = at(frame * interval_s, frame < 20 ? 0.001 : 10);
                demand.moment.request.pitch = pitch * (1 + 0.1 * view);
                demand.wait = view == 4 && frame % 8 == 0;
                const PatternLease lease = store_->take(demand);
                const double energy = energy_of(lease.pattern());
                if (!(energy > least && energy < most)) ++bad;
            }
        });
    }
    store_->prepare(glare::navigation_lamps());
    for (std::thread& view : views)
        view.join();
    EXPECT_EQ(bad, 0);
}

// Frames that add up their lights on the processor go first; but for ever nobody waits for them, and not at all who is waited for.
TEST_P(AsyncStore, LetsFramesPassAndIsNotStarvedByThem) {
    if (!GetParam().opencl || !glare::ClShared::acquire()->is_cpu())
        GTEST_SKIP() << "the pattern shares no threads of OpenCL's with frames";
    store_->warm_up(at(0, 0.001).moment);
    const glare::ClFrameTurn frame;
    const std::uint64_t made = store_->patterns_made();
    bool let_pass = false;
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    for (int i = 1; std::chrono::steady_clock::now() < give_up; ++i) {
        if (let_pass && store_->patterns_made() >= made + 3) break;
        static_cast<void>(store_->take(at(i * interval_s, 0.001)));
        for (int tries = 0; tries < 20; ++tries) {
            let_pass = let_pass || glare::ClBehindFrames::waiting() > 0;
            std::this_thread::sleep_for(std::chrono::microseconds(100));
        }
    }
    EXPECT_TRUE(let_pass);
    EXPECT_GE(store_->patterns_made(), made + 3);
    auto exact = at(0.4, 0.001);
    exact.wait = true;
    EXPECT_TRUE(store_->take(exact).pattern().generation != 0);
    store_.reset();
    EXPECT_EQ(glare::ClBehindFrames::waiting(), 0);
}

TEST_P(AsyncStore, EndsWhileAPatternIsBeingMade) {
    store_->warm_up(at(0, 0.001).moment);
    static_cast<void>(store_->take(at(0.5, 10)));
    store_.reset();
}

// Where nothing moves, nothing is made.
TEST_P(AsyncStore, AnEyeAtRestCostsNothing) {
    store_->warm_up(at(0, 0.001).moment);
    auto demand = at(0, 0.001);
    demand.moment = glare::at_rest(demand.moment);
    demand.wait = true;
    const std::uint64_t generation = store_->take(demand).pattern().generation;
    const std::uint64_t made = store_->patterns_made();
    const std::uint64_t launches = store_->kernel_launches();
    for (const bool wait : {false, true}) {
        for (int frame = 1; frame < 100; ++frame) {
            auto later = at(frame * 0.1, 0.001);
            later.moment = glare::at_rest(later.moment);
            later.wait = wait;
            const PatternLease lease = store_->take(later);
            EXPECT_TRUE(lease.reused());
            EXPECT_EQ(lease.pattern().generation, generation);
        }
    }
    EXPECT_EQ(store_->patterns_made(), made);
    EXPECT_EQ(store_->kernel_launches(), launches);
}

INSTANTIATE_TEST_SUITE_P(Ways, AsyncStore,
                         ::testing::Values(Way{"Cpu", false, glare::MotionMode::every_frame},
                                           Way{"OpenCl", true, glare::MotionMode::every_frame},
                                           Way{"Interpolated", true, glare::MotionMode::interpolated},
                                           Way{"FlipBook", true, glare::MotionMode::flip_book}),
                         [](const auto& given) { return std::string(given.param.name); });

}  // namespace
