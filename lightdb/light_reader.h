// One light of a light file, from its JSON object.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lightdb/json/value.h"
#include "lightdb/lamp_choice.h"
#include "lightdb/light.h"
#include "lightdb/mistakes.h"

namespace seaglare::lightdb {

// Where a light file lies, and what lies beside it and was read already: lights share photometric solids and spectra.
struct LightFolder {
    std::string path;
    std::map<std::string, SharedSolid> solids;  // by the name in the light file
    LampShelf lamps{};
};

// Every key that a light may have.
std::span<const std::string_view> light_keys();

// Reads one light into `light`, which is new. Its mistakes go to `mistakes`: the first ends the reading with a json::Error,
// or each part that can be read is, and the mistakes of all are collected. False: there were some, and the light is not to
// be used. Appends to `warnings` ("FILE:LINE:COL: text").
bool read_light(const json::Value& value, const std::string& default_source, LightFolder& folder,
                Mistakes& mistakes, std::vector<std::string>& warnings, Light& light);

}  // namespace seaglare::lightdb
