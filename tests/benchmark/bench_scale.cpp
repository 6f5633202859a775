// The light database from a hundred lights to a million: loading, memory, and what a frame costs. Each speed stands beside
// its error: every evaluation is compared with looking at all lights one by one.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <numbers>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "lightdb/evaluate.h"
#include "lightdb/geodesy.h"
#include "lightdb/light_file.h"
#include "lightdb/light_store.h"
#include "lightdb/photometry.h"
#include "plugin_api/frame_mutex.h"
#include "tests/benchmark/light_file_text.h"

namespace seaglare::benchmark {
namespace {

using lightdb::Evaluated;
using lightdb::Light;
using lightdb::LightId;
using lightdb::LightStore;
using lightdb::Observer;

constexpr std::int64_t in_sight_count = 1000;

std::vector<std::int64_t> light_counts(std::int64_t least) {
    std::vector<std::int64_t> counts;
    for (std::int64_t count = 100; count <= 1'000'000; count *= 10) {
        if (count >= least) counts.push_back(count);
    }
    return counts;
}

Observer on_a_bridge() {
    Observer observer;
    observer.eye_m = {0, 0, 20};
    observer.view_from_scene = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1};
    observer.time_s = 1234.5;
    observer.extinction_per_m = lightdb::extinction_per_m(20 * 1852.0);
    observer.least_illuminance_lx = 1e-9;
    return observer;
}

class Scatter {
  public:
    Light light(double least_distance_m, double most_distance_m, double intensity_cd, double height_m) {
        const double a = least_distance_m * least_distance_m;
        const double b = most_distance_m * most_distance_m;
        const double distance_m = std::sqrt(a + (b - a) * unit_(engine_));
        const double turn = 2 * std::numbers::pi * unit_(engine_);
        Light light;
        light.name = "Light " + std::to_string(++count_);
        light.source = "generated";
        light.position_m = {distance_m * std::cos(turn), distance_m * std::sin(turn), height_m};
        light.intensity_cd[0] = intensity_cd * (0.5 + unit_(engine_));
        light.character = "Fl 5s";
        // Never quite dark: each frame has the same lights to draw.
        light.rhythm.phases = {{1, true, lightdb::Colour::white}, {4, true, lightdb::Colour::white, 0.1}};
        light.rhythm.period_s = 5;
        return light;
    }

