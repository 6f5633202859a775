// The seamark:light:* tags of one OpenStreetMap element as charted lights. Internal to lightdb/import/osm*.cpp.
#pragma once

#include <string>
#include <vector>

#include "lightdb/import/charted_light.h"
#include "lightdb/json/value.h"

namespace seaglare::lightdb::osm {

struct TaggedLights {
    std::vector<ChartedLight> lights;  // the unnumbered one first, then by number
    std::vector<std::string> doubts;
    std::vector<std::string> left_out;  // "light 2: extinguished"
};

// `tags` is the element's object of strings.
TaggedLights read_tags(const json::Value& tags);

// Whether any tag is of a light.
bool has_light_tags(const json::Value& tags);

// The text of a tag; empty where it is missing or no text.
std::string tag(const json::Value& tags, std::string_view key);

}  // namespace seaglare::lightdb::osm
