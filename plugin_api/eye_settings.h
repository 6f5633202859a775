// An eye file, config/eye/*.json, as the model that glare takes. config/schema/eye.schema.json describes the same.
#pragma once

#include "glare/eye/eye_model.h"
#include "lightdb/json/value.h"

namespace seaglare::plugin {

// Keys that are left out keep what `eye` has; an unknown key is an error. Throws json::Error with line and column.
glare::EyeModel read_eye(const json::Value& value, glare::EyeModel eye);

}  // namespace seaglare::plugin
