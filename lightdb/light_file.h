// The light files that operators and importers write: JSON with the keys below, errors as FILE:LINE:COL: text.
//
//     { "origin": {"lat": 55.3, "lon": 11.0},          where the scene of local positions lies; optional
//       "source": "NGA Pub. 116 (2024)",                of every light that names none of its own
//       "include": ["bridge.json"],                     other light files, relative to this one
//       "lights": [ { "name": "Halskov Rev",
//         "lat": 55.33, "lon": 11.03, "height_m": 14,   or "position": [east_m, north_m, up_m]
//         "character": "Fl(2) WRG 10s",                 chart notation
//         "phases": [{"lit": 0.5, "colour": "R"}, {"eclipse": 2.5}],  seconds; instead of it, or beside it to be exact
//         "nominal_range_nm": {"W": 12, "R": 9},        by night at 10 nm visibility; or "intensity_cd"; a number or per colour
//         "sectors": [{"colour": "R", "from": 259, "to": 292}],  true bearings from seaward; null: obscured
//         "sector_reference": "from_seaward",           or "outward_from_ahead", for ships
//         "vertical_profile": "sabik_vp",               or {"angle_deg": [...], "factor": [...]}
//         "radius_m": 0.05, "spectrum": "led_white", "body": 7, "day": "off", "true_north_deg": 0,
//         "orientation": [0, 0, 0, 1], "sync_group": "leading line", "source": "…" } ] }
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightdb/geodesy.h"
#include "lightdb/json/value.h"
#include "lightdb/light.h"

namespace seaglare::lightdb {

struct LightFile {
    std::optional<GeographicPoint> origin;
    std::string source;
    std::vector<Light> lights;          // geographic ones are not placed yet: see place_lights()
    std::vector<std::string> warnings;  // FILE:LINE:COL: text, of what was read but looks odd
};

// Reads a file with all that it includes; a file that is included twice is read once. All or nothing. Throws json::Error
// for what is wrong inside (an include that cannot be read or that includes itself among it), std::system_error when
// `path` cannot be read.
LightFile load_light_file(const std::string& path);

// The same from text; `file` is its name in messages, and includes are looked for beside it.
LightFile parse_light_file(std::string_view text, const std::string& file);

// The JSON text of these lights, one file without includes: reading it gives equal lights. Nominal ranges are written as
// the intensities they became. What place_lights() and the store derived is left out: the scene position and true north
// of geographic lights, and what is set at run time.
std::string format_light_file(const LightFile& file);

// Writes it, whole or not at all: to a file beside `path` that is then renamed. Throws std::system_error.
void save_light_file(const LightFile& file, const std::string& path);

// A colour by its letters on charts or its name: "W" or "white", "Bu" or "blue". Nothing when it is neither.
std::optional<Colour> colour_from_name(std::string_view name);

}  // namespace seaglare::lightdb
