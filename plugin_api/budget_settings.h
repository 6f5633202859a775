// "budget" and "device_costs" of a quality file.
#pragma once

#include "lightdb/json/reader.h"
#include "plugin_api/settings.h"

namespace seaglare::plugin {

// `had_threshold`: the file has tone.threshold_codes, the older name of budget.max_error_codes, which is then in
// settings.budget already. Throws json::Error, also when the file has both.
void read_budget(json::ObjectReader& quality, bool had_threshold, Settings& settings);

}  // namespace seaglare::plugin
