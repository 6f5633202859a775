// The command line of seaglare-lights.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "lightdb/tool/commands.h"
#include "lightdb/tool/import_command.h"
#include "lightdb/tool/lint_command.h"
#include "lightdb/tool/spectra_command.h"

namespace {

using seaglare::lights_tool::ImportRequest;
using seaglare::lights_tool::LintRequest;

constexpr const char* about =
    "Light files for Seaglare: check them, write them from lists of lights, and see what a character "
    "means.\n\n"
    "A light file is JSON: a list of lights with a place, a height, a character as charts write it\n"
    "(\"Fl(2) WRG 10s\"), nominal ranges and sectors. You need no photometry: intensities follow from "
    "ranges.";

constexpr const char* about_validate =
    "Reads light files as the product does and prints every error and warning as FILE:LINE:COLUMN: text.\n"
    "Exit status 0: no errors; 1: errors; 2: a file cannot be read.";
constexpr const char* about_json =
    "Says whether a file is JSON (RFC 8259), whatever it is about. Exit status 0: it is; 1: it is not, and\n"
    "the message names the line and the column; 2: it cannot be read.";
constexpr const char* about_character =
    "Explains a light's character: which phases of light and darkness it stands for, in seconds, its "
    "colours,\n"
    "height and ranges, as JSON. \"assumptions\" lists what the notation leaves open and common practice "
    "filled in;\n"
    "\"warnings\" lists what contradicts itself or is an old form. Charts (Fl(2+1)WRG.10s15m12-9M) and lists "
    "of lights\n"
    "(\"L.Fl.W. period 10s fl. 2.0s, ec. 8.0s\") are both understood.\n"
    "  seaglare-lights character \"Q(6)+LFl 15s\"\n"
    "  seaglare-lights character \"Fl W 3s\" --sigseq \"00.8+(02.2)\"\n"
    "  seaglare-lights character --format \"Gp Fl(2) WRG ev 10 sec\"\n"
    "Exit status 0: understood, if with warnings; 1: it is no light's character, and the message names the "
    "place.";
constexpr const char* about_lint =
    "Says what is odd in light files that are valid: durations that do not sum to the period, swapped, "
    "gapped and\n"
    "overlapping sectors, ranges against intensities, duplicates, leading lights off their line, colours "
    "that a\n"
    "display cannot show inside their COLREG region. Nothing is repaired. Exit status 0: done; 1: a file is "
    "wrong,\n"
    "or something was found with --strict; 2: a file cannot be read.";
constexpr const char* about_spectra =
    "Lists the lamps that light files and hosts can name, and says what the spectrum in a file is: its\n"
    "chromaticity (CIE 1931), scotopic per photopic luminance (S/P), the wavelengths below which 10, 50 and\n"
    "90 % of its light lie, the named lamp nearest to it (how far light has to be moved along the\n"
    "wavelengths to turn one into the other) and the colour whose region of COLREG Annex I it lies in.\n"
    "  seaglare-lights spectra\n"
    "  seaglare-lights spectra lamp.spdx planck:2700 config/spectra/tungsten_red_glass.json\n"
    "  seaglare-lights spectra --filter red a led_white\n"
    "Exit status 0: done; 1: one of them is no spectrum; 2: a file cannot be read.";
constexpr const char* about_import =
    "Writes a light file from a published list of lights. Every record is imported or stands in the report\n"
    "with the reason why not; what the source leaves open is assumed, and said in the light's source; what "
    "lint finds\n"
    "is reported, never repaired.";
constexpr const char* about_nga =
    "From the U.S. NGA List of Lights in its JSON form, any volume.\n"
    "  seaglare-lights import nga pub116.json --near 55.34,11.03,15 -o great_belt.json --report report.txt";
constexpr const char* about_osm =
    "From OpenStreetMap's seamark:light:* tags, as the Overpass API answers them in JSON. Ask it for the "
    "middle of\n"
    "ways (\"out center\"). The data are under the Open Database License: name OpenStreetMap where you show "
    "them.\n"
    "  seaglare-lights import osm overpass.json -o harbour.json --report report.txt";
constexpr const char* about_s57 =
    "From the LIGHTS objects of an S-57 cell with the updates beside it. Takes a build with "
    "SEAGLARE_S57=ON.\n"
    "  seaglare-lights import s57 DK5OSTBT.000 -o belt.json --report report.txt";

void add_import_options(CLI::App* command, ImportRequest& request, const char* file) {
    command->add_option("FILE", request.file, file)->required();
    command->add_option("-o,--output", request.output, "the light file to write (else to standard output)");
    command->add_option(
        "--report", request.report,
        "where to write the whole report: counts, what was left out and why, every doubt, lint");
}

// Swapped figures are the usual slip; NaN is none.
void check_place(const char* option, double latitude_deg, double longitude_deg) {
    if (!(std::abs(latitude_deg) <= 90))
        throw CLI::ValidationError(option, "latitudes are -90 to 90 degrees");
    if (!(std::abs(longitude_deg) <= 180))
        throw CLI::ValidationError(option, "longitudes are -180 to 180 degrees");
}

int run(int argc, char** argv) {
    CLI::App app(about, "seaglare-lights");
    app.require_subcommand(1);
    int status = 0;

    CLI::App* validate = app.add_subcommand("validate", about_validate);
    std::vector<std::string> files;
    validate->add_option("FILE", files, "light files")->required();
    validate->callback([&] { status = seaglare::lights_tool::validate(files, std::cout, std::cerr); });

    CLI::App* json = app.add_subcommand("json", about_json);
    std::string json_file;
    json->add_option("FILE", json_file, "any file")->required();
    json->callback([&] { status = seaglare::lights_tool::check_json(json_file, std::cerr); });

    CLI::App* character = app.add_subcommand("character", about_character);
    seaglare::lights_tool::CharacterRequest explained;
    character->add_option("TEXT", explained.text, "the character, in quotation marks")->required();
    CLI::Option* phases_option = character->add_option(
        "--phases", explained.phases,
        "durations in the place of assumed ones: \"fl. 0.8s, ec. 2.2s\", or JSON as in a light file");
    character
        ->add_option("--sigseq", explained.sigseq,
                     "the same as S-57's SIGSEQ: \"00.8+(02.2)\", eclipses in brackets")
        ->excludes(phases_option);
    character->add_flag("--format", explained.format_only, "print the notation as charts write it today");
    character->callback(
        [&] { status = seaglare::lights_tool::explain_character(explained, std::cout, std::cerr); });

    CLI::App* spectra = app.add_subcommand("spectra", about_spectra);
    seaglare::lights_tool::SpectraRequest listed;
    spectra->add_option("NAME", listed.names, "lamps, or files: .csv, .spdx, .json (default: all names)");
    spectra->add_option("--filter", listed.filter, "a coloured glass before each lamp, or a table of one");
    spectra->add_flag("--json", listed.json, "as JSON, for machines");
    spectra->callback([&] { status = seaglare::lights_tool::list_spectra(listed, std::cout, std::cerr); });

    CLI::App* import = app.add_subcommand("import", about_import);
    import->require_subcommand(1);
    CLI::App* nga = import->add_subcommand("nga", about_nga);
    ImportRequest request;
    std::vector<double> near;
    std::vector<double> box;
    add_import_options(nga, request, "the List, e.g. pub116.json");
    CLI::Option* near_option =
        nga->add_option("--near", near, "LAT,LON,NM: only lights within NM nautical miles of that place")
            ->delimiter(',')
            ->expected(3);
    nga->add_option("--box", box, "S,W,N,E: only lights within these limits, in degrees")
        ->delimiter(',')
        ->expected(4)
        ->excludes(near_option);
    nga->callback([&] {
        if (!near.empty()) {
            check_place("--near", near[0], near[1]);
            if (!(near[2] >= 0))
                throw CLI::ValidationError("--near", "the radius in nautical miles is negative");
            request.area.centre_deg = std::pair{near[0], near[1]};
            request.area.radius_nm = near[2];
        }
        if (!box.empty()) {
            check_place("--box", box[0], box[1]);
            check_place("--box", box[2], box[3]);
            if (!(box[0] <= box[2])) throw CLI::ValidationError("--box", "its south lies north of its north");
            request.area.south_deg = box[0];
            request.area.west_deg = box[1];
            request.area.north_deg = box[2];
            request.area.east_deg = box[3];
        }
        request.show_progress = isatty(STDERR_FILENO) != 0;
        status = seaglare::lights_tool::import_nga(request, std::cout, std::cerr);
    });

    CLI::App* osm = import->add_subcommand("osm", about_osm);
    add_import_options(osm, request, "OSM JSON, e.g. Overpass' answer");
    osm->callback([&] {
        request.show_progress = isatty(STDERR_FILENO) != 0;
        status = seaglare::lights_tool::import_osm(request, std::cout, std::cerr);
    });
    CLI::App* s57 = import->add_subcommand("s57", about_s57);
    add_import_options(s57, request, "the cell, e.g. DK5OSTBT.000");
    s57->callback([&] {
        request.show_progress = isatty(STDERR_FILENO) != 0;
        status = seaglare::lights_tool::import_s57(request, std::cout, std::cerr);
    });

    CLI::App* lint = app.add_subcommand("lint", about_lint);
    LintRequest linted;
    lint->add_option("FILE", linted.files, "light files")->required();
    lint->add_flag("--strict", linted.strict, "exit status 1 when anything is found");
    lint->add_flag("--json", linted.json, "findings as JSON, for machines");
    lint->callback([&] { status = seaglare::lights_tool::lint_files(linted, std::cout, std::cerr); });

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const int result = app.exit(error);
        return result == 0 ? 0 : 2;
    }
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "seaglare-lights: %s\n", error.what());
        return 2;
    }
}
