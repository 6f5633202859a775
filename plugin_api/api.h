// The function table behind seaglare_get_api.
#pragma once

#include "plugin_api/seaglare.h"

namespace seaglare::plugin {

seaglare_result fill_api(uint32_t abi_major, seaglare_api* api) noexcept;

}  // namespace seaglare::plugin
