// The LIGHTS objects of an S-57 cell, read by GDAL where the build has it (CMake option SEAGLARE_S57).
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "lightdb/import/s57_light.h"

namespace seaglare::lightdb::s57 {

// The cell cannot be read, or nothing here can read cells. what() says which and what to do.
struct CellError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct Cell {
    std::string name;  // "S-57 cell DK5OSTBT"
    std::vector<Feature> features;
};

// Whether this build reads cells.
bool can_read_cells();

// Any data source that GDAL opens with a layer of points called LIGHTS and S-57's attributes will do: cells (with the
// updates beside them), GeoPackage, GeoJSON. Throws CellError.
Cell read_cell(const std::string& path);

}  // namespace seaglare::lightdb::s57
