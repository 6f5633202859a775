// The reader of builds without GDAL: it says how to get one.
#include "lightdb/import/s57.h"

namespace seaglare::lightdb::s57 {

bool can_read_cells() {
    return false;
}

Cell read_cell(const std::string& path) {
    throw CellError(
        "cannot read '" + path +
        "': this build has no reader of S-57 cells. Install libgdal-dev (the packages of group s57 in "
        "scripts/packages.txt), configure with -DSEAGLARE_S57=ON and build again.");
}

}  // namespace seaglare::lightdb::s57
