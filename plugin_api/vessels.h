// The extension tables for what floats: "seaglare.vessels/1" and "seaglare.waves/1" of seaglare.h.
#pragma once

#include "plugin_api/seaglare.h"

namespace seaglare::plugin {

extern const seaglare_vessels_api vessels_api;
extern const seaglare_waves_api waves_api;

}  // namespace seaglare::plugin
