// One light of a light file, from its JSON object.
#pragma once

#include <string>
#include <vector>

#include "lightdb/json/value.h"
#include "lightdb/light.h"

namespace seaglare::lightdb {

// Throws json::Error; appends to `warnings` ("FILE:LINE:COL: text").
Light read_light(const json::Value& value, const std::string& default_source,
                 std::vector<std::string>& warnings);

}  // namespace seaglare::lightdb
