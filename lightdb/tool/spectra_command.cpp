#include "lightdb/tool/spectra_command.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <ostream>
#include <string_view>

#include "glare/colour/named_spectra.h"
#include "lightdb/colreg_regions.h"
#include "lightdb/json/writer.h"
#include "lightdb/lamp_choice.h"
#include "lightdb/spectrum_file.h"
#include "lightdb/tool/guarded.h"

namespace seaglare::lights_tool {
namespace {

using glare::Chromaticity;
using lightdb::Colour;
using lightdb::LampChoice;

constexpr std::string_view colour_names[] = {"white", "red", "green", "yellow"};

struct Lamp {
    std::string source;
    std::string filter;
    Chromaticity xy;
    double scotopic_per_photopic = 0;
    // A tenth, half and nine tenths of its luminous flux lie below.
    std::array<double, 3> flux_nm{};
    std::string nearest;
    double distance_nm = 0;
    std::string colreg;  // the colour whose region it lies in; empty: none
};

double wavelength_of_flux(const glare::LampSpectrum& lamp, double share) {
    const auto& flux = lamp.flux_up_to();
    const auto reached = std::lower_bound(flux.begin(), flux.end(), share);
    return glare::cie_first_wavelength_nm +
           static_cast<double>(std::min(reached, flux.end() - 1) - flux.begin());
}

Lamp describe(const LampChoice& choice, lightdb::LampShelf& shelf) {
    const glare::LampSpectrum& spectrum = *shelf.lamp(choice);
    Lamp lamp;
    lamp.source = choice.source;
    lamp.filter = choice.filter;
    const auto& colour = spectrum.colour();
    lamp.xy = glare::chromaticity_of(
        glare::xyz_from_srgb({static_cast<double>(colour.rgb[0]), static_cast<double>(colour.rgb[1]),
                              static_cast<double>(colour.rgb[2])}));
    lamp.scotopic_per_photopic = static_cast<double>(colour.scotopic_per_photopic);
    lamp.flux_nm = {wavelength_of_flux(spectrum, 0.1), wavelength_of_flux(spectrum, 0.5),
                    wavelength_of_flux(spectrum, 0.9)};
    lamp.distance_nm = std::numeric_limits<double>::infinity();
    for (const std::string_view name : glare::spectrum_names()) {
        if (name == choice.source && choice.filter.empty()) continue;  // of a named lamp: the next
        const double distance = glare::spectral_distance_nm(*shelf.lamp({std::string(name), ""}), spectrum);
        if (distance >= lamp.distance_nm) continue;
        lamp.distance_nm = distance;
        lamp.nearest = name;
    }
    for (std::size_t c = 0; c < std::size(colour_names); ++c) {
        if (lightdb::inside_region(lightdb::colreg_region(static_cast<Colour>(c)), lamp.xy))
            lamp.colreg = colour_names[c];
    }
    return lamp;
}

std::string fixed(double value, int digits) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.*f", digits, value);
    return text.data();
}

std::string name_of(const Lamp& lamp) {
    return lamp.filter.empty() ? lamp.source : lamp.source + " + " + lamp.filter;
}

void write_text(std::ostream& out, const std::vector<Lamp>& lamps) {
    std::size_t width = 8;
    for (const Lamp& lamp : lamps)
        width = std::max(width, name_of(lamp).size());
    const auto cell = [&](const std::string& text, std::size_t columns) {
        out << text << std::string(columns > text.size() ? columns - text.size() : 0, ' ') << "  ";
    };
    cell("lamp", width);
    out << "x       y       S/P     flux nm (10 50 90 %)  nearest lamp             COLREG\n";
    for (const Lamp& lamp : lamps) {
        cell(name_of(lamp), width);
        cell(fixed(lamp.xy.x, 4), 6);
        cell(fixed(lamp.xy.y, 4), 6);
        cell(fixed(lamp.scotopic_per_photopic, 3), 6);
        cell(fixed(lamp.flux_nm[0], 0) + " " + fixed(lamp.flux_nm[1], 0) + " " + fixed(lamp.flux_nm[2], 0),
             20);
        cell(lamp.nearest + ", " + fixed(lamp.distance_nm, 1) + " nm", 23);
        out << (lamp.colreg.empty() ? "-" : lamp.colreg) << "\n";
    }
}

void write_json(std::ostream& out, const std::vector<Lamp>& lamps) {
    json::Writer writer;
    writer.begin_array();
    for (const Lamp& lamp : lamps) {
        writer.begin_object();
        writer.member("source", lamp.source);
        if (!lamp.filter.empty()) writer.member("filter", lamp.filter);
        writer.member("x", lamp.xy.x);
        writer.member("y", lamp.xy.y);
        writer.member("scotopic_per_photopic", lamp.scotopic_per_photopic);
        writer.key("flux_nm");
        writer.begin_array(json::Writer::Layout::line);
        for (const double nm : lamp.flux_nm)
            writer.value(nm);
        writer.end_array();
        writer.member("nearest", lamp.nearest);
        writer.member("nearest_distance_nm", lamp.distance_nm);
        if (!lamp.colreg.empty()) writer.member("colreg", lamp.colreg);
        writer.end_object();
    }
    writer.end_array();
    out << writer.take();
}

// Every name, and the glasses before the lamp that they are made for.
std::vector<LampChoice> everything(const std::string& filter) {
    std::vector<LampChoice> choices;
    for (const std::string_view name : glare::spectrum_names())
        choices.push_back({std::string(name), filter});
    if (!filter.empty()) return choices;
    for (const std::string_view glass : glare::filter_names())
        choices.push_back({"a", std::string(glass)});
    return choices;
}

// A table that says that it is a glass's is one, and stands before the lamp that glasses are made for.
bool is_glass(const std::string& name) {
    return lightdb::is_spectrum_table_name(name) &&
           lightdb::load_spectrum_table(name).quantity == lightdb::SpectralQuantity::transmittance;
}

}  // namespace

int list_spectra(const SpectraRequest& request, std::ostream& out, std::ostream& err) {
    std::vector<LampChoice> choices;
    int status = 0;
    if (request.names.empty()) choices = everything(request.filter);
    lightdb::LampShelf shelf;
    std::vector<Lamp> lamps;
    const auto take = [&](const LampChoice& choice) {
        try {
            lamps.push_back(describe(choice, shelf));
            return 0;
        } catch (const lightdb::LampError& error) {
            err << error.what() << "\n";
            return 1;
        }
    };
    for (const LampChoice& choice : choices)
        status = std::max(status, take(choice));
    for (const std::string& name : request.names) {
        const int result = guarded(err, [&] {
            try {
                if (is_glass(name)) return take({"a", name});
            } catch (const lightdb::SpectrumFileError& error) {
                err << error.what() << "\n";
                return 1;
            }
            return take({name, request.filter});
        });
        status = std::max(status, result);
    }
    if (request.json) {
        write_json(out, lamps);
    } else if (!lamps.empty()) {
        write_text(out, lamps);
    }
    return status;
}

}  // namespace seaglare::lights_tool
