// The extension table "seaglare.lights/1" of seaglare.h.
#pragma once

#include "plugin_api/seaglare.h"

namespace seaglare::plugin {

extern const seaglare_lights_api lights_api;

}  // namespace seaglare::plugin
