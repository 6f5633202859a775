// The host's three commands. Each returns the exit status: 0 done, 1 failed, 3 the plug-in broke its contract.
#pragma once

#include <filesystem>

#include "host_stub/simulation.h"

namespace seaglare::host {

inline constexpr int exit_contract_broken = 3;

struct RenderOptions {
    SceneOptions scene;
    std::filesystem::path out;
    int frames = 1;
    double frame_rate_hz = 60;
    bool print_plan = false;
    bool sequence = false;        // a PNG of every frame
    bool without_plugin = false;  // the host's own picture only
    bool check = true;            // the contract, around every call
};
int render_command(const RenderOptions& options);

struct BenchOptions {
    SceneOptions scene;
    int frames = 60;
    bool json = false;
};
int bench_command(const BenchOptions& options);

struct WindowOptions {
    SceneOptions scene;
    int frames = 0;  // 0: until closed
    std::filesystem::path screenshot;
    bool without_plugin = false;
};
int window_command(const WindowOptions& options);

}  // namespace seaglare::host
