// A buoy of a light file, from its JSON object, with the lights it carries.
//
//     "buoys": [ { "name": "Halskov Rev S",
//         "lat": 55.33, "lon": 11.03,                   or "position": [east_m, north_m] of the scene
//         "focal_height_m": 4,                          else that of its highest light
//         "heave_period_s": 2.8, "heave_damping": 0.3,  natural period, share of the critical damping; else by its height
//         "roll_period_s": 4, "roll_damping": 0.1, "max_tilt_deg": 60,
//         "body": 12,                                   for a host that moves it itself; else a number is made up
//         "lights": [ { "name": "Halskov Rev S", "position": [0, 0, 4], "character": "Q(6)+LFl 15s", … } ] } ]
//
// The lights are those of light_file.h, in the buoy's frame: x east, y north, z up its mast, from its waterline.
#pragma once

#include <string>
#include <vector>

#include "lightdb/buoy.h"
#include "lightdb/json/value.h"
#include "lightdb/json/writer.h"
#include "lightdb/light.h"
#include "lightdb/light_reader.h"
#include "lightdb/mistakes.h"

namespace seaglare::lightdb {

// Bodies that no file and no host has numbered: a buoy without "body" gets one from here up, by its name and place.
inline constexpr std::uint32_t first_made_up_body = 0x80000000U;

struct BuoyWithLights {
    Buoy buoy;  // a geographic one is not placed yet: place_buoy()
    std::vector<Light> lights;
};

// Throws json::Error for what is wrong with the buoy itself; mistakes in its lights go to `mistakes`, as read_light() says.
// Appends to `warnings` ("FILE:LINE:COL: text").
BuoyWithLights read_buoy(const json::Value& value, const std::string& default_source, LightFolder& folder,
                         Mistakes& mistakes, std::vector<std::string>& warnings);

// The buoy as an object that read_buoy() takes, without its lights: those name its body.
void write_buoy(json::Writer& writer, const Buoy& buoy);

}  // namespace seaglare::lightdb
