// A sector as light files have it. Internal to what writes them.
#pragma once

#include "lightdb/json/writer.h"
#include "lightdb/light.h"

namespace seaglare::lightdb {

// An object on a line of its own; what is as everywhere, a hard edge and all elevations, is left out.
void write_sector(json::Writer& writer, const Sector& sector);

}  // namespace seaglare::lightdb
