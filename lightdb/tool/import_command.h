// `seaglare-lights import`: light files from published lists. Every record is imported or stands in the report with its
// reason; after every import, lint looks over the lights.
#pragma once

#include <iosfwd>
#include <string>

#include "lightdb/import/nga.h"

namespace seaglare::lights_tool {

struct ImportRequest {
    std::string file;
    lightdb::nga::Area area;  // NGA only
    std::string output;       // empty: to `out`
    std::string report;       // empty: a summary to `err`
    bool show_progress = false;
};

// 0: done, whatever lint found; 1: the input is wrong; 2: a file could not be read or written.
int import_nga(const ImportRequest& request, std::ostream& out, std::ostream& err);
int import_osm(const ImportRequest& request, std::ostream& out, std::ostream& err);
int import_s57(const ImportRequest& request, std::ostream& out, std::ostream& err);

}  // namespace seaglare::lights_tool
