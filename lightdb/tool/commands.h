// What `seaglare-lights` does, apart from its command line: each command returns the exit status, prints results to
// `out` and what went wrong to `err`.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "lightdb/import/nga.h"

namespace seaglare::lights_tool {

// 0: done and nothing wrong; 1: the input is wrong; 2: a file could not be read or written.
int validate(const std::vector<std::string>& files, std::ostream& out, std::ostream& err);
int check_json(const std::string& file, std::ostream& err);
int explain_character(const std::string& text, std::ostream& out, std::ostream& err);

struct ImportRequest {
    std::string file;
    lightdb::nga::Area area;
    std::string output;  // empty: to `out`
    std::string report;  // empty: a summary to `err`
    bool show_progress = false;
};
int import_nga(const ImportRequest& request, std::ostream& out, std::ostream& err);

}  // namespace seaglare::lights_tool
