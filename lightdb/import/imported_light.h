// One light as an importer hands it over: facts as its source has them, in SI; what was chosen where the source is
// silent stands in `notes` and, in the light file, in the light's "source".
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lightdb/light.h"

namespace seaglare::lightdb {

struct ImportedLight {
    std::string name;
    double latitude_deg = 0;
    double longitude_deg = 0;
    double height_m = 0;        // above high water
    double radius_m = 0;        // of the lantern, by range: no source gives it
    std::string character;      // chart notation, with the durations the source gives; empty: see phases
    std::vector<Phase> phases;  // only for rhythms that the notation cannot write
    std::vector<std::pair<Colour, double>> nominal_range_nm;
    std::vector<Sector> sectors;                // true bearings from seaward
    std::optional<double> leading_bearing_deg;  // likewise: of the leading line, or of a direction light
    std::string sync_group;
    bool all_day = false;  // shown by day, too
    std::string source;    // "NGA Pub. 116 (2016/08), 3690 / C1532.603"
    std::vector<std::string> notes;
};

// What no list gives, and all importers assume alike.
inline constexpr double assumed_height_m = 5;       // the commonest in NGA Pub. 116
inline constexpr double assumed_range_nm = 3;       // small lights of harbours, where most of them stand
inline constexpr double assumed_dim_factor = 0.25;  // of an unintensified sector's intensity
inline constexpr double faint_factor = 0.05;        // "faintly visible"
inline constexpr double line_half_width_deg = 3;    // visible on a leading line only: a narrow lens
inline constexpr double lamp_spacing_m = 1;         // between lamps above each other
// The most that a light file takes: beyond it a figure is a slip of the pen.
inline constexpr double highest_m = 1000;
inline constexpr double farthest_nm = 38;

// Lanterns by nominal range: LED lanterns, small lenses, lighthouse lenses.
double lantern_radius_m(double range_nm);

// Rounded to what sources state: 1e-7 degrees of position, 1e-4 of bearing in [0, 360), thousandths of a factor.
double tidy_position_deg(double value);
double tidy_bearing_deg(double value);
double tidy_factor(double factor);

// "8" or "5.5".
std::string plain_number(double value);

// A light file of these lights, stable to the byte. `source` is the file's own.
std::string imported_light_file_text(std::span<const ImportedLight> lights, std::string_view source);

}  // namespace seaglare::lightdb
