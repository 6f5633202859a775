// The light files that operators and importers write: JSON with the keys below, errors as FILE:LINE:COL: text. Every key
// with its limits: config/schema/lights.schema.json.
//
//     { "origin": {"lat": 55.3, "lon": 11.0},          where the scene of local positions lies; optional
//       "source": "NGA Pub. 116 (2024)",                of every light that names none of its own
//       "include": ["bridge.json"],                     other light files, relative to this one
//       "vessels": [ … ],                               their lights by COLREG: vessel_reader.h
//       "buoys": [ … ],                                 with the lights they carry: buoy_reader.h
//       "lights": [ { "name": "Halskov Rev",
//         "lat": 55.33, "lon": 11.03, "height_m": 14,   or "position": [east_m, north_m, up_m]
//         "character": "Fl(2) WRG 10s",                 chart notation
//         "phases": [{"lit": 0.5, "colour": "R"}, {"eclipse": 2.5}],  seconds; instead of it, or beside it, in its colours
//                                                       unless they name their own, to be exact
//         "sync_group": "leading line", "delay_s": 0.5, begins its period that much later than its group
//         "sigseq": "00.8+(02.2)",                      the same as S-57 writes it; in the character's colour
//         "rise_s": 0.3, "fall_s": 0.4,                 seconds until the lamp has come 90 % of the way
//         "nominal_range_nm": {"W": 12, "R": 9},        by night at 10 nm visibility; or "intensity_cd"; a number or per colour
//         "day_range_nm": {"W": 3},                     by day (1e-3 lx); or "day_intensity_cd"; or "day": "off"
//         "sectors": [{"colour": "R", "from": 259, "to": 292, "transition_deg": 1,  true bearings from seaward; null: obscured
//                      "from_elevation": -5, "to_elevation": 5}],
//         "sector_reference": "from_seaward",           or "outward_from_ahead", for ships
//         "leading_bearing_deg": 275.5,                 of the leading line or the direction light
//         "horizontal_profile": {"angle_deg": [...], "factor": [...]},  from ahead, clockwise
//         "vertical_profile": "sabik_vp",               or a table
//         "photometry": "lantern.ies",                  measured: LM-63 or EULUMDAT, relative to this file
//         "rotation": {"period_s": 20, "beams": 2, "width_deg": 1.5},  or "beam": a table; "direction": "anticlockwise"
//         "spectrum": {"W": "led_white", "R": "lamp.spdx", "G": {"source": "a", "filter": "green"}},  or one lamp: lamp_choice.h
//         "radius_m": 0.05, "body": 7, "true_north_deg": 0, "orientation": [0, 0, 0, 1],
//         "phase_key": "0123456789abcdef",              of whose rhythm the phase is, if not the light's own; as saved
//         "source": "…" } ] }
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightdb/buoy.h"
#include "lightdb/geodesy.h"
#include "lightdb/json/value.h"
#include "lightdb/light.h"

namespace seaglare::lightdb {

struct LightFile {
    std::optional<GeographicPoint> origin;
    std::string source;
    std::vector<Light> lights;  // geographic ones are not placed yet: see place_lights()
    std::vector<Buoy> buoys;    // whose bodies some of the lights stand on; likewise: see place_buoy()
    std::vector<std::string> warnings;  // FILE:LINE:COL: text, of what was read but looks odd
};

// Reads a file with all that it includes; a file that is included twice is read once. All or nothing. Throws json::Error
// for what is wrong inside (an include that cannot be read or that includes itself among it), std::system_error when
// `path` cannot be read.
LightFile load_light_file(const std::string& path);

// The same from text; `file` is its name in messages, and includes are looked for beside it.
LightFile parse_light_file(std::string_view text, const std::string& file);

// All that is wrong with a file, for its author: goes on where loading ends at the first mistake.
struct LightFileCheck {
    std::vector<std::string> errors;    // FILE:LINE:COL: text; at most Mistakes::most_collected
    std::vector<std::string> warnings;  // likewise, of the parts that could be read
    std::size_t light_count = 0;        // of lights without a mistake
    bool complete = true;               // false: there are more errors than are kept
};
// Throws std::system_error when `path` itself cannot be read.
LightFileCheck check_light_file(const std::string& path);

// The JSON text of these lights, one file without includes: reading it gives equal lights, and writing those the same
// text. Intensities that are those of a nominal range of up to six decimals to the last bit are written as that range,
// others in candela; tables that have a name by it, photometric files as paths from `folder` (empty: the working folder).
// Vessels stand there as the lights that they became. What place_lights() and the store derived is left out: the scene
// position and true north of geographic lights, and what is set at run time.
std::string format_light_file(const LightFile& file, const std::string& folder = "");

// Writes it, whole or not at all: to a file beside `path` that is then renamed. Before that the text is read back: throws
// json::Error, naming `path` and the place in it, when a light holds what no file may (an intensity above 1e8 cd, say).
// Throws std::system_error when it cannot be written.
void save_light_file(const LightFile& file, const std::string& path);

// One name for each file, whatever path leads to it: canonical, as far as it exists.
std::string file_identity(const std::string& path);

// A colour by its letters on charts or its name: "W" or "white", "Bu" or "blue". Nothing when it is neither.
std::optional<Colour> colour_from_name(std::string_view name);

}  // namespace seaglare::lightdb
