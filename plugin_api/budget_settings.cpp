#include "plugin_api/budget_settings.h"

#include <string>

namespace seaglare::plugin {

namespace {

// Costs that are not named keep their default: what is pinned is the whole list.
glare::DeviceCosts read_device_costs(json::ObjectReader& reader) {
    glare::DeviceCosts costs;
    costs.pinned = true;
    for (std::size_t i = 0; i < glare::work_kinds; ++i) {
        const auto work = static_cast<glare::Work>(i);
        const std::string key = std::string(glare::name_of(work)) + "_ns";
        costs.of(work) = reader.number(key, 0, 1e12, costs.of(work));
    }
    return costs;
}

}  // namespace

void read_budget(json::ObjectReader& quality, bool had_threshold, Settings& settings) {
    if (auto child = quality.optional_object("budget")) {
        if (had_threshold && child->has("max_error_codes")) {
            throw child->require("max_error_codes")
                .error("max_error_codes beside tone.threshold_codes, its older name: give one of the two");
        }
        glare::Budget& budget = settings.budget;
        budget.max_error_codes = child->number("max_error_codes", 0, 16, budget.max_error_codes);
        budget.time_ms = child->number("time_ms", 0, 1000, budget.time_ms);
        budget.most_error_codes = child->number("most_error_codes", 0, 64, budget.most_error_codes);
        child->finish();
    }
    if (auto child = quality.optional_object("device_costs")) {
        settings.pinned_costs = read_device_costs(*child);
        child->finish();
    }
}

}  // namespace seaglare::plugin
