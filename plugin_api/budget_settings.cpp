#include "plugin_api/budget_settings.h"

#include <algorithm>
#include <string>
#include <vector>

namespace seaglare::plugin {

namespace {

std::string key_of(glare::Work work) {
    return std::string(glare::name_of(work)) + "_ns";
}

// With the whole list: a file that names work there is no longer is helped by no name that resembles it.
void throw_if_unknown(const json::Value& costs) {
    std::vector<std::string> known = {"$schema"};
    std::string list;
    for (std::size_t i = 0; i < glare::work_kinds; ++i) {
        known.push_back(key_of(static_cast<glare::Work>(i)));
        list += (i == 0 ? "'" : ", '") + known.back() + "'";
    }
    for (const json::Member& member : costs.object()) {
        if (std::find(known.begin(), known.end(), member.name()) != known.end()) continue;
        throw member.key().error("unknown key '" + std::string(member.name()) +
                                 "' in 'device_costs', which may have: " + list);
    }
}

// Costs that are not named keep their default: what is pinned is the whole list.
glare::DeviceCosts read_device_costs(json::ObjectReader& reader) {
    glare::DeviceCosts costs;
    costs.pinned = true;
    for (std::size_t i = 0; i < glare::work_kinds; ++i) {
        const auto work = static_cast<glare::Work>(i);
        costs.of(work) = reader.number(key_of(work), 0, 1e12, costs.of(work));
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
        throw_if_unknown(quality.require("device_costs"));
        settings.pinned_costs = read_device_costs(*child);
    }
}

}  // namespace seaglare::plugin
