// seaglare-host: a stand-in ship simulator that loads Seaglare as any host would.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <iostream>

#include "host_stub/commands.h"

namespace {

using namespace seaglare::host;

void add_scene_options(CLI::App& app, SceneOptions& o) {
    app.add_option("--scene", o.scene, "scene file, such as config/scenes/great_belt_night.json")->required();
    app.add_option("--channel", o.channel, "one of the scene's channels, by name (default: its first)");
    app.add_option("--observer", o.observer, "one of the scene's observers, by name (default: its first)");
    app.add_option("--size", o.size, "WIDTHxHEIGHT in pixels instead of the channel's");
    app.add_option("--time", o.time, "local time of day, HH:MM[:SS], instead of the scene's");
    app.add_option("--start", o.start_s, "absolute time of the first frame in seconds: rhythms depend on it");
    app.add_option("--plugin", o.plugin,
                   "libseaglare.so to load (default: $SEAGLARE_PLUGIN, then beside this program)");
    app.add_option("--quality", o.quality, "quality file instead of the scene's");
}

int run(int argc, char** argv) {
    CLI::App app("A stand-in ship simulator that shows what Seaglare does to a night scene", "seaglare-host");
    app.require_subcommand(1);

    RenderOptions render;
    CLI::App* render_app =
        app.add_subcommand("render", "draw without a display and write pictures and statistics");
    add_scene_options(*render_app, render.scene);
    render_app
        ->add_option("--out", render.out,
                     "folder for before.png, glare.exr, after.png, stats.json, plan.json")
        ->required();
    render_app->add_option("--frames", render.frames, "frames to draw; the pictures are of the last")
        ->check(CLI::Range(1, 1000000));
    render_app->add_option("--rate", render.frame_rate_hz, "frames per second of simulated time")
        ->check(CLI::Range(0.01, 1000.0));
    render_app->add_flag("--plan", render.print_plan, "print the plan of the last frame");
    render_app->add_flag("--sequence", render.sequence, "write a picture of every frame");
    render_app->add_flag("--without-plugin", render.without_plugin, "the host's own picture only");
    render_app->add_flag("!--no-check", render.check, "do not compare GL and process state around each call");

    BenchOptions bench;
    CLI::App* bench_app = app.add_subcommand("bench", "frame times with and without the plug-in");
    add_scene_options(*bench_app, bench.scene);
    bench_app->add_option("--frames", bench.frames, "frames to time")->check(CLI::Range(1, 1000000));
    bench_app->add_flag("--json", bench.json, "write JSON instead of a table");

    WindowOptions window;
    CLI::App* window_app = app.add_subcommand("window", "the same in a window; also as --window");
    add_scene_options(*window_app, window.scene);
    window_app->add_option("--frames", window.frames, "close after so many frames")
        ->check(CLI::Range(0, 1000000));
    window_app->add_option("--screenshot", window.screenshot, "write the last of --frames to this PNG file");
    window_app->add_flag("--without-plugin", window.without_plugin, "the host's own picture only");

    std::vector<std::string> arguments(argv + 1, argv + argc);
    // A subcommand comes before its options; --window may stand anywhere.
    if (const auto at = std::find(arguments.begin(), arguments.end(), "--window"); at != arguments.end()) {
        arguments.erase(at);
        arguments.insert(arguments.begin(), "window");
    }
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants a vector
    try {
        app.parse(arguments);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : 2;
    }
    if (render_app->parsed()) return render_command(render);
    if (bench_app->parsed()) return bench_command(bench);
    return window_command(window);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& e) {
        std::cerr << "seaglare-host: " << e.what() << "\n";
        return 1;
    }
}
