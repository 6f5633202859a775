// OpenSeaMap: the seamark:light:* tags of OpenStreetMap elements in OSM JSON, as the Overpass API answers it
// ({"elements": [{"type": "node", "id": 1, "lat": 54, "lon": 11, "tags": {"seamark:light:character": "Fl"}}]}). Tags as in
// the OpenStreetMap wiki, pages Seamarks/Lights and Seamarks/Sectored and Directional Lights.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "lightdb/import/imported_light.h"
#include "lightdb/json/value.h"

namespace seaglare::lightdb::osm {

// What became of one element that has seamark:light:* tags, or that calls itself a light.
struct ElementReport {
    std::string id;  // "node 123"
    std::string name;
    bool imported = false;
    std::string reason;               // why not
    std::vector<std::string> doubts;  // what was not understood or contradicts itself
    std::size_t first_light = 0;      // into Import::lights
    std::size_t light_count = 0;
};

struct Import {
    std::vector<ImportedLight> lights;
    std::vector<ElementReport> records;
    std::size_t elements = 0;  // of the file, those without a light among them
};

// Throws json::Error when the document is no OSM JSON. Elements are never a reason to throw.
Import import_elements(const json::Value& root, std::string_view file);

std::string light_file_text(const Import& import);

}  // namespace seaglare::lightdb::osm
