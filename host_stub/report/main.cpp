// seaglare-report: measures the glare pattern and whole frames, and writes what it found as tables, plots and one page.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <iostream>

#include "host_stub/report/commands.h"

namespace {

using namespace seaglare::report;

void add_psf(CLI::App& app, PsfOptions& o) {
    app.add_option("--out", o.out, "folder for pictures, tables, plots and index.html")->required();
    app.add_option("--eye", o.eye, "eye file, such as config/eye/sixty.json (default: the quality's)")
        ->check(CLI::ExistingFile);
    app.add_option("--quality", o.quality, "quality file (default: config/quality/default.json)")
        ->check(CLI::ExistingFile);
    app.add_option("--pupil-mm", o.pupil_mm, "pupil diameter (default: the eye's by starlight)")
        ->check(CLI::Range(1.0, 8.5));
    app.add_option("--time", o.time_s, "the instant, in seconds");
    app.add_option("--lines", o.lines, "lines of the channel")->check(CLI::Range(64, 16384));
    app.add_option("--vfov", o.vfov_deg, "its vertical field of view in degrees")
        ->check(CLI::Range(1.0, 150.0));
    app.add_option("--field", o.field_deg, "angle up to which patterns are compared, in degrees")
        ->check(CLI::Range(0.05, 12.0));
    app.add_option("--step-nm", o.step_nm, "the reference's step in wavelength")
        ->check(CLI::IsMember({5, 10, 20, 40}));
    app.add_option("--cache", o.cache, "folder of reference patterns made before (default: OUT/cache)");
    app.add_flag(
        "--quick", o.quick,
        "pictures and profile only: half a minute of the processor's time, and with the sweeps over knobs, "
        "eyes and run time about two and a half");
}

struct FrameArguments {
    FrameOptions options;
    std::vector<std::filesystem::path> scenes;
    std::filesystem::path folder;
    std::vector<std::uint32_t> lights = {100, 250, 500, 1000, 10000};
};

void add_frames(CLI::App& app, FrameArguments& a) {
    app.add_option("--out", a.options.out, "folder for pictures, tables, plots and index.html")->required();
    app.add_option(
        "--scene", a.scenes,
        "scene file, or the name of one in the folder of scenes; may be given again (default: all)");
    app.add_option("--scenes", a.folder, "folder of scenes (default: config/scenes where this was built)");
    app.add_option("--plugin", a.options.plugin, "the library (default: the one built beside this)");
    app.add_option("--cache", a.options.cache,
                   "folder of reference patterns made before (default: OUT/cache)");
    app.add_option("--size", a.options.size, "WIDTHxHEIGHT instead of the channel's");
    app.add_option("--step-nm", a.options.step_nm, "the reference's step in wavelength")
        ->check(CLI::IsMember({5, 10, 20, 40}));
    CLI::Option* const quick = app.add_flag("--quick", a.options.quick, "a few knobs and frames only");
    app.add_flag("--full", a.options.full,
                 "every setting of every knob, and every way for every number of lights")
        ->excludes(quick);
}

// Names become files, none becomes all.
void find_scenes(FrameArguments& a) {
    if (a.folder.empty()) a.folder = SEAGLARE_SCENES_DIR;
    if (a.scenes.empty()) {
        for (const auto& entry : std::filesystem::directory_iterator(a.folder))
            if (entry.path().extension() == ".json") a.scenes.push_back(entry.path());
        std::sort(a.scenes.begin(), a.scenes.end());
    }
    for (std::filesystem::path& scene : a.scenes)
        if (!std::filesystem::exists(scene)) scene = a.folder / (scene.string() + ".json");
}

int run(int argc, char** argv) {
    CLI::App app("Measures Seaglare's glare pattern: error against run time", "seaglare-report");
    app.require_subcommand(1);
    PsfOptions psf;
    CLI::App* const psf_app = app.add_subcommand("psf", "the pattern of one light, beside the reference");
    add_psf(*psf_app, psf);
    std::filesystem::path stability_out;
    CLI::App* const stability =
        app.add_subcommand("stability", "stiff and extreme cases, each with its worst error");
    stability->add_option("--out", stability_out, "folder for tables, plots and index.html")->required();
    FrameArguments frames;
    CLI::App* const accuracy =
        app.add_subcommand("accuracy", "whole frames of each scene and each knob, beside the reference");
    add_frames(*accuracy, frames);
    CLI::App* const speed =
        app.add_subcommand("speed", "what frames take, pass by pass, beside their error and the way of 2012");
    add_frames(*speed, frames);
    speed->add_option("--lights", frames.lights, "numbers of lights of thesis_many_lights; 0: not that")
        ->delimiter(',');
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : 2;
    }
    if (accuracy->parsed() || speed->parsed()) find_scenes(frames);
    if (accuracy->parsed()) return accuracy_command(frames.options, frames.scenes);
    if (speed->parsed()) {
        std::erase(frames.lights, 0U);
        return speed_command(frames.options, frames.scenes, frames.folder / "thesis_many_lights.json",
                             frames.lights);
    }
    return stability->parsed() ? stability_command(stability_out) : psf_command(psf);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& e) {
        std::cerr << "seaglare-report: " << e.what() << "\n";
        return 1;
    }
}