  private:
    std::mt19937 engine_{7};
    std::uniform_real_distribution<double> unit_{0, 1};
    int count_ = 0;
};

// What the others are: the reasons for which lights of a large database are not seen.
enum class Others {
    below_horizon,
    too_faint_among_them,
    switched_off,
    on_ships_far_away,
    of_photometers_by_day,
    switched_off_later,
    eclipsed,
    out_of_sector,
    count
};
constexpr const char* others_names[] = {"below the horizon",        "among them, too faint",
                                        "among them, switched off", "of ships below the horizon",
                                        "among them, off by day",   "among them, switched off just now",
                                        "among them, eclipsed",     "among them, out of sector"};

// 1000 lights in sight and the rest of `count` of the other kind, in an order that tells nothing.
LightStore scene(std::int64_t count, Others others) {
    Scatter scatter;
    LightStore store;
    std::mt19937 engine(11);
    std::int64_t near_left = in_sight_count;
    std::vector<LightId> later;
    for (std::int64_t left = count; left > 0; --left) {
        if (std::uniform_int_distribution<std::int64_t>(1, left)(engine) <= near_left) {
            --near_left;
            store.add(scatter.light(200, 15e3, 500, 12));
            continue;
        }
        Light light;
        switch (others) {
            case Others::below_horizon:
                light = scatter.light(60e3, 4e6, 500, 12);
                break;
            case Others::too_faint_among_them:
                light = scatter.light(200, 15e3, 1e-6, 12);
                break;
            case Others::switched_off:
                light = scatter.light(200, 15e3, 500, 12);
                light.on = false;
                break;
            case Others::on_ships_far_away: {
                light = scatter.light(1, 100, 50, 12);
                light.body_id = static_cast<std::uint32_t>(1 + left / 20);
                break;
            }
            case Others::of_photometers_by_day:
                light = scatter.light(200, 15e3, 500, 12);
                light.day_off = true;
                break;
            case Others::eclipsed:
                light = scatter.light(200, 15e3, 500, 12);
                light.rhythm.phases = {{1e-9, true, lightdb::Colour::white}, {5, false}};
                light.rhythm.period_s = 5 + 1e-9;
                break;
            case Others::out_of_sector:
                light = scatter.light(200, 15e3, 500, 12);
                // Shown to those who see it against the centre: away from the eye.
                light.true_north_deg =
                    std::atan2(light.position_m[0], light.position_m[1]) * 180 / std::numbers::pi;
                light.sectors = {{lightdb::Colour::white, 170, 190}};
                break;
            case Others::switched_off_later:
            case Others::count:
                light = scatter.light(200, 15e3, 500, 12);
                break;
        }
        const LightId id = store.add(light);
        if (others == Others::switched_off_later) later.push_back(id);
    }
    if (others == Others::on_ships_far_away) {
        for (std::int64_t body = 1; body <= 1 + count / 20; ++body) {
            const Light at = scatter.light(60e3, 2e6, 1, 0);
            store.set_body_pose(static_cast<std::uint32_t>(body), {at.position_m, {0, 0, 0, 1}});
        }
    }
    store.optimise();
    for (const LightId id : later)
        store.set_on(id, false);
    return store;
}

bool same(const glare::PointSource& a, const glare::PointSource& b) {
    return a.position_view_m == b.position_view_m && a.illuminance_rgb_lx == b.illuminance_rgb_lx &&
           a.illuminance_scotopic_lx == b.illuminance_scotopic_lx && a.radius_m == b.radius_m &&
           a.lamp == b.lamp;
}

// The error beside the speed: how many sources differ from what looking at every light gives.
void check(::benchmark::State& state, const LightStore& store, const Observer& observer) {
    Evaluated with;
    Evaluated without;
    lightdb::evaluate(store, observer, with, lightdb::Culling::by_index);
    lightdb::evaluate(store, observer, without, lightdb::Culling::one_by_one);
    std::size_t different = std::max(with.sources.size(), without.sources.size()) -
                            std::min(with.sources.size(), without.sources.size());
    for (std::size_t i = 0; i < std::min(with.sources.size(), without.sources.size()); ++i)
        different += with.light[i] != without.light[i] || !same(with.sources[i], without.sources[i]) ? 1 : 0;
    const std::size_t told = with.sources.size() + with.dark + with.below_horizon + with.too_faint;
    state.counters["sources"] = static_cast<double>(with.sources.size());
    state.counters["different"] = static_cast<double>(different);
    state.counters["without_reason"] = static_cast<double>(store.size() - told);
    if (different != 0 || told != store.size()) state.SkipWithError("the index gives other sources");
}

void load(::benchmark::State& state) {
    const auto path = std::filesystem::temp_directory_path() /
                      ("seaglare_bench_scale_" + std::to_string(state.range(0)) + ".json");
    std::ofstream(path) << light_file_text(static_cast<std::size_t>(state.range(0)));
    std::size_t bytes = 0;
    std::size_t lights = 0;
    std::size_t kinds = 0;
    for (auto _ : state) {
        lightdb::LightFile file = lightdb::load_light_file(path.string());
        lightdb::place_lights(file.lights, {55.5, 11, 0}, lightdb::Earth::round);
        LightStore store;
        for (Light& light : file.lights)
            store.add(std::move(light));
        store.optimise();
        bytes = store.memory_bytes();
        lights = store.size();
        kinds = store.kind_count();
    }
    state.counters["file_MB"] = static_cast<double>(std::filesystem::file_size(path)) / 1e6;
    state.counters["bytes_per_light"] = static_cast<double>(bytes) / static_cast<double>(lights);
    state.counters["kinds"] = static_cast<double>(kinds);
    state.SetItemsProcessed(state.iterations() * state.range(0));
    std::filesystem::remove(path);
}

void add(::benchmark::State& state) {
    Scatter scatter;
    std::vector<Light> lights;
    for (std::int64_t i = 0; i < state.range(0); ++i)
        lights.push_back(scatter.light(200, 1e6, 500, 12));
    std::size_t bytes = 0;
    for (auto _ : state) {
        LightStore store;
        for (const Light& light : lights)
            store.add(light);
        store.optimise();
        bytes = store.memory_bytes();
    }
    state.counters["bytes_per_light"] = static_cast<double>(bytes) / static_cast<double>(lights.size());
    state.SetItemsProcessed(state.iterations() * state.range(0));
}

void evaluate_all_in_sight(::benchmark::State& state) {
    Scatter scatter;
    LightStore store;
    for (std::int64_t i = 0; i < state.range(0); ++i)
        store.add(scatter.light(200, 15e3, 500, 12));
    store.optimise();
    const Observer observer = on_a_bridge();
    Evaluated out;
    for (auto _ : state)
        lightdb::evaluate(store, observer, out);
    check(state, store, observer);
    state.SetItemsProcessed(state.iterations() * state.range(0));
}

void thousand_among(::benchmark::State& state) {
    const auto others = static_cast<Others>(state.range(1));
    const LightStore store = scene(state.range(0), others);
    Observer observer = on_a_bridge();
    observer.is_day = others == Others::of_photometers_by_day;
    Evaluated out;
    for (auto _ : state)
        lightdb::evaluate(store, observer, out);
    check(state, store, observer);

    state.counters["others"] = static_cast<double>(state.range(0) - in_sight_count);
    state.SetLabel(others_names[state.range(1)]);
}

// A frame in which the host moves lights of a million: the update and the evaluation after it.
void frame_after_moving(::benchmark::State& state) {
    LightStore store = scene(1'000'000, Others::below_horizon);
    const std::vector<LightId> ids = store.ids();
    const Observer observer = on_a_bridge();
    const std::int64_t moved = state.range(0);
    const bool again = state.range(1) != 0;  // the same ones in each frame, or the first time
    Evaluated out;
    double shift_m = 0;
    double slowest_settling_ms = 0;
    const auto move_them = [&] {
        shift_m += 1;
        for (std::int64_t i = 0; i < moved; ++i) {
            const LightId id = ids[static_cast<std::size_t>(i * (1'000'000 / moved))];
            store.set_position(id, {5e5 + shift_m, static_cast<double>(i), 10});
        }
    };
    if (again) move_them();
    for (auto _ : state) {
        if (!again) {
            state.PauseTiming();
            store.optimise();
            state.ResumeTiming();
        }
        move_them();
        store.settle();
        lightdb::evaluate(store, observer, out);
    }
    // The frames after it, until all have settled.
    for (int frame = 0; frame < 100; ++frame) {
        const auto start = std::chrono::steady_clock::now();
        store.settle();
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
        slowest_settling_ms = std::max(slowest_settling_ms, took.count());
    }
    check(state, store, observer);
    state.counters["slowest_settling_ms"] = slowest_settling_ms;
    state.SetLabel(again ? "the same ones as before" : "that had kept still");
}

// The lights of a generated file, each made unlike any other where asked for.
std::vector<Light> various_lights(std::int64_t count, bool all_different) {
    Scatter scatter;
    std::vector<Light> lights;
    lights.reserve(static_cast<std::size_t>(count));
    for (std::int64_t i = 0; i < count; ++i) {
        lights.push_back(scatter.light(200, 1e6, 500, 12));
        if (!all_different) continue;
        const double from_deg = std::fmod(static_cast<double>(i) * 0.01, 300);
        lights.back().sectors = {
            {lightdb::Colour::white, from_deg, from_deg + 10},
            {lightdb::Colour::red, from_deg + 10, from_deg + 20},
            {lightdb::Colour::green, from_deg + 20, from_deg + 20 + 1e-6 * static_cast<double>(i)}};
    }
    return lights;
}

// What other programs on the machine do does not count.
double thread_cpu_ms() {
    std::timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

// Loading as a context does it, piece by piece, while another thread draws frames: how long the longest waits for the
// lights, and how long the lights are held for at once.
void load_while_frames_are_drawn(::benchmark::State& state) {
    using Clock = std::chrono::steady_clock;
    const auto ms = [](Clock::duration d) { return std::chrono::duration<double, std::milli>(d).count(); };
    const bool all_different = state.range(1) != 0;
    double longest_wait_ms = 0, longest_piece_ms = 0, show_ms = 0, bytes = 0, kinds = 0;
    std::int64_t frames = 0;
    for (auto _ : state) {
        state.PauseTiming();
        std::vector<Light> lights = various_lights(state.range(0), all_different);
        LightStore store;
        plugin::FrameMutex mutex;
        std::atomic<bool> loading{true};
        std::thread renderer([&] {
            Evaluated out;
            while (loading) {
                const Clock::time_point asked = Clock::now();
                {
                    const std::lock_guard lock(mutex);
                    longest_wait_ms = std::max(longest_wait_ms, ms(Clock::now() - asked));
                    store.settle();
                    lightdb::evaluate(store, on_a_bridge(), out);
                }
                ++frames;
                std::this_thread::sleep_for(std::chrono::milliseconds(2));
            }
        });
        state.ResumeTiming();
        lightdb::LightBatch batch(std::move(lights));
        for (bool more = true; more; mutex.let_others_pass()) {
            const std::lock_guard lock(mutex);
            const Clock::time_point start = Clock::now();
            const double cpu_ms = thread_cpu_ms();
            do {
                more = store.take_in(batch, 32);
            } while (more && Clock::now() - start < std::chrono::microseconds(250));
            longest_piece_ms = std::max(longest_piece_ms, thread_cpu_ms() - cpu_ms);
        }
        {
            const std::lock_guard lock(mutex);
            const Clock::time_point start = Clock::now();
            store.show(batch);
            show_ms = std::max(show_ms, ms(Clock::now() - start));
        }
        loading = false;
        renderer.join();
        bytes = static_cast<double>(store.memory_bytes());
        kinds = static_cast<double>(store.kind_count());
        state.PauseTiming();
        check(state, store, on_a_bridge());
        state.ResumeTiming();
    }
    state.counters["longest_wait_ms"] = longest_wait_ms;
    state.counters["longest_piece_cpu_ms"] = longest_piece_ms;
    state.counters["show_ms"] = show_ms;
    state.counters["frames"] = static_cast<double>(frames);
    state.counters["bytes_per_light"] = bytes / static_cast<double>(state.range(0));
    state.counters["kinds"] = kinds;
    state.SetLabel(all_different ? "each unlike any other" : "of one kind");
}

// A table needs the same columns in every row: 0 where one says nothing.
auto with_all_columns(void (*measure)(::benchmark::State&)) {
    return [measure](::benchmark::State& state) {
        for (const char* const column :
             {"different", "without_reason", "sources", "others", "bytes_per_light", "kinds", "file_MB",
              "frames", "longest_wait_ms", "longest_piece_cpu_ms", "show_ms", "slowest_settling_ms"})
            state.counters[column] = 0;
        measure(state);
    };
}

void declare() {
    using ::benchmark::kMillisecond;
    for (const std::int64_t count : light_counts(0))
        ::benchmark::RegisterBenchmark("load_file", with_all_columns(load))->Arg(count)->Unit(kMillisecond);
    for (const std::int64_t count : light_counts(0))
        ::benchmark::RegisterBenchmark("add", with_all_columns(add))->Arg(count)->Unit(kMillisecond);
    for (const std::int64_t different : {0, 1}) {
        for (const std::int64_t count : light_counts(0)) {
            ::benchmark::RegisterBenchmark("load_while_frames_are_drawn",
                                           with_all_columns(load_while_frames_are_drawn))
                ->Args({count, different})
                ->Iterations(1)
                ->Unit(kMillisecond);
        }
    }
    for (const std::int64_t count : light_counts(0)) {
        ::benchmark::RegisterBenchmark("evaluate_all_in_sight", with_all_columns(evaluate_all_in_sight))
            ->Arg(count)
            ->Unit(kMillisecond);
    }
    for (int others = 0; others < static_cast<int>(Others::count); ++others) {
        for (const std::int64_t count : light_counts(in_sight_count)) {
            ::benchmark::RegisterBenchmark("thousand_in_sight_among", with_all_columns(thousand_among))
                ->Args({count, others})
                ->Unit(kMillisecond);
        }
    }
    for (const std::int64_t moved : {1000, 10'000, 100'000}) {
        for (const std::int64_t again : {0, 1}) {
            ::benchmark::RegisterBenchmark("frame_after_moving", with_all_columns(frame_after_moving))
                ->Args({moved, again})
                ->Iterations(again != 0 ? 20 : 3)
                ->Unit(kMillisecond);
        }
    }
}

}  // namespace
}  // namespace seaglare::benchmark

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    seaglare::benchmark::declare();
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
