// seaglare-report: measures the glare pattern, and writes what it found as tables, plots and one page.
#include <CLI/CLI.hpp>
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
    app.add_flag("--quick", o.quick, "pictures and profile only: no sweeps over the knobs");
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
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : 2;
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
