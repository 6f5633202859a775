// The one exported symbol.
#include "plugin_api/api.h"
#include "plugin_api/seaglare.h"

seaglare_result SEAGLARE_CALL seaglare_get_api(uint32_t abi_major, seaglare_api* api) {
    return seaglare::plugin::fill_api(abi_major, api);
}
